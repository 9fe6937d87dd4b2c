#include "app/app.h"

namespace app {

void AddSlamCommand(CLI::App& pas, const Globals&, int&) { pas.add_subcommand("slam", ""); }

}  // namespace app
