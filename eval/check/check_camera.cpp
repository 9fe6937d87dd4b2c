#include "eval/check/check_camera.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>

#include "eval/check/checked_text.h"

namespace eval {
namespace {

const std::string kFile = "camera.yaml";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Reads one number strictly inside (low, high) or on `low` when it says so.
class CameraKeys {
 public:
  CameraKeys(FolderCheck& check, YAML::Node root) : check_(check), root_(std::move(root)) {}

  double Number(const std::string& key, double above, double below, const std::string& unit) {
    const YAML::Node node = root_[key];
    if (!node) return Fail(0, key + " is missing", "add `" + key + ": <number>` in " + unit);
    const int line = node.Mark().line + 1;
    const auto value =
        node.IsScalar() ? FiniteNumberIn(node.Scalar()) : std::optional<double>();
    if (!value) return Fail(line, key + " is not a finite number", "give it in " + unit);
    if (*value > above && *value < below) return *value;
    return Fail(line, fmt::format("{} is {}; expected {}", key, *value, Range(above, below)),
                "give it in " + unit);
  }

  int Size(const std::string& key) {
    const double value = Number(key, 0, 100000, "pixels");
    if (std::isnan(value) || value == std::floor(value)) {
      return std::isnan(value) ? 0 : static_cast<int>(value);
    }
    Fail(root_[key].Mark().line + 1, fmt::format("{} is {}; expected whole pixels", key, value),
         "give a whole number");
    return 0;
  }

  double Optional(const std::string& key) {
    return root_[key] ? Number(key, -kInfinity, kInfinity, "the model of OpenCV") : 0.0;
  }

  double Fail(int line, std::string what, std::string mend) {
    good_ = false;
    check_.Add(kFile, line, std::move(what), std::move(mend));
    return std::numeric_limits<double>::quiet_NaN();
  }

  bool good() const { return good_; }

 private:
  static std::string Range(double above, double below) {
    if (std::isinf(below)) return fmt::format("more than {}", above);
    return fmt::format("between {} and {}", above, below);
  }

  FolderCheck& check_;
  YAML::Node root_;
  bool good_ = true;
};

void CheckModel(CameraKeys& keys, const YAML::Node& root) {
  const YAML::Node model = root["model"];
  if (!model) {
    keys.Fail(0, "model is missing", "add `model: pinhole`");
  } else if (!model.IsScalar() || model.Scalar() != "pinhole") {
    keys.Fail(model.Mark().line + 1, "model is not pinhole",
              "only `model: pinhole` is defined");
  }
}

}  // namespace

std::optional<CheckedCamera> CheckCamera(FolderCheck& check) {
  if (!check.Has(kFile)) return std::nullopt;
  check.files.insert(kFile);
  YAML::Node root;
  try {
    root = YAML::LoadFile((check.root / kFile).string());
  } catch (const YAML::Exception& error) {
    check.Add(kFile, error.mark.line + 1, "is not valid YAML: " + error.msg, "mend the syntax");
    return std::nullopt;
  }
  if (!root.IsMap()) {
    check.Add(kFile, 0, "is not a list of `key: value`", "write one key a line");
    return std::nullopt;
  }
  CameraKeys keys(check, root);
  CheckModel(keys, root);
  CheckedCamera camera;
  camera.width = keys.Size("width");
  camera.height = keys.Size("height");
  camera.fx = keys.Number("fx", 0, kInfinity, "pixels");
  camera.fy = keys.Number("fy", 0, kInfinity, "pixels");
  camera.cx =
      keys.Number("cx", -0.5, camera.width > 0 ? camera.width - 0.5 : kInfinity, "pixels");
  camera.cy =
      keys.Number("cy", -0.5, camera.height > 0 ? camera.height - 0.5 : kInfinity, "pixels");
  keys.Number("fps", 0, kInfinity, "frames per second");
  camera.depth_factor = keys.Number("depth_factor", 0, kInfinity, "depth units per metre");
  const char* const names[] = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < 5; ++i) camera.distortion[i] = keys.Optional(names[i]);
  if (!keys.good()) return std::nullopt;
  return camera;
}

}  // namespace eval
