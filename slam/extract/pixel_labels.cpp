#include "slam/extract/pixel_labels.h"

#include <algorithm>

namespace slam {
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
void NumberRuns(const DepthGrid& grid, const LabelImage& labels, std::vector<int>& number,
                std::vector<int>& parent) {
  parent.clear();
  number.resize(labels.size());
  const auto width = static_cast<std::size_t>(grid.width);
  for (int v = 0; v < grid.height; ++v) {
    const auto start = static_cast<std::size_t>(grid.Index(0, v));
    for (std::size_t u = 0; u < width;) {
      const std::int32_t label = labels[start + u];
      std::size_t end = u + 1;
      while (end < width && labels[start + end] == label) ++end;
      if (label != kNoLabel) {
        int id = -1;
        for (std::size_t k = u; v > 0 && k < end; ++k) {
          const std::size_t above = start + k - width;
          if (labels[above] != label) continue;
          if (id < 0) {
            id = number[above];
          } else if (number[above] != id) {
            Unite(parent, id, number[above]);
          }
        }
        if (id < 0) {
          id = static_cast<int>(parent.size());
          parent.push_back(id);
        }
        std::fill(number.begin() + static_cast<std::ptrdiff_t>(start + u),
                  number.begin() + static_cast<std::ptrdiff_t>(start + end), id);
      }
      u = end;
    }
  }
}

/// Counts which side of its plane the neighbour of a component's pixel lies on.
void CountSide(const DepthGrid& grid, const LabelImage& labels,
               const std::vector<LabelPlane>& planes, std::size_t from, std::size_t to,
               LabelComponents& out) {
  if (labels[from] == kNoLabel || !(grid.g[to] > 0)) return;
  LabelComponent& c = out.list[static_cast<std::size_t>(out.component[from])];
  const float residual = ResidualSigmas(grid, to, planes[static_cast<std::size_t>(c.label)]);
  ++(residual > 0 ? c.in_front : c.behind);
}

}  // namespace

void FindComponents(const DepthGrid& grid, const LabelImage& labels,
                    const std::vector<LabelPlane>& planes, LabelComponents& out) {
  NumberRuns(grid, labels, out.component, out.parent);
  out.compact.assign(out.parent.size(), -1);
  out.list.clear();
  for (std::size_t i = 0; i < labels.size();) {
    const std::int32_t label = labels[i];
    std::size_t end = i + 1;
    const int provisional = out.component[i];
    while (end < labels.size() && labels[end] == label &&
           (label == kNoLabel || out.component[end] == provisional)) {
      ++end;
    }
    if (label != kNoLabel) {
      int& id = out.compact[static_cast<std::size_t>(Root(out.parent, provisional))];
      if (id < 0) {
        id = static_cast<int>(out.list.size());
        out.list.push_back({label, 0, static_cast<int>(i), 0, 0});
      }
      for (std::size_t k = i; k < end; ++k) out.component[k] = id;
      out.list[static_cast<std::size_t>(id)].pixels += static_cast<int>(end - i);
    }
    i = end;
  }
  const auto width = static_cast<std::size_t>(grid.width);
  const auto both = [&](std::size_t i, std::size_t j) {
    if (labels[i] == labels[j]) return;
    CountSide(grid, labels, planes, i, j, out);
    CountSide(grid, labels, planes, j, i, out);
  };
  for (int v = 0; v < grid.height; ++v) {
    const auto start = static_cast<std::size_t>(grid.Index(0, v));
    for (std::size_t i = start; i + 1 < start + width; ++i) both(i, i + 1);
    if (v + 1 == grid.height) continue;
    for (std::size_t i = start; i < start + width; ++i) both(i, i + width);
  }
}

}  // namespace slam
