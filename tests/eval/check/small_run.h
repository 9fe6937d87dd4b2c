#pragma once

#include "tests/eval/check/small_world.h"

namespace eval::small_world {

struct RunOptions {
  /// Run world w from truth world g: what a system that starts elsewhere would write.
  Eigen::Isometry3d T_wg = Eigen::Isometry3d::Identity();
  bool segmentation = true;
  int min_pixels = 30;
  std::string sequence;
};

/// Map plane id of a truth face: any numbering but the truth's.
inline int MapId(int face) { return 40 - face; }

inline json FramePlaneJson(const World& world, const Face& face, const View& view, int index,
                           int pixels, bool is_new) {
  const Eigen::Isometry3d T_cw = view.T_wc.inverse();
  const Vector3d n_c = T_cw.linear() * face.n;
  const double d_c = face.d - n_c.dot(T_cw.translation());
  const BoxObject& object = world.objects[static_cast<std::size_t>(face.object - 1)];
  json plane{{"index", index},
             {"normal", AsJson(n_c)},
             {"d", d_c},
             {"pixels", pixels},
             {"inlier_ratio", 0.97},
             {"class", nullptr},
             {"detection", nullptr},
             {"bad", nullptr},
             {"lines", json::array()},
             {"vertices", json::array()},
             {"map_plane", nullptr},
             {"decision", "none"},
             {"by", nullptr}};
  Vector3d centroid = Vector3d::Zero();
  for (const Vector3d& v : face.vertices) centroid += T_cw * v / 4;
  centroid.z() = std::max(centroid.z(), 0.1);
  plane["centroid"] = AsJson(centroid);
  if (object.role == "unstructured") {
    plane["bad"] = "unstructured";
    return plane;
  }
  plane["class"] = object.class_name;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d P = T_cw * face.vertices[i], Q = T_cw * face.vertices[(i + 1) % 4];
    plane["lines"].push_back({AsJson(P), AsJson((Q - P).normalized())});
    if (object.role == "regular") plane["vertices"].push_back(AsJson(P));
  }
  plane["map_plane"] = MapId(face.id);
  plane["decision"] = is_new ? "new" : "matched";
  if (!is_new) plane["by"] = "iou+ranksum";
  return plane;
}

inline json MapJson(const World& world, const std::map<int, std::array<double, 3>>& seen,
                    const Eigen::Isometry3d& T_wg) {
  json map{{"planes", json::array()}};
  for (const Face& face : world.faces) {
    if (seen.count(face.id) == 0) continue;
    const auto& [observations, first, last] = seen.at(face.id);
    const Vector3d n_w = T_wg.linear() * face.n;
    json plane{{"id", MapId(face.id)},
               {"class", world.objects[static_cast<std::size_t>(face.object - 1)].class_name},
               {"normal", AsJson(n_w)},
               {"d", face.d - n_w.dot(T_wg.translation())},
               {"area", 0.1},
               {"observations", static_cast<int>(observations)},
               {"first_seen", first},
               {"last_seen", last},
               {"merged_into", nullptr}};
    for (const Vector3d& v : face.vertices) {
      plane["vertices"].push_back(AsJson(T_wg * v));
      plane["hull"].push_back(AsJson(T_wg * v));
    }
    map["planes"].push_back(plane);
  }
  return map;
}

inline void WriteMapPly(const fs::path& folder, const json& map) {
  std::string points;
  int count = 0;
  for (const json& plane : map["planes"]) {
    for (const json& v : plane["vertices"]) {
      std::ostringstream line;
      line << v[0] << ' ' << v[1] << ' ' << v[2] << " 200 100 50 " << plane["id"] << "\n";
      points += line.str();
      ++count;
    }
  }
  WriteText(
      folder / "map.ply",
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
          "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
          "property uchar green\nproperty uchar blue\nproperty int plane_id\nend_header\n" +
          points);
}

/// Writes the run of a system that makes no mistake, in its own world frame.
inline void WriteRun(const fs::path& folder, const World& world,
                     const RunOptions& options = {}) {
  std::string trajectory, keyframes, lines;
  std::string timing = "timestamp,orb,od,mdc,epi,pp,da,po,upm,mt\n";
  std::map<int, std::array<double, 3>> seen;
  for (const View& view : world.views) {
    const std::string t = StampText(view.stamp_s);
    const cv::Mat ids = Render(world, view).plane_ids;
    cv::Mat labels = cv::Mat::zeros(ids.size(), CV_8U);
    json planes = json::array();
    std::set<int> made_now;
    for (const json& item : Counted(ids, false)) {
      const int pixels = item["pixels"], id = item["id"];
      if (pixels < options.min_pixels) continue;
      const Face& face = world.faces[static_cast<std::size_t>(id - 1)];
      const int index = static_cast<int>(planes.size());
      planes.push_back(FramePlaneJson(world, face, view, index, pixels, seen.count(id) == 0));
      labels.setTo(index + 1, ids == id);
      if (planes.back()["map_plane"].is_null()) continue;
      auto& entry =
          seen.try_emplace(id, std::array<double, 3>{0, std::stod(t), 0}).first->second;
      entry[0] += 1, entry[2] = std::stod(t);
    }
    if (options.segmentation) WriteImage(folder / ("segmentation/" + t + ".png"), labels);
    lines += json{{"timestamp", std::stod(t)}, {"planes", planes}}.dump() + "\n";
    trajectory += TumLine(view.stamp_s, options.T_wg * view.T_wc);
    if (keyframes.empty()) keyframes = trajectory;
    timing += t + ",9,0,0.1,12,3,2,8,1.5,40\n";
  }
  const int frames = static_cast<int>(world.views.size());
  const json run{{"format", "pas-run/1"},
                 {"sequence", options.sequence.empty() ? "none" : options.sequence},
                 {"variant", "full"},
                 {"association", "full"},
                 {"detector", "replay"},
                 {"seed", 1},
                 {"version", "1"},
                 {"options", json::object()},
                 {"frames", frames},
                 {"tracked", frames},
                 {"lost", 0},
                 {"wall_time_s", 1.5},
                 {"peak_memory_mb", 90}};
  const json map = MapJson(world, seen, options.T_wg);
  WriteText(folder / "run.json", run.dump(1));
  WriteText(folder / "trajectory.txt", trajectory);
  WriteText(folder / "keyframes.txt", keyframes);
  WriteText(folder / "frame_planes.jsonl", lines);
  WriteText(folder / "map.json", map.dump(1));
  WriteText(folder / "timing.csv", timing);
  WriteMapPly(folder, map);
}

}  // namespace eval::small_world
