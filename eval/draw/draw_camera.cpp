#include "eval/draw/draw_camera.h"

namespace eval {
namespace {

constexpr double kNear_m = 0.05;

/// A camera of the TUM RGB-D benchmark.
Camera TumKinect(double fx, double fy, double cx, double cy,
                 const std::array<double, 5>& distortion) {
  return {640, 480, fx, fy, cx, cy, 30.0, 5000.0, distortion};
}

}  // namespace

std::optional<cv::Point2d> Project(const Camera& camera, const Eigen::Vector3d& p_c) {
  if (!(p_c.z() > kNear_m)) return std::nullopt;
  Camera drawn = camera;
  // Far outside the image the lens's model folds back; there the pinhole is closer to the
  // truth.
  if ((p_c.head<2>() / p_c.z()).squaredNorm() >= 1) drawn.distortion = {};
  const Eigen::Vector2d pixel = PixelOf(drawn, p_c);
  return cv::Point2d(pixel.x(), pixel.y());
}

std::vector<cv::Point2d> ProjectOutline(const Camera& camera,
                                        const std::vector<Eigen::Vector3d>& points_c) {
  std::vector<cv::Point2d> outline;
  const auto add = [&](const Eigen::Vector3d& p) {
    if (const auto pixel = Project(camera, p)) outline.push_back(*pixel);
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

Camera ReadNamedCamera(const std::string& name) {
  // The calibrations that the TUM RGB-D benchmark publishes for its three Kinects.
  if (name == "tum1") {
    return TumKinect(517.306408, 516.469215, 318.643040, 255.313989,
                     {0.262383, -0.953104, -0.005358, 0.002628, 1.163314});
  }
  if (name == "tum2") {
    return TumKinect(520.908620, 521.007327, 325.141442, 249.701764,
                     {0.231222, -0.784899, -0.003257, -0.000105, 0.917205});
  }
  if (name == "tum3") return TumKinect(535.4, 539.2, 320.1, 247.6, {});
  const std::filesystem::path file = name;
  Folder folder(file.parent_path());
  return ReadCamera(folder, file.filename().string(),
                    "expected tum1, tum2, tum3 or a camera.yaml")
      .value();
}

std::optional<Camera> ChooseCamera(const std::string& choice, const Sequence& sequence,
                                   const Run& run) {
  if (!choice.empty()) return ReadNamedCamera(choice);
  if (sequence.camera) return sequence.camera;
  if (run.info.camera) return run.info.camera;
  const std::string& name = run.info.camera_name;
  if (name.starts_with("tum") || (!name.empty() && std::filesystem::exists(name))) {
    return ReadNamedCamera(name);
  }
  return std::nullopt;
}

}  // namespace eval
