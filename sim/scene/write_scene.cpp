#include "sim/scene/write_scene.h"

#include <cmath>

#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/sha256.h"
#include "sim/base/angle.h"
#include "sim/scene/names.h"
#include "sim/scene/read_model.h"

namespace sim {
namespace {

template <typename Numbers>
std::string ListText(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "[" : ", ") + io::NumberText(number);
  return text + "]";
}

/// Degrees that read back to exactly `angle_rad` where there are such, short ones first.
std::string DegreesText(double angle_rad) {
  const double angle_deg = RadToDeg(angle_rad);
  const double rounded_deg = std::round(angle_deg * 1e6) / 1e6;
  if (DegToRad(rounded_deg) == angle_rad) return io::NumberText(rounded_deg);
  for (const double towards : {-1e9, 1e9}) {
    double near_deg = angle_deg;
    for (int i = 0; i < 4; ++i) {
      if (DegToRad(near_deg) == angle_rad) return io::NumberText(near_deg);
      near_deg = std::nextafter(near_deg, towards);
    }
  }
  return io::NumberText(angle_deg);
}

std::string RotationText(const Eigen::Quaterniond& q) {
  const Eigen::Vector3d rpy_deg = RpyDegFromQuaternion(q).unaryExpr(
      [](double a) { return std::round(a * 1e6) / 1e6 + 0.0; });
  if (QuaternionFromRpyDeg(rpy_deg).coeffs() == q.coeffs()) {
    return "rpy_deg: " + ListText(rpy_deg);
  }
  return "q_xyzw: " + ListText(q.coeffs());
}

std::string MaterialText(const Material& material) {
  return "{print: " + kPrintNames[static_cast<std::size_t>(material.print)] +
         ", colour: " + ListText(material.colour) + ", ink: " + ListText(material.ink) +
         ", richness: " + io::NumberText(material.richness) +
         ", seed: " + std::to_string(material.seed) +
         (material.infrared ? ", infrared: " + io::NumberText(*material.infrared) : "") +
         (material.gloss ? ", gloss: " + io::NumberText(*material.gloss) : "") + "}";
}

std::string ObjectText(const Object& object) {
  std::string text = "  - id: " + std::to_string(object.id) + "\n";
  const auto line = [&](const std::string& entry) { text += "    " + entry + "\n"; };
  line("name: " + object.name);
  line("class: " + object.class_name);
  line("role: " + kRoleNames[static_cast<std::size_t>(object.role)]);
  line("shape: " + kShapeNames[static_cast<std::size_t>(object.shape)]);
  if (object.way.empty()) line("center_m: " + ListText(object.center_w));
  line(RotationText(object.q_wo));
  if (object.shape == ShapeKind::kMesh) {
    text += ModelText(object);
  } else {
    line("size_m: " + ListText(object.size));
  }
  if (!object.way.empty()) line("way:");
  for (const Waypoint& point : object.way) {
    line("  - {time_s: " + io::NumberText(point.time_s) + ", center_m: " +
         ListText(point.center_w) + ", yaw_deg: " + io::NumberText(point.yaw_deg) + "}");
  }
  if (object.detection_group != 0) {
    line("detection_group: " + std::to_string(object.detection_group));
  }
  if (object.seed != 0) line("seed: " + std::to_string(object.seed));
  if (object.shape == ShapeKind::kMesh && object.model_colours) return text;
  line("faces:");
  const std::string all = MaterialText(object.faces[0]);
  line("  all: " + all);
  for (std::size_t i = 1; i < object.faces.size(); ++i) {
    const std::string material = MaterialText(object.faces[i]);
    if (material != all) line("  " + kFaceNames[i] + ": " + material);
  }
  return text;
}

/// What only some scenes have; nothing at all for the others.
std::string PaceText(const Motion& motion) {
  std::string text;
  if (motion.speed_m_s > 0) text += "  speed_m_s: " + io::NumberText(motion.speed_m_s) + "\n";
  if (motion.turn_deg_s > 0)
    text += "  turn_deg_s: " + io::NumberText(motion.turn_deg_s) + "\n";
  if (!motion.stations.empty()) text += "  stations:\n";
  for (const Station& station : motion.stations) {
    text += "    - {camera_m: " + ListText(station.camera_w) +
            ", gaze_m: " + ListText(station.gaze_w) + "}\n";
  }
  return text;
}

std::string CaptureText(const Capture& capture) {
  const std::string distortion =
      capture.distortion ? "\n  distortion: " + ListText(*capture.distortion) : "";
  return "capture:\n  width_px: " + std::to_string(capture.width) +
         "\n  height_px: " + std::to_string(capture.height) +
         "\n  focal_px: " + ListText(std::array{capture.fx, capture.fy}) +
         "\n  centre_px: " + ListText(std::array{capture.cx, capture.cy}) + distortion +
         "\n  sensor: " + capture.sensor + "\n  fps: " + io::NumberText(capture.fps) +
         "\n  frames: " + std::to_string(capture.frames) + "\n";
}

std::string LightText(const Light& light) {
  const auto points = [](const std::string& key, const Eigen::Vector3d& x_w) {
    return ", " + key + ": " + ListText(x_w);
  };
  std::string text = "  - {kind: " + kLightNames[static_cast<std::size_t>(light.kind)];
  if (light.kind == LightKind::kLamp) {
    text += points("position_m", light.center_w);
  } else {
    text += points("center_m", light.center_w) + points("half_a_m", light.half_a_w) +
            points("half_b_m", light.half_b_w) +
            ", samples_per_side: " + std::to_string(light.samples_per_side);
  }
  return text + ", intensity: " + io::NumberText(light.intensity) +
         ", colour: " + ListText(light.colour) + "}\n";
}

std::string MotionText(const Motion& motion) {
  return "motion:\n  preset: " + motion.preset + "\n  target_m: " + ListText(motion.target_w) +
         "\n  target_spread_m: " + io::NumberText(motion.target_spread_m) +
         "\n  distance_min_m: " + io::NumberText(motion.distance_min_m) +
         "\n  distance_max_m: " + io::NumberText(motion.distance_max_m) +
         "\n  azimuth_min_deg: " + DegreesText(motion.azimuth_min_rad) +
         "\n  azimuth_max_deg: " + DegreesText(motion.azimuth_max_rad) +
         "\n  pitch_min_deg: " + DegreesText(motion.pitch_min_rad) +
         "\n  pitch_max_deg: " + DegreesText(motion.pitch_max_rad) + "\n" + PaceText(motion);
}

}  // namespace

std::string SceneText(const Scene& scene) {
  std::string text = std::string("format: ") + kSceneFormat + "\nname: " + scene.name + "\n";
  if (!scene.family.empty()) text += "family: " + scene.family + "\n";
  text += "seed: " + std::to_string(scene.seed) + "\n";
  text += "sun:\n  direction: " + ListText(scene.sun.direction_w) +
          "\n  intensity: " + io::NumberText(scene.sun.intensity) +
          "\n  ambient: " + io::NumberText(scene.sun.ambient) + "\n";
  if (!scene.lights.empty()) text += "lights:\n";
  for (const Light& light : scene.lights) text += LightText(light);
  text += MotionText(scene.motion);
  if (scene.capture) text += CaptureText(*scene.capture);
  text += "objects:\n";
  for (const Object& object : scene.objects) text += ObjectText(object);
  return text;
}

void WriteScene(const Scene& scene, const std::filesystem::path& path) {
  io::WriteFile(path, SceneText(scene));
}

std::string SceneHash(const Scene& scene) { return io::Sha256Hex(SceneText(scene)); }

}  // namespace sim
