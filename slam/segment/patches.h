#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/boundary_shares.h"
#include "slam/segment/boundary_steps.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/label_pairs.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/pixel_growth.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// A label's plane and the pixels that it was fitted to.
struct Patch {
  PlaneSums sums;
  LabelPlane plane;
};

/// Squared distance of two planes over the pixels of the smaller patch, over what noise and
/// `max_gap_sigmas` allow there; below 1: they may be one plane.
double PatchGap(const Patch& a, const Patch& b, double max_gap_sigmas, const DepthNoise& noise,
                const PlaneExtractionConfig& config);

/// Which patch each patch has become part of.
class PatchUnion {
 public:
  /// Begins with patches that are not joined: the labels' pixels, and planes fitted to them
  /// (those given, where nothing can be fitted).
  void Begin(const std::vector<PlaneSums>& sums, const std::vector<LabelPlane>& planes,
             const DepthNoise& noise);
  /// The lower number stays, and is fitted to the pixels of both.
  void Join(int a, int b, const DepthNoise& noise);
  int Root(int k) const { return into_[static_cast<std::size_t>(k)]; }
  const Patch& At(int k) const { return patches_[static_cast<std::size_t>(Root(k))]; }
  const std::vector<int>& into() const { return into_; }
  /// Two surfaces meet where patches k and l touch: nothing may join what they belong to.
  void KeepApart(int k, int l) { apart_.emplace_back(k, l); }
  bool Apart(int a, int b) const;
  /// Whether something that patch `a` is kept apart from agrees with `b` too, within the bounds
  /// on bending: both cannot be of its plane. A sheet of paper may meet a desk without a step
  /// on one side, and have a raised edge on the other, beyond which the desk goes on.
  bool IsAmbiguous(int a, int b, const DepthNoise& noise,
                   const PlaneExtractionConfig& config) const;
  void CopyPlanes(std::vector<LabelPlane>& planes) const;

 private:
  std::vector<Patch> patches_;
  std::vector<int> into_;
  std::vector<std::pair<int, int>> apart_;
};

/// What of the patches that grew is one plane. The memory of one image serves the next.
class PatchJoining {
 public:
  /// Merges touching labels that are one plane within the noise, closest pair first, refits
  /// every plane to its pixels and grows them anew.
  /// @param blocks  sums of the measured pixels of each block of `growth`, or empty
  void MergeEqualNeighbours(const DepthGrid& grid, const std::vector<PlaneSums>& blocks,
                            const DepthNoise& noise, const PlaneExtractionConfig& config,
                            PixelGrowth& growth);

  /// Joins touching labels that are parts of one surface which the sensor has bent: a real step
  /// stands all along the boundary, while the parts of a bent surface meet there. So the planes
  /// of the two labels must agree along the boundary, and those of the segments that they
  /// belong to must agree within the wider bounds on bending. The labels keep their own planes,
  /// and with them their pixels.
  /// @param blocks  as above
  /// @param warped  the bounds allow for a warp (sensor_warp.h), and planes alone do not tell
  ///   two surfaces from one: what meets in a crease (boundary_shares.h) is kept apart, here
  ///   and when hidden parts are joined
  /// @returns what stands until the next call
  const PatchUnion& JoinBentParts(const DepthGrid& grid, const std::vector<PlaneSums>& blocks,
                                  const DepthNoise& noise, const PlaneExtractionConfig& config,
                                  PixelGrowth& growth, bool warped);

  /// Runs of the labels that the last call has read.
  const LabelRuns& runs() const { return runs_; }

 private:
  /// Pixels on either side of a common boundary; their sums without inverse depth, which a
  /// distance of planes does not ask for, once they are wanted.
  struct Contact {
    int pixels = 0;
    bool wanted = false, summed = false;
    PlaneSums rays;
  };
  void FindContacts(const DepthGrid& grid, PixelGrowth& growth);
  void SumContacts(const DepthGrid& grid, const DepthNoise& noise,
                   const PlaneExtractionConfig& config);
  void RankMeetingLabels(const DepthNoise& noise, const PlaneExtractionConfig& config);
  void JoinMeeting(const DepthNoise& noise, const PlaneExtractionConfig& config);

  PatchUnion patches_;
  std::vector<PlaneSums> sums_;  ///< one a label
  LabelImage labels_;
  LabelRuns runs_;
  LabelPairs<Contact> contacts_;
  std::vector<std::uint8_t> wanted_;  ///< labels with a contact that is to be summed
  StepMeasurement step_measurement_;
  BoundarySteps steps_;
  LabelPairs<BoundaryStrips> strips_;
  BoundaryShares shares_;
  std::vector<LabelPlane> planes_;
  /// Labels without a step between them, by the mean square of what there is.
  std::vector<std::pair<double, std::pair<int, int>>> meeting_;
};

}  // namespace slam
