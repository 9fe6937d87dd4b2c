#include <cstdio>

#include "app/app.h"
#include "eval/check/check_folder.h"

namespace app {
namespace {

int RunCheck(const std::string& folder, bool deep, bool quiet) {
  const eval::CheckReport report = eval::CheckFolder(folder, deep);
  for (const eval::Fault& fault : report.faults) {
    std::fprintf(stderr, "%s\n", eval::Describe(fault).c_str());
  }
  if (report.faults.empty()) {
    if (!quiet) {
      std::printf("%s %s: %d files, %d frames, no faults\n", report.kind.c_str(),
                  folder.c_str(), report.files, report.frames);
    }
    return kDone;
  }
  std::fprintf(stderr, "pas check: %s: %zu fault%s in %d files, %d frames\n", folder.c_str(),
               report.faults.size(), report.faults.size() == 1 ? "" : "s", report.files,
               report.frames);
  return kBadInput;
}

}  // namespace

void AddCheckCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* check = pas.add_subcommand(
      "check",
      "Validates a sequence or a run folder against the format and lists every fault with its\n"
      "file, line (or JSON pointer), what was expected and how to mend it. A sequence with\n"
      "truth is also checked against itself: counts and boxes against the id images, file\n"
      "hashes, and every depth image against the depth that poses and planes predict.\n"
      "Exit code 0 when there is no fault, 2 when there is one.");
  auto folder = std::make_shared<std::string>();
  check->add_option("FOLDER", *folder, "SEQ or RUN; which of the two is seen from its files")
      ->required()
      ->type_name("DIR");
  auto deep = std::make_shared<bool>(false);
  check->add_flag(
      "--deep", *deep,
      "Also, on up to 24 frames with truth: ids against the outlines of the faces,\n"
      "depth against the poses of the frames before and after, and two views warped\n"
      "into each other by the written poses");
  check->callback([folder, deep, &globals, &exit_code] {
    exit_code = RunCheck(*folder, *deep, globals.quiet);
  });
}

}  // namespace app
