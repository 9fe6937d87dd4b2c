#include "sim/shapes/body.h"

#include <Eigen/Geometry>

#include "sim/base/angle.h"

namespace sim {
namespace {

using Eigen::Vector3d;

constexpr int kRound = 18;  ///< corners about a limb
constexpr int kCap = 4;     ///< rings of a rounded end

/// From a to b, rounded at both ends.
struct Limb {
  Vector3d a, b;
  double radius_a, radius_b;
};

void AddRing(const Vector3d& middle, const Vector3d& u, const Vector3d& v, double radius,
             ClosedSurface& body) {
  for (int i = 0; i < kRound; ++i) {
    const SinCos turn = SinCosDeg(360.0 / kRound * i);
    body.vertices_o.push_back(middle + radius * (turn.cos * u + turn.sin * v));
  }
}

void AddLimb(const Limb& limb, ClosedSurface& body) {
  const Vector3d along = (limb.b - limb.a).normalized();
  const Vector3d u = along.unitOrthogonal(), v = along.cross(u);
  const int first = static_cast<int>(body.vertices_o.size());
  body.vertices_o.push_back(limb.a - limb.radius_a * along);
  const auto ring_at = [&](const Vector3d& end, double radius, double rise_deg) {
    const SinCos rise = SinCosDeg(rise_deg);
    AddRing(end + radius * rise.sin * along, u, v, radius * rise.cos, body);
  };
  for (int i = 1; i <= kCap; ++i) ring_at(limb.a, limb.radius_a, -90 + 90.0 * i / kCap);
  for (int i = 0; i < kCap; ++i) ring_at(limb.b, limb.radius_b, 90.0 * i / kCap);
  const int last = static_cast<int>(body.vertices_o.size());
  body.vertices_o.push_back(limb.b + limb.radius_b * along);
  constexpr int kRings = 2 * kCap;
  for (int i = 0; i < kRound; ++i) {
    const int next = (i + 1) % kRound;
    body.triangles.push_back({first, first + 1 + next, first + 1 + i});
    for (int k = 0; k + 1 < kRings; ++k) {
      const int low = first + 1 + k * kRound, high = low + kRound;
      body.triangles.push_back({low + i, low + next, high + next});
      body.triangles.push_back({low + i, high + next, high + i});
    }
    const int top = first + 1 + (kRings - 1) * kRound;
    body.triangles.push_back({last, top + i, top + next});
  }
}

ClosedSurface Filling(const std::vector<Limb>& limbs, const Vector3d& size) {
  ClosedSurface body;
  for (const Limb& limb : limbs) AddLimb(limb, body);
  Eigen::AlignedBox3d extent;
  for (const Vector3d& x : body.vertices_o) extent.extend(x);
  for (Vector3d& x : body.vertices_o) {
    const Vector3d part = (x - extent.min()).cwiseQuotient(extent.sizes());
    x = (part - Vector3d::Constant(0.5)).cwiseProduct(size);
  }
  return body;
}

}  // namespace

ClosedSurface PersonSurface(const Vector3d& size) {
  std::vector<Limb> limbs{{{0, 0, 1.63}, {0, -.01, 1.66}, .095, .105},  // head
                          {{0, .01, 1.44}, {0, 0, 1.58}, .055, .05},    // neck
                          {{-.07, 0, 1.05}, {.07, 0, 1.05}, .12, .12},  // hips
                          {{0, 0, 1.05}, {0, .01, 1.33}, .14, .15},
                          {{-.15, .01, 1.40}, {.15, .01, 1.40}, .08, .08}};  // shoulders
  for (const double s : {-1.0, 1.0}) {
    const double swing = 0.10 * s;  // walking
    limbs.push_back({{s * .09, 0, .98}, {s * .10, swing, .52}, .095, .065});
    limbs.push_back({{s * .10, swing, .52}, {s * .10, swing + .06, .09}, .06, .045});
    limbs.push_back({{s * .10, swing + .06, .05}, {s * .11, swing - .11, .045}, .045, .04});
    limbs.push_back({{s * .21, .01, 1.38}, {s * .26, .03, 1.10}, .055, .045});
    limbs.push_back({{s * .26, .03, 1.10}, {s * .25, -.12 - swing, .90}, .042, .034});
    limbs.push_back({{s * .25, -.13 - swing, .88}, {s * .24, -.17 - swing, .82}, .04, .03});
  }
  return Filling(limbs, size);
}

ClosedSurface HandSurface(const Vector3d& size) {
  std::vector<Limb> limbs{{{0, -.32, .03}, {0, -.03, .012}, .046, .030},
                          {{-.026, 0, 0}, {-.030, .065, 0}, .020, .018},
                          {{.0, 0, .002}, {0, .07, .003}, .022, .019},
                          {{.026, 0, 0}, {.030, .06, 0}, .020, .017},
                          {{-.045, .005, -.004}, {-.072, .045, -.010}, .014, .010}};
  const double lengths[4] = {.066, .078, .072, .055};
  for (int i = 0; i < 4; ++i) {
    const double x = -.033 + .022 * i, knuckle = .070 + .4 * (lengths[i] - .06);
    const double bend = knuckle + .55 * lengths[i];
    limbs.push_back({{x, knuckle, .002}, {1.05 * x, bend, -.004}, .0105, .009});
    limbs.push_back(
        {{1.05 * x, bend, -.004}, {1.08 * x, knuckle + lengths[i], -.020}, .009, .007});
  }
  return Filling(limbs, size);
}

}  // namespace sim
