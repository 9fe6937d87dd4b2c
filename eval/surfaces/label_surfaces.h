#pragma once

#include <vector>

#include "eval/formats/sequence/sequence.h"
#include "eval/surfaces/depth_views.h"
#include "eval/surfaces/outline.h"
#include "eval/surfaces/surface.h"

namespace eval {

/// Says which surface each pixel of a view shows.
class SurfaceLabeller {
 public:
  explicit SurfaceLabeller(const SurfaceFile& file);

  /// Ids (CountedAs) of the surfaces that the pixels show, 0 = none. A pixel shows the surface
  /// in whose outline its point falls and to whose plane it is nearest, as a share of its
  /// tolerance; where its neighbourhood is smooth, that must face as the surface does.
  cv::Mat1w Label(const DepthView& view, const cv::Mat2d& rays) const;

 private:
  struct LabelledSurface {
    int label = 0;
    Plane pi_g;
    SurfaceArea area;
  };
  double noise_per_m_;
  std::vector<LabelledSurface> surfaces_;
};

/// Which pixels of a true plane count.
enum class TruePixels {
  kWithDepth,     ///< all that have depth
  kDepthOnPlane,  ///< those whose depth lies on the plane, within its tolerance
};

/// The same of a simulated sequence by its truth, gt/plane_id, of the scored planes of which all
/// views together show min_area_m2.
class TrueSurfaceLabeller {
 public:
  /// @throws InputError when the sequence has no gt/scene.json or no gt/plane_id
  TrueSurfaceLabeller(const Sequence& sequence, const DepthViews& views, double min_area_m2,
                      TruePixels pixels);

  cv::Mat1w Label(const DepthView& view, const cv::Mat2d& rays) const;
  const std::vector<int>& ids() const { return ids_; }

 private:
  Sequence sequence_;
  TruePixels pixels_;
  double noise_per_m_;
  std::vector<int> ids_;
};

}  // namespace eval
