#include "app/app.h"

namespace app {

void AddBenchCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* bench = pas.add_subcommand("bench", "Measure one part of the system by itself");
  bench->require_subcommand(1);
  for (const AddCommand add :
       {AddBenchSim, AddBenchPlanes, AddBenchSlam, AddBenchWarp, AddBenchFactors,
        AddBenchStructure, AddBenchWrongPlanes, AddBenchEpipolar}) {
    add(*bench, globals, exit_code);
  }
}

}  // namespace app
