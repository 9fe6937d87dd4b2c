#include "sim/models/loops.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "sim/base/angle.h"

namespace sim {
namespace {

using Eigen::Vector3d;

/// How far `next` turns left of `along`, in (-pi, pi], seen from the front of `normal`.
double TurnLeft(const Vector3d& along, const Vector3d& next, const Vector3d& normal) {
  return Atan2Rad(normal.dot(along.cross(next)), along.dot(next));
}

double FromSegment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const Vector3d way = b - a;
  const double squared = way.squaredNorm();
  const double part = squared > 0 ? std::clamp(way.dot(x - a) / squared, 0.0, 1.0) : 0.0;
  return (x - a - part * way).norm();
}

/// Marks what must stay between two kept corners of a chain.
void Keep(const std::vector<Vector3d>& chain, std::size_t first, std::size_t last,
          double tolerance, std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> spans{{first, last}};
  while (!spans.empty()) {
    const auto [from, to] = spans.back();
    spans.pop_back();
    double farthest = tolerance;
    std::size_t at = 0;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off = FromSegment(chain[i], chain[from], chain[to]);
      if (!(off > farthest)) continue;
      farthest = off;
      at = i;
    }
    if (at == 0) continue;
    kept[at] = true;
    spans.emplace_back(from, at);
    spans.emplace_back(at, to);
  }
}

/// Area over the longest side squared; negative for what is no ear of what is left.
double EarQuality(const std::vector<Vector3d>& polygon, const std::vector<std::size_t>& left,
                  const std::array<std::size_t, 3>& t, const Vector3d& normal) {
  const Vector3d &a = polygon[t[0]], &b = polygon[t[1]], &c = polygon[t[2]];
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double quality = longest > 0 ? normal.dot((b - a).cross(c - b)) / longest : 0;
  if (!(quality > 0)) return quality;
  const auto on_or_left = [&](const Vector3d& from, const Vector3d& to, const Vector3d& x) {
    return normal.dot((to - from).cross(x - from)) >= 0;
  };
  for (const std::size_t i : left) {
    const Vector3d& x = polygon[i];
    if (i == t[0] || i == t[1] || i == t[2] || x == a || x == b || x == c) continue;
    if (on_or_left(a, b, x) && on_or_left(b, c, x) && on_or_left(c, a, x)) return -1;
  }
  return quality;
}

}  // namespace

Vector3d TwiceArea(const std::vector<Vector3d>& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  }
  return sum;
}

std::vector<std::vector<Vector3d>> Loops(const std::vector<std::pair<int, int>>& edges,
                                         const std::vector<Vector3d>& vertices,
                                         const Vector3d& normal) {
  const auto at = [&](int i) -> const Vector3d& {
    return vertices[static_cast<std::size_t>(i)];
  };
  std::multimap<int, int> out;
  for (const auto& [from, to] : edges) out.emplace(from, to);
  std::vector<std::vector<Vector3d>> loops;
  while (!out.empty()) {
    const int start = out.begin()->first;
    int before = start, here = out.begin()->second;
    out.erase(out.begin());
    std::vector<Vector3d> loop{at(start)};
    while (here != start) {
      loop.push_back(at(here));
      const auto [low, high] = out.equal_range(here);
      if (low == high) break;  // an open chain: the edges were no closed boundary
      const Vector3d along = at(here) - at(before);
      const auto left = std::max_element(low, high, [&](const auto& a, const auto& b) {
        return TurnLeft(along, at(a.second) - at(here), normal) <
               TurnLeft(along, at(b.second) - at(here), normal);
      });
      before = here;
      here = left->second;
      out.erase(left);
    }
    if (here == start && loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<std::array<std::size_t, 3>> Triangulated(const std::vector<Vector3d>& polygon) {
  const Vector3d normal = TwiceArea(polygon).normalized();
  std::vector<std::size_t> left(polygon.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<std::array<std::size_t, 3>> triangles;
  while (left.size() >= 3) {
    const std::size_t n = left.size();
    double best = -std::numeric_limits<double>::infinity();
    std::size_t ear = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<std::size_t, 3> t{left[(i + n - 1) % n], left[i], left[(i + 1) % n]};
      const double quality = EarQuality(polygon, left, t, normal);
      if (!(quality > best)) continue;
      best = quality;
      ear = i;
    }
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

std::vector<Vector3d> Simplified(const std::vector<Vector3d>& loop, double tolerance) {
  const std::size_t n = loop.size();
  if (n <= 3) return loop;
  const auto farthest = [&](const Vector3d& from) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if ((loop[i] - from).squaredNorm() > (loop[best] - from).squaredNorm()) best = i;
    }
    return best;
  };
  // Ends of the widest chord are corners of the hull, so both must stay.
  const std::size_t a = farthest(loop[0]);
  std::vector<Vector3d> chain(loop.begin() + static_cast<std::ptrdiff_t>(a), loop.end());
  chain.insert(chain.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(a) + 1);
  const std::size_t b = (farthest(loop[a]) + n - a) % n;
  std::vector<bool> kept(chain.size());
  kept[0] = kept[b] = true;
  Keep(chain, 0, b, tolerance, kept);
  Keep(chain, b, n, tolerance, kept);
  std::vector<Vector3d> simple;
  for (std::size_t i = 0; i < n; ++i) {
    if (kept[i]) simple.push_back(chain[i]);
  }
  return simple;
}

}  // namespace sim
