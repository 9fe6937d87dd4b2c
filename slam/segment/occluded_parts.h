#pragma once

#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/label_components.h"
#include "slam/segment/sight_lines.h"
#include "slam/segment/surfaces.h"

namespace slam {

/// Numbers the segments that connected parts of labels make, across what hides parts of them.
///
/// Two parts are one plane though nothing joins them in the image if the smaller lies on the
/// larger's extension, and either both what surrounds the smaller and what lies between them is
/// in front of it, so that the plane can pass behind, or from all over the one to all over the
/// other something in front is seen and nothing behind, whatever else ends them. Two book tops
/// of one height have the desk between them, which is behind, and stay apart.
///
/// The memory of one image serves the next.
class PartSegmentation {
 public:
  /// @param labels  runs of the labels of the surfaces
  /// @returns runs of segments 0, 1, ...; kNoLabel where a part is too small to be one. Two
  ///          beside each other may be of one segment. They stand until the next call.
  const LabelRuns& Segment(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                           const LabelRuns& labels, const DepthNoise& noise,
                           const PlaneExtractionConfig& config);

  /// Sums of the pixels of each segment of the last call: those of the labels that `joined`
  /// knows, but for the parts that went elsewhere.
  void SumSegments(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                   std::vector<PlaneSums>& sums) const;

 private:
  /// Pixels across a boundary that lie behind or in front of the plane.
  struct Surroundings {
    int behind = 0, in_front = 0;
    /// Whether the plane can pass behind what surrounds it.
    bool MayHide(double max_behind) const { return behind <= max_behind * (behind + in_front); }
  };
  void SortBySize(const std::vector<Surface>& surfaces);
  void JoinHiddenLabels(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                        const DepthNoise& noise, const PlaneExtractionConfig& config);
  bool IsHiddenPart(int part, int larger, const Surroundings& around, int label,
                    const PlaneExtractionConfig& config);
  void FindMainComponents();
  void NumberSegments(const DepthGrid& grid, const PlaneExtractionConfig& config);

  LabelComponents components_;
  SightLines between_;
  std::vector<LabelPlane> planes_;     ///< one a label
  std::vector<double> unsure_sigmas_;  ///< the same: what is as near is on no side of it
  std::vector<Surroundings> around_;   ///< one a label
  std::vector<int> by_size_;           ///< labels with pixels, largest first
  std::vector<int> label_of_run_;
  std::vector<int> into_;     ///< label that each label is part of
  std::vector<int> main_;     ///< largest component of each label; -1 = it has none
  std::vector<int> segment_;  ///< the segment that each component is part of; -1 = none
  int segment_count_ = 0;
};

}  // namespace slam
