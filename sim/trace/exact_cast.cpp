#include "sim/trace/exact_cast.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace sim {
namespace {

constexpr int kLeaf = 4;             ///< triangles
constexpr double kPadding_m = 1e-9;  ///< so that rounding never loses a flat box
constexpr double kSame = 1e-12;      ///< share of the distance
constexpr std::size_t kDeepest = 64;

/// Where the ray enters the box, or infinity.
double Enter(const Eigen::Array3d& low, const Eigen::Array3d& high,
             const Eigen::Array3d& origin, const Eigen::Array3d& inverse, double far) {
  const Eigen::Array3d a = (low - origin) * inverse, b = (high - origin) * inverse;
  double enter = 0, leave = far;
  for (int axis = 0; axis < 3; ++axis) {
    // A ray in the plane of a side gives NaN; boxes are padded, so that nothing lies there.
    const double in = a[axis] < b[axis] ? a[axis] : b[axis];
    const double out = a[axis] < b[axis] ? b[axis] : a[axis];
    if (in > enter) enter = in;
    if (out < leave) leave = out;
  }
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace

ExactCaster::ExactCaster(std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners_w;
    triangles_.push_back({a, b, c});
  }
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) Build(0, static_cast<int>(order_.size()));
}

int ExactCaster::Build(int first, int count) {
  const auto corners = [&](int i) -> const Corners& {
    return triangles_[static_cast<std::size_t>(i)];
  };
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  // The node's box holds all its triangles.
  node.low.setConstant(std::numeric_limits<double>::infinity());
  node.high = -node.low;
  const auto begin = order_.begin() + first;
  for (auto it = begin; it != begin + count; ++it) {
    for (const Eigen::Vector3d* x : {&corners(*it).a, &corners(*it).b, &corners(*it).c}) {
      node.low = node.low.min(x->array());
      node.high = node.high.max(x->array());
    }
  }
  node.low -= kPadding_m;
  node.high += kPadding_m;
  if (count <= kLeaf) {
    node.first = first;
    node.count = count;
  } else {
    // Half of the triangles go to each child, parted along the longest side. Ties go by index,
    // so that the tree is the same everywhere.
    Eigen::Index axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const auto middle = [&](int i) {
      return corners(i).a[axis] + corners(i).b[axis] + corners(i).c[axis];
    };
    std::nth_element(begin, begin + count / 2, begin + count, [&](int i, int j) {
      return middle(i) != middle(j) ? middle(i) < middle(j) : i < j;
    });
    node.left = Build(first, count / 2);
    node.right = Build(first + count / 2, count - count / 2);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

void ExactCaster::Try(int triangle, const Eigen::Vector3d& origin_w,
                      const Eigen::Vector3d& direction_w, double near, ExactHit& best) const {
  const Corners& t = triangles_[static_cast<std::size_t>(triangle)];
  const Eigen::Vector3d a = t.a - origin_w, b = t.b - origin_w, c = t.c - origin_w;
  // Volumes spanned by the ray and each edge; a neighbour sees its edge reversed, which negates
  // the volume exactly, so no ray slips between the two.
  const double ab = direction_w.dot(a.cross(b)), bc = direction_w.dot(b.cross(c)),
               ca = direction_w.dot(c.cross(a));
  const bool inside = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  const double sum = ab + bc + ca;
  if (!inside || !(sum != 0)) return;
  // The distance comes from the plane, in units of the direction.
  const Eigen::Vector3d n = (t.b - t.a).cross(t.c - t.a);
  const double slope = n.dot(direction_w), distance = n.dot(a) / slope;
  if (!(distance > near)) return;
  const ExactHit hit{triangle, distance, slope < 0};
  // Of triangles at one distance, that seen from its front wins, then the first in the scene.
  if (best.triangle < 0 || distance < best.distance * (1 - kSame)) {
    best = hit;
  } else if (distance <= best.distance * (1 + kSame)) {
    const bool better =
        hit.from_front != best.from_front ? hit.from_front : triangle < best.triangle;
    if (better) best = hit;
  }
}

ExactHit ExactCaster::Nearest(const Eigen::Vector3d& origin_w,
                              const Eigen::Vector3d& direction_w, double near) const {
  ExactHit best;
  if (nodes_.empty()) return best;
  const Eigen::Array3d origin = origin_w.array(), inverse = direction_w.array().inverse();
  struct Visit {
    int node;
    double enter;
  };
  std::array<Visit, kDeepest> stack;
  std::size_t size = 0;
  const auto far = [&] {  // beyond the best: what is as near must be seen too
    return best.triangle < 0 ? std::numeric_limits<double>::infinity()
                             : best.distance * (1 + 2 * kSame);
  };
  const auto visit = [&](int index) -> Visit {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    return {index, Enter(node.low, node.high, origin, inverse, far())};
  };
  stack[size++] = visit(0);
  while (size > 0) {
    const Visit at = stack[--size];
    if (!(at.enter <= far()) || at.enter == std::numeric_limits<double>::infinity()) continue;
    const Node& node = nodes_[static_cast<std::size_t>(at.node)];
    for (int i = node.first; i < node.first + node.count; ++i) {
      Try(order_[static_cast<std::size_t>(i)], origin_w, direction_w, near, best);
    }
    if (node.count > 0) continue;
    // The nearer child is looked at first: what it holds may rule the other out.
    Visit first = visit(node.left), second = visit(node.right);
    if (second.enter < first.enter) std::swap(first, second);
    if (second.enter <= far()) stack[size++] = second;
    if (first.enter <= far()) stack[size++] = first;
  }
  return best;
}

}  // namespace sim
