#include "eval/draw/draw_camera.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/yaml_value.h"

namespace eval {
namespace {

constexpr double kNear_m = 0.05;

}  // namespace

std::optional<cv::Point2d> DrawCamera::Project(const Eigen::Vector3d& p_c) const {
  if (!(p_c.z() > kNear_m)) return std::nullopt;
  const double x = p_c.x() / p_c.z(), y = p_c.y() / p_c.z(), r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = distortion;
  double xd = x, yd = y;
  // Far outside the image the polynomial folds back; there the pinhole is closer to the truth.
  if (r2 < 1) {
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    xd = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    yd = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  }
  return cv::Point2d(fx * xd + cx, fy * yd + cy);
}

std::vector<cv::Point2d> DrawCamera::ProjectOutline(
    const std::vector<Eigen::Vector3d>& points_c) const {
  std::vector<cv::Point2d> outline;
  const auto add = [&](const Eigen::Vector3d& p) {
    if (const auto pixel = Project(p)) outline.push_back(*pixel);
  };
  for (std::size_t i = 0; i < points_c.size(); ++i) {
    const Eigen::Vector3d& a = points_c[i];
    const Eigen::Vector3d& b = points_c[(i + 1) % points_c.size()];
    const double near = kNear_m * 1.01;
    const bool a_in = a.z() > near, b_in = b.z() > near;
    if (a_in) add(a);
    if (a_in != b_in) add(a + (b - a) * ((near * 1.001 - a.z()) / (b.z() - a.z())));
  }
  return outline;
}

DrawCamera ReadDrawCamera(const std::string& name) {
  // The calibrations that the TUM RGB-D benchmark publishes for its three Kinects.
  if (name == "tum1") {
    return {517.306408,
            516.469215,
            318.643040,
            255.313989,
            {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};
  }
  if (name == "tum2") {
    return {520.908620,
            521.007327,
            325.141442,
            249.701764,
            {0.231222, -0.784899, -0.003257, -0.000105, 0.917205}};
  }
  if (name == "tum3") return {535.4, 539.2, 320.1, 247.6, {}};
  const io::YamlMap map(io::ReadYaml(name, "expected tum1, tum2, tum3 or a camera.yaml"));
  const auto number = [&](const char* key) {
    return map.At(key).Number(io::Interval("(-inf, inf)"), "pixels");
  };
  const auto optional = [&](const char* key) { return map.Has(key) ? number(key) : 0.0; };
  return {number("fx"),
          number("fy"),
          number("cx"),
          number("cy"),
          {optional("k1"), optional("k2"), optional("p1"), optional("p2"), optional("k3")}};
}

std::optional<DrawCamera> ChooseDrawCamera(const std::string& choice,
                                           const std::filesystem::path& sequence,
                                           const std::filesystem::path& run) {
  if (!choice.empty()) return ReadDrawCamera(choice);
  if (std::filesystem::exists(sequence / "camera.yaml")) {
    return ReadDrawCamera((sequence / "camera.yaml").string());
  }
  std::ifstream in(run / "run.json");
  const auto document = nlohmann::json::parse(in, nullptr, false);
  if (!document.is_object()) return std::nullopt;
  const nlohmann::json options = document.value("options", nlohmann::json::object());
  for (const nlohmann::json* place : {&document, &options}) {
    if (!place->is_object() || !place->contains("camera")) continue;
    const nlohmann::json& camera = place->at("camera");
    if (!camera.is_string() || camera.get<std::string>().empty()) continue;
    const std::string name = camera.get<std::string>();
    if (name.rfind("tum", 0) == 0 || std::filesystem::exists(name)) return ReadDrawCamera(name);
  }
  return std::nullopt;
}

}  // namespace eval
