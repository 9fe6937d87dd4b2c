#include "eval/draw/draw_run.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "eval/draw/contact_sheet.h"
#include "eval/draw/error_picture.h"
#include "eval/draw/map_picture.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/output_folder.h"

namespace eval {
namespace fs = std::filesystem;
namespace {

constexpr const char* kContactSheet = "contact_sheet.png";

}  // namespace

std::vector<Picture> DrawRun(const fs::path& folder, const DrawOptions& options) {
  const Run run = ReadRun(folder);
  const fs::path sequence_folder = options.truth ? *options.truth : SequenceOf(run);
  const Sequence sequence = ReadSequence(sequence_folder);
  if (options.warn) {
    for (const std::string& line : Summaries(run.warnings, folder)) options.warn(line);
    for (const std::string& line : Summaries(sequence.warnings, sequence_folder)) {
      options.warn(line);
    }
  }
  const auto camera = ChooseCamera(options.camera, sequence, run);
  if (!camera && run.segmentation_files.empty()) {
    throw io::InputError(sequence_folder.string(),
                         "has no camera.yaml, and run.json names no camera; give one with "
                         "--camera tum1|tum2|tum3|FILE");
  }
  std::vector<Picture> pictures;
  pictures.push_back({kContactSheet, ContactSheet(run, sequence, camera, options.frames)});
  const std::string title =
      fmt::format("Map of {}  (variant {}), seen from above",
                  fs::absolute(folder).lexically_normal().filename().string(),
                  run.info.variant.empty() ? "?" : run.info.variant);
  pictures.push_back({"top_view.png", DrawMap(CollectMap(run, sequence), title)});
  if (auto error = ErrorOverTime(run, sequence)) {
    pictures.push_back({"error_over_time.png", *error});
  }
  return pictures;
}

void WritePictures(const std::vector<Picture>& pictures, const fs::path& folder, bool force) {
  std::vector<std::string> files;
  for (const Picture& picture : pictures) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", picture.image, bytes);
    files.emplace_back(bytes.begin(), bytes.end());
  }
  // Only pictures are replaced: other files of a folder that was named by mistake stay.
  if (force && fs::is_directory(folder)) {
    for (std::size_t i = 0; i < files.size(); ++i) {
      io::WriteFile(folder / pictures[i].name, files[i]);
    }
    return;
  }
  io::OutputFolder output(folder, kContactSheet, force);
  for (std::size_t i = 0; i < files.size(); ++i) output.Write(pictures[i].name, files[i]);
  output.Commit();
}

}  // namespace eval
