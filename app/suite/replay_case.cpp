#include "app/suite/replay_case.h"

#include <fmt/core.h>
#include <sys/wait.h>

#include <cstdlib>

#include "io/input_error.h"

namespace app {

int ReplayCase(const SuiteCase& one, const SuiteProgram& program,
               const std::filesystem::path& folder, bool quiet) {
  const std::string line = CommandLines({{"cd", folder.string()}}) + " && " +
                           CommandLines(CommandsOf(one, program.file.string(), "replay"));
  if (!quiet) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }
  const int status = std::system(line.c_str());
  if (status == -1) throw io::InputError("the system", "no process can be made; try again");
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace app
