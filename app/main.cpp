#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <opencv2/core/utils/logger.hpp>

#include "app/app.h"
#include "app/console/command_line.h"
#include "app/console/failure.h"
#include "app/console/wrapped_help.h"
#include "app/options/number_options.h"
#include "io/input_error.h"
#include "version.h"

namespace {

constexpr const char* kFlow =
    "PAS-SLAM: planar SLAM for ambiguous tabletop scenes, and the scenes to measure it on.\n"
    "\n"
    "  scene.yaml --pas sim--> SEQ --pas slam--> RUN --pas eval--> metrics.json\n"
    "\n"
    "  pas scene  make, list or show a tabletop scene with known planes\n"
    "  pas sim    render it: RGB-D frames, detections, exact truth        -> SEQ\n"
    "  pas import a bag of ROS 1, or depth that does not lie on colour    -> SEQ\n"
    "  pas slam   track the camera and map the planes; never reads truth  -> RUN\n"
    "  pas config print every setting of pas slam, as a file for --config\n"
    "  pas calibrate  how a SEQ's depth camera bends what is flat         -> YAML\n"
    "  pas surfaces   large flat surfaces of a SEQ with camera truth      -> YAML\n"
    "  pas eval   score a run against the truth                           -> metrics.json\n"
    "  pas plot   trajectories, errors, times of runs, for a paper        -> plots\n"
    "  pas suite  run and score many cases, and say what became worse     -> SQLite\n"
    "  pas draw   contact sheet and top view of a run                     -> pictures\n"
    "  pas export a SEQ with truth as COCO or BOP, to train detectors     -> data set\n"
    "  pas check  validate a SEQ or RUN folder, fault by fault\n"
    "  pas vocabulary  train the words by which a lost camera finds its place\n"
    "  pas bench  measure one part by itself\n"
    "  pas help COMMAND  the options of a command\n"
    "\n"
    "Exit codes: 0 done, 1 the result is a failure, 2 bad input or usage, 128 + signal when\n"
    "one stopped it.";

// A line a command, in the order of the data flow.
constexpr app::AddCommand kCommands[] = {
    app::AddSceneCommand,       //
    app::AddSimCommand,         //
    app::AddImportCommand,      //
    app::AddSlamCommand,        //
    app::AddConfigCommand,      //
    app::AddVocabularyCommand,  //
    app::AddCalibrateCommand,   //
    app::AddSurfacesCommand,    //
    app::AddEvalCommand,        //
    app::AddPlotCommand,        //
    app::AddSuiteCommand,       //
    app::AddDrawCommand,        //
    app::AddExportCommand,      //
    app::AddCheckCommand,       //
    app::AddBenchCommand,       //
};

int Run(int argc, char** argv) {
  CLI::App pas(kFlow, "pas");
  pas.set_version_flag("--version", "pas " PAS_VERSION);
  pas.require_subcommand(1);
  pas.fallthrough();
  pas.formatter(
      std::make_shared<app::WrappedHelp>());  // before the commands, which take it over

  app::Globals globals;
  int exit_code = app::kDone;
  pas.add_flag("-q,--quiet", globals.quiet, "No progress, no summary; errors still show");
  for (const app::AddCommand add : kCommands) {
    add(pas, globals, exit_code);
  }
  app::CheckValues(pas);

  std::vector<std::string> arguments = app::ArgumentsOf(argc, argv);
  app::RequireKnownCommands(pas, arguments);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    pas.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return pas.exit(error);  // help, or the version
    throw io::InputError(error.what() + ("; see " + app::CommandName(pas) + " --help"));
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  app::KeepStandardStreams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit of its size is an error of writing
  // What OpenCV would log of a broken image is told in our own words.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    const int code = Run(argc, argv);
    app::FinishOutput();
    return code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pas: %s\n", app::Words(error).c_str());
    return app::kBadInput;
  }
}
