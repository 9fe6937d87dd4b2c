#include "sim/scene/read_lights.h"

#include <cmath>

#include "sim/scene/names.h"

namespace sim {
namespace {

constexpr double kMinHalf_m = 1e-4, kMaxHalf_m = 25;
constexpr double kMinIntensity = 1e-6, kMaxIntensity = 1e4;
constexpr double kSquare = 1e-6;  ///< cosine of what passes for a right angle
constexpr std::uint64_t kMaxSamplesPerSide = 16;

Eigen::Vector3d ReadPoint(const io::YamlMap& map, const char* key) {
  return map.At(key).Numbers(3, {-kMaxCoordinate_m, kMaxCoordinate_m}, "metres");
}

Eigen::Vector3d ReadHalf(const io::YamlMap& map, const char* key) {
  Eigen::Vector3d half = map.At(key).Numbers(3, {-kMaxHalf_m, kMaxHalf_m}, "metres");
  if (!(half.norm() >= kMinHalf_m)) map.At(key).Fail("expected 0.1 mm or more, or kind: lamp");
  return half;
}

Light ReadLight(const io::YamlValue& value) {
  static const std::vector<std::string> kKeys{"kind",      "position_m", "center_m",
                                              "half_a_m",  "half_b_m",   "samples_per_side",
                                              "intensity", "colour"};
  const io::YamlMap map(value, kKeys);
  Light light;
  light.kind = static_cast<LightKind>(map.At("kind").OneOf(kLightNames));
  const bool lamp = light.kind == LightKind::kLamp;
  for (const char* key : {"center_m", "half_a_m", "half_b_m", "samples_per_side"}) {
    if (lamp && map.Has(key)) {
      map.At(key).Fail("is for `kind: area`; a lamp has position_m");
    }
  }
  if (lamp) {
    light.center_w = ReadPoint(map, "position_m");
  } else {
    if (map.Has("position_m")) map.At("position_m").Fail("is for `kind: lamp`; name center_m");
    light.center_w = ReadPoint(map, "center_m");
    light.half_a_w = ReadHalf(map, "half_a_m");
    light.half_b_w = ReadHalf(map, "half_b_m");
    if (!(std::abs(light.half_a_w.normalized().dot(light.half_b_w.normalized())) < kSquare)) {
      map.At("half_b_m").Fail("is not square to half_a_m; a light is a rectangle");
    }
  }
  if (map.Has("samples_per_side")) {
    light.samples_per_side = map.At("samples_per_side").Whole({1, kMaxSamplesPerSide});
  }
  light.intensity = map.At("intensity").Number({kMinIntensity, kMaxIntensity});
  if (map.Has("colour")) {
    const Eigen::VectorXd rgb = map.At("colour").Numbers(3, {0, 1}, "linear RGB");
    light.colour = {rgb[0], rgb[1], rgb[2]};
  }
  return light;
}

}  // namespace

std::vector<Light> ReadLights(const io::YamlValue& value) {
  std::vector<Light> lights;
  for (const io::YamlValue& entry : value.List(kMaxLights)) lights.push_back(ReadLight(entry));
  return lights;
}

}  // namespace sim
