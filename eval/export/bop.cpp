#include "eval/export/bop.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "eval/export/box_model.h"
#include "eval/export/silhouette.h"
#include "io/image/encode_png.h"
#include "io/input_error.h"
#include "io/output_folder.h"

namespace eval {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// One object id for things of one name, class and size: the same scene recorded twice has the
/// same models.
class Models {
 public:
  int IdOf(const TruthObject& object) {
    const auto [at, is_new] =
        id_of_.try_emplace({object.object_class, object.name, object.size_m.x(),
                            object.size_m.y(), object.size_m.z()},
                           static_cast<int>(objects_.size()) + 1);
    if (is_new) objects_.push_back(object);
    return at->second;
  }
  int size() const { return static_cast<int>(objects_.size()); }

  void Write(const io::OutputFolder& folder, const ExportOptions& options) const {
    Json info = Json::object();
    std::string about = "# Simulated tabletop scenes\n\nWritten by pas " + options.version +
                        ".\nModels are boxes without texture.\n\n| obj_id | class | name |\n"
                        "|---|---|---|\n";
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const TruthObject& object = objects_[i];
      info[std::to_string(i + 1)] = BoxInfo(object.size_m);
      folder.Write(fmt::format("models/obj_{:06}.ply", i + 1), BoxPly(object.size_m));
      about += fmt::format("| {} | {} | {} |\n", i + 1, object.object_class, object.name);
    }
    folder.Write("models/models_info.json", info.dump(1) + "\n");
    folder.Write("dataset_info.md", about);
  }

 private:
  std::map<std::tuple<std::string, std::string, double, double, double>, int> id_of_;
  std::vector<TruthObject> objects_;
};

Json RowMajor(const Eigen::Matrix3d& m) {
  Json list = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) list.push_back(m(row, column));
  }
  return list;
}
Json Millimetres(const Eigen::Vector3d& t_m) {
  return {1000 * t_m.x(), 1000 * t_m.y(), 1000 * t_m.z()};
}
Json BoxOf(const PixelSet& pixels) {
  return {pixels.x0, pixels.y0, pixels.x1 - pixels.x0, pixels.y1 - pixels.y0};
}

class BopScene {
 public:
  BopScene(const io::OutputFolder& folder, const Sequence& sequence, std::size_t number,
           const ExportOptions& options, Models& models)
      : folder_(folder),
        sequence_(sequence),
        place_(fmt::format("train/{:06}", number)),
        models_(models) {
    for (const TruthObject& object : sequence.scene->objects) {
      if (object.role == Role::kStructure && !options.structure) continue;
      if (IsBox(*sequence.scene, object)) {
        objects_.push_back(&object);
      } else {
        ++left_out_;
      }
    }
  }

  void AddFrame(int im_id, const SequenceFrame& frame, const Pose& T_gc) {
    const std::string image = fmt::format("{:06}.png", im_id);
    folder_.Write(place_ / "rgb" / image, ReadColourBytes(sequence_, frame.rgb));
    folder_.Write(place_ / "depth" / image, ReadImageBytes(sequence_, frame.depth));
    const Camera& camera = *sequence_.true_camera;
    const Pose T_cg = Inverse(T_gc);
    const std::string key = std::to_string(im_id);
    cameras_[key] = {
        {"cam_K", {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0}},
        {"depth_scale", 1000.0 / camera.depth_factor},
        {"cam_R_w2c", RowMajor(T_cg.R)},
        {"cam_t_w2c", Millimetres(T_cg.t)}};
    poses_[key] = Json::array();
    infos_[key] = Json::array();
    const cv::Mat1w ids = ReadCheckedObjectIds(sequence_, frame.stamp_s);
    const cv::Mat1w depth = ReadLabels(sequence_.folder / frame.depth, {CV_16U, 1, {}});
    if (depth.size() != ids.size()) {
      throw io::InputError((sequence_.folder / frame.depth).string(),
                           "has another size than camera.yaml says");
    }
    for (const TruthObject* object : objects_) AddObject(im_id, *object, T_cg, ids, depth);
  }

  void Finish(ExportSummary& summary) const {
    folder_.Write(place_ / "scene_camera.json", cameras_.dump(1) + "\n");
    folder_.Write(place_ / "scene_gt.json", poses_.dump(1) + "\n");
    folder_.Write(place_ / "scene_gt_info.json", infos_.dump(1) + "\n");
    summary.images += static_cast<int>(cameras_.size());
    summary.instances += instances_;
    summary.left_out += left_out_;
  }

 private:
  void AddObject(int im_id, const TruthObject& object, const Pose& T_cg, const cv::Mat1w& ids,
                 const cv::Mat1w& depth) {
    const Pose T_co = T_cg * Pose{object.R_go, object.center_g};
    cv::Mat1b visible(ids.size(), uchar{0});
    PixelSet seen;
    for (int v = 0; v < ids.rows; ++v) {
      for (int u = 0; u < ids.cols; ++u) {
        if (ids(v, u) != object.id) continue;
        visible(v, u) = 255;
        seen.Add(u, v);
      }
    }
    if (seen.count == 0) return;
    Silhouette whole = BoxSilhouette(*sequence_.true_camera, T_co, object.size_m);
    int valid = 0;
    for (int v = 0; v < ids.rows; ++v) {
      for (int u = 0; u < ids.cols; ++u) {
        // At an edge the renderer's rounding may see what our ray misses.
        if (visible(v, u) != 0 && whole.mask(v, u) == 0) {
          whole.mask(v, u) = 255;
          whole.all.Add(u, v);
        }
        valid += whole.mask(v, u) != 0 && depth(v, u) != 0 ? 1 : 0;
      }
    }
    const std::string key = std::to_string(im_id);
    const std::string mask = fmt::format("{:06}_{:06}.png", im_id, poses_[key].size());
    folder_.Write(place_ / "mask" / mask, io::EncodePng(whole.mask));
    folder_.Write(place_ / "mask_visib" / mask, io::EncodePng(visible));
    poses_[key].push_back({{"cam_R_m2c", RowMajor(T_co.R)},
                           {"cam_t_m2c", Millimetres(T_co.t)},
                           {"obj_id", models_.IdOf(object)}});
    infos_[key].push_back({{"bbox_obj", BoxOf(whole.all)},
                           {"bbox_visib", BoxOf(seen)},
                           {"px_count_all", whole.all.count},
                           {"px_count_valid", valid},
                           {"px_count_visib", seen.count},
                           {"visib_fract", static_cast<double>(seen.count) / whole.all.count}});
    ++instances_;
  }

  const io::OutputFolder& folder_;
  const Sequence& sequence_;
  fs::path place_;
  Models& models_;
  std::vector<const TruthObject*> objects_;
  Json cameras_ = Json::object(), poses_ = Json::object(), infos_ = Json::object();
  int instances_ = 0, left_out_ = 0;
};

void RefuseLens(const Sequence& sequence) {
  if (!sequence.true_camera->distorted()) return;
  const bool told_otherwise = fs::exists(sequence.folder / kTrueCamera);
  throw io::InputError(
      (sequence.folder / (told_otherwise ? kTrueCamera : "camera.yaml")).string(),
      "has lens distortion, which BOP's camera cannot say: poses would miss their "
      "masks. Record with --lens 0 0 0 0 0, or export to COCO, which needs no camera");
}

void WriteCamera(const io::OutputFolder& folder, const Camera& camera) {
  const Json json{
      {"cx", camera.cx},      {"cy", camera.cy}, {"depth_scale", 1000.0 / camera.depth_factor},
      {"fx", camera.fx},      {"fy", camera.fy}, {"height", camera.height},
      {"width", camera.width}};
  folder.Write("camera.json", json.dump(1) + "\n");
}

}  // namespace

ExportSummary ExportBop(const std::vector<fs::path>& folders, const fs::path& output,
                        const ExportOptions& options) {
  io::OutputFolder folder(output, kExportMarker, options.force);  // refused before the work
  std::vector<Sequence> sequences;
  std::size_t total = 0;
  for (const fs::path& sequence : folders) {
    sequences.push_back(ReadExportable(sequence, options));
    RefuseLens(sequences.back());
    total += sequences.back().frames.size();
  }
  if (!sequences.empty()) WriteCamera(folder, *sequences.front().true_camera);
  ExportSummary summary;
  Models models;
  int done = 0;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const std::vector<Pose> poses = FramePoses(sequences[i]);
    BopScene scene(folder, sequences[i], i, options, models);
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
      scene.AddFrame(static_cast<int>(frame), sequences[i].frames[frame], poses[frame]);
      if (options.progress) options.progress(++done, static_cast<int>(total));
    }
    scene.Finish(summary);
  }
  models.Write(folder, options);
  CommitExport(folder, "bop");
  summary.kinds = models.size();
  return summary;
}

}  // namespace eval
