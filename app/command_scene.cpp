#include "app/app.h"

namespace app {

void AddSceneCommand(CLI::App& pas, const Globals&, int&) { pas.add_subcommand("scene", ""); }

}  // namespace app
