#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "eval/formats/plane.h"
#include "io/atomic_file.h"
#include "tests/support/image_files.h"

/// A desk with two books and a toy, its truth as a sequence folder, and the run that says
/// exactly the truth. Written with nothing but the file formats, so that readers and scores are
/// tested against them and not against themselves.
namespace eval::testing {

using nlohmann::json;

struct TinyPlane {
  int id = 0, object = 0;
  Plane pi_g;
  std::vector<Eigen::Vector3d> corners_g;  ///< counter-clockwise about the normal
};

struct TinyFrame {
  double stamp_s = 0.0;
  Pose T_gc;
  cv::Mat1w plane_ids, object_ids;
};

inline json ToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline json ToJson(const std::vector<Eigen::Vector3d>& points) {
  json array = json::array();
  for (const Eigen::Vector3d& p : points) array.push_back(ToJson(p));
  return array;
}
inline std::string ToText(double value) { return json(value).dump(); }

inline std::string TumLine(double stamp_s, const Pose& T) {
  const Eigen::Quaterniond q(T.R);
  std::string line = ToText(stamp_s);
  for (const double v : {T.t.x(), T.t.y(), T.t.z(), q.x(), q.y(), q.z(), q.w()}) {
    line += ' ';
    line += ToText(v);
  }
  return line + "\n";
}

class TinyWorld {
 public:
  static constexpr int kWidth = 160, kHeight = 120, kFrames = 45;
  static constexpr double kFocal = 150.0, kFps = 30.0;
  static constexpr int kDesk = 1, kThickBook = 2, kThinBook = 3, kToy = 4;
  static constexpr int kDeskTop = 1, kThickTop = 11, kThinTop = 21;

  TinyWorld() {
    AddTop(kDeskTop, kDesk, {0, 0, 0.70}, {0.60, 0.45});
    AddBook(kThickTop, kThickBook, {-0.15, 0.05, 0.70}, {0.11, 0.08}, 0.06);
    AddBook(kThinTop, kThinBook, {0.18, -0.06, 0.70}, {0.10, 0.13}, 0.03);
    // The toy has faces that the camera sees, but no true planes.
    AddBook(901, kToy, {0.02, -0.25, 0.70}, {0.04, 0.04}, 0.10);
    for (int i = 0; i < kFrames; ++i) frames.push_back(Render(i));
  }

  std::vector<TinyPlane> planes;  ///< of scored objects
  std::vector<TinyFrame> frames;

  /// World of the run: another origin and another heading than the truth's.
  static Pose RunFromTruth() {
    return {Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
            Eigen::Vector3d(0.4, -1.1, 0.2)};
  }

  void WriteSequence(const std::filesystem::path& folder) const {
    namespace fs = std::filesystem;
    fs::create_directories(folder / "gt/plane_id");
    fs::create_directories(folder / "gt/object_id");
    std::string truth = "# timestamp tx ty tz qx qy qz qw\n", associations;
    std::string frame_lines;
    for (const TinyFrame& frame : frames) {
      const std::string t = ToText(frame.stamp_s);
      truth += TumLine(frame.stamp_s, frame.T_gc);
      associations += t + " rgb/" + t + ".png " + t + " depth/" + t + ".png\n";
      test_support::WriteImageFile(folder / "gt/plane_id" / (t + ".png"), frame.plane_ids);
      test_support::WriteImageFile(folder / "gt/object_id" / (t + ".png"), frame.object_ids);
      frame_lines += FrameTruthLine(frame).dump() + "\n";
    }
    io::WriteFile(folder / "groundtruth.txt", truth);
    io::WriteFile(folder / "associations.txt", associations);
    io::WriteFile(folder / "gt/frames.jsonl", frame_lines);
    io::WriteFile(folder / "gt/scene.json", SceneJson().dump(1));
    io::WriteFile(folder / "camera.yaml",
                  "model: pinhole\nwidth: 160\nheight: 120\nfx: 150\nfy: 150\ncx: 79.5\n"
                  "cy: 59.5\nfps: 30\ndepth_factor: 5000\n");
    io::WriteFile(folder / "manifest.json",
                  "{\"format\": \"pas-sequence/1\", \"complete\": true, \"frames\": 45}\n");
  }

  json SceneJson() const {
    json scene{
        {"format", "pas-scene-gt/1"}, {"objects", json::array()}, {"planes", json::array()}};
    const auto object = [&](int id, const char* object_class, const char* role) {
      const auto [low, high] = BoundsOf(id);
      scene["objects"].push_back({{"id", id},
                                  {"class", object_class},
                                  {"role", role},
                                  {"regular", std::string(role) == "regular"},
                                  {"center", ToJson(Eigen::Vector3d((low + high) / 2))},
                                  {"size", ToJson(Eigen::Vector3d(high - low))},
                                  {"q_xyzw", {0, 0, 0, 1}}});
    };
    object(kDesk, "desk", "structure");
    object(kThickBook, "book", "regular");
    object(kThinBook, "book", "regular");
    object(kToy, "teddy bear", "unstructured");
    for (const TinyPlane& plane : planes) {
      scene["planes"].push_back({{"id", plane.id},
                                 {"object", plane.object},
                                 {"normal", ToJson(plane.pi_g.n)},
                                 {"d", plane.pi_g.d},
                                 {"area", (plane.corners_g[1] - plane.corners_g[0]).norm() *
                                              (plane.corners_g[2] - plane.corners_g[1]).norm()},
                                 {"vertices", ToJson(plane.corners_g)}});
    }
    return scene;
  }

  static bool InImage(const Pose& T_gc, const Eigen::Vector3d& x_g) {
    const Eigen::Vector3d x_c = Inverse(T_gc) * x_g;
    if (!(x_c.z() > 0.0)) return false;
    const double u = kFocal * x_c.x() / x_c.z() + kCx, v = kFocal * x_c.y() / x_c.z() + kCy;
    return u >= 0.0 && v >= 0.0 && u <= kWidth - 1.0 && v <= kHeight - 1.0;
  }

  /// Direction through the centre of a pixel, z = 1.
  static Eigen::Vector3d Ray(int x, int y) {
    return {(x - kCx) / kFocal, (y - kCy) / kFocal, 1.0};
  }

 private:
  static constexpr double kCx = 79.5, kCy = 59.5;

  /// The box of an object: all its faces, and 4 cm below its highest one.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> BoundsOf(int object) const {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e3), high = -low;
    for (const TinyPlane& face : faces_) {
      if (face.object != object) continue;
      for (const Eigen::Vector3d& corner_g : face.corners_g) {
        low = low.cwiseMin(corner_g);
        high = high.cwiseMax(corner_g);
      }
    }
    low.z() = std::min(low.z(), high.z() - 0.04);
    return {low, high};
  }

  void AddFace(int id, int object, const Eigen::Vector3d& middle, const Eigen::Vector3d& half_u,
               const Eigen::Vector3d& half_v) {
    TinyPlane plane;
    plane.id = id;
    plane.object = object;
    plane.pi_g.n = half_u.cross(half_v).normalized();
    plane.pi_g.d = -plane.pi_g.n.dot(middle);
    plane.corners_g = {middle - half_u - half_v, middle + half_u - half_v,
                       middle + half_u + half_v, middle - half_u + half_v};
    faces_.push_back(plane);
    if (object != kToy) planes.push_back(plane);
  }

  void AddTop(int id, int object, const Eigen::Vector3d& middle, const Eigen::Vector2d& half) {
    AddFace(id, object, middle, {half.x(), 0, 0}, {0, half.y(), 0});
  }

  void AddBook(int id, int object, const Eigen::Vector3d& foot, const Eigen::Vector2d& half,
               double height_m) {
    const Eigen::Vector3d x(half.x(), 0, 0), y(0, half.y(), 0), up(0, 0, 0.5 * height_m);
    AddTop(id, object, foot + 2 * up, half);
    AddFace(id + 1, object, foot + up + x, y, up);
    AddFace(id + 2, object, foot + up - x, -y, up);
    AddFace(id + 3, object, foot + up + y, -x, up);
    AddFace(id + 4, object, foot + up - y, x, up);
  }

  static Pose CameraAt(int i) {
    const double angle = -2.2 + 1.6 * i / (kFrames - 1.0);
    const Eigen::Vector3d eye(0.85 * std::cos(angle), 0.85 * std::sin(angle),
                              1.35 + 0.08 * std::sin(0.3 * i));
    const Eigen::Vector3d forward = (Eigen::Vector3d(0, 0, 0.72) - eye).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    Pose T_gc;
    T_gc.R << right, forward.cross(right), forward;
    T_gc.t = eye;
    return T_gc;
  }

  TinyFrame Render(int i) const {
    TinyFrame frame{i / kFps, CameraAt(i), cv::Mat1w(kHeight, kWidth, std::uint16_t(0)),
                    cv::Mat1w(kHeight, kWidth, std::uint16_t(0))};
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const TinyPlane* hit = Nearest(frame.T_gc.t, frame.T_gc.R * Ray(x, y));
        if (hit == nullptr) continue;
        frame.object_ids(y, x) = static_cast<std::uint16_t>(hit->object);
        if (hit->object != kToy) frame.plane_ids(y, x) = static_cast<std::uint16_t>(hit->id);
      }
    }
    return frame;
  }

  const TinyPlane* Nearest(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) const {
    double nearest = std::numeric_limits<double>::infinity();
    const TinyPlane* hit = nullptr;
    for (const TinyPlane& face : faces_) {
      const double slope = face.pi_g.n.dot(ray);
      if (!(slope < 0.0)) continue;
      const double depth = -SignedDistance(face.pi_g, eye) / slope;
      if (!(depth > 0.0) || !(depth < nearest)) continue;
      const Eigen::Vector3d from_corner = eye + depth * ray - face.corners_g[0];
      const Eigen::Vector3d u = face.corners_g[1] - face.corners_g[0];
      const Eigen::Vector3d v = face.corners_g[3] - face.corners_g[0];
      const double a = from_corner.dot(u) / u.squaredNorm();
      const double b = from_corner.dot(v) / v.squaredNorm();
      if (a < 0.0 || a > 1.0 || b < 0.0 || b > 1.0) continue;
      nearest = depth;
      hit = &face;
    }
    return hit;
  }

  static json FrameTruthLine(const TinyFrame& frame) {
    std::map<int, int> pixels;
    for (const std::uint16_t id : frame.plane_ids) {
      if (id != 0) ++pixels[id];
    }
    json line{
        {"timestamp", frame.stamp_s}, {"objects", json::array()}, {"planes", json::array()}};
    for (const auto& [id, count] : pixels) {
      line["planes"].push_back({{"id", id}, {"pixels", count}});
    }
    return line;
  }

  std::vector<TinyPlane> faces_;  // all, the toy's too
};

/// A run to be spoilt: public parts, written as they stand.
struct TinyRun {
  json info;
  std::vector<std::pair<double, Pose>> trajectory;  ///< T_wc
  std::vector<json> frames;                         ///< lines of frame_planes.jsonl
  std::vector<cv::Mat1b> segmentation;
  json map;
  std::string timing;

  static int MapId(int truth) { return truth + 100; }

  explicit TinyRun(const TinyWorld& world) {
    info = {{"format", "pas-run/1"},
            {"sequence", "../SEQ"},
            {"variant", "full"},
            {"frames", world.frames.size()},
            {"tracked", world.frames.size()},
            {"peak_memory_mb", 128.5}};
    const Pose T_wg = TinyWorld::RunFromTruth();
    std::set<int> known;
    timing = "timestamp,orb,mt\n";
    for (const TinyFrame& frame : world.frames) {
      trajectory.emplace_back(frame.stamp_s, T_wg * frame.T_gc);
      timing += ToText(frame.stamp_s) + ",4,10\n";
      AddFrame(world, frame, known);
    }
    map["planes"] = json::array();
    for (const TinyPlane& plane : world.planes) {
      if (known.count(plane.id) == 0) continue;
      const Plane pi_w = Transform(T_wg, plane.pi_g);
      std::vector<Eigen::Vector3d> corners_w;
      for (const Eigen::Vector3d& p : plane.corners_g) corners_w.push_back(T_wg * p);
      map["planes"].push_back({{"id", MapId(plane.id)},
                               {"class", nullptr},
                               {"normal", ToJson(pi_w.n)},
                               {"d", pi_w.d},
                               {"covariance", {1e-6, 0, 0, 0, 1e-6, 0, 0, 1e-6, 0, 1e-6}},
                               {"area", 0.1},
                               {"observations", 3},
                               {"merged_into", nullptr},
                               {"vertices", ToJson(corners_w)},
                               {"hull", ToJson(corners_w)}});
    }
  }

  void Write(const std::filesystem::path& folder) const {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::string poses, lines;
    for (const auto& [stamp_s, T_wc] : trajectory) poses += TumLine(stamp_s, T_wc);
    for (const json& frame : frames) lines += frame.dump() + "\n";
    io::WriteFile(folder / "run.json", info.dump(1));
    io::WriteFile(folder / "trajectory.txt", poses);
    io::WriteFile(folder / "frame_planes.jsonl", lines);
    io::WriteFile(folder / "map.json", map.dump(1));
    io::WriteFile(folder / "timing.csv", timing);
    if (segmentation.empty()) return;
    std::filesystem::create_directories(folder / "segmentation");
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const std::string t = ToText(frames[i]["timestamp"].get<double>());
      test_support::WriteImageFile(folder / "segmentation" / (t + ".png"), segmentation[i]);
    }
  }

 private:
  void AddFrame(const TinyWorld& world, const TinyFrame& frame, std::set<int>& known) {
    json line{{"timestamp", frame.stamp_s}, {"planes", json::array()}};
    cv::Mat1b labels(frame.plane_ids.size(), std::uint8_t(0));
    const Pose T_cg = Inverse(frame.T_gc);
    for (const TinyPlane& plane : world.planes) {
      const Plane pi_c = Transform(T_cg, plane.pi_g);
      const int index = static_cast<int>(line["planes"].size());
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int pixels = 0;
      for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
          if (frame.plane_ids(y, x) != plane.id) continue;
          const Eigen::Vector3d ray = TinyWorld::Ray(x, y);
          sum += ray * (-pi_c.d / pi_c.n.dot(ray));
          labels(y, x) = static_cast<std::uint8_t>(index + 1);
          ++pixels;
        }
      }
      if (pixels == 0) continue;
      std::vector<Eigen::Vector3d> corners_c;
      for (const Eigen::Vector3d& p_g : plane.corners_g) {
        if (TinyWorld::InImage(frame.T_gc, p_g)) corners_c.push_back(T_cg * p_g);
      }
      const bool is_new = known.insert(plane.id).second;
      line["planes"].push_back({{"index", index},
                                {"normal", ToJson(pi_c.n)},
                                {"d", pi_c.d},
                                {"centroid", ToJson(Eigen::Vector3d(sum / pixels))},
                                {"pixels", pixels},
                                {"inlier_ratio", 1.0},
                                {"class", nullptr},
                                {"detection", nullptr},
                                {"bad", nullptr},
                                {"lines", json::array()},
                                {"vertices", ToJson(corners_c)},
                                {"map_plane", MapId(plane.id)},
                                {"decision", is_new ? "new" : "matched"},
                                {"by", "parameters"}});
    }
    frames.push_back(line);
    segmentation.push_back(labels);
  }
};

}  // namespace eval::testing
