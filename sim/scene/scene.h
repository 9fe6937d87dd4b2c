#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/models/model.h"

namespace sim {

/// What an object is to the evaluation (formats.md, gt/scene.json).
enum class Role { kStructure, kRegular, kUnstructured, kOther };

/// How a face looks. Procedural, evaluated in metres on the face; the pattern depends on
/// `seed`.
enum class Print { kPlain, kWood, kCloth, kText, kCover, kKeys, kScreen, kSpeckle };

struct Material {
  Print print = Print::kPlain;
  std::array<double, 3> colour{0.7, 0.7, 0.7};  ///< linear RGB, base
  std::array<double, 3> ink{0.1, 0.1, 0.1};     ///< linear RGB, of what is printed
  double richness = 1.0;                        ///< 0 no print .. 1 rich
  std::uint64_t seed = 0;
  // For depth sensors and reflections; surface_light.h says what they are when left out.
  std::optional<double> infrared = {};  ///< share of infrared light that is scattered all round
  std::optional<double> gloss = {};     ///< share of the surface that mirrors as glass does
};

/// Six faces of a box; the truth planes. -x, +x, -y, +y, -z, +z of the object's own frame.
enum class Face { kMinusX, kPlusX, kMinusY, kPlusY, kMinusZ, kPlusZ };

enum class ShapeKind {
  kBox,  ///< `size` along the object's axes; six planes
  kToy,  ///< unstructured: a closed smooth body of bumps inside `size`, no planes; shape from
         ///< `seed`
  // Round about the object's z, inside `size`, no planes (round.h):
  kCylinder,
  kMug,     ///< hollow, open above
  kBottle,  ///< body, shoulder, neck
  kBowl,
  kBush,  ///< unstructured foliage; shape from `seed`
  kMesh,  ///< `model`; `size` is that of its box
  // Unstructured, z up, no planes (body.h):
  kPerson,
  kHand  ///< a forearm with its hand, fingers towards +y
};

/// Where something that moves is at a moment: straight ways and steady turns between.
struct Waypoint {
  double time_s = 0;
  Eigen::Vector3d center_w = Eigen::Vector3d::Zero();
  double yaw_deg = 0;  ///< about z, on top of the object's own rotation
};

/// One solid object. World frame w: metres, z up. T_wo takes object to world; the object's
/// origin is the centre of its box.
struct Object {
  int id = 0;              ///< from 1, unique
  std::string name;        ///< unique, "book_3"
  std::string class_name;  ///< COCO name where there is one: book, keyboard, tv, laptop ...
  Role role = Role::kOther;
  ShapeKind shape = ShapeKind::kBox;
  Eigen::Vector3d center_w = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_wo = Eigen::Quaterniond::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< full lengths, metres
  std::array<Material, 6> faces;                   ///< by Face; a toy uses the first
  std::uint64_t seed = 0;
  std::shared_ptr<const Model> model;  ///< only of a kMesh
  bool model_colours = true;           ///< a kMesh looks as its file says; else as `faces[0]`
  /// Only of what moves; times grow, it stands at its ends before and after. Then `center_w` is
  /// the first of them.
  std::vector<Waypoint> way;
  /// Objects of one group are detected as one (laptop base and lid); 0 = alone.
  int detection_group = 0;
};

struct Sun {
  Eigen::Vector3d direction_w{-0.3, 0.2, -1.0};  ///< the way light travels, need not be unit
  double intensity = 0.8;
  double ambient = 0.45;
};

enum class LightKind {
  kLamp,  ///< a point
  kArea   ///< a rectangle that shines evenly to its front
};

/// A light beside the sun. Light that falls on a surface square to it, at distance r:
/// intensity / r^2, in units of the sun's; on others the cosine of that. A rectangle gives as
/// much as a lamp in its middle does to what is far off before it; elsewhere, the cosine at the
/// rectangle too.
struct Light {
  LightKind kind = LightKind::kLamp;
  Eigen::Vector3d center_w = Eigen::Vector3d::Zero();
  /// Only of a rectangle: from its centre to the middles of two sides, square to each other.
  /// Its front is where half_a x half_b points.
  Eigen::Vector3d half_a_w{0.3, 0, 0}, half_b_w{0, -0.3, 0};
  double intensity = 1;
  std::array<double, 3> colour{1, 1, 1};  ///< linear RGB
  /// Only of a rectangle; its square is the rays to it from each place.
  int samples_per_side = 4;
};

/// A place on the way of the camera, and what it looks at there.
struct Station {
  Eigen::Vector3d camera_w = Eigen::Vector3d::Zero();
  Eigen::Vector3d gaze_w = Eigen::Vector3d::Zero();
};

/// Where the camera looks and how it moves; see motion/.
struct Motion {
  /// slow | office | fast | xyz | rpy | 360 | orbit | loop | lookaway
  std::string preset = "office";
  double speed_m_s = 0, turn_deg_s = 0;  ///< means at 30 Hz; 0 = the preset's own
  /// What `loop` goes round, smoothly and without end; empty: as `orbit`.
  std::vector<Station> stations;
  Eigen::Vector3d target_w{0, 0, 0.75};  ///< what the camera looks at
  double target_spread_m = 0.25;         ///< the gaze drifts this far
  double distance_min_m = 0.7, distance_max_m = 1.3;
  double azimuth_min_rad = -0.9, azimuth_max_rad = 0.9;  ///< round z, 0 looks from -y
  /// The optical axis this far below the horizon: 25 to 45 degrees.
  double pitch_min_rad = 0.4363323129985824, pitch_max_rad = 0.7853981633974483;
};

/// How a scene wants to be recorded; a simulator may do otherwise.
struct Capture {
  int width = 640, height = 480;
  double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  ///< pixels
  /// k1 k2 p1 p2 k3, zeros: a straight image; not set: the lens of the sensor.
  std::optional<std::array<double, 5>> distortion;
  std::string sensor = "kinect1";
  double fps = 30;
  int frames = 300;
};

inline constexpr std::size_t kMaxLights = 8;
inline constexpr int kMaxId = 65535;  ///< ids of objects and planes fit images of 16 bits
inline constexpr double kMaxCoordinate_m = 100;  ///< the farthest a scene may reach
/// Presets that follow a pattern look no steeper up or down.
inline constexpr double kSteepest_deg = 85;

struct Scene {
  std::string name;
  std::string family;  ///< who made it; empty when written by hand
  std::uint64_t seed = 0;
  std::vector<Object> objects;
  Sun sun;
  std::vector<Light> lights;  ///< kMaxLights at most
  Motion motion;
  std::optional<Capture> capture;
};

}  // namespace sim
