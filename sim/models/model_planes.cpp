#include "sim/models/model_planes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "sim/models/loops.h"

namespace sim {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;

constexpr double kAlike = 0.9;  ///< cosine: a triangle of the plane faces as it does
constexpr double kSmooth = 0.965925826289;  ///< cos 15 degrees
constexpr double kMaxSmooth = 0.5;          ///< share of a plane's rim
constexpr double kOutline_m = 5e-5;
constexpr double kSliver_m = 1e-6;  ///< height of a triangle; single precision makes 1e-7
constexpr int kFits = 3;

struct Flat {
  Vector3d n;
  double d;
  double From(const Vector3d& x) const { return std::abs(n.dot(x) + d); }
};

/// The triangles of a model with their neighbours.
class Faces {
 public:
  explicit Faces(const Model& model) : model_(model) {
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
      twice_.push_back((At(t, 1) - At(t, 0)).cross(At(t, 2) - At(t, 0)));
      for (std::size_t k = 0; k < 3; ++k) of_edge_.emplace(EdgeOf(t, k), static_cast<int>(t));
    }
  }
  std::size_t Count() const { return twice_.size(); }
  const Vector3d& At(std::size_t t, std::size_t k) const {
    return model_.vertices_o[static_cast<std::size_t>(model_.triangles[t][k])];
  }
  Edge EdgeOf(std::size_t t, std::size_t k) const {
    return {model_.triangles[t][k], model_.triangles[t][(k + 1) % 3]};
  }
  /// Across edge k; -1 when there is none or more than one.
  int Neighbour(std::size_t t, std::size_t k) const {
    const Edge edge = EdgeOf(t, k);
    const auto [low, high] = of_edge_.equal_range({edge.second, edge.first});
    return low != high && std::next(low) == high ? low->second : -1;
  }
  const Vector3d& Twice(std::size_t t) const { return twice_[t]; }
  Vector3d Normal(std::size_t t) const { return twice_[t].normalized(); }
  /// Too thin for a normal of its own: what is left of corners on one line.
  bool IsSliver(std::size_t t) const {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (At(t, (k + 1) % 3) - At(t, k)).norm());
    }
    return twice_[t].norm() <= kSliver_m * longest;
  }
  /// Whether it looks the way of the plane.
  bool LooksAs(std::size_t t, const Flat& plane) const {
    return IsSliver(t) || Normal(t).dot(plane.n) > kAlike;
  }
  double FarthestFrom(const Flat& plane, std::size_t t) const {
    return std::max({plane.From(At(t, 0)), plane.From(At(t, 1)), plane.From(At(t, 2))});
  }
  /// Area-weighted normal through the area-weighted middle.
  Flat Fit(const std::vector<std::size_t>& region) const {
    Vector3d sum = Vector3d::Zero(), middle = Vector3d::Zero();
    double area = 0;
    for (const std::size_t t : region) {
      const double weight = twice_[t].norm();
      sum += twice_[t];
      middle += weight * (At(t, 0) + At(t, 1) + At(t, 2)) / 3;
      area += weight;
    }
    const Vector3d n = sum.normalized();
    return {n, -n.dot(middle / area)};
  }

 private:
  const Model& model_;
  std::vector<Vector3d> twice_;
  std::multimap<Edge, int> of_edge_;
};

std::vector<std::size_t> Grow(const Faces& faces, std::size_t seed, const Flat& plane,
                              const Model& model) {
  std::vector<std::size_t> region{seed};
  std::set<std::size_t> in{seed};
  for (std::size_t next = 0; next < region.size(); ++next) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int across = faces.Neighbour(region[next], k);
      if (across < 0) continue;
      const auto t = static_cast<std::size_t>(across);
      if (in.contains(t) || model.plane_of[t] >= 0) continue;
      if (!(faces.FarthestFrom(plane, t) <= model.options.flatness_m)) continue;
      if (!faces.LooksAs(t, plane)) continue;
      in.insert(t);
      region.push_back(t);
    }
  }
  std::sort(region.begin(), region.end());
  return region;
}

struct Rim {
  std::vector<Edge> edges;
  double length = 0, smooth = 0;
};

Rim RimOf(const Faces& faces, const std::vector<std::size_t>& region) {
  const std::set<std::size_t> in(region.begin(), region.end());
  Rim rim;
  for (const std::size_t t : region) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int across = faces.Neighbour(t, k);
      if (across >= 0 && in.contains(static_cast<std::size_t>(across))) continue;
      const double length = (faces.At(t, (k + 1) % 3) - faces.At(t, k)).norm();
      rim.edges.push_back(faces.EdgeOf(t, k));
      rim.length += length;
      if (across >= 0 &&
          faces.Normal(t).dot(faces.Normal(static_cast<std::size_t>(across))) > kSmooth) {
        rim.smooth += length;
      }
    }
  }
  return rim;
}

ModelPlane PlaneWith(const Flat& flat, std::vector<std::vector<Vector3d>> loops) {
  ModelPlane plane;
  plane.n_o = flat.n;
  plane.d = flat.d;
  double widest = 0;
  for (std::vector<Vector3d>& loop : loops) {
    for (Vector3d& x : loop) x -= (flat.n.dot(x) + flat.d) * flat.n;
    loop = Simplified(loop, kOutline_m);
    const double area = flat.n.dot(TwiceArea(loop)) / 2;
    plane.area_m2 += area;
    if (area > widest) {
      widest = area;
      std::swap(plane.outline_o, loop);
    }
    if (loop.size() >= 3) plane.holes_o.push_back(loop);
  }
  return plane;
}

}  // namespace

void FindPlanes(Model& model) {
  const Faces faces(model);
  model.planes.clear();
  model.plane_of.assign(faces.Count(), -1);
  std::vector<std::size_t> order(faces.Count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return faces.Twice(a).squaredNorm() > faces.Twice(b).squaredNorm();
  });
  std::set<std::size_t> tried;  // no need to grow again from within what was no plane
  for (const std::size_t seed : order) {
    if (model.plane_of[seed] >= 0 || tried.contains(seed) || faces.IsSliver(seed)) continue;
    const Vector3d n = faces.Normal(seed);
    Flat plane{n, -n.dot(faces.At(seed, 0))};
    std::vector<std::size_t> region = Grow(faces, seed, plane, model);
    for (int i = 0; i < kFits; ++i) {
      plane = faces.Fit(region);
      if (!(faces.FarthestFrom(plane, seed) <= model.options.flatness_m)) break;
      region = Grow(faces, seed, plane, model);
    }
    tried.insert(region.begin(), region.end());
    if (!(faces.FarthestFrom(plane, seed) <= model.options.flatness_m)) continue;
    const Rim rim = RimOf(faces, region);
    if (rim.smooth > kMaxSmooth * rim.length) continue;
    ModelPlane found = PlaneWith(plane, Loops(rim.edges, model.vertices_o, plane.n));
    if (!(found.area_m2 >= model.options.min_plane_m2) || found.outline_o.size() < 3) continue;
    for (const std::size_t t : region) {
      model.plane_of[t] = static_cast<int>(model.planes.size());
    }
    model.planes.push_back(std::move(found));
  }
}

namespace {

/// Whether a point of the plane is inside the outline: the outline goes round it.
bool Inside(const std::vector<Vector3d>& outline, const Vector3d& n, const Vector3d& x) {
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3d a = outline[i] - x, b = outline[(i + 1) % outline.size()] - x;
    const double va = v.dot(a), vb = v.dot(b);
    if ((va > 0) == (vb > 0)) continue;
    if (u.dot(a) + va / (va - vb) * (u.dot(b) - u.dot(a)) > 0) inside = !inside;
  }
  return inside;
}

int TakeTriangles(const Faces& faces, const ModelPlane& plane, int index, Model& model) {
  const Flat flat{plane.n_o, plane.d};
  int taken = 0;
  for (std::size_t t = 0; t < faces.Count(); ++t) {
    if (model.plane_of[t] >= 0 || !faces.LooksAs(t, flat)) continue;
    if (!(faces.FarthestFrom(flat, t) <= model.options.flatness_m)) continue;
    const Vector3d middle = (faces.At(t, 0) + faces.At(t, 1) + faces.At(t, 2)) / 3;
    if (!Inside(plane.outline_o, flat.n, middle)) continue;
    model.plane_of[t] = index;
    ++taken;
  }
  return taken;
}

}  // namespace

int TakeDeclaredPlanes(Model& model) {
  const Faces faces(model);
  model.planes.clear();
  model.plane_of.assign(faces.Count(), -1);
  for (std::size_t i = 0; i < model.options.declared.size(); ++i) {
    std::vector<Vector3d> outline;
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& x_f : model.options.declared[i]) {
      outline.push_back(x_f * model.options.scale - model.middle_f);
      middle += outline.back();
    }
    middle /= static_cast<double>(outline.size());
    int taken = 0;
    // Either sense of turning is fine: the triangles know the front.
    for (int sense = 0; sense < 2 && taken == 0; ++sense) {
      std::reverse(outline.begin(), outline.end());
      const Vector3d n = TwiceArea(outline).normalized();
      ModelPlane plane = PlaneWith({n, -n.dot(middle)}, {outline});
      taken = TakeTriangles(faces, plane, static_cast<int>(i), model);
      if (taken > 0) model.planes.push_back(std::move(plane));
    }
    if (taken == 0) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace sim
