#include "app/app.h"

namespace app {

void AddSimCommand(CLI::App& pas, const Globals&, int&) { pas.add_subcommand("sim", ""); }

}  // namespace app
