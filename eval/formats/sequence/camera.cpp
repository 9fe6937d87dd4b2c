#include "eval/formats/sequence/camera.h"

#include <algorithm>
#include <iterator>

#include "eval/formats/sequence/camera_forms.h"
#include "io/number_text.h"
#include "io/yaml_value.h"

namespace eval {
namespace {

// Wider than any lens, sensor and file of one, and far from where squares overflow.
constexpr const char* kSize = "(0, 100000)";
constexpr int kMaxSize = 99999;  // the same of whole numbers
constexpr const char* kPositive = "(0, 1e9)";
constexpr const char* kAny = "(-1e9, 1e9)";
constexpr const char* kDistortion[] = {"k1", "k2", "p1", "p2", "k3"};

/// Reads the keys one by one, so that each fault is told.
class CameraKeys {
 public:
  CameraKeys(Folder& folder, const std::string& file, const io::YamlMap& map)
      : folder_(folder), file_(file), map_(map) {}

  std::optional<Camera> Read() {
    Try([&] { map_.At("model").OneOf({"pinhole"}); },
        map_.Has("model") ? Severity::kFatal : Severity::kFlaw);
    Camera camera;
    const io::Interval size(kSize), positive(kPositive), any(kAny);
    Try([&] { camera.width = map_.At("width").Whole(size); });
    Try([&] { camera.height = map_.At("height").Whole(size); });
    Number("fx", positive, "pixels", camera.fx);
    Number("fy", positive, "pixels", camera.fy);
    PrincipalPoint("cx", camera.width, camera.cx);
    PrincipalPoint("cy", camera.height, camera.cy);
    camera.fps = kUsualRate_Hz;
    Try([&] { camera.fps = map_.At("fps").Number(positive, "frames per second"); },
        map_.Has("fps") ? Severity::kFatal : Severity::kFlaw);
    Number("depth_factor", positive, "depth units per metre", camera.depth_factor);
    for (std::size_t i = 0; i < camera.distortion.size(); ++i) {
      if (map_.Has(kDistortion[i])) {
        Number(kDistortion[i], any, "as OpenCV's", camera.distortion[i]);
      }
    }
    return good_ ? std::optional(camera) : std::nullopt;
  }

 private:
  template <typename ReadKey>
  bool Try(const ReadKey& read, Severity severity = Severity::kFatal) {
    const bool good = folder_.Try(file_, read, severity);
    good_ = good_ && (good || severity != Severity::kFatal);
    return good;
  }

  bool Number(const char* key, const io::Interval& domain, const char* unit, double& value) {
    return Try([&] { value = map_.At(key).Number(domain, unit); });
  }

  /// It lies in the image, as a rule; a picture that was cut out of a larger one may lack it.
  void PrincipalPoint(const char* key, int pixels, double& value) {
    if (!Number(key, io::Interval(kAny), "pixels", value) || pixels == 0) return;
    const io::Interval inside("(-0.5, " + io::NumberText(pixels - 0.5) + ")");
    Try([&] { map_.At(key).Number(inside, "pixels"); }, Severity::kWarning);
  }

  Folder& folder_;
  const std::string& file_;
  const io::YamlMap& map_;
  bool good_ = true;
};

}  // namespace

Eigen::Vector2d PixelOf(const Camera& camera, const Eigen::Vector3d& x_c) {
  const double x = x_c.x() / x_c.z(), y = x_c.y() / x_c.z(), r2 = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {camera.fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + camera.cx,
          camera.fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + camera.cy};
}

std::optional<Camera> ReadCamera(Folder& folder, const std::string& file,
                                 const std::string& mend) {
  std::optional<Camera> camera;
  folder.Try(file, [&] {
    const io::YamlMap map(io::ReadYaml(folder.Open(file), mend));
    camera = CameraOfOtherForm(map);
    if (!camera) camera = CameraKeys(folder, file, map).Read();
  });
  return camera;
}

std::optional<Camera> ReadTrueCamera(Folder& folder) {
  const bool is_camera = folder.Try(
      kTrueCamera,
      [&] {
        const io::YamlMap map(io::ReadYaml(folder.Open(kTrueCamera)));
        if (CameraOfOtherForm(map)) return;
        for (const char* key : {"width", "height", "fx", "fy", "cx", "cy", "depth_factor"}) {
          if (!map.Has(key)) map.At(key).Number(io::Interval(kAny));  // throws what is missing
        }
      },
      Severity::kWarning);
  return is_camera ? ReadCamera(folder, kTrueCamera) : std::nullopt;
}

std::optional<Camera> ReadCamera(const JsonRecord& record) {
  const io::Interval positive(kPositive), any(kAny);
  const auto width = record.Integer("width", 1, kMaxSize);
  const auto height = record.Integer("height", 1, kMaxSize);
  const auto fx = record.Number("fx", positive), fy = record.Number("fy", positive);
  const auto cx = record.Number("cx", any), cy = record.Number("cy", any);
  const auto fps = record.Number("fps", positive);
  const auto depth_factor = record.Number("depth_factor", positive);
  if (!width || !height || !fx || !fy || !cx || !cy || !fps || !depth_factor) return {};
  Camera camera{*width, *height, *fx, *fy, *cx, *cy, *fps, *depth_factor};
  // One of them that is not there may have been lost; a camera without a lens has none.
  const bool has_lens = std::any_of(std::begin(kDistortion), std::end(kDistortion),
                                    [&](const char* key) { return record.Has(key); });
  for (std::size_t i = 0; has_lens && i < camera.distortion.size(); ++i) {
    camera.distortion[i] = record.Number(kDistortion[i], any).value_or(0);
  }
  return camera;
}

}  // namespace eval
