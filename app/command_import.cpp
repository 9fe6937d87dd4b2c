#include <fmt/core.h>

#include "app/app.h"
#include "app/console/console.h"
#include "app/import/import_folder.h"
#include "app/import/imported_files.h"
#include "io/folder_kind.h"
#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/output_folder.h"
#include "io/path_type.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"

namespace app {
namespace {

/// Frames a second, by the first and the last stamp; `otherwise` where these are of one frame.
double RateOf(const slam::SequenceReader& reader, double otherwise) {
  const int last = reader.size() - 1;
  return last > 0 ? last / (reader.entry(last).timestamp_s - reader.entry(0).timestamp_s)
                  : otherwise;
}

int ImportBag(const ImportArguments& arguments, bool quiet) {
  io::OutputFolder folder(arguments.output, kImportedFrom, arguments.force);
  slam::Camera camera = slam::ChooseCamera(arguments.camera, arguments.recording).camera;
  slam::SequenceReader reader(arguments.recording, camera);
  camera.fps = RateOf(reader, camera.fps);
  ImportedFiles files(folder, camera);
  Progress progress("import", reader.size(), quiet);
  for (int i = 0; i < reader.size(); ++i) {
    const slam::SequenceEntry& entry = reader.entry(i);
    const slam::RecordedFrame frame = reader.Read(i);
    files.Add(entry.timestamp_s, io::EncodePng(frame.bgr), ".png", entry.depth_timestamp_s,
              frame.depth_m);
    progress.Update(i + 1);
  }
  files.Finish(std::filesystem::path(arguments.recording).filename().string());
  folder.Commit();
  for (const std::string& warning : reader.warnings()) PrintWarning(warning);
  WarnOfFarDepth(files, camera.depth_factor);
  if (!quiet) fmt::print("{}: {} frames\n", arguments.output, reader.size());
  return kDone;
}

int RunImport(const ImportArguments& arguments, bool quiet) {
  const std::string& recording = arguments.recording;
  if (io::TypeAt(recording) == std::filesystem::file_type::not_found) {
    throw io::InputError(recording,
                         "no such file; expected a bag of ROS 1, RECORDING.bag, or a sequence "
                         "folder with --depth-registration");
  }
  if (io::TypeAt(recording) == std::filesystem::file_type::regular &&
      !io::IsBagFile(recording)) {
    throw io::InputError(
        recording,
        "is no bag of ROS 1; expected RECORDING.bag (docs/cameras.md says how to "
        "convert other recordings)");
  }
  io::RequireRecording(recording);
  const bool bag = io::IsBagFile(recording), registered = !arguments.registration.empty();
  if (!bag && !registered) {
    throw io::InputError(recording,
                         "is a sequence already; give it to `pas slam` as it is, or name the "
                         "two cameras with --depth-registration FILE where its depth does not "
                         "lie on colour (docs/cameras.md)");
  }
  if (bag && registered) {
    throw io::InputError(recording,
                         "is a bag, and --depth-registration is for folders; import the bag "
                         "first, then its folder with --depth-registration");
  }
  if (arguments.force) {
    std::error_code ignored;  // tum1 is a word, and a folder may be called so
    const bool file = std::filesystem::is_regular_file(arguments.camera, ignored);
    io::RefuseInputsInside(arguments.output,
                           {recording, arguments.registration, file ? arguments.camera : ""});
  }
  return bag ? ImportBag(arguments, quiet) : ImportFolder(arguments, quiet);
}

}  // namespace

void AddImportCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand(
      "import",
      "Make a sequence folder of what is none yet: of a bag of ROS 1, for the commands that\n"
      "read files (pas draw, pas surfaces, pas check; `pas slam` and `pas calibrate` read a "
      "bag\n"
      "as it is), or of a folder whose depth does not lie on colour, with "
      "--depth-registration.");
  auto arguments = std::make_shared<ImportArguments>();
  command->add_option("RECORDING", arguments->recording, "RECORDING.bag, or a sequence folder")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Sequence folder to write; it is there whole or not at all")
      ->required()
      ->type_name("DIR");
  command->add_option("--camera", arguments->camera,
                      "As of pas slam: tum1 | tum2 | tum3 | a file; default: the CameraInfo of "
                      "the bag, camera.yaml of the folder");
  command->add_option("--depth-registration", arguments->registration,
                      "Of a folder: file of the depth camera, the colour camera and how they "
                      "stand to each other; depth is laid on colour (docs/surfaces.md)");
  command->add_flag("--force", arguments->force, "Replace an older import");
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = RunImport(*arguments, globals.quiet); });
}

}  // namespace app
