#include "slam/input/camera_keys.h"

#include <array>

#include "io/number_text.h"

namespace slam {
namespace {

const io::Interval kSize_px(16, 8192), kFocal_px(1, 100000), kCentre_px(-8192, 16384),
    kLens(-100, 100), kRate_Hz("(0, 10000]"), kDepthFactor(1, 1000000);
constexpr const char* kDepthUnit =
    "steps of the depth images a metre: 1000 for millimetres, 5000 in TUM's";

void ReadIfThere(const io::YamlMap& map, const std::string& key, const io::Interval& domain,
                 double& value) {
  if (map.Has(key)) value = map.At(key).Number(domain);
}

/// ICL-NUIM gives fy = -480, of a world that is left-handed; its images are upright all the same.
double FocalLengthDown(const io::YamlMap& map, const std::string& key) {
  const io::YamlValue fy = map.At(key);
  if (map.Has(key) && fy.IsScalar() && io::ParseNumber(fy.Text()).value_or(1) < 0) {
    fy.Fail("expected a number in " + kFocal_px.text() + ", found `" + fy.Text() +
            "`; write it without the sign, and mirror groundtruth.txt (docs/cameras.md: "
            "ICL-NUIM)");
  }
  return fy.Number(kFocal_px);
}

std::vector<double> NumbersOf(const io::YamlValue& list, const io::Interval& domain) {
  std::vector<double> numbers;
  for (const io::YamlValue& number : list.List()) numbers.push_back(number.Number(domain));
  return numbers;
}

/// Takes the row-major matrix of fx, fy, cx, cy. @param where  to complain
void TakeMatrix(const std::vector<double>& k, const io::YamlValue& where, Camera& camera) {
  if (k.size() != 9 || k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1 ||
      !kFocal_px.Contains(k[0]) || !kFocal_px.Contains(k[4]) || !kCentre_px.Contains(k[2]) ||
      !kCentre_px.Contains(k[5])) {
    where.Fail("expected data: [fx, 0, cx, 0, fy, cy, 0, 0, 1] in pixels");
  }
  camera.fx = k[0], camera.cx = k[2], camera.fy = k[4], camera.cy = k[5];
}

/// The lens in OpenCV's order; more coefficients than Brown's five must be 0.
/// @param where  to complain
void TakeLens(const std::vector<double>& data, const io::YamlValue& where, Camera& camera) {
  const std::array<double*, 5> lens = {&camera.k1, &camera.k2, &camera.p1, &camera.p2,
                                       &camera.k3};
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (i < lens.size()) {
      *lens[i] = data[i];
    } else if (data[i] != 0) {
      where.Fail(
          "has more than the five coefficients k1 k2 p1 p2 k3; calibrate without the "
          "rational, thin prism and tilted models");
    }
  }
}

/// Refuses a principal point outside the image, and a lens that cannot be inverted over it.
/// @param x, y, lens  where to complain
void RequireSound(const Camera& c, const io::YamlValue& x, const io::YamlValue& y,
                  const io::YamlValue& lens) {
  if (!c.ImageBox().Contains({c.cx, c.cy}, 0.5)) {
    (c.cx < -0.5 || c.cx > c.width - 0.5 ? x : y)
        .Fail("the principal point (cx, cy) must lie inside the image");
  }
  // A pixel that does not come back from its ray means that the coefficients are wrong, or of
  // another model.
  constexpr double kTolerance_px = 0.5;  // then it is another pixel
  constexpr int kSteps = 8;              // a lens is smooth: a coarse grid shows where it folds
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d u(static_cast<double>((c.width - 1) * i) / kSteps,
                              static_cast<double>((c.height - 1) * j) / kSteps);
      const Eigen::Vector2d ideal = c.Undistort(u);
      const Eigen::Vector2d back = c.ProjectDistorted(c.Backproject(ideal, 1.0));
      if (!((back - u).norm() < kTolerance_px))
        lens.Fail("the distortion k1 k2 p1 p2 k3 cannot be inverted over a " +
                  std::to_string(c.width) + " x " + std::to_string(c.height) +
                  " image; check the coefficients and their order");
    }
  }
}

}  // namespace

Camera CameraUnder(const io::YamlMap& map, const CameraKeys& keys) {
  Camera c;
  c.width = map.At(keys.width).Whole(kSize_px);
  c.height = map.At(keys.height).Whole(kSize_px);
  c.fx = map.At(keys.fx).Number(kFocal_px);
  c.fy = FocalLengthDown(map, keys.fy);
  c.cx = map.At(keys.cx).Number(kCentre_px);
  c.cy = map.At(keys.cy).Number(kCentre_px);
  c.depth_factor = map.At(keys.depth_factor).Number(kDepthFactor, kDepthUnit);
  ReadIfThere(map, keys.fps, kRate_Hz, c.fps);
  ReadIfThere(map, keys.k1, kLens, c.k1);
  ReadIfThere(map, keys.k2, kLens, c.k2);
  ReadIfThere(map, keys.p1, kLens, c.p1);
  ReadIfThere(map, keys.p2, kLens, c.p2);
  ReadIfThere(map, keys.k3, kLens, c.k3);
  RequireSound(c, map.At(keys.cx), map.At(keys.cy), map.At(keys.k1));
  return c;
}

Camera CameraOfMatrices(const io::YamlMap& map) {
  // Of a message of ROS the values are plain lists; ROS 2 writes their names small.
  const bool message = map.Has("K") || map.Has("k"), small = map.Has("k");
  const auto values = [&](const io::YamlValue& value) {
    return message ? value : io::YamlMap(value).At("data");
  };
  // Of the models that ROS names this is Brown's, and one that holds it.
  if (map.Has("distortion_model")) {
    map.At("distortion_model").OneOf({"plumb_bob", "rational_polynomial"});
  }
  Camera c;
  c.width = map.At(message ? "width" : "image_width").Whole(kSize_px);
  c.height = map.At(message ? "height" : "image_height").Whole(kSize_px);
  const io::YamlValue matrix = map.At(!message ? "camera_matrix" : small ? "k" : "K");
  TakeMatrix(NumbersOf(values(matrix), io::Interval("(-inf, inf)")), matrix, c);
  const std::string depth = map.Has("DepthMapFactor") ? "DepthMapFactor" : "depth_factor";
  c.depth_factor = map.At(depth).Number(kDepthFactor, kDepthUnit);
  ReadIfThere(map, "fps", kRate_Hz, c.fps);
  const io::YamlValue lens = map.At(!message ? "distortion_coefficients" : small ? "d" : "D");
  TakeLens(NumbersOf(values(lens), kLens), lens, c);
  RequireSound(c, matrix, matrix, lens);
  return c;
}

}  // namespace slam
