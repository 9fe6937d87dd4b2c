#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/frame.h"

namespace slam {

/// Number of differing bits, in [0, 256].
int DescriptorDistance(const Descriptor& a, const Descriptor& b);

/// Features of one image by where they are; refers to the features by index.
class FeatureGrid {
 public:
  FeatureGrid(const std::vector<PointFeature>& features, const Camera& camera);

  /// Indices of the features within a square of half width `radius_px` around `u_px` whose
  /// octave is in [min_octave, max_octave]; cell by cell, ascending in each.
  std::vector<int> Near(const Eigen::Vector2d& u_px, double radius_px, int min_octave,
                        int max_octave) const;

 private:
  int ColumnOf(double u_px) const;
  int RowOf(double v_px) const;

  const std::vector<PointFeature>& features_;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<int>> cells_;
};

/// Gates of point matching.
struct PointMatchConfig {
  int max_distance = 100;  // TH_HIGH of ORB-SLAM2
  double max_ratio = 0.9;
};

inline void VisitFields(PointMatchConfig& c, FieldVisitor& v) {
  v.Integer("max_distance", c.max_distance, "[0, 256]",
            "largest number of differing bits of two matched descriptors");
  v.Number("max_ratio", c.max_ratio, "(0, 1]",
           "largest distance to the best candidate over that to the second best of its octave");
}

/// Something looked for in an image: a map point where it is expected.
struct PointQuery {
  int point = kNone;       ///< id that the match will carry
  Eigen::Vector2d u_px;    ///< expected position, undistorted
  double radius_px = 7.0;  ///< half width of the search square
  int min_octave = 0, max_octave = 7;
  Descriptor descriptor{};
  float angle_deg = -1.0f;  ///< orientation of the feature it was seen at; < 0: not compared
};

/// Finds for each query the feature with the nearest descriptor among the near ones. A feature
/// goes to the query that is nearest to it, the earlier one at a tie.
/// @param taken parallel to `features`: such features are left out; empty for none
/// @returns parallel to `features`: index of the query, or kNone
std::vector<int> MatchQueries(const std::vector<PointQuery>& queries,
                              const std::vector<PointFeature>& features,
                              const FeatureGrid& grid, const std::vector<bool>& taken,
                              const PointMatchConfig& config);

/// Whether another corner nearby looks like this one, so that a match with either may be meant for
/// the other: the steps of a slanting edge's pixels, which stay where they are in the image while the
/// camera slides along the edge; prints in a row.
/// @param reach_px  half width of the square that is looked through, at octave 0
/// @param max_distance  differing bits of descriptors that look alike
bool HasDouble(const PointFeature& feature, const std::vector<PointFeature>& features,
               const FeatureGrid& grid, const FeatureScale& scale, double reach_px,
               int max_distance);

struct FeaturePair {
  int first, second;  ///< indices into the features of the two images
};

/// Pairs of features of two images by descriptors alone: each is the other's nearest.
/// @param use_second  parallel to the second image's: which take part; empty for all
std::vector<FeaturePair> MatchDescriptors(const std::vector<PointFeature>& first,
                                          const std::vector<PointFeature>& second,
                                          const std::vector<bool>& use_second,
                                          const PointMatchConfig& config);

/// Which pairs turn as the image does: a histogram of the angle differences, of which the three
/// fullest of 30 bins stay (only those with at least a tenth of the fullest), as in ORB-SLAM2.
/// @param turns_deg differences of angles, any range; NaN always stays
std::vector<bool> ConsistentTurns(const std::vector<double>& turns_deg);

}  // namespace slam
