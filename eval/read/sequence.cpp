#include "eval/read/sequence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "eval/read/trajectory_file.h"
#include "io/input_error.h"
#include "io/json_field.h"
#include "io/text_table.h"
#include "io/yaml_value.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxAssociation_s = 0.02;

struct ListedFile {
  double stamp_s = 0.0;
  std::string file;
};

std::vector<ListedFile> ReadFileList(const fs::path& list) {
  std::vector<ListedFile> files;
  for (const io::TextRecord& record : io::ReadRecords(list, "timestamp file")) {
    files.push_back({record.Number(0, "timestamp"), record.fields[1]});
  }
  std::stable_sort(files.begin(), files.end(), [](const ListedFile& a, const ListedFile& b) {
    return a.stamp_s < b.stamp_s;
  });
  return files;
}

std::vector<SequenceFrame> ReadAssociations(const fs::path& file) {
  std::vector<SequenceFrame> frames;
  for (const io::TextRecord& record : io::ReadRecords(file, "t_rgb rgb t_depth depth")) {
    frames.push_back({record.Number(0, "t_rgb"), record.fields[1], record.Number(2, "t_depth"),
                      record.fields[3]});
  }
  return frames;
}

bool IsSynthetic(const fs::path& manifest) {
  if (!fs::exists(manifest)) return false;
  const nlohmann::json json = io::ReadJson(manifest);
  return io::JsonField(json, manifest.string())["format"].Text() == "pas-sequence/1";
}

std::optional<cv::Mat1w> ReadFrameLabels(const StampedFiles& files, double stamp_s) {
  const auto file = files.Find(stamp_s);
  if (!file) return std::nullopt;
  return ReadLabels(*file);
}

}  // namespace

Camera ReadCamera(const fs::path& file) {
  const io::YamlMap map(io::ReadYaml(file));
  const io::Interval size("[1, 1000000]"), positive("(0, inf)"), any("(-inf, inf)");
  Camera camera;
  camera.width = map.At("width").Whole(size);
  camera.height = map.At("height").Whole(size);
  camera.fx = map.At("fx").Number(positive);
  camera.fy = map.At("fy").Number(positive);
  camera.cx = map.At("cx").Number(any);
  camera.cy = map.At("cy").Number(any);
  camera.fps = map.At("fps").Number(positive);
  camera.depth_factor = map.At("depth_factor").Number(positive);
  constexpr std::array<const char*, 5> kDistortion{"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < kDistortion.size(); ++i) {
    if (map.Has(kDistortion[i])) camera.distortion[i] = map.At(kDistortion[i]).Number(any);
  }
  return camera;
}

std::vector<SequenceFrame> AssociateByTime(const fs::path& rgb_list,
                                           const fs::path& depth_list) {
  const std::vector<ListedFile> depth = ReadFileList(depth_list);
  std::vector<SequenceFrame> frames;
  for (const ListedFile& rgb : ReadFileList(rgb_list)) {
    const auto nearest = std::min_element(
        depth.begin(), depth.end(), [&](const ListedFile& a, const ListedFile& b) {
          return std::abs(a.stamp_s - rgb.stamp_s) < std::abs(b.stamp_s - rgb.stamp_s);
        });
    if (nearest == depth.end()) break;
    if (std::abs(nearest->stamp_s - rgb.stamp_s) > kMaxAssociation_s) continue;
    frames.push_back({rgb.stamp_s, rgb.file, nearest->stamp_s, nearest->file});
  }
  return frames;
}

Sequence ReadSequence(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw io::InputError(folder.string(), "there is no such folder");
  Sequence sequence;
  sequence.folder = folder;
  sequence.synthetic = IsSynthetic(folder / "manifest.json");
  sequence.frames = fs::exists(folder / "associations.txt")
                        ? ReadAssociations(folder / "associations.txt")
                        : AssociateByTime(folder / "rgb.txt", folder / "depth.txt");
  std::stable_sort(
      sequence.frames.begin(), sequence.frames.end(),
      [](const SequenceFrame& a, const SequenceFrame& b) { return a.stamp_s < b.stamp_s; });
  if (fs::exists(folder / "camera.yaml")) sequence.camera = ReadCamera(folder / "camera.yaml");
  if (fs::exists(folder / "groundtruth.txt")) {
    sequence.groundtruth = ReadTrajectory(folder / "groundtruth.txt");
  }
  if (fs::exists(folder / "gt/scene.json")) {
    sequence.scene = ReadSceneTruth(folder / "gt/scene.json");
  }
  if (fs::exists(folder / "gt/frames.jsonl")) {
    sequence.frame_truth = ReadFrameTruth(folder / "gt/frames.jsonl");
  }
  sequence.plane_id_files = StampedFiles(folder / "gt/plane_id");
  sequence.object_id_files = StampedFiles(folder / "gt/object_id");
  return sequence;
}

cv::Mat1w ReadLabels(const fs::path& file) {
  const cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (image.empty()) throw io::InputError(file.string(), "cannot be read as an image");
  if (image.channels() != 1 || (image.depth() != CV_8U && image.depth() != CV_16U)) {
    throw io::InputError(file.string(), "expected one channel of 8 or 16 bits");
  }
  cv::Mat1w labels;
  image.convertTo(labels, CV_16U);
  return labels;
}

std::optional<cv::Mat1w> ReadPlaneIds(const Sequence& sequence, double stamp_s) {
  std::optional<cv::Mat1w> ids = ReadFrameLabels(sequence.plane_id_files, stamp_s);
  if (!ids || sequence.scored_as.empty()) return ids;
  ids->forEach([&](std::uint16_t& id, const int*) {
    const auto found = sequence.scored_as.find(id);
    if (found != sequence.scored_as.end()) id = static_cast<std::uint16_t>(found->second);
  });
  return ids;
}

std::optional<cv::Mat1w> ReadObjectIds(const Sequence& sequence, double stamp_s) {
  return ReadFrameLabels(sequence.object_id_files, stamp_s);
}

}  // namespace eval
