#include "sim/scene/read_model.h"

#include "io/number_text.h"

namespace sim {
namespace {

constexpr double kMaxInFile = 1e6;
constexpr std::size_t kMaxPlanes = 1000, kMaxCorners = 1000;

std::vector<std::vector<Eigen::Vector3d>> ReadPlanes(const io::YamlValue& value) {
  std::vector<std::vector<Eigen::Vector3d>> planes;
  for (const io::YamlValue& entry : value.List(kMaxPlanes)) {
    planes.emplace_back();
    for (const io::YamlValue& corner : entry.List(kMaxCorners)) {
      planes.back().push_back(
          corner.Numbers(3, {-kMaxInFile, kMaxInFile}, "units of the file"));
    }
    if (planes.back().size() < 3) entry.Fail("expected 3 corners or more");
  }
  if (planes.empty()) value.Fail("expected a plane, or leave the key out to find them");
  return planes;
}

ModelOptions ReadOptions(const io::YamlMap& map) {
  ModelOptions options;
  const auto number = [&](const char* key, double low, double high, double otherwise) {
    return map.Has(key) ? map.At(key).Number({low, high}) : otherwise;
  };
  options.file = map.At("mesh").Path();
  options.scale = number("scale", 1e-9, 1e6, 1);
  options.flip = map.Has("flip") && map.At("flip").Flag();
  options.flatness_m = number("flatness_mm", 0.001, 20, 1e3 * options.flatness_m) / 1e3;
  options.min_plane_m2 = number("min_plane_cm2", 0.01, 1e6, 1e4 * options.min_plane_m2) / 1e4;
  options.open_edges = number("open_edges", 0, 1, 0);
  if (map.Has("planes")) options.declared = ReadPlanes(map.At("planes"));
  return options;
}

std::string PlanesText(const std::vector<std::vector<Eigen::Vector3d>>& planes) {
  std::string text;
  for (const auto& plane : planes) {
    text += "      - [";
    for (std::size_t i = 0; i < plane.size(); ++i) {
      text += std::string(i > 0 ? ", " : "") + "[" + io::NumberText(plane[i].x()) + ", " +
              io::NumberText(plane[i].y()) + ", " + io::NumberText(plane[i].z()) + "]";
    }
    text += "]\n";
  }
  return text;
}

}  // namespace

void ReadObjectModel(const io::YamlMap& map, const std::filesystem::path& folder,
                     Object& object) {
  if (map.Has("size_m")) {
    map.At("size_m").Fail("is given by the mesh; leave it out, and set `scale`");
  }
  if (map.Has("center_m") + map.Has("origin_m") + map.Has("way") != 1) {
    map.value().Fail(
        "a mesh stands by `center_m` (middle of its box) or `origin_m` (place of the file's "
        "origin), or moves along a `way`; give one of them");
  }
  const auto model = std::make_shared<Model>(ReadModel(ReadOptions(map), folder));
  if (map.Has("mesh_sha256") && map.At("mesh_sha256").Word() != model->sha256) {
    map.At("mesh_sha256")
        .Fail("differs from that of " + model->options.file + ", " + model->sha256 +
              ": the mesh has changed; bring it back, or remove this line");
  }
  object.shape = ShapeKind::kMesh;
  object.size = model->size;
  object.model_colours = !map.Has("faces");
  if (map.Has("origin_m")) {
    const Eigen::Vector3d origin_w =
        map.At("origin_m").Numbers(3, {-kMaxCoordinate_m, kMaxCoordinate_m}, "metres");
    object.center_w = origin_w + object.q_wo * model->middle_f;
  }
  object.model = model;
}

std::string ModelText(const Object& object) {
  const ModelOptions& options = object.model->options;
  const ModelOptions usual;
  std::string text =
      "    mesh: " + options.file + "\n    mesh_sha256: " + object.model->sha256 + "\n";
  const auto line = [&](const char* key, const std::string& value) {
    text += std::string("    ") + key + ": " + value + "\n";
  };
  if (options.scale != usual.scale) line("scale", io::NumberText(options.scale));
  if (options.flip) line("flip", "true");
  if (options.flatness_m != usual.flatness_m) {
    line("flatness_mm", io::NumberText(1e3 * options.flatness_m));
  }
  if (options.min_plane_m2 != usual.min_plane_m2) {
    line("min_plane_cm2", io::NumberText(1e4 * options.min_plane_m2));
  }
  if (options.open_edges != 0) line("open_edges", io::NumberText(options.open_edges));
  if (!options.declared.empty()) text += "    planes:\n" + PlanesText(options.declared);
  return text;
}

}  // namespace sim
