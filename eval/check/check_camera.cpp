#include "eval/check/check_camera.h"

#include <cstdlib>

#include "io/input_error.h"
#include "io/number_text.h"
#include "io/read_file.h"
#include "io/yaml_value.h"

namespace eval {
namespace {

const std::string kFile = "camera.yaml";

// Calls `read`; what it throws ("camera.yaml:8: fps: expected ...") is a fault.
template <typename Read>
void Collect(FolderCheck& check, Read read) {
  try {
    read();
  } catch (const io::InputError& error) {
    const std::string text = error.what();
    const bool placed = text.starts_with(kFile + ":");
    const int line = placed ? std::atoi(text.c_str() + kFile.size() + 1) : 0;
    check.Add(kFile, line, text.substr(text.find(": ") + 2), "write it as the format says");
  }
}

// Where the principal point of an image of so many pixels may be; anywhere when they are
// unknown.
io::Interval Inside(int pixels) {
  if (pixels == 0) return io::Interval("(-0.5, inf)");
  return io::Interval("(-0.5, " + io::NumberText(pixels - 0.5) + ")");
}

CheckedCamera ReadKeys(FolderCheck& check, const io::YamlMap& map) {
  CheckedCamera camera;
  const io::Interval size("(0, 100000)"), positive("(0, inf)"), any("(-inf, inf)");
  const auto whole = [&](const char* key, int& value) {
    Collect(check, [&] { value = map.At(key).Whole(size); });
  };
  const auto number = [&](const char* key, const io::Interval& domain, const char* unit,
                          double& value) {
    Collect(check, [&] { value = map.At(key).Number(domain, unit); });
  };
  Collect(check, [&] { map.At("model").OneOf({"pinhole"}); });
  whole("width", camera.width);
  whole("height", camera.height);
  number("fx", positive, "pixels", camera.fx);
  number("fy", positive, "pixels", camera.fy);
  number("cx", Inside(camera.width), "pixels", camera.cx);
  number("cy", Inside(camera.height), "pixels", camera.cy);
  double fps = 0;
  number("fps", positive, "frames per second", fps);
  number("depth_factor", positive, "depth units per metre", camera.depth_factor);
  const char* const names[] = {"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < camera.distortion.size(); ++i) {
    if (map.Has(names[i])) number(names[i], any, "as OpenCV's", camera.distortion[i]);
  }
  return camera;
}

}  // namespace

std::optional<CheckedCamera> CheckCamera(FolderCheck& check) {
  if (!check.Has(kFile)) return std::nullopt;
  check.files.insert(kFile);
  const std::size_t faults = check.faults.size();
  CheckedCamera camera;
  Collect(check, [&] {
    const std::string text = io::ReadFile(check.root / kFile);
    camera = ReadKeys(check, io::YamlMap(io::ParseYaml(text, kFile)));
  });
  if (check.faults.size() > faults) return std::nullopt;
  return camera;
}

}  // namespace eval
