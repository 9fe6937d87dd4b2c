#include "app/import/import_folder.h"

#include <fmt/core.h>

#include <filesystem>

#include "app/app.h"
#include "app/console/console.h"
#include "app/import/imported_files.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/surfaces/depth_views.h"
#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/input/camera_reader.h"

namespace app {
namespace {

namespace fs = std::filesystem;

/// The colour camera of the registration; what it does not say is of the recording's camera.
slam::Camera ColourCamera(const eval::Camera& colour, slam::Camera camera) {
  camera.width = colour.width, camera.height = colour.height;
  camera.fx = colour.fx, camera.fy = colour.fy;
  camera.cx = colour.cx, camera.cy = colour.cy;
  const auto& k = colour.distortion;
  camera.k1 = k[0], camera.k2 = k[1], camera.p1 = k[2], camera.p2 = k[3], camera.k3 = k[4];
  return camera;
}

void RequireColourSize(const fs::path& file, const eval::Camera& colour,
                       const std::string& registration) {
  const cv::Size size = eval::ReadColour(file).size();
  if (size == cv::Size(colour.width, colour.height)) return;
  throw io::InputError(
      file.string(),
      fmt::format("is {} x {}, but `colour` of {} is {} x {}; give it the size "
                  "and the camera of the images",
                  size.width, size.height, registration, colour.width, colour.height));
}

}  // namespace

int ImportFolder(const ImportArguments& arguments, bool quiet) {
  const eval::DepthRegistration registration =
      eval::ReadDepthRegistration(arguments.registration);
  const slam::Camera camera = ColourCamera(
      registration.colour, slam::ChooseCamera(arguments.camera, arguments.recording).camera);
  const eval::Sequence sequence = eval::ReadSequence(arguments.recording);
  io::OutputFolder folder(arguments.output, kImportedFrom, arguments.force);
  ImportedFiles files(folder, camera);
  const int count = static_cast<int>(sequence.frames.size());
  Progress progress("import", count, quiet);
  int done = 0;
  for (const eval::SequenceFrame& frame : sequence.frames) {
    const fs::path colour = sequence.folder / frame.rgb;
    RequireColourSize(colour, registration.colour, arguments.registration);
    files.Add(frame.stamp_s, io::ReadFile(colour), colour.extension().string(),
              frame.depth_stamp_s,
              eval::ReadDepthOnColour(sequence.folder, frame, camera.depth_factor,
                                      registration.depth, registration));
    progress.Update(++done);
  }
  for (const char* name : {"groundtruth.txt", "detections.jsonl"}) {
    const fs::path file = sequence.folder / name;
    if (fs::exists(file)) folder.Write(name, io::ReadFile(file));
  }
  files.Finish(fs::absolute(arguments.recording).lexically_normal().string());
  folder.Commit();
  WarnOfFarDepth(files, camera.depth_factor);
  if (!quiet) fmt::print("{}: {} frames\n", arguments.output, count);
  return kDone;
}

}  // namespace app
