#include "eval/draw/draw_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>

#include "eval/draw/contact_sheet.h"
#include "eval/draw/error_picture.h"
#include "eval/draw/map_picture.h"
#include "eval/read/input_error.h"

namespace eval {
namespace fs = std::filesystem;

std::vector<Picture> DrawRun(const fs::path& folder, const DrawOptions& options) {
  const Run run = ReadRun(folder);
  const fs::path sequence_folder = options.truth ? *options.truth : SequenceOf(run);
  const Sequence sequence = ReadSequence(sequence_folder);
  const auto camera = ChooseDrawCamera(options.camera, sequence_folder, folder);
  if (!camera && run.segmentation_files.empty()) {
    throw InputError(sequence_folder.string(),
                     "has no camera.yaml, and run.json names no camera; give one with "
                     "--camera tum1|tum2|tum3|FILE");
  }
  std::vector<Picture> pictures;
  pictures.push_back(
      {"contact_sheet.png", ContactSheet(run, sequence, camera, options.frames)});
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
  if (fs::exists(folder) && !force) {
    throw InputError(folder.string(), "exists; name another folder or pass --force");
  }
  const fs::path target = fs::absolute(folder / "").parent_path();
  const fs::path temporary =
      target.parent_path() / fmt::format(".{}.{}", target.filename().string(), getpid());
  try {
    fs::create_directories(target.parent_path());
    fs::remove_all(temporary);
    fs::create_directory(temporary);
    for (const Picture& picture : pictures) {
      if (!cv::imwrite((temporary / picture.name).string(), picture.image)) {
        throw InputError((temporary / picture.name).string(), "cannot be written");
      }
    }
    // Only pictures are replaced: other files of a folder that was named by mistake stay.
    if (fs::exists(target)) {
      for (const Picture& picture : pictures) {
        fs::rename(temporary / picture.name, target / picture.name);
      }
      fs::remove_all(temporary);
    } else {
      fs::rename(temporary, target);
    }
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
    throw InputError(folder.string(), "cannot be written (" + error.code().message() +
                                          "); choose another folder");
  }
}

}  // namespace eval
