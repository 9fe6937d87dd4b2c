#pragma once

#include <openssl/sha.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/file_contents.h"
#include "tests/support/image_files.h"
#include "tests/support/temporary_folder.h"

/// A few boxes seen by a pinhole camera, written as a faultless sequence and a faultless run.
/// The answer to everything in them is known, so tests plant one fault and look for exactly
/// that.
namespace eval::small_world {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using nlohmann::json;
using test_support::ReadText;

struct BoxObject {
  int id;
  std::string class_name, role;
  Vector3d center, size;
  double yaw_rad = 0;
};

struct Face {
  int id, object;
  Vector3d n;
  double d;
  std::array<Vector3d, 4> vertices;
};

struct View {
  double stamp_s;
  Eigen::Isometry3d T_wc;
};

struct World {
  int width = 64, height = 48;
  double focal_px = 60, depth_factor = 5000;
  std::vector<BoxObject> objects;
  std::vector<Face> faces;
  std::vector<View> views;
  double cx() const { return (width - 1) / 2.0; }
  double cy() const { return (height - 1) / 2.0; }
};

inline Eigen::Matrix3d Rotation(const BoxObject& box) {
  return Eigen::AngleAxisd(box.yaw_rad, Vector3d::UnitZ()).toRotationMatrix();
}

inline void AddFaces(World& world) {
  for (const BoxObject& box : world.objects) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        const Vector3d n_o = sign * Vector3d::Unit(axis);
        const Vector3d u = Vector3d::Unit((axis + 1) % 3), v = n_o.cross(u);
        Face face{static_cast<int>(world.faces.size()) + 1, box.id, Rotation(box) * n_o, 0, {}};
        const std::array<std::pair<int, int>, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
        for (std::size_t i = 0; i < 4; ++i) {
          const Vector3d c = n_o + corners[i].first * u + corners[i].second * v;
          face.vertices[i] = box.center + Rotation(box) * c.cwiseProduct(box.size / 2);
        }
        face.d = -face.n.dot(face.vertices[0]);
        world.faces.push_back(face);
      }
    }
  }
}

/// Camera at `eye` that looks at `target`, z up in the world; x right, y down, z ahead.
inline Eigen::Isometry3d LookAt(const Vector3d& eye, const Vector3d& target) {
  const Vector3d z = (target - eye).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d T_wc = Eigen::Isometry3d::Identity();
  T_wc.linear() << x, z.cross(x), z;
  T_wc.translation() = eye;
  return T_wc;
}

inline World MakeWorld(int width = 64, int height = 48, int frames = 4) {
  World world;
  world.width = width, world.height = height;
  world.focal_px = width * 0.9;
  world.objects = {
      {1, "dining table", "structure", {0, 0, 0.70}, {1.4, 0.8, 0.04}, 0},
      {2, "book", "regular", {-0.2, 0.0, 0.74}, {0.22, 0.16, 0.04}, 0.4},
      {3, "keyboard", "regular", {0.15, -0.1, 0.73}, {0.36, 0.13, 0.02}, -0.15},
      {4, "teddy bear", "unstructured", {0.05, 0.2, 0.77}, {0.12, 0.10, 0.10}, 0.7}};
  AddFaces(world);
  for (int i = 0; i < frames; ++i) {
    const double s = frames > 1 ? static_cast<double>(i) / (frames - 1) : 0.0;
    const Vector3d eye(-0.3 + 0.6 * s, -0.75 + 0.1 * std::sin(6 * s),
                       1.25 + 0.08 * std::cos(5 * s));
    world.views.push_back({1.0 + i / 30.0, LookAt(eye, {0.02, 0, 0.72})});
  }
  return world;
}

/// The face that a ray o + z r meets first, with its z; id 0 for none.
inline std::pair<int, double> Hit(const World& world, const Vector3d& o, const Vector3d& r) {
  std::pair<int, double> hit{0, std::numeric_limits<double>::infinity()};
  for (const Face& face : world.faces) {
    const double towards = face.n.dot(r);
    if (towards >= 0) continue;
    const double z = -(face.n.dot(o) + face.d) / towards;
    const Vector3d x = o + z * r - face.vertices[0];
    const Vector3d a = face.vertices[1] - face.vertices[0],
                   b = face.vertices[3] - face.vertices[0];
    const double s = x.dot(a) / a.squaredNorm(), t = x.dot(b) / b.squaredNorm();
    if (z > 0 && z < hit.second && s >= 0 && s <= 1 && t >= 0 && t <= 1) hit = {face.id, z};
  }
  return hit;
}

struct Images {
  cv::Mat rgb, depth, plane_ids, object_ids;
};

inline Images Render(const World& world, const View& view) {
  Images images{cv::Mat(world.height, world.width, CV_8UC3, cv::Scalar(60, 70, 80)),
                cv::Mat::zeros(world.height, world.width, CV_16U),
                cv::Mat::zeros(world.height, world.width, CV_16U),
                cv::Mat::zeros(world.height, world.width, CV_16U)};
  for (int y = 0; y < world.height; ++y) {
    for (int x = 0; x < world.width; ++x) {
      const Vector3d r_c((x - world.cx()) / world.focal_px, (y - world.cy()) / world.focal_px,
                         1);
      const Vector3d r_w = view.T_wc.linear() * r_c;
      const auto [id, z] = Hit(world, view.T_wc.translation(), r_w);
      if (id == 0) continue;
      const Face& face = world.faces[static_cast<std::size_t>(id - 1)];
      const Vector3d p = view.T_wc.translation() + z * r_w;
      const int check = (static_cast<int>(std::floor(p.x() * 25)) +
                         static_cast<int>(std::floor(p.y() * 25))) &
                        1;
      const double light = 0.45 + 0.4 * std::max(0.0, face.n.dot(Vector3d(0.3, -0.4, 0.87)));
      const double tone = light * (check != 0 ? 200 : 170);
      images.rgb.at<cv::Vec3b>(y, x) =
          cv::Vec3b(cv::saturate_cast<uchar>(tone * (face.object == 2 ? 0.7 : 0.9)),
                    cv::saturate_cast<uchar>(tone), cv::saturate_cast<uchar>(tone * 1.05));
      images.depth.at<ushort>(y, x) = cv::saturate_cast<ushort>(z * world.depth_factor);
      images.plane_ids.at<ushort>(y, x) = static_cast<ushort>(id);
      images.object_ids.at<ushort>(y, x) = static_cast<ushort>(face.object);
    }
  }
  return images;
}

inline std::string StampText(double stamp_s) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(6) << stamp_s;
  return out.str();
}

inline void WriteText(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

inline void WriteImage(const fs::path& file, const cv::Mat& image) {
  fs::create_directories(file.parent_path());
  test_support::WriteImageFile(file, image);
}

inline json AsJson(const Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); }

inline std::string TumLine(double stamp_s, const Eigen::Isometry3d& T_wc) {
  const Eigen::Quaterniond q(T_wc.linear());
  std::ostringstream out;
  out << StampText(stamp_s) << std::setprecision(17);
  for (const double v : {T_wc.translation().x(), T_wc.translation().y(), T_wc.translation().z(),
                         q.x(), q.y(), q.z(), q.w()}) {
    out << ' ' << v;
  }
  return out.str() + "\n";
}

inline json Counted(const cv::Mat& ids, bool boxes) {
  std::map<int, std::array<int, 5>> seen;
  for (int y = 0; y < ids.rows; ++y) {
    for (int x = 0; x < ids.cols; ++x) {
      const int id = ids.at<ushort>(y, x);
      if (id == 0) continue;
      auto& s = seen.try_emplace(id, std::array<int, 5>{0, x, y, x, y}).first->second;
      ++s[0];
      s = {s[0], std::min(s[1], x), std::min(s[2], y), std::max(s[3], x), std::max(s[4], y)};
    }
  }
  json list = json::array();
  for (const auto& [id, s] : seen) {
    json item{{"id", id}, {"pixels", s[0]}};
    if (boxes) {
      item["visible_box"] = {s[1], s[2], s[3], s[4]};
      item["amodal_box"] = {s[1], s[2], s[3], s[4]};
      item["visible_fraction"] = 1.0;
    }
    list.push_back(item);
  }
  return list;
}

inline json SceneJson(const World& world) {
  json scene{{"format", "pas-scene-gt/1"}};
  for (const BoxObject& box : world.objects) {
    const Eigen::Quaterniond q(Rotation(box));
    scene["objects"].push_back({{"id", box.id},
                                {"class", box.class_name},
                                {"role", box.role},
                                {"regular", box.role != "unstructured"},
                                {"center", AsJson(box.center)},
                                {"size", AsJson(box.size)},
                                {"q_xyzw", {q.x(), q.y(), q.z(), q.w()}}});
  }
  for (const Face& face : world.faces) {
    json plane{
        {"id", face.id}, {"object", face.object}, {"normal", AsJson(face.n)}, {"d", face.d}};
    for (const Vector3d& v : face.vertices) plane["vertices"].push_back(AsJson(v));
    plane["area"] =
        (face.vertices[1] - face.vertices[0]).cross(face.vertices[2] - face.vertices[1]).norm();
    scene["planes"].push_back(plane);
  }
  return scene;
}

inline std::string Sha256Of(const fs::path& file) {
  const std::string bytes = ReadText(file);
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::ostringstream hex;
  for (const unsigned char byte : digest) {
    hex << std::hex << std::setw(2) << std::setfill('0') << static_cast<int>(byte);
  }
  return hex.str();
}

/// Writes manifest.json for what the folder holds now; tests call it again after a change that
/// the hashes are not to notice.
inline void WriteManifest(const fs::path& folder, int frames) {
  json manifest{{"format", "pas-sequence/1"},
                {"generator", "small world"},
                {"version", "1"},
                {"seed", 1},
                {"scene_hash", "none"},
                {"sensor", "ideal"},
                {"frames", frames},
                {"complete", true},
                {"sha256", json::object()}};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string file = fs::relative(entry.path(), folder).generic_string();
    if (entry.is_regular_file() && file != "manifest.json") {
      manifest["sha256"][file] = Sha256Of(entry.path());
    }
  }
  WriteText(folder / "manifest.json", manifest.dump(1));
}

inline void WriteSequence(const fs::path& folder, const World& world) {
  std::string rgb, depth, truth = "# truth\n", detections, frames, pairs;
  for (const View& view : world.views) {
    const Images images = Render(world, view);
    const std::string t = StampText(view.stamp_s);
    WriteImage(folder / ("rgb/" + t + ".png"), images.rgb);
    WriteImage(folder / ("depth/" + t + ".png"), images.depth);
    WriteImage(folder / ("gt/plane_id/" + t + ".png"), images.plane_ids);
    WriteImage(folder / ("gt/object_id/" + t + ".png"), images.object_ids);
    rgb += t + " rgb/" + t + ".png\n";
    depth += t + " depth/" + t + ".png\n";
    pairs += t + " rgb/" + t + ".png " + t + " depth/" + t + ".png\n";
    truth += TumLine(view.stamp_s, view.T_wc);
    const json stamp = std::stod(t);
    json boxes = json::array();
    for (const json& object : Counted(images.object_ids, true)) {
      const json& b = object["visible_box"];
      if (object["pixels"].get<int>() < 20) continue;
      const auto id = object["id"].get<std::size_t>();
      boxes.push_back({{"class", world.objects[id - 1].class_name},
                       {"score", 0.9},
                       {"box", {b[0], b[1], b[2].get<int>() + 1, b[3].get<int>() + 1}}});
    }
    detections += json{{"timestamp", stamp}, {"detections", boxes}}.dump() + "\n";
    frames += json{{"timestamp", stamp},
                   {"objects", Counted(images.object_ids, true)},
                   {"planes", Counted(images.plane_ids, false)}}
                  .dump() +
              "\n";
  }
  std::ostringstream camera;
  camera << "model: pinhole\nwidth: " << world.width << "\nheight: " << world.height
         << "\nfx: " << world.focal_px << "\nfy: " << world.focal_px << "\ncx: " << world.cx()
         << "\ncy: " << world.cy() << "\nfps: 30\ndepth_factor: " << world.depth_factor << "\n";
  WriteText(folder / "rgb.txt", "# colour\n" + rgb);
  WriteText(folder / "depth.txt", depth);
  WriteText(folder / "associations.txt", pairs);
  WriteText(folder / "groundtruth.txt", truth);
  WriteText(folder / "camera.yaml", camera.str());
  WriteText(folder / "detections.jsonl", detections);
  WriteText(folder / "gt/frames.jsonl", frames);
  WriteText(folder / "gt/scene.json", SceneJson(world).dump(1));
  WriteManifest(folder, static_cast<int>(world.views.size()));
}

using test_support::TemporaryFolder;

/// Replaces the first `from` of a file by `to`; throws when there is none.
inline void Edit(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = ReadText(file);
  const auto at = text.find(from);
  if (at == std::string::npos)
    throw std::runtime_error("no '" + from + "' in " + file.string());
  WriteText(file, text.replace(at, from.size(), to));
}

}  // namespace eval::small_world
