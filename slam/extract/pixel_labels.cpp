#include "slam/extract/pixel_labels.h"

#include <algorithm>

namespace slam {

std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  std::size_t i = 0;
  while (i < labels.size()) {
    const std::int16_t label = labels[i];
    if (label == kNoLabel) {
      ++i;
      continue;
    }
    PlaneSums run;  // sums of a run stay in registers
    for (; i < labels.size() && labels[i] == label; ++i) {
      const double g = static_cast<double>(grid.g[i]);
      run.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
              static_cast<double>(grid.q[i]), g * g);
    }
    sums[static_cast<std::size_t>(label)] += run;
  }
  return sums;
}

namespace {

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

/// Provisional numbers by runs; equal ones are united in `parent`.
std::vector<int> NumberRuns(const DepthGrid& grid, const LabelImage& labels,
                            std::vector<int>& parent) {
  std::vector<int> number(labels.size(), -1);
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels[i] == kNoLabel) continue;
      const bool left = u > 0 && labels[i - 1] == labels[i];
      const std::size_t above = v > 0 ? i - static_cast<std::size_t>(grid.width) : i;
      const bool up = v > 0 && labels[above] == labels[i];
      if (left) {
        number[i] = number[i - 1];
        if (up && number[above] != number[i]) Unite(parent, number[i], number[above]);
      } else if (up) {
        number[i] = number[above];
      } else {
        number[i] = static_cast<int>(parent.size());
        parent.push_back(number[i]);
      }
    }
  }
  return number;
}

}  // namespace

LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels,
                                    const std::vector<LabelPlane>& planes,
                                    double unsure_side_sigmas) {
  std::vector<int> parent;
  LabelComponents out;
  out.unsure_side_sigmas = unsure_side_sigmas;
  out.component = NumberRuns(grid, labels, parent);
  std::vector<int> compact(parent.size(), -1);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoLabel) continue;
    int& id = compact[static_cast<std::size_t>(Root(parent, out.component[i]))];
    if (id < 0) {
      id = static_cast<int>(out.list.size());
      out.list.push_back({labels[i], 0, static_cast<int>(i), 0, 0});
    }
    out.component[i] = id;
    ++out.list[static_cast<std::size_t>(id)].pixels;
  }
  CountSides(grid, labels, planes, out);
  return out;
}

void CountSides(const DepthGrid& grid, const LabelImage& labels,
                const std::vector<LabelPlane>& planes, LabelComponents& components) {
  for (LabelComponent& c : components.list) c.behind = c.in_front = 0;
  const float unsure = static_cast<float>(components.unsure_side_sigmas);
  const auto count_side = [&](std::size_t from, std::size_t to) {
    if (labels[from] == kNoLabel || labels[to] == labels[from] || !(grid.g[to] > 0)) return;
    LabelComponent& c = components.list[static_cast<std::size_t>(components.component[from])];
    const float residual = ResidualSigmas(grid, to, planes[static_cast<std::size_t>(c.label)]);
    if (residual > unsure) ++c.in_front;
    if (residual <= -unsure) ++c.behind;
  };
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (u + 1 < grid.width) count_side(i, i + 1), count_side(i + 1, i);
      const std::size_t below = i + static_cast<std::size_t>(grid.width);
      if (v + 1 < grid.height) count_side(i, below), count_side(below, i);
    }
  }
}

}  // namespace slam
