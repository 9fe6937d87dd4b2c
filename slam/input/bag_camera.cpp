#include "slam/input/bag_camera.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "io/input_error.h"
#include "io/number_text.h"
#include "io/yaml_value.h"
#include "slam/input/bag_topics.h"
#include "slam/input/camera_keys.h"

namespace slam {
namespace {

constexpr double kMillimetres = 1000;      // a metre; REP 118 for 16-bit depth
constexpr double kOfFloats = 5000;         // as TUM writes its depth, which is 32FC1, to PNG
constexpr double kFitTolerance_px = 0.5;   // beyond it is another pixel
constexpr int kFitSteps = 16;              // a lens is smooth: a grid tells it
using Lens = Eigen::Matrix<double, 5, 1>;  // k1 k2 p1 p2 k3

/// Brown's terms at an ideal point: what the lens moves it by is their product with the lens.
Eigen::Matrix<double, 2, 5> BrownTerms(const Eigen::Vector2d& u) {
  const double r2 = u.squaredNorm(), x = u.x(), y = u.y();
  Eigen::Matrix<double, 2, 5> terms;
  terms << x * r2, x * r2 * r2, 2 * x * y, r2 + 2 * x * x, x * r2 * r2 * r2,  //
      y * r2, y * r2 * r2, r2 + 2 * y * y, 2 * x * y, y * r2 * r2 * r2;
  return terms;
}

/// Brown's lens that undoes the inverse one, which is Brown's polynomial taken from recorded
/// to ideal points: least squares over a grid of recorded pixels.
/// @throws InputError when it is farther from it than the tolerance anywhere
Lens BrownOfInverse(const Lens& inverse, const BagCameraInfo& info, const std::string& where) {
  constexpr int kPoints = (kFitSteps + 1) * (kFitSteps + 1);
  Eigen::Matrix<double, Eigen::Dynamic, 5> terms(2 * kPoints, 5);
  Eigen::VectorXd moved(2 * kPoints);
  for (int at = 0; at < kPoints; ++at) {
    const int column = at % (kFitSteps + 1), row = at / (kFitSteps + 1);
    const double u = (info.width - 1.0) * column / kFitSteps;
    const double v = (info.height - 1.0) * row / kFitSteps;
    const Eigen::Vector2d recorded((u - info.k[2]) / info.k[0], (v - info.k[5]) / info.k[4]);
    const Eigen::Vector2d ideal = recorded + BrownTerms(recorded) * inverse;
    terms.middleRows<2>(2 * at) = BrownTerms(ideal);
    moved.segment<2>(2 * at) = recorded - ideal;
  }
  Lens lens = terms.colPivHouseholderQr().solve(moved);
  const double error_px =
      std::max(info.k[0], info.k[4]) * (terms * lens - moved).lpNorm<Eigen::Infinity>();
  if (!(error_px < kFitTolerance_px)) {
    throw io::InputError(where, "the lens `" + info.lens +
                                    "` cannot be told by k1 k2 p1 p2 k3; give a camera with "
                                    "--camera");
  }
  return lens;
}

/// @throws InputError for a lens of another model
Lens LensOf(const BagCameraInfo& info, const std::string& where) {
  const auto bends = [](double coefficient) { return coefficient != 0; };
  Lens lens = Lens::Zero();
  if (std::none_of(info.d.begin(), info.d.end(), bends)) return lens;
  const auto count = static_cast<std::ptrdiff_t>(std::min(info.d.size(), std::size_t{5}));
  std::copy_n(info.d.begin(), count, lens.data());
  const bool brown = info.lens == "plumb_bob" || info.lens == "Brown Conrady" ||
                     info.lens == "rational_polynomial";
  const bool five = std::none_of(info.d.begin() + count, info.d.end(), bends);
  if (brown && five) return lens;
  if (info.lens == "Inverse Brown Conrady" && five) return BrownOfInverse(lens, info, where);
  throw io::InputError(where,
                       "the lens is " + io::Quoted(info.lens) +
                           ", expected plumb_bob with k1 k2 p1 p2 k3; give a camera with "
                           "--camera, or record rectified images");
}

/// Units are parts of a metre (1/1000, 1/4000), which single precision does not hold exactly.
double WholeFactor(double factor) {
  constexpr double kSinglePrecision = 1e-6;  // a few times its relative round-off
  const double whole = std::round(factor);
  return std::abs(factor - whole) < kSinglePrecision * factor ? whole : factor;
}

}  // namespace

double DepthFactorOf(const BagFile& bag, const BagTopics& topics) {
  const std::string& depth_topic = topics.depth;
  if (bag.Image(depth_topic, 0).encoding == "32FC1") return kOfFloats;
  if (!IsOfRealSense(depth_topic)) return kMillimetres;
  const std::string stream = depth_topic.substr(0, depth_topic.find("/image/data"));
  const std::string sensor = stream.substr(0, stream.rfind('/'));
  for (const char* option : {"/option/Depth Units/value", "/option/Depth_Units/value"}) {
    if (bag.Find(sensor + option, BagTopic::Kind::kNumber) == nullptr) continue;
    const double unit_m = bag.Number(sensor + option);
    if (unit_m > 0 && unit_m <= 1) return WholeFactor(1 / unit_m);
    throw io::InputError(bag.file().string() + " (" + sensor + option + ")",
                         "the unit of depth is " + std::to_string(unit_m) +
                             " m, expected more than 0 and up to 1");
  }
  return kMillimetres;
}

Camera CameraOfInfo(const BagFile& bag, const std::string& info_topic,
                    const std::string& image_topic) {
  BagCameraInfo info = bag.CameraInfo(info_topic);
  const std::string where = bag.file().string() + " (" + info_topic + ")";
  const std::string name = image_topic.substr(image_topic.rfind('/') + 1);
  if (name.find("rect") != std::string::npos && info.p[0] != 0) {
    info.k = {info.p[0], 0, info.p[2], 0, info.p[5], info.p[6], 0, 0, 1};
    info.d.clear();
  }
  // The ranges of a camera file hold for this one too.
  std::string text = "depth_factor: 1000\n";
  const auto add = [&text](const char* key, double value) {
    text += std::string(key) + ": " + io::NumberText(value) + "\n";
  };
  add("width", info.width), add("height", info.height);
  add("fx", info.k[0]), add("fy", info.k[4]), add("cx", info.k[2]), add("cy", info.k[5]);
  const Lens lens = LensOf(info, where);
  const std::array<const char*, 5> keys = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    add(keys[i], lens[static_cast<Eigen::Index>(i)]);
  }
  try {
    return CameraUnder(io::YamlMap(io::ParseYaml(text, where)));
  } catch (const io::InputError& error) {
    // The line is one of the text above, which nobody has.
    const std::string message = error.what();
    throw io::InputError(where, message.substr(message.find(": ", where.size()) + 2));
  }
}

Camera CameraOfBag(const std::filesystem::path& file) {
  const BagFile bag(file);
  const BagTopics topics = ChooseTopics(bag);
  if (topics.colour_info.empty()) {
    throw io::InputError(file.string(), "has no CameraInfo beside " + topics.colour +
                                            "; pass --camera tum1, tum2, tum3 or a file");
  }
  Camera camera = CameraOfInfo(bag, topics.colour_info, topics.colour);
  camera.depth_factor = DepthFactorOf(bag, topics);
  return camera;
}

}  // namespace slam
