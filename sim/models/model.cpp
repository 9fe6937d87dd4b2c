#include "sim/models/model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "io/input_error.h"
#include "io/number_text.h"
#include "sim/models/model_file.h"
#include "sim/models/model_planes.h"

namespace sim {
namespace {

using Eigen::Vector3d;

constexpr double kMinTwiceArea_m2 = 1e-14;  ///< twice the area of a triangle that is kept

std::string PointText(const Vector3d& x) {
  const auto text = [](double a) { return io::NumberText(std::round(a * 1e6) / 1e6 + 0.0); };
  return "(" + text(x.x()) + ", " + text(x.y()) + ", " + text(x.z()) + ")";
}

void CheckCorners(const ModelFile& file, const std::string& path) {
  for (std::size_t t = 0; t < file.triangles.size(); ++t) {
    for (const Vector3d& x : file.triangles[t]) {
      if (x.allFinite()) continue;
      throw io::InputError(path, "triangle " + std::to_string(t + 1) +
                                     " has a corner that is not finite; mend the file");
    }
  }
}

/// The largest part of a triangle list, in metres, about the middle of its box.
void TakeShape(const ModelFile& file, Model& model, const std::string& path) {
  Eigen::AlignedBox3d box;
  for (const auto& corners : file.triangles) {
    for (const Vector3d& x : corners) box.extend(x * model.options.scale);
  }
  model.middle_f = box.center();
  model.size = box.sizes().cwiseMax(kMinSize_m);
  if (!(model.size.maxCoeff() <= kMaxSize_m && box.sizes().maxCoeff() >= kMinSize_m)) {
    throw io::InputError(path,
                         "is " + io::NumberText(std::round(1e3 * model.size.maxCoeff()) / 1e3) +
                             " m large; expected 0.01 mm to 50 m: set `scale` to metres a unit "
                             "of the file (0.001 for millimetres)");
  }
  std::map<std::array<double, 3>, int> vertex;
  for (std::size_t t = 0; t < file.triangles.size(); ++t) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d x = file.triangles[t][k] * model.options.scale - model.middle_f;
      const auto [at, fresh] =
          vertex.try_emplace({x.x(), x.y(), x.z()}, static_cast<int>(model.vertices_o.size()));
      if (fresh) model.vertices_o.push_back(x);
      triangle[k] = at->second;
    }
    // One that repeats a corner covers nothing: an exporter's sliver.
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    if (model.options.flip) std::swap(triangle[1], triangle[2]);
    model.triangles.push_back(triangle);
    model.colour_of.push_back(file.colour_of[t]);
  }
}

/// Edges by how often each of their directions occurs.
struct EdgeUse {
  int there = 0, back = 0;
  bool Closed() const { return there == 1 && back == 1; }
};

void CheckEdges(const Model& model, const std::string& path) {
  std::map<std::pair<int, int>, EdgeUse> uses;
  for (const auto& t : model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      (a < b ? uses[{a, b}].there : uses[{b, a}].back) += 1;
    }
  }
  std::size_t open = 0, twisted = 0, crowded = 0;
  std::pair<int, int> first{-1, -1};
  for (const auto& [edge, use] : uses) {
    if (use.Closed()) continue;
    if (first.first < 0) first = edge;
    const int triangles = use.there + use.back;
    ++(triangles == 1 ? open : triangles == 2 ? twisted : crowded);
  }
  const std::size_t bad = open + twisted + crowded;
  if (static_cast<double>(bad) <= model.options.open_edges * static_cast<double>(uses.size())) {
    return;
  }
  const Vector3d at = model.vertices_o[static_cast<std::size_t>(first.first)] + model.middle_f;
  throw io::InputError(
      path, "is no closed surface: of " + std::to_string(uses.size()) + " edges " +
                std::to_string(open) + " have one triangle, " + std::to_string(twisted) +
                " two that disagree which side is out, " + std::to_string(crowded) +
                " more than two; the first is at " + PointText(at / model.options.scale) +
                ". Mend it, or allow a share of such edges with `open_edges`");
}

void CheckSide(const Model& model, const std::string& path) {
  double volume = 0;
  for (const auto& [a, b, c] : model.triangles) {
    const auto x = [&](int i) { return model.vertices_o[static_cast<std::size_t>(i)]; };
    volume += x(a).dot(x(b).cross(x(c))) / 6;
  }
  // A sheet with one side encloses nothing.
  if (model.options.open_edges > 0 && !(volume < -1e-3 * model.size.prod())) return;
  if (volume > 0) return;
  throw io::InputError(path,
                       "is inside out: its triangles turn their fronts inwards; flip the "
                       "normals, or set `flip: true`");
}

/// Triangles without area join their neighbours, but show nothing.
void DropThinTriangles(Model& model, const std::string& path) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto x = [&](std::size_t k) {
      return model.vertices_o[static_cast<std::size_t>(model.triangles[t][k])];
    };
    if (!((x(1) - x(0)).cross(x(2) - x(0)).norm() > kMinTwiceArea_m2)) continue;
    model.triangles[kept] = model.triangles[t];
    model.plane_of[kept] = model.plane_of[t];
    model.colour_of[kept] = model.colour_of[t];
    ++kept;
  }
  if (kept == 0)
    throw io::InputError(path, "has only triangles without area; expected a surface");
  model.triangles.resize(kept);
  model.plane_of.resize(kept);
  model.colour_of.resize(kept);
}

}  // namespace

Model ReadModel(const ModelOptions& options, const std::filesystem::path& folder) {
  const std::filesystem::path full = folder / options.file;
  const std::string path = full.string();
  const ModelFile file = ReadModelFile(full);
  CheckCorners(file, path);
  Model model;
  model.options = options;
  model.sha256 = file.sha256;
  model.colours = file.colours;
  TakeShape(file, model, path);
  CheckEdges(model, path);
  CheckSide(model, path);
  if (options.declared.empty()) {
    FindPlanes(model);
  } else if (const int missed = TakeDeclaredPlanes(model); missed >= 0) {
    throw io::InputError(path,
                         "has no triangle in plane " + std::to_string(missed + 1) +
                             " of `planes`; give its corners in the coordinates of the file");
  }
  DropThinTriangles(model, path);
  return model;
}

}  // namespace sim
