#include "app/app.h"

namespace app {

void AddDrawCommand(CLI::App& pas, const Globals&, int&) { pas.add_subcommand("draw", ""); }

}  // namespace app
