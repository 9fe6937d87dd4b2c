#include "eval/draw/draw_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "eval/draw/contact_sheet.h"
#include "eval/draw/error_picture.h"
#include "eval/draw/map_picture.h"
#include "eval/draw/sheet_header.h"
#include "eval/formats/run/run_agreement.h"
#include "io/atomic_file.h"
#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "io/output_file.h"
#include "io/output_folder.h"

namespace eval {
namespace fs = std::filesystem;
namespace {

constexpr const char* kContactSheet = "contact_sheet.png";
constexpr const char* kTopView = "top_view.png";
constexpr const char* kErrorPicture = "error_over_time.png";

bool Exists(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

bool IsEmptyFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error) && fs::is_empty(path, error) && !error;
}

std::vector<std::string> Encoded(const std::vector<Picture>& pictures) {
  std::vector<std::string> files;
  for (const Picture& picture : pictures) files.push_back(io::EncodePng(picture.image));
  return files;
}

/// Replaces the pictures of a folder that is there; other files stay. All are written before
/// the first is renamed. A picture of an earlier drawing that this one has not is removed: it
/// would tell of another run.
void ReplacePictures(const std::vector<Picture>& pictures,
                     const std::vector<std::string>& files, const fs::path& folder) {
  for (const Picture& picture : pictures) {
    std::error_code error;
    const auto there = fs::symlink_status(folder / picture.name, error);
    if (fs::exists(there) && !fs::is_regular_file(there)) {
      throw io::InputError((folder / picture.name).string(),
                           "is no regular file, so it is not replaced; choose another folder");
    }
  }
  std::vector<std::unique_ptr<io::AtomicFile>> written;
  for (std::size_t i = 0; i < files.size(); ++i) {
    written.push_back(std::make_unique<io::AtomicFile>(folder / pictures[i].name));
    written.back()->Add(files[i]);
  }
  for (const auto& file : written) file->Finish();
  for (const char* name : {kContactSheet, kTopView, kErrorPicture}) {
    const bool drawn = std::any_of(pictures.begin(), pictures.end(),
                                   [&](const Picture& p) { return p.name == name; });
    std::error_code error;
    if (!drawn && fs::is_regular_file(folder / name, error)) fs::remove(folder / name, error);
  }
}

/// Refuses an output that exists and is not to be replaced; an empty folder may be filled.
void RefuseOutput(const fs::path& folder, bool force) {
  if (!Exists(folder) || IsEmptyFolder(folder)) return;
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw io::InputError(folder.string(),
                         "is no folder; choose another name for the folder of the pictures");
  }
  if (!force) {
    throw io::InputError(folder.string(),
                         "exists already; choose another name or pass --force");
  }
  if (!Exists(folder / kContactSheet)) {
    throw io::InputError(folder.string(),
                         fmt::format("exists and holds no {}, so even --force does not write "
                                     "into it; choose another name",
                                     kContactSheet));
  }
}

}  // namespace

Drawing DrawRun(const fs::path& folder, const DrawOptions& options) {
  const Run run = ReadRun(folder);
  const fs::path sequence_folder = options.truth ? *options.truth : SequenceOf(run);
  RefuseOutput(options.output, options.force);
  if (options.force) io::RefuseInputsInside(options.output, {folder, sequence_folder});
  const Sequence sequence = ReadSequence(sequence_folder);
  RequireRunOf(sequence, run);
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
  const RunTitle title = TitleOf(run, sequence);
  Drawing drawing;
  drawing.pictures.push_back(
      {kContactSheet, ContactSheet(run, sequence, camera, options.frames)});
  drawing.pictures.push_back({kTopView, DrawMap(CollectMap(run, sequence), title)});
  const auto errors = ErrorsOverTime(run, sequence);
  if (errors) drawing.pictures.push_back({kErrorPicture, DrawErrors(*errors, title)});

  if (!title.warning.empty()) drawing.notes.push_back("the run: " + title.warning);
  if (!run.frames.empty() && run.segmentation_files.empty()) {
    drawing.notes.push_back(fmt::format("{}: {}", kContactSheet, kNoSegmentationNote));
  }
  if (!errors) {
    drawing.notes.push_back(fmt::format(
        "no {}: {}", kErrorPicture,
        sequence.groundtruth ? "the sequence has fewer than 2 frames"
                             : "the sequence has no true trajectory (groundtruth.txt)"));
  } else if (errors->alignment != ErrorAlignment::kPositions) {
    drawing.notes.push_back(fmt::format("{}: {}", kErrorPicture, Explain(errors->alignment)));
  }
  return drawing;
}

void WritePictures(const std::vector<Picture>& pictures, const fs::path& folder, bool force) {
  RefuseOutput(folder, force);
  const std::vector<std::string> files = Encoded(pictures);
  if (Exists(folder)) {
    ReplacePictures(pictures, files, folder);
    return;
  }
  io::OutputFolder output(folder, kContactSheet, force);
  for (std::size_t i = 0; i < files.size(); ++i) output.Write(pictures[i].name, files[i]);
  output.Commit();
}

}  // namespace eval
