#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "app/app.h"
#include "app/console/console.h"
#include "io/folder_kind.h"
#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/output_file.h"
#include "io/output_folder.h"
#include "io/path_type.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"

namespace app {
namespace {

constexpr const char* kFrameList = "associations.txt";
constexpr const char* kOrigin = "imported_from.txt";  // marks a folder of this command

struct ImportArguments {
  std::string bag, output, camera;
  bool force = false;
};

std::string CameraText(const slam::Camera& camera) {
  std::string text = "model: pinhole\n";
  const auto add = [&text](const char* key, double value) {
    text += fmt::format("{}: {}\n", key, io::NumberText(value));
  };
  add("width", camera.width), add("height", camera.height);
  add("fx", camera.fx), add("fy", camera.fy), add("cx", camera.cx), add("cy", camera.cy);
  add("k1", camera.k1), add("k2", camera.k2), add("p1", camera.p1), add("p2", camera.p2);
  add("k3", camera.k3);
  add("depth_factor", camera.depth_factor), add("fps", camera.fps);
  return text;
}

/// Depth as a sequence folder keeps it. What 16 bits do not hold becomes 0.
/// @param too_far  counts it
cv::Mat1w RawDepth(const cv::Mat1f& depth_m, double depth_factor, long& too_far) {
  cv::Mat1w raw(depth_m.size(), std::uint16_t{0});
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double units = std::round(depth_factor * static_cast<double>(depth_m(v, u)));
      const bool fits = units >= 0 && units < std::numeric_limits<std::uint16_t>::max();
      if (fits) raw(v, u) = static_cast<std::uint16_t>(units);
      too_far += !fits;
    }
  }
  return raw;
}

/// Frames a second, by the first and the last stamp; `otherwise` where these are of one frame.
double RateOf(const slam::SequenceReader& reader, double otherwise) {
  const int last = reader.size() - 1;
  return last > 0 ? last / (reader.entry(last).timestamp_s - reader.entry(0).timestamp_s)
                  : otherwise;
}

int RunImport(const ImportArguments& arguments, bool quiet) {
  if (io::TypeAt(arguments.bag) == std::filesystem::file_type::not_found) {
    throw io::InputError(arguments.bag, "no such file; expected a bag of ROS 1, RECORDING.bag");
  }
  if (io::TypeAt(arguments.bag) == std::filesystem::file_type::regular &&
      !io::IsBagFile(arguments.bag)) {
    throw io::InputError(
        arguments.bag,
        "is no bag of ROS 1; expected RECORDING.bag (docs/cameras.md says how to "
        "convert other recordings)");
  }
  io::RequireRecording(arguments.bag);
  if (!io::IsBagFile(arguments.bag)) {
    throw io::InputError(arguments.bag,
                         "is a sequence already; give it to `pas slam` as it is");
  }
  if (arguments.force) {
    std::error_code ignored;  // tum1 is a word, and a folder may be called so
    const bool file = std::filesystem::is_regular_file(arguments.camera, ignored);
    io::RefuseInputsInside(arguments.output, {arguments.bag, file ? arguments.camera : ""});
  }
  io::OutputFolder folder(arguments.output, kOrigin, arguments.force);
  slam::Camera camera = slam::ChooseCamera(arguments.camera, arguments.bag).camera;
  slam::SequenceReader reader(arguments.bag, camera);
  camera.fps = RateOf(reader, camera.fps);
  std::string list, colour_list, depth_list;
  long too_far = 0;
  Progress progress("import", reader.size(), quiet);
  for (int i = 0; i < reader.size(); ++i) {
    const slam::SequenceEntry& entry = reader.entry(i);
    const slam::RecordedFrame frame = reader.Read(i);
    const std::string colour = fmt::format("{0:.6f} rgb/{0:.6f}.png", entry.timestamp_s);
    const std::string depth = fmt::format("{0:.6f} depth/{0:.6f}.png", entry.depth_timestamp_s);
    folder.Write(colour.substr(colour.find(' ') + 1), io::EncodePng(frame.bgr));
    folder.Write(depth.substr(depth.find(' ') + 1),
                 io::EncodePng(RawDepth(frame.depth_m, camera.depth_factor, too_far)));
    list += colour + " " + depth + "\n";
    colour_list += colour + "\n";
    depth_list += depth + "\n";
    progress.Update(i + 1);
  }
  folder.Write("rgb.txt", colour_list);
  folder.Write("depth.txt", depth_list);
  folder.Write("camera.yaml", CameraText(camera));
  folder.Write(kFrameList, list);
  folder.Write(kOrigin, std::filesystem::path(arguments.bag).filename().string() + "\n");
  folder.Commit();
  for (const std::string& warning : reader.warnings()) PrintWarning(warning);
  if (too_far > 0) {
    PrintWarning(fmt::format(
        "{} pixels of depth are left out: 16 bits at {} a metre end at {:.1f} m", too_far,
        camera.depth_factor, std::numeric_limits<std::uint16_t>::max() / camera.depth_factor));
  }
  if (!quiet) fmt::print("{}: {} frames\n", arguments.output, reader.size());
  return kDone;
}

}  // namespace

void AddImportCommand(CLI::App& pas, const Globals& globals, int& exit_code) {
  CLI::App* command = pas.add_subcommand(
      "import",
      "Make a sequence folder of a bag of ROS 1, for the commands that read files: pas draw,\n"
      "pas surfaces, pas check. `pas slam` and `pas calibrate` read a bag as it is.");
  auto arguments = std::make_shared<ImportArguments>();
  command->add_option("BAG", arguments->bag, "RECORDING.bag")->required()->type_name("FILE");
  command
      ->add_option("-o,--output", arguments->output,
                   "Sequence folder to write; it is there whole or not at all")
      ->required()
      ->type_name("DIR");
  command->add_option("--camera", arguments->camera,
                      "As of pas slam: tum1 | tum2 | tum3 | a file; default: the CameraInfo of "
                      "the bag");
  command->add_flag("--force", arguments->force, "Replace an older import");
  command->callback(
      [arguments, &globals, &exit_code] { exit_code = RunImport(*arguments, globals.quiet); });
}

}  // namespace app
