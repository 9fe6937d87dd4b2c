#include "slam/extract/pixel_labels.h"

#include <algorithm>
#include <numeric>

#include "slam/extract/block_sums.h"

namespace slam {
namespace {

constexpr int kTile_px = 8;

int Root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    int& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

/// The lower number becomes the root, so that a root is its component's first provisional one.
void Unite(std::vector<int>& parent, int i, int j) {
  i = Root(parent, i), j = Root(parent, j);
  parent[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
}

/// Provisional numbers of runs, -1 without a label; `parent` leads to the first one of their
/// component.
std::vector<int> NumberRuns(const LabelRuns& runs) {
  std::vector<int> parent(runs.runs.size());
  std::iota(parent.begin(), parent.end(), 0);
  VisitRunsBelow(runs, [&](std::size_t a, std::size_t b, int, int, int) {
    if (runs.runs[a].label == runs.runs[b].label)
      Unite(parent, static_cast<int>(a), static_cast<int>(b));
  });
  return parent;
}

}  // namespace

std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  for (int v = 0; v < grid.height; v += kTile_px) {
    for (int u = 0; u < grid.width; u += kTile_px) {
      SumTile(BlockAt(grid, u, v, kTile_px),
              labels.data() + static_cast<std::size_t>(grid.Index(u, v)), sums);
    }
  }
  return sums;
}

void MapLabels(const LabelImage& labels, const std::vector<int>& to, LabelImage& out) {
  out.resize(labels.size());
  std::int16_t last = kNoLabel, mapped = kNoLabel;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != last) {
      last = labels[i];
      mapped = last == kNoLabel ? kNoLabel
                                : static_cast<std::int16_t>(to[static_cast<std::size_t>(last)]);
    }
    out[i] = mapped;
  }
}

LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels) {
  LabelComponents out;
  FindRuns(labels, grid.width, grid.height, out.runs);
  std::vector<int> parent = NumberRuns(out.runs);
  std::vector<int> number(parent.size(), -1);
  out.component.resize(labels.size());
  std::size_t run = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (; run < out.runs.rows[static_cast<std::size_t>(v) + 1]; ++run) {
      const LabelRun& at = out.runs.runs[run];
      const int first = grid.Index(at.begin, v), size = at.end - at.begin;
      int id = -1;
      if (at.label != kNoLabel) {
        int& known = number[static_cast<std::size_t>(Root(parent, static_cast<int>(run)))];
        if (known < 0) {
          known = static_cast<int>(out.list.size());
          out.list.push_back({at.label, 0, first, 0, 0});
        }
        id = known;
        out.list[static_cast<std::size_t>(id)].pixels += size;
      }
      std::fill_n(out.component.begin() + first, size, id);
    }
  }
  return out;
}

LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels,
                                    const std::vector<LabelPlane>& planes,
                                    double unsure_side_sigmas) {
  LabelComponents out = ConnectedComponents(grid, labels);
  out.unsure_side_sigmas = unsure_side_sigmas;
  CountSides(grid, labels, planes, out);
  return out;
}

void CountSides(const DepthGrid& grid, const LabelImage& labels,
                const std::vector<LabelPlane>& planes, LabelComponents& components) {
  for (LabelComponent& c : components.list) c.behind = c.in_front = 0;
  const std::vector<PixelPlane> in_float(planes.begin(), planes.end());
  const auto unsure = static_cast<float>(components.unsure_side_sigmas);
  const auto count_side = [&](std::size_t from, std::size_t to) {
    if (labels[from] == kNoLabel || !(grid.g[to] > 0)) return;
    LabelComponent& c = components.list[static_cast<std::size_t>(components.component[from])];
    const auto label = static_cast<std::size_t>(c.label);
    const PixelPlane& p = in_float[label];
    const float nearer = grid.q[to] - (p.a * grid.x[to] + p.b * grid.y[to] + p.c);
    const float margin =
        unsure > 0 ? unsure * static_cast<float>(planes[label].grazing) / grid.g[to] : 0.0f;
    if (nearer > margin) ++c.in_front;
    if (nearer <= -margin) ++c.behind;
  };
  VisitBoundaries(components.runs,
                  [&](std::size_t i, std::size_t j) { count_side(i, j), count_side(j, i); });
}

}  // namespace slam
