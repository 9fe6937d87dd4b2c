#include "slam/extract/occluded_parts.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "slam/extract/bridges.h"
#include "slam/extract/sight_lines.h"

namespace slam {
namespace {

/// Pixels across a boundary that lie behind or in front of the plane.
struct Surroundings {
  int behind = 0, in_front = 0;
  /// Whether the plane can pass behind what surrounds it.
  bool MayHide(double max_behind) const { return behind <= max_behind * (behind + in_front); }
};

std::vector<Surroundings> OfLabels(const LabelComponents& components, std::size_t count) {
  std::vector<Surroundings> out(count);
  for (const LabelComponent& c : components.list) {
    Surroundings& s = out[static_cast<std::size_t>(c.label)];
    s.behind += c.behind, s.in_front += c.in_front;
  }
  return out;
}

/// Labels with pixels, largest first.
std::vector<int> BySize(const PatchUnion& patches, std::size_t count) {
  std::vector<int> order;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    if (patches.Root(k) == k && patches.At(k).sums.n >= 3) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return patches.At(a).sums.n > patches.At(b).sums.n; });
  return order;
}

/// Gives labels whose parts lie on the extension of a larger label's plane, hidden in between,
/// the larger label.
void JoinHiddenLabels(const DepthGrid& grid, const PatchUnion& patches, std::size_t count,
                      const PlaneExtractionConfig& config, const LabelImage& labels,
                      LabelComponents& components) {
  const std::vector<Surroundings> around = OfLabels(components, count);
  const std::vector<int> order = BySize(patches, count);
  const std::vector<int> parts(labels.begin(), labels.end());
  const SightLines between(grid, parts, static_cast<int>(count), config.unsure_side_sigmas);
  std::vector<int> into(count);
  std::iota(into.begin(), into.end(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto small = static_cast<std::size_t>(order[k]);
    if (!around[small].MayHide(config.max_island_behind)) continue;
    double least = 1.0;
    for (std::size_t j = 0; j < k; ++j) {
      const int large = order[j];
      if (into[static_cast<std::size_t>(large)] != large) continue;
      const double gap = PatchGap(patches.At(order[k]), patches.At(large),
                                  config.max_hidden_gap_sigmas, config);
      if (!(gap < least) || patches.Apart(order[k], large)) continue;
      const LabelPlane& plane = patches.At(large).plane;
      if (between.ShareBehind(order[k], large, plane) > config.max_island_behind) continue;
      least = gap, into[small] = large;
    }
  }
  for (LabelComponent& c : components.list) c.label = into[static_cast<std::size_t>(c.label)];
}

/// Largest component of each label; -1 = it has none.
std::vector<int> MainComponents(const LabelComponents& components, std::size_t label_count) {
  std::vector<int> main(label_count, -1);
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    int& largest = main[static_cast<std::size_t>(components.list[k].label)];
    if (largest < 0 ||
        components.list[k].pixels > components.list[static_cast<std::size_t>(largest)].pixels) {
      largest = static_cast<int>(k);
    }
  }
  return main;
}

/// Which segment each connected component belongs to; -1 = none. A label's largest component
/// makes a segment; another one joins it if what separates them is in front, makes a segment of
/// its own if it is large enough, or is dropped.
std::vector<int> SegmentsOfComponents(const DepthGrid& grid, const LabelComponents& components,
                                      const std::vector<LabelPlane>& planes,
                                      const PlaneExtractionConfig& config, int& segment_count) {
  const std::vector<int> main = MainComponents(components, planes.size());
  const SightLines between(grid, components.component, static_cast<int>(components.list.size()),
                           config.unsure_side_sigmas);
  std::vector<int> segment(components.list.size(), -1);
  segment_count = 0;
  for (const int k : main) {
    if (k >= 0) segment[static_cast<std::size_t>(k)] = segment_count++;
  }
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    const LabelComponent& c = components.list[k];
    if (segment[k] >= 0 || c.pixels < config.min_island_pixels) continue;
    const int largest = main[static_cast<std::size_t>(c.label)];
    const auto hidden_between = [&] {
      return between.ShareBehind(static_cast<int>(k), largest,
                                 planes[static_cast<std::size_t>(c.label)]) <=
             config.max_island_behind;
    };
    if (Surroundings{c.behind, c.in_front}.MayHide(config.max_island_behind) &&
        hidden_between()) {
      segment[k] = segment[static_cast<std::size_t>(largest)];
    } else if (c.pixels >= config.min_pixels) {
      segment[k] = segment_count++;
    }
  }
  return segment;
}

}  // namespace

int SegmentParts(const DepthGrid& grid, const PatchUnion& joined,
                 const PlaneExtractionConfig& config, LabelImage& labels) {
  const std::vector<LabelPlane> planes = joined.Planes();
  LabelComponents components =
      ConnectedComponents(grid, labels, planes, config.unsure_side_sigmas);
  CutBridges(grid, labels, planes, config.max_island_behind, components);
  JoinHiddenLabels(grid, joined, planes.size(), config, labels, components);
  int count = 0;
  const std::vector<int> segment_of =
      SegmentsOfComponents(grid, components, planes, config, count);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoLabel) continue;
    labels[i] = static_cast<std::int16_t>(
        segment_of[static_cast<std::size_t>(components.component[i])]);
  }
  return count;
}

}  // namespace slam
