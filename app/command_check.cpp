#include "app/app.h"

namespace app {

void AddCheckCommand(CLI::App& pas, const Globals&, int&) { pas.add_subcommand("check", ""); }

}  // namespace app
