#include "slam/extract/bridges.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "slam/extract/sight_lines.h"

namespace slam {
namespace {

constexpr int kLeastCore_px = 40;

/// The labels of the pixels whose 8 neighbours have the same.
LabelImage Interior(const DepthGrid& grid, const LabelImage& labels) {
  LabelImage out(labels.size(), kNoLabel);
  const auto w = static_cast<std::size_t>(grid.width);
  for (int v = 1; v + 1 < grid.height; ++v) {
    const std::int16_t* at = labels.data() + static_cast<std::size_t>(v) * w;
    std::int16_t* inside = out.data() + static_cast<std::size_t>(v) * w;
    for (std::size_t u = 1; u + 1 < w; ++u) {
      const std::int16_t *above = at + u - w, *here = at + u, *below = at + u + w;
      const std::int16_t label = *here;
      // Bits in which a neighbour differs; no branches, many pixels at once.
      const int differs = (above[-1] ^ label) | (above[0] ^ label) | (above[1] ^ label) |
                          (here[-1] ^ label) | (here[1] ^ label) | (below[-1] ^ label) |
                          (below[0] ^ label) | (below[1] ^ label);
      inside[u] = differs == 0 ? label : kNoLabel;
    }
  }
  return out;
}

/// Cores large enough to be a surface of their own, of each component, largest first.
std::vector<std::vector<int>> CoresOf(const LabelComponents& components,
                                      const LabelComponents& cores) {
  std::vector<std::vector<int>> out(components.list.size());
  for (std::size_t k = 0; k < cores.list.size(); ++k) {
    if (cores.list[k].pixels < kLeastCore_px) continue;
    const auto first = static_cast<std::size_t>(cores.list[k].first_pixel);
    out[static_cast<std::size_t>(components.component[first])].push_back(static_cast<int>(k));
  }
  for (std::vector<int>& own : out) {
    std::stable_sort(own.begin(), own.end(), [&](int a, int b) {
      return cores.list[static_cast<std::size_t>(a)].pixels >
             cores.list[static_cast<std::size_t>(b)].pixels;
    });
  }
  return out;
}

/// Numbers the parts that cores make: a core is of the part of a larger one that nothing behind
/// separates it from.
std::vector<int> PartsOf(const std::vector<int>& cores, const SightLines& between,
                         const LabelPlane& plane, double max_behind, int& part_count) {
  std::vector<int> part(cores.size(), -1);
  part_count = 0;
  for (std::size_t k = 0; k < cores.size(); ++k) {
    for (std::size_t j = 0; j < k && part[k] < 0; ++j) {
      if (between.ShareBehind(cores[k], cores[j], plane) <= max_behind) part[k] = part[j];
    }
    if (part[k] < 0) part[k] = part_count++;
  }
  return part;
}

/// Gives each pixel of a component the part whose core is fewest steps away.
void Spread(const DepthGrid& grid, const std::vector<int>& seeds, int component,
            const std::vector<int>& ids, LabelComponents& components,
            std::vector<int>& part_at) {
  std::deque<int> next(seeds.begin(), seeds.end());
  while (!next.empty()) {
    const int i = next.front();
    next.pop_front();
    const int u = i % grid.width, v = i / grid.width;
    const auto visit = [&](int k) {
      const auto at = static_cast<std::size_t>(k);
      if (components.component[at] != component || part_at[at] >= 0) return;
      part_at[at] = part_at[static_cast<std::size_t>(i)];
      next.push_back(k);
    };
    if (u > 0) visit(i - 1);
    if (u + 1 < grid.width) visit(i + 1);
    if (v > 0) visit(i - grid.width);
    if (v + 1 < grid.height) visit(i + grid.width);
  }
  for (std::size_t i = 0; i < part_at.size(); ++i) {
    if (components.component[i] != component || part_at[i] < 0) continue;
    LabelComponent& to =
        components.list[static_cast<std::size_t>(ids[static_cast<std::size_t>(part_at[i])])];
    components.component[i] = ids[static_cast<std::size_t>(part_at[i])];
    if (to.pixels++ == 0) to.first_pixel = static_cast<int>(i);
  }
}

}  // namespace

void CutBridges(const DepthGrid& grid, const LabelImage& labels,
                const std::vector<LabelPlane>& planes, double max_behind,
                LabelComponents& components) {
  const LabelComponents cores = ConnectedComponents(grid, Interior(grid, labels));
  const std::vector<std::vector<int>> of_component = CoresOf(components, cores);
  const SightLines between(grid, cores.component, static_cast<int>(cores.list.size()));
  bool cut = false;
  for (std::size_t c = 0; c < of_component.size(); ++c) {
    const std::vector<int>& own = of_component[c];
    if (own.size() < 2) continue;
    const int label = components.list[c].label;
    int part_count = 0;
    const std::vector<int> part =
        PartsOf(own, between, planes[static_cast<std::size_t>(label)], max_behind, part_count);
    if (part_count < 2) continue;
    cut = true;
    std::vector<int> seeds, part_at(labels.size(), -1);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto core = std::find(own.begin(), own.end(), cores.component[i]);
      if (cores.component[i] < 0 || core == own.end()) continue;
      part_at[i] = part[static_cast<std::size_t>(core - own.begin())];
      seeds.push_back(static_cast<int>(i));
    }
    std::vector<int> ids{static_cast<int>(c)};
    components.list[c].pixels = 0;
    for (int k = 1; k < part_count; ++k) {
      ids.push_back(static_cast<int>(components.list.size()));
      components.list.push_back({label, 0, 0, 0, 0});
    }
    Spread(grid, seeds, static_cast<int>(c), ids, components, part_at);
  }
  if (cut) CountSides(grid, labels, planes, components);
}

}  // namespace slam
