#include "slam/segment/occluded_parts.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "slam/segment/measured_segments.h"

namespace slam {
namespace {

constexpr double kMinPlane_px = 3.0;  // a plane has three parameters

PlaneSums SumRun(const DepthGrid& grid, int row, const LabelRun& run) {
  PlaneSums sums;
  for (int u = run.begin; u < run.end; ++u)
    AddPixel(grid, static_cast<std::size_t>(grid.Index(u, row)), sums);
  return sums;
}

}  // namespace

/// Labels with pixels, largest first.
void PartSegmentation::SortBySize(const PatchUnion& patches) {
  by_size_.clear();
  for (int k = 0; k < static_cast<int>(planes_.size()); ++k) {
    if (patches.Root(k) == k && patches.At(k).sums.n >= kMinPlane_px) by_size_.push_back(k);
  }
  std::sort(by_size_.begin(), by_size_.end(), [&](int a, int b) {
    const double n_a = patches.At(a).sums.n, n_b = patches.At(b).sums.n;
    return n_a != n_b ? n_a > n_b : a < b;
  });
}

/// Gives labels whose parts lie on the extension of a larger label's plane, hidden in between,
/// the larger label.
void PartSegmentation::JoinHiddenLabels(const DepthGrid& grid, const PatchUnion& patches,
                                        const DepthNoise& noise,
                                        const PlaneExtractionConfig& config) {
  // What surrounds the parts of each label, and the lines of sight between them.
  around_.assign(planes_.size(), {});
  for (const LabelComponent& c : components_.list) {
    Surroundings& s = around_[static_cast<std::size_t>(c.label)];
    s.behind += c.behind, s.in_front += c.in_front;
  }
  SortBySize(patches);
  label_of_run_.clear();
  for (const LabelRun& run : components_.runs.runs) label_of_run_.push_back(run.label);
  between_.Begin(grid, components_.runs, label_of_run_, static_cast<int>(planes_.size()),
                 config.unsure_side_sigmas);

  // Each label, the larger first, joins the larger one that fits its pixels best.
  into_.resize(planes_.size());
  std::iota(into_.begin(), into_.end(), 0);
  for (std::size_t k = 1; k < by_size_.size(); ++k) {
    const auto small = static_cast<std::size_t>(by_size_[k]);
    const bool may_hide = around_[small].MayHide(config.max_island_behind);
    double min_gap = 1.0;
    for (std::size_t j = 0; j < k; ++j) {
      const int large = by_size_[j];
      if (into_[static_cast<std::size_t>(large)] != large) continue;
      const double gap = PatchGap(patches.At(by_size_[k]), patches.At(large),
                                  config.max_hidden_gap_sigmas, noise, config);
      if (!(gap < min_gap) || patches.Apart(by_size_[k], large)) continue;
      const LabelPlane& plane = patches.At(large).plane;
      // Where a part ends in sight, bounds that a warp has widened would let in what lies on
      // the plane.
      const auto equal = [&] {
        return PatchGap(patches.At(by_size_[k]), patches.At(large), config.max_merge_gap_sigmas,
                        noise, config) < 1.0;
      };
      const bool hidden =
          (may_hide &&
           between_.ShareBehind(by_size_[k], large, plane) <= config.max_island_behind) ||
          (equal() && between_.AreSidesOfSomethingInFront(by_size_[k], large, plane));
      if (hidden) min_gap = gap, into_[small] = large;
    }
  }
  for (LabelComponent& c : components_.list) c.label = into_[static_cast<std::size_t>(c.label)];
}

void PartSegmentation::FindMainComponents() {
  main_.assign(planes_.size(), -1);
  for (std::size_t k = 0; k < components_.list.size(); ++k) {
    int& largest = main_[static_cast<std::size_t>(components_.list[k].label)];
    if (largest < 0 || components_.list[k].pixels >
                           components_.list[static_cast<std::size_t>(largest)].pixels) {
      largest = static_cast<int>(k);
    }
  }
}

/// A label's largest component makes a segment; another one joins it if what separates them is
/// in front, makes a segment of its own if it is large enough, or is dropped.
void PartSegmentation::NumberSegments(const DepthGrid& grid,
                                      const PlaneExtractionConfig& config) {
  // One segment for the largest component of each label.
  FindMainComponents();
  between_.Begin(grid, components_.runs, components_.component,
                 static_cast<int>(components_.list.size()), config.unsure_side_sigmas);
  segment_.assign(components_.list.size(), -1);
  segment_count_ = 0;
  for (const int k : main_) {
    if (k >= 0) segment_[static_cast<std::size_t>(k)] = segment_count_++;
  }

  // The other components.
  for (std::size_t k = 0; k < components_.list.size(); ++k) {
    const LabelComponent& c = components_.list[k];
    if (segment_[k] >= 0 || c.pixels < config.min_island_pixels) continue;
    const int largest = main_[static_cast<std::size_t>(c.label)];
    const LabelPlane& plane = planes_[static_cast<std::size_t>(c.label)];
    const auto part = static_cast<int>(k);
    if ((Surroundings{c.behind, c.in_front}.MayHide(config.max_island_behind) &&
         between_.ShareBehind(part, largest, plane) <= config.max_island_behind) ||
        between_.AreSidesOfSomethingInFront(part, largest, plane)) {
      segment_[k] = segment_[static_cast<std::size_t>(largest)];
    } else if (c.pixels >= config.min_pixels) {
      segment_[k] = segment_count_++;
    }
  }
}

const LabelRuns& PartSegmentation::Segment(const DepthGrid& grid, const PatchUnion& joined,
                                           const LabelRuns& labels, const DepthNoise& noise,
                                           const PlaneExtractionConfig& config) {
  // Connected parts of the labels, cut at bridges.
  joined.CopyPlanes(planes_);
  MapRuns(labels, joined.into(), components_.runs);
  components_.unsure_side_sigmas = config.unsure_side_sigmas;
  ConnectRuns(components_);
  CountSides(grid, planes_, components_);
  bridges_.Cut(grid, planes_, config.max_island_behind, components_);

  // Which of them are one segment, and the runs drawn with its number.
  JoinHiddenLabels(grid, joined, noise, config);
  NumberSegments(grid, config);
  for (std::size_t k = 0; k < components_.component.size(); ++k) {
    const int component = components_.component[k];
    components_.runs.runs[k].label =
        component < 0 ? kNoLabel : segment_[static_cast<std::size_t>(component)];
  }
  return components_.runs;
}

void PartSegmentation::SumSegments(const DepthGrid& grid, const PatchUnion& joined,
                                   std::vector<PlaneSums>& sums) const {
  sums.assign(static_cast<std::size_t>(segment_count_), PlaneSums{});

  // Whole labels first.
  const auto segment_of_label = [&](int label) {
    const int largest = main_[static_cast<std::size_t>(label)];
    return largest < 0 ? -1 : segment_[static_cast<std::size_t>(largest)];
  };
  for (int k = 0; k < static_cast<int>(into_.size()); ++k) {
    const int segment = segment_of_label(into_[static_cast<std::size_t>(k)]);
    if (joined.Root(k) == k && segment >= 0)
      sums[static_cast<std::size_t>(segment)] += joined.At(k).sums;
  }

  // Then parts move that are not of their label's segment.
  const LabelRuns& runs = components_.runs;
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      if (components_.component[k] < 0) continue;
      const auto component = static_cast<std::size_t>(components_.component[k]);
      const int from = segment_of_label(components_.list[component].label);
      const int to = segment_[component];
      if (to == from) continue;
      const PlaneSums run = SumRun(grid, static_cast<int>(row), runs.runs[k]);
      PlaneSums& rest = sums[static_cast<std::size_t>(from)];
      rest = Without(rest, run);
      if (to >= 0) sums[static_cast<std::size_t>(to)] += run;
    }
  }
}

}  // namespace slam
