#include "sim/sensor/read_sensor.h"

#include <cmath>

#include "io/input_error.h"
#include "io/yaml_value.h"
#include "sim/base/angle.h"
#include "sim/scene/names.h"

namespace sim {
namespace {

constexpr SensorKind kKinds[] = {SensorKind::kIdeal, SensorKind::kKinect1,
                                 SensorKind::kKinect1Clean, SensorKind::kAzure,
                                 SensorKind::kD435};

bool IsWhole(double x) { return x == std::round(x); }

/// Calls visit(key, low, high, unit, value, set) for each parameter; value and set use file units.
/// set says whether it takes the number: fractions are none of a whole one's.
template <typename Visit>
class Lister {
 public:
  explicit Lister(Visit visit) : visit_(std::move(visit)) {}

  void Number(const char* key, double& field, double low, double high, const char* unit,
              double scale = 1.0) {
    visit_(key, low, high, unit, field / scale, [&field, scale](double x) {
      field = x * scale;
      return true;
    });
  }
  void Switch(const char* key, bool& field) {
    visit_(key, 0.0, 1.0, "0 or 1", field ? 1.0 : 0.0, [&field](double x) {
      field = x != 0;
      return IsWhole(x);
    });
  }
  void Whole(const char* key, int& field, int low, int high, const char* unit) {
    visit_(key, low, high, unit, field, [&field](double x) {
      field = static_cast<int>(std::lround(x));
      return IsWhole(x);
    });
  }

  void List(IdealModel&) {}
  void List(DepthBend& bend) {
    // gt/depth_warp.png holds 3.2 %: four sds of the largest.
    Number("bend_rms", bend.rms, 0, 0.008, "of the depth");
    Number("bend_drift_share", bend.drift_share, 0, 1, "");
    Whole("device", bend.device, 0, 1000000000, "");
  }
  void List(ReturnLoss& loss) {
    Number("min_return_per_m2", loss.min_return_per_m2, 0, 10, "1/m^2");
    Number("return_spread_ln", loss.spread_ln, 0, 2, "");
    Number("mirror_spot_deg", loss.mirror_spot_rad, 0, 45, "degrees", kDegree_rad);
  }
  void List(KinectModel& m) {
    Number("disparity_m_steps", m.disparity_m_steps, 1, 1e6, "m");
    Number("projector_offset_m", m.projector_offset_m, -1, 1, "m");
    Number("min_depth_m", m.min_depth_m, 0, 100, "m");
    Number("max_depth_m", m.max_depth_m, 0, 100, "m");
    Number("max_incidence_deg", m.max_incidence_rad, 0, 90, "degrees", kDegree_rad);
    Number("noise_scale", m.noise_scale, 0, 100, "");
    Number("lateral_scale", m.lateral_scale, 0, 20, "");
    Switch("quantise", m.quantise);
    List(m.bend);
    List(m.loss);
    Whole("window_px", m.window.side_px, 0, 31, "pixels");
    Number("window_min_share", m.window.min_share, 0, 1, "");
    Number("window_dots", m.window.dots, 0, 1000, "");
    Number("window_max_apart_steps", m.window.max_apart_steps, 0, 1e4, "steps");
  }
  void List(AzureModel& m) {
    Number("min_depth_m", m.min_depth_m, 0, 100, "m");
    Number("max_depth_m", m.max_depth_m, 0, 100, "m");
    Number("noise_scale", m.noise_scale, 0, 100, "");
    Number("reflectivity", m.reflectivity, 0.01, 1, "");
    Number("lateral_px", m.lateral_px, 0, 20, "pixels");
    Switch("flying_pixels", m.flying_pixels);
    Number("max_mixed_m", m.max_mixed_m, 0, 100, "m");
    Number("min_mixed_share", m.min_mixed_share, 0, 0.5, "");
    Number("multipath_m", m.multipath_m, 0, 1, "m");
    Number("multipath_reach_m", m.multipath_reach_m, 0.001, 1, "m");
    Number("multipath_loss", m.multipath_loss, 0, 1, "");
    Number("wiggle_m", m.wiggle_m, 0, 1, "m");
    Number("wiggle_period_m", m.wiggle_period_m, 0.01, 100, "m");
    Number("session_offset_m", m.session_offset_m, 0, 0.2, "m");
    Switch("hexagon", m.hexagon);
    Number("rounding_m", m.rounding_m, 0, 0.1, "m");
    List(m.loss);
    List(m.bend);
  }
  void List(D435Model& m) {
    Number("focal_baseline_px_m", m.focal_baseline_px_m, 0.1, 1e4, "px m");
    Number("baseline_m", m.baseline_m, -1, 1, "m");
    Number("subpixel_px", m.subpixel_px, 0, 5, "pixels");
    Number("correlated_share", m.correlated_share, 0, 1, "");
    Whole("window_px", m.window_px, 1, 31, "pixels");
    Number("grid_px", m.grid_px, 0, 1, "pixels");
    Number("ripple_px", m.ripple_px, 0, 0.15, "pixels");
    Whole("fattening_px", m.fattening_px, 0, 15, "pixels");
    Number("max_mixed_px", m.max_mixed_px, 0, 100, "pixels");
    Number("min_share", m.min_share, 0, 1, "");
    Number("min_depth_m", m.min_depth_m, 0, 100, "m");
    Number("max_depth_m", m.max_depth_m, 0, 100, "m");
    Number("rounding_m", m.rounding_m, 0, 0.1, "m");
    List(m.bend);
  }
  void All(Sensor& sensor) {
    std::visit([this](auto& model) { this->List(model); }, sensor.depth);
    Number("colour_shot_variance", sensor.colour.shot_variance, 0, 1, "");
    Number("colour_read_sigma", sensor.colour.read_sigma, 0, 1, "");
    Number("colour_corner_loss", sensor.colour.corner_loss, 0, 1, "");
    Number("colour_gamma", sensor.colour.gamma, 0.1, 10, "");
    Number("shutter_ms", sensor.exposure.shutter_s, 0, 1000, "ms", 1e-3);
    Number("rolling_ms", sensor.exposure.rolling_s, 0, 1000, "ms", 1e-3);
    Number("exposure_drift_stops", sensor.exposure.drift_stops, 0, 4, "stops");
    Number("drop_ratio", sensor.timing.drop_ratio, 0, 0.9, "");
    Number("repeat_ratio", sensor.timing.repeat_ratio, 0, 0.9, "");
    Number("depth_offset_ms", sensor.timing.depth_offset_s, 0, 20, "ms", 1e-3);
    Number("stamp_jitter_ms", sensor.timing.stamp_jitter_s, 0, 1000, "ms", 1e-3);
    Number("registration_px", sensor.calibration.registration_px, 0, 20, "pixels");
    Number("intrinsics_error", sensor.calibration.intrinsics, 0, 0.05, "");
    Number("lens_k1", sensor.lens.k1, -10, 10, "");
    Number("lens_k2", sensor.lens.k2, -10, 10, "");
    Number("lens_p1", sensor.lens.p1, -1, 1, "");
    Number("lens_p2", sensor.lens.p2, -1, 1, "");
    Number("lens_k3", sensor.lens.k3, -10, 10, "");
    Number("colour_reflections", sensor.colour.reflections, 0, 10, "");
  }

 private:
  Visit visit_;
};

std::vector<std::string> Keys(const Sensor& sensor) {
  std::vector<std::string> keys{"base", "name"};
  for (const SensorParameter& parameter : Parameters(sensor)) keys.push_back(parameter.key);
  return keys;
}

/// A window without a centre. A Kinect's may be 0: none.
bool HasEvenWindow(const DepthModel& model) {
  const auto* d435 = std::get_if<D435Model>(&model);
  const auto* kinect = std::get_if<KinectModel>(&model);
  return (d435 != nullptr && d435->window_px % 2 == 0) ||
         (kinect != nullptr && kinect->window.side_px > 0 && kinect->window.side_px % 2 == 0);
}

bool MeasuresNothing(const DepthModel& model) {
  return std::visit(
      [](const auto& depth) {
        if constexpr (requires { depth.min_depth_m; }) {
          return !(depth.min_depth_m < depth.max_depth_m);
        }
        return false;
      },
      model);
}

Sensor SensorFrom(const io::YamlValue& file) {
  const io::YamlMap map(file);
  Sensor sensor(kKinds[map.At("base").OneOf(kSensorNames)]);
  map.RefuseOtherKeys(Keys(sensor));
  if (map.Has("name")) sensor.name = map.At("name").Word();
  Lister([&](const char* key, double low, double high, const char* unit, double,
             const auto& set) {
    if (!map.Has(key)) return;
    const double value = map.At(key).Number({low, high}, unit);
    if (!set(value)) map.At(key).Fail("expected a whole number");
    sensor.changed[key] = value;
  }).All(sensor);
  if (MeasuresNothing(sensor.depth)) {
    map.At(map.Has("min_depth_m") ? "min_depth_m" : "max_depth_m")
        .Fail("leaves no depth to measure: min_depth_m is not below max_depth_m");
  }
  if (HasEvenWindow(sensor.depth)) {
    map.At("window_px").Fail("expected an odd number of pixels, so that a window has a centre");
  }
  return sensor;
}

}  // namespace

std::vector<SensorParameter> Parameters(const Sensor& sensor) {
  std::vector<SensorParameter> list;
  Sensor copy = sensor;
  Lister([&](const char* key, double low, double high, const char* unit, double value,
             const auto&) {
    list.push_back({key, value, low, high, unit});
  }).All(copy);
  return list;
}

Sensor ParseSensor(const std::string& text, const std::string& file) {
  return SensorFrom(io::ParseYaml(text, file));
}

Sensor ReadSensor(const std::filesystem::path& file) {
  return SensorFrom(io::ReadYaml(file, "expected a sensor file (docs/sensors.md)"));
}

Sensor SensorByName(const std::string& text) {
  for (std::size_t i = 0; i < kSensorNames.size(); ++i) {
    if (text == kSensorNames[i]) return kKinds[i];
  }
  const std::string suffix = std::filesystem::path(text).extension().string();
  if (suffix == ".yaml" || suffix == ".yml") return ReadSensor(text);
  throw io::InputError(
      "--sensor " + text,
      "expected ideal, kinect1, kinect1-clean, azure, d435, or a file that ends in .yaml");
}

}  // namespace sim
