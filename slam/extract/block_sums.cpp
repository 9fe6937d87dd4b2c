#include "slam/extract/block_sums.h"

#include <algorithm>
#include <cmath>

#include "slam/extract/lanes.h"

namespace slam {
namespace {

/// Sums of every fourth column of a block each, about the block's middle.
struct Columns {
  Ints n = All(std::int32_t{0});
  Floats w = All(0.0f), wx = w, wy = w, wxx = w, wxy = w, wyy = w, wq = w, wqx = w, wqy = w,
         wqq = w;
};

struct Middle {
  float x = 0, y = 0, q = 0;
};

/// The pixel in the middle; where it is not measured, the first that is.
Middle MiddleOf(const DepthGrid& grid, int u0, int v0, int u1, int v1) {
  const auto i = static_cast<std::size_t>(grid.Index((u0 + u1) / 2, (v0 + v1) / 2));
  Middle m{grid.x[i], grid.y[i], grid.q[i]};
  for (int v = v0; v < v1 && !(m.q > 0); ++v) {
    for (int u = u0; u < u1 && !(m.q > 0); ++u) {
      m.q = grid.q[static_cast<std::size_t>(grid.Index(u, v))];
    }
  }
  return m;
}

/// Adds four pixels of a row; a pixel of weight 0 adds nothing.
inline void AddFour(const Floats& x, const Floats& y, const Floats& q, const Floats& w,
                    const Middle& m, Columns& c) {
  const Floats dx = x - All(m.x), dy = y - All(m.y), dq = q - All(m.q);
  const Floats wx = w * dx, wy = w * dy, wq = w * dq;
  c.n -= w > All(0.0f);  // true is -1
  c.w += w;
  c.wx += wx, c.wy += wy, c.wq += wq;
  c.wxx += wx * dx, c.wxy += wx * dy, c.wyy += wy * dy;
  c.wqx += wq * dx, c.wqy += wq * dy, c.wqq += wq * dq;
}

/// Adds a row of n pixels, those that `chosen(k)`, a mask of four lanes from pixel k on,
/// leaves.
template <typename Chosen>
void AddRow(const DepthGrid& grid, std::size_t i, int n, const Middle& m, const Chosen& chosen,
            Columns& c) {
  int k = 0;
  for (; k + kLanes <= n; k += kLanes) {
    const std::size_t at = i + static_cast<std::size_t>(k);
    const Floats g = Load(&grid.g[at]);
    const Floats w = chosen(at, kLanes) ? g * g : All(0.0f);
    AddFour(Load(&grid.x[at]), Load(&grid.y[at]), Load(&grid.q[at]), w, m, c);
  }
  if (k == n) return;
  Floats x = All(0.0f), y = x, q = x, w = x;  // what is left of the row
  const std::size_t at = i + static_cast<std::size_t>(k);
  const Ints mask = chosen(at, n - k);
  for (int lane = 0; lane < n - k; ++lane) {
    const std::size_t j = at + static_cast<std::size_t>(lane);
    x[lane] = grid.x[j], y[lane] = grid.y[j], q[lane] = grid.q[j];
    w[lane] = mask[lane] != 0 ? grid.g[j] * grid.g[j] : 0.0f;
  }
  AddFour(x, y, q, w, m, c);
}

/// Moves sums about the middle to sums about the origin.
PlaneSums AboutOrigin(const Columns& c, const Middle& m) {
  const double x = m.x, y = m.y, q = m.q;
  PlaneSums s;
  s.n = Total(c.n), s.w = Total(c.w);
  const double wx = Total(c.wx), wy = Total(c.wy), wq = Total(c.wq);
  s.wx = wx + s.w * x, s.wy = wy + s.w * y, s.wq = wq + s.w * q;
  s.wxx = Total(c.wxx) + 2.0 * x * wx + s.w * x * x;
  s.wyy = Total(c.wyy) + 2.0 * y * wy + s.w * y * y;
  s.wqq = Total(c.wqq) + 2.0 * q * wq + s.w * q * q;
  s.wxy = Total(c.wxy) + x * wy + y * wx + s.w * x * y;
  s.wqx = Total(c.wqx) + x * wq + q * wx + s.w * x * q;
  s.wqy = Total(c.wqy) + y * wq + q * wy + s.w * y * q;
  return s;
}

}  // namespace

namespace {

template <typename Chosen>
PlaneSums SumChosen(const DepthGrid& grid, const BlockLayout& layout, int block,
                    const Chosen& chosen) {
  const int u0 = layout.Left(block), v0 = layout.Top(block);
  const int u1 = layout.Right(block), v1 = layout.Bottom(block);
  const Middle m = MiddleOf(grid, u0, v0, u1, v1);
  if (!(m.q > 0)) return {};
  Columns columns;
  for (int v = v0; v < v1; ++v) {
    AddRow(grid, static_cast<std::size_t>(grid.Index(u0, v)), u1 - u0, m, chosen, columns);
  }
  return AboutOrigin(columns, m);
}

}  // namespace

PlaneSums SumBlock(const DepthGrid& grid, const BlockLayout& layout, int block,
                   const std::uint8_t* taken) {
  if (taken == nullptr) {
    return SumChosen(grid, layout, block, [](std::size_t, int) { return All(-1); });
  }
  return SumChosen(grid, layout, block, [&](std::size_t i, int n) {
    Ints mask = All(0);
    for (int k = 0; k < n; ++k) mask[k] = taken[i + static_cast<std::size_t>(k)] == 0 ? -1 : 0;
    return mask;
  });
}

PlaneSums SumLabel(const DepthGrid& grid, const BlockLayout& layout, int block,
                   const std::vector<std::int32_t>& labels, std::int32_t label) {
  return SumChosen(grid, layout, block, [&](std::size_t i, int n) -> Ints {
    if (n == kLanes) return Load(&labels[i]) == All(label);
    Ints mask = All(0);
    for (int k = 0; k < n; ++k)
      mask[k] = labels[i + static_cast<std::size_t>(k)] == label ? -1 : 0;
    return mask;
  });
}

float LargestJump(const DepthGrid& grid, const BlockLayout& layout, int block) {
  const int u0 = layout.Left(block), v0 = layout.Top(block);
  const int u1 = layout.Right(block), v1 = layout.Bottom(block);
  float most = 0.0f;
  const auto jump = [&](std::size_t i, std::size_t j) {
    const float step = std::abs(grid.q[i] - grid.q[j]) * grid.g[i];
    return grid.g[j] > 0.0f ? step : 0.0f;  // g of i is 0 where it is not measured
  };
  for (int v = v0; v < v1; ++v) {
    const auto i = static_cast<std::size_t>(grid.Index(u0, v));
    const auto n = static_cast<std::size_t>(u1 - u0),
               below = static_cast<std::size_t>(grid.width);
    for (std::size_t k = 0; k + 1 < n; ++k) most = std::max(most, jump(i + k, i + k + 1));
    if (v + 1 == v1) continue;
    for (std::size_t k = 0; k < n; ++k) most = std::max(most, jump(i + k, i + k + below));
  }
  return most;
}

}  // namespace slam
