#include "sim/shapes/toy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/base/random.h"

namespace sim {
namespace {

constexpr int kSubdivisions = 2;       // 20 * 4^2 = 320 triangles
constexpr double kBaseHeight = -0.55;  // of the unit body; what is lower is pressed flat

ClosedSurface Icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  ClosedSurface body;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      body.vertices_o.emplace_back(0, a, b);
      body.vertices_o.emplace_back(a, b, 0);
      body.vertices_o.emplace_back(b, 0, a);
    }
  }
  const auto adjacent = [&](int i, int j) {
    const auto& v = body.vertices_o;
    return (v[static_cast<std::size_t>(i)] - v[static_cast<std::size_t>(j)]).squaredNorm() <
           4.5;
  };
  for (int i = 0; i < 12; ++i) {
    for (int j = i + 1; j < 12; ++j) {
      for (int k = j + 1; k < 12; ++k) {
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(i, k)) continue;
        const Eigen::Vector3d& a = body.vertices_o[static_cast<std::size_t>(i)];
        const Eigen::Vector3d& b = body.vertices_o[static_cast<std::size_t>(j)];
        const Eigen::Vector3d& c = body.vertices_o[static_cast<std::size_t>(k)];
        const bool outward = (b - a).cross(c - a).dot(a) > 0;
        body.triangles.push_back(outward ? std::array{i, j, k} : std::array{i, k, j});
      }
    }
  }
  for (Eigen::Vector3d& vertex : body.vertices_o) vertex.normalize();
  return body;
}

ClosedSurface Subdivided(const ClosedSurface& coarse) {
  ClosedSurface fine{coarse.vertices_o, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), 0);
    if (is_new) {
      at->second = static_cast<int>(fine.vertices_o.size());
      const Eigen::Vector3d sum = coarse.vertices_o[static_cast<std::size_t>(i)] +
                                  coarse.vertices_o[static_cast<std::size_t>(j)];
      fine.vertices_o.push_back(sum.normalized());
    }
    return at->second;
  };
  for (const auto& [i, j, k] : coarse.triangles) {
    const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
    fine.triangles.insert(fine.triangles.end(),
                          {{i, ij, ki}, {ij, j, jk}, {ki, jk, k}, {ij, jk, ki}});
  }
  return fine;
}

struct Bump {
  Eigen::Vector3d direction;
  double height;
  double reach;  ///< 1 - cosine of its radius
};

/// Drawn one by one: compilers differ in the order in which arguments are evaluated.
Eigen::Vector3d InCube(double half, Random& random) {
  Eigen::Vector3d point;
  for (int i = 0; i < 3; ++i) point[i] = random.Between(-half, half);
  return point;
}

/// Body, head, two ears, limbs: enough lumps that no large patch is flat.
std::vector<Bump> Bumps(Random& random) {
  std::vector<Bump> bumps;
  const auto add = [&](double x, double y, double z, double height, double reach) {
    const Eigen::Vector3d shake = InCube(0.2, random);
    bumps.push_back({(Eigen::Vector3d(x, y, z) + shake).normalized(),
                     height * random.Between(0.8, 1.2), reach * random.Between(0.8, 1.2)});
  };
  add(0, 0, 1, 0.45, 0.45);
  for (const double side : {-1.0, 1.0}) {
    add(0.55 * side, 0.1, 0.8, 0.35, 0.08);
    add(side, -0.3, 0.1, 0.40, 0.18);
    add(0.6 * side, -0.8, -0.5, 0.45, 0.18);
  }
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d at = InCube(1, random);
    add(at.x(), at.y(), std::max(at.z(), -0.5), 0.12, 0.12);
  }
  return bumps;
}

double Radius(const std::vector<Bump>& bumps, const Eigen::Vector3d& direction) {
  double radius = 0.6;
  for (const Bump& bump : bumps) {
    const double inside = 1 - (1 - bump.direction.dot(direction)) / bump.reach;
    if (inside > 0) radius += bump.height * inside * inside * (3 - 2 * inside);
  }
  return radius;
}

std::vector<Bump> Leaves(Random& random) {
  std::vector<Bump> bumps;
  for (int i = 0; i < 48; ++i) {
    const Eigen::Vector3d at = InCube(1, random);
    const double height = random.Between(0.15, 0.5);
    bumps.push_back({at.normalized(), height, random.Between(0.02, 0.08)});
  }
  return bumps;
}

ClosedSurface Lump(const std::vector<Bump>& bumps, int subdivisions,
                   const Eigen::Vector3d& size) {
  ClosedSurface body = Icosahedron();
  for (int i = 0; i < subdivisions; ++i) body = Subdivided(body);
  Eigen::AlignedBox3d extent;
  for (Eigen::Vector3d& vertex : body.vertices_o) {
    vertex *= Radius(bumps, vertex);
    vertex.z() = std::max(vertex.z(), kBaseHeight);
    extent.extend(vertex);
  }
  for (Eigen::Vector3d& vertex : body.vertices_o) {
    const Eigen::Vector3d part = (vertex - extent.min()).cwiseQuotient(extent.sizes());
    vertex = (part - Eigen::Vector3d::Constant(0.5)).cwiseProduct(size);
  }
  return body;
}

}  // namespace

ClosedSurface ToySurface(const Eigen::Vector3d& size, std::uint64_t seed) {
  Random random({0x746f79, seed});
  return Lump(Bumps(random), kSubdivisions, size);
}

ClosedSurface BushSurface(const Eigen::Vector3d& size, std::uint64_t seed) {
  Random random({0x62757368, seed});
  return Lump(Leaves(random), kSubdivisions + 1, size);
}

}  // namespace sim
