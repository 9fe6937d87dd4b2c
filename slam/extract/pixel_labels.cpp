#include "slam/extract/pixel_labels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slam {
namespace {

// A plane owning fewer pixels of a block than this does not spread from it: chance crossings of
// another surface with the plane's extension are thinner.
constexpr int kLeastPixelsToSpread = 4;

/// Gives the pixels of one block to the nearest of its planes.
/// @returns how many pixels each plane of the block owns, in the order of seeds.At(block).
std::vector<int> LabelBlock(const DepthGrid& grid, const std::vector<LabelPlane>& planes,
                            const LabelSeeds& seeds, int block, double max_sigmas,
                            LabelImage& labels) {
  const std::vector<int>& candidates = seeds.At(block);
  const int size = seeds.block_px();
  const int u0 = block % seeds.cols() * size, v0 = block / seeds.cols() * size;
  const int u1 = std::min(u0 + size, grid.width), v1 = std::min(v0 + size, grid.height);
  std::vector<int> owned(candidates.size(), 0);
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      labels[i] = kNoLabel;
      if (!(grid.g[i] > 0)) continue;
      float best = static_cast<float>(max_sigmas);
      int chosen = -1;
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        const auto label = static_cast<std::size_t>(candidates[k]);
        const float distance = std::abs(ResidualSigmas(grid, i, planes[label]));
        if (distance < best) best = distance, chosen = static_cast<int>(k);
      }
      if (chosen < 0) continue;
      const auto k = static_cast<std::size_t>(chosen);
      labels[i] = static_cast<std::int16_t>(candidates[k]);
      ++owned[k];
    }
  }
  return owned;
}

}  // namespace

bool LabelSeeds::Add(int block, int label) {
  std::vector<int>& at = labels_[static_cast<std::size_t>(block)];
  const auto place = std::lower_bound(at.begin(), at.end(), label);
  if (place != at.end() && *place == label) return false;
  at.insert(place, label);
  return true;
}

LabelImage AssignPixels(const DepthGrid& grid, const std::vector<LabelPlane>& planes,
                        LabelSeeds seeds, double max_sigmas) {
  LabelImage labels(grid.q.size(), kNoLabel);
  const int cols = seeds.cols(), rows = seeds.rows();
  std::vector<int> active;
  for (int block = 0; block < cols * rows; ++block) {
    if (!seeds.At(block).empty()) active.push_back(block);
  }
  // Each round adds at least one label to a block, so there are finitely many.
  while (!active.empty()) {
    std::vector<std::pair<int, int>> reached;  // (block, label)
    for (const int block : active) {
      const std::vector<int> owned = LabelBlock(grid, planes, seeds, block, max_sigmas, labels);
      const int c = block % cols, r = block / cols;
      for (std::size_t k = 0; k < owned.size(); ++k) {
        if (owned[k] < kLeastPixelsToSpread) continue;
        for (int y = std::max(r - 1, 0); y <= std::min(r + 1, rows - 1); ++y) {
          for (int x = std::max(c - 1, 0); x <= std::min(c + 1, cols - 1); ++x) {
            reached.emplace_back(y * cols + x, seeds.At(block)[k]);
          }
        }
      }
    }
    active.clear();
    for (const auto& [block, label] : reached) {
      if (seeds.Add(block, label)) active.push_back(block);
    }
    std::sort(active.begin(), active.end());
    active.erase(std::unique(active.begin(), active.end()), active.end());
  }
  return labels;
}

std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoLabel) continue;
    const double g = static_cast<double>(grid.g[i]);
    sums[static_cast<std::size_t>(labels[i])].Add(static_cast<double>(grid.x[i]),
                                                  static_cast<double>(grid.y[i]),
                                                  static_cast<double>(grid.q[i]), g * g);
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
                                    const std::vector<LabelPlane>& planes) {
  std::vector<int> parent;
  LabelComponents out;
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
  const auto count_side = [&](std::size_t from, std::size_t to) {
    if (labels[from] == kNoLabel || labels[to] == labels[from] || !(grid.g[to] > 0)) return;
    LabelComponent& c = out.list[static_cast<std::size_t>(out.component[from])];
    const float residual = ResidualSigmas(grid, to, planes[static_cast<std::size_t>(c.label)]);
    ++(residual > 0 ? c.in_front : c.behind);
  };
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (u + 1 < grid.width) count_side(i, i + 1), count_side(i + 1, i);
      const std::size_t below = i + static_cast<std::size_t>(grid.width);
      if (v + 1 < grid.height) count_side(i, below), count_side(below, i);
    }
  }
  return out;
}

}  // namespace slam
