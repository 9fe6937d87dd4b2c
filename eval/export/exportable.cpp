#include "eval/export/exportable.h"

#include <fmt/format.h>

#include "io/image/image_header.h"
#include "io/input_error.h"
#include "io/read_file.h"

namespace eval {

void CommitExport(io::OutputFolder& folder, const std::string& kind) {
  const nlohmann::json marker{{"format", "pas-export/1"}, {"kind", kind}};
  folder.Write(kExportMarker, marker.dump(1) + "\n");
  folder.Commit();
}

Sequence ReadExportable(const std::filesystem::path& folder, const ExportOptions& options) {
  Sequence sequence = ReadSequence(folder);
  // Whoever trains on an export does not see that frames are missing.
  if (!sequence.complete) {
    throw io::InputError((folder / "manifest.json").string(),
                         "complete is false: the sequence was not finished; resume or make it "
                         "again");
  }
  if (options.warn) {
    for (const std::string& line : Summaries(sequence.warnings, folder)) options.warn(line);
    if (sequence.rolling_s != 0.0) {
      options.warn(
          fmt::format("{}: colour was read over {:g} ms (rolling shutter), and masks, boxes "
                      "and poses are of the middle of it: off by some pixels where the camera "
                      "moves. To train on it, record with --rolling-ms 0",
                      folder.string(), 1e3 * sequence.rolling_s));
    }
  }
  const auto require = [&](bool there, const char* file) {
    if (!there) {
      throw io::InputError(
          (folder / file).string(),
          "is missing; only a sequence with truth, as `pas sim` writes it, can be "
          "exported");
    }
  };
  require(sequence.camera.has_value(), "camera.yaml");
  require(sequence.scene.has_value(), "gt/scene.json");
  require(!sequence.object_id_files.empty(), "gt/object_id");
  return sequence;
}

std::string ReadImageBytes(const Sequence& sequence, const std::filesystem::path& image) {
  const std::filesystem::path file = sequence.folder / image;
  std::string bytes = io::ReadFile(file);
  const auto header = io::ReadImageHeader(bytes);
  if (!header || header->width != sequence.camera->width ||
      header->height != sequence.camera->height) {
    throw io::InputError(file.string(),
                         "is no image of the size that camera.yaml says; restore it");
  }
  return bytes;
}

std::string ReadColourBytes(const Sequence& sequence, const std::filesystem::path& image) {
  ReadColour(sequence.folder / image);  // refuses a damaged one
  return ReadImageBytes(sequence, image);
}

cv::Mat1w ReadCheckedObjectIds(const Sequence& sequence, double stamp_s) {
  const auto file = sequence.object_id_files.Find(stamp_s);
  if (!file) {
    throw io::InputError((sequence.folder / "gt/object_id").string(),
                         "has no image of the frame at " + std::to_string(stamp_s) +
                             "; render the sequence again");
  }
  Folder folder(file->parent_path());
  cv::Mat1w ids = ReadImage(folder, file->filename().string(),
                            {CV_16U, 1, {sequence.camera->width, sequence.camera->height}});
  int last = 0;
  for (int v = 0; v < ids.rows; ++v) {
    for (int u = 0; u < ids.cols; ++u) {
      const int id = ids(v, u);
      if (id == last || id == 0) continue;
      if (sequence.scene->FindObject(id) == nullptr) {
        throw io::InputError(file->string(), "shows object " + std::to_string(id) +
                                                 ", which gt/scene.json does not have");
      }
      last = id;
    }
  }
  return ids;
}

std::vector<Pose> FramePoses(const Sequence& sequence) {
  const std::string file = (sequence.folder / "groundtruth.txt").string();
  if (!sequence.groundtruth) throw io::InputError(file, "is missing; poses cannot be exported");
  const Trajectory& truth = *sequence.groundtruth;
  std::vector<Pose> poses;
  if (sequence.synthetic && truth.size() == sequence.frames.size()) {
    for (const StampedPose& pose : truth) poses.push_back(pose.T_wc);
    return poses;
  }
  std::vector<double> stamps_s;
  for (const StampedPose& pose : truth) stamps_s.push_back(pose.stamp_s);
  for (const SequenceFrame& frame : sequence.frames) {
    const auto at = FindStamp(stamps_s, frame.stamp_s);
    if (!at) {
      throw io::InputError(
          file, "has no pose at " + std::to_string(frame.stamp_s) + "; each frame needs one");
    }
    poses.push_back(truth[*at].T_wc);
  }
  return poses;
}

}  // namespace eval
