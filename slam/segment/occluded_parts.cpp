#include "slam/segment/occluded_parts.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "slam/base/index.h"
#include "slam/segment/pixels/label_components.h"
#include "slam/segment/sight_lines.h"

namespace slam {
namespace {

constexpr double kMinPlane_px = 3.0;  // a plane has three parameters
/// Of a label's border: what it shares with another has been asked for steps (JoinSurfaces), and
/// they were kept apart.
constexpr double kMaxContactShare = 0.2;

PlaneSums SumRun(const DepthGrid& grid, int row, const LabelRun& run) {
  PlaneSums sums;
  for (int u = run.begin; u < run.end; ++u)
    AddPixel(grid, static_cast<std::size_t>(grid.Index(u, row)), sums);
  return sums;
}

class PartSegmentation {
 public:
  PartSegmentation(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                   const LabelRuns& labels, const PlaneExtractionConfig& config);
  void JoinHiddenLabels(const DepthNoise& noise);
  void NumberSegments();
  PartSegments Segments() &&;

 private:
  std::vector<int> LabelsBySize() const;
  bool PassBehind(const SightLines& lines, int a, int b, int label) const;
  void FindMainComponents();
  std::vector<PlaneSums> SumSegments() const;

  const DepthGrid& grid_;
  const std::vector<Surface>& surfaces_;
  const PlaneExtractionConfig& config_;
  LabelComponents components_;
  LabelContacts contacts_;
  std::vector<int> into_;     ///< label that each label is part of
  std::vector<int> main_;     ///< largest component of each label; -1 = it has none
  std::vector<int> segment_;  ///< the segment of each component; -1 = none
  int segment_count_ = 0;
};

PartSegmentation::PartSegmentation(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                                   const LabelRuns& labels, const PlaneExtractionConfig& config)
    : grid_(grid),
      surfaces_(surfaces),
      config_(config),
      contacts_(CountContacts(labels, surfaces.size())) {
  components_.runs = labels;
  ConnectRuns(components_);
}

/// Labels with pixels, largest first.
std::vector<int> PartSegmentation::LabelsBySize() const {
  const auto pixels = [&](int k) { return surfaces_[Index(k)].sums.n; };
  std::vector<int> labels;
  for (int k = 0; k < static_cast<int>(surfaces_.size()); ++k)
    if (pixels(k) >= kMinPlane_px) labels.push_back(k);
  std::stable_sort(labels.begin(), labels.end(),
                   [&](int a, int b) { return pixels(a) > pixels(b); });
  return labels;
}

/// Gives labels that lie on the extension of a larger label's plane, which may go on in between,
/// the larger label.
void PartSegmentation::JoinHiddenLabels(const DepthNoise& noise) {
  const std::vector<int> by_size = LabelsBySize();
  std::vector<int> label_of_run;
  for (const LabelRun& run : components_.runs.runs) label_of_run.push_back(run.label);
  const SightLines lines(grid_, components_.runs, std::move(label_of_run),
                         static_cast<int>(surfaces_.size()));

  // Each label, the larger first, joins the larger one that fits its pixels best.
  into_.resize(surfaces_.size());
  std::iota(into_.begin(), into_.end(), 0);
  for (std::size_t k = 1; k < by_size.size(); ++k) {
    const auto small = static_cast<std::size_t>(by_size[k]);
    double min_cost = config_.joining.max_hidden_cost;
    for (std::size_t j = 0; j < k; ++j) {
      const int large = by_size[j];
      if (into_[Index(large)] != large) continue;
      if (contacts_.shared.Of(by_size[k], large) > kMaxContactShare * contacts_.around[small])
        continue;
      const double cost = HiddenUnionCost(surfaces_[small].sums, surfaces_[Index(large)].sums,
                                          noise, config_.joining);
      if (cost < min_cost && !PassBehind(lines, by_size[k], large, large))
        min_cost = cost, into_[small] = large;
    }
  }
  for (LabelComponent& c : components_.list) c.label = into_[Index(c.label)];
}

/// Whether the lines from one part to another pass something behind the surface of a label.
bool PartSegmentation::PassBehind(const SightLines& lines, int a, int b, int label) const {
  const Surface& surface = surfaces_[Index(label)];
  return lines.PassBehind(a, b, surface.plane, BendSigmas(surface, config_.joining));
}

void PartSegmentation::FindMainComponents() {
  main_.assign(surfaces_.size(), -1);
  for (std::size_t k = 0; k < components_.list.size(); ++k) {
    int& largest = main_[Index(components_.list[k].label)];
    if (largest < 0 || components_.list[k].pixels > components_.list[Index(largest)].pixels) {
      largest = static_cast<int>(k);
    }
  }
}

/// A label's largest component makes a segment; another one joins it if nothing behind is seen
/// between them, or makes a segment of its own.
void PartSegmentation::NumberSegments() {
  // One segment for the largest component of each label.
  FindMainComponents();
  const SightLines lines(grid_, components_.runs, components_.component,
                         static_cast<int>(components_.list.size()));
  segment_.assign(components_.list.size(), -1);
  segment_count_ = 0;
  for (const int k : main_) {
    if (k >= 0) segment_[Index(k)] = segment_count_++;
  }

  // The other components.
  for (std::size_t k = 0; k < components_.list.size(); ++k) {
    const LabelComponent& c = components_.list[k];
    if (segment_[k] >= 0 || c.pixels < config_.min_island_pixels) continue;
    const int largest = main_[Index(c.label)];
    if (!PassBehind(lines, static_cast<int>(k), largest, c.label)) {
      segment_[k] = segment_[Index(largest)];
    } else {
      segment_[k] = segment_count_++;
    }
  }
}

std::vector<PlaneSums> PartSegmentation::SumSegments() const {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(segment_count_));

  // Whole labels first.
  const auto segment_of_label = [&](int label) {
    const int largest = main_[Index(label)];
    return largest < 0 ? -1 : segment_[Index(largest)];
  };
  for (int k = 0; k < static_cast<int>(into_.size()); ++k) {
    const int segment = segment_of_label(into_[Index(k)]);
    if (segment >= 0) sums[Index(segment)] += surfaces_[Index(k)].sums;
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
      const PlaneSums run = SumRun(grid_, static_cast<int>(row), runs.runs[k]);
      sums[Index(from)] -= run;
      if (to >= 0) sums[Index(to)] += run;
    }
  }
  return sums;
}

PartSegments PartSegmentation::Segments() && {
  PartSegments out{{}, SumSegments()};
  out.runs = std::move(components_.runs);
  for (std::size_t k = 0; k < components_.component.size(); ++k) {
    const int component = components_.component[k];
    out.runs.runs[k].label = component < 0 ? kNoLabel : segment_[Index(component)];
  }
  return out;
}

}  // namespace

PartSegments SegmentParts(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                          const LabelRuns& labels, const DepthNoise& noise,
                          const PlaneExtractionConfig& config) {
  PartSegmentation parts(grid, surfaces, labels, config);
  parts.JoinHiddenLabels(noise);
  parts.NumberSegments();
  return std::move(parts).Segments();
}

}  // namespace slam
