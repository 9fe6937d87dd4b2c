#pragma once

#include "slam/base/field_visitor.h"

namespace slam {

/// What decides whether two regions are one plane.
enum class MergeRule {
  kAddedError,  ///< the error that the merge adds
  kMeanError    ///< the mean error of the union, as in PEAC: to compare with
};

/// When neighbouring blocks and regions are one plane. Everything is in units of the noise.
struct ClusterConfig {
  /// Part of a block that must be measured; domain (0, 1].
  double min_measured = 0.6;
  /// Mean squared error of a block about its own plane, in sigma^2: a block across a depth step
  /// or a crease exceeds it. Domain (0, inf).
  double max_block_error = 3.0;
  /// A block with a larger jump between neighbouring pixels, in sigmas, lies across a depth
  /// step: a step can look like a slanted surface, whose larger noise would excuse it. Domain
  /// (0, inf).
  double max_jump_sigmas = 12.0;
  MergeRule merge_rule = MergeRule::kAddedError;
  /// Chi-square bound (3 degrees of freedom) on the error that a merge adds; 16.3 is 0.1 %.
  double max_merge_chi2 = 16.3;
  /// Distance, in sigmas, that two parts of one real surface may differ by for reasons other
  /// than noise (calibration, warp of the sensor); domain [0, inf).
  double model_error_sigmas = 1.0;
  /// Blocks below which a region is dropped; domain [1, inf).
  int min_blocks = 4;
};

inline void VisitFields(ClusterConfig& c, FieldVisitor& v) {
  v.Number("min_measured", c.min_measured, "(0, 1]", "part of a block with depth");
  v.Number("max_block_error", c.max_block_error, "(0, inf)", "mean squared error, sigma^2");
  v.Number("max_jump_sigmas", c.max_jump_sigmas, "(0, inf)", "between neighbouring pixels");
  v.Named("merge_rule", c.merge_rule, {"added_error", "mean_error"}, "mean_error is PEAC's");
  v.Number("max_merge_chi2", c.max_merge_chi2, "(0, inf)",
           "error that a merge adds, 3 degrees of freedom");
  v.Number("model_error_sigmas", c.model_error_sigmas, "[0, inf)",
           "of one real surface, besides noise");
  v.Integer("min_blocks", c.min_blocks, "[1, 100000]", "of a region");
}

}  // namespace slam
