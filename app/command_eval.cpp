#include "app/app.h"

namespace app {

void AddEvalCommand(CLI::App& pas, const Globals&, int&) { pas.add_subcommand("eval", ""); }

}  // namespace app
