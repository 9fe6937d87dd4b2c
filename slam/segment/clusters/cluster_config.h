#pragma once

#include "slam/base/chi_square.h"
#include "slam/base/field_visitor.h"

namespace slam {

/// What decides whether two regions are one plane.
enum class MergeRule {
  kAddedError,  ///< the error that the merge adds
  kMeanError    ///< the mean error of the union, as in PEAC: to compare with
};

/// When neighbouring blocks and regions are one plane. Everything is in units of the noise.
struct ClusterConfig {
  double min_measured = 0.6;
  double max_block_error = 3.0;  // a block across a depth step or a crease exceeds it
  /// A step can look like a slanted surface, whose larger noise would excuse it.
  double max_jump_sigmas = 12.0;
  MergeRule merge_rule = MergeRule::kAddedError;
  double max_merge_chi2 = kChi2Of3At999;
  double model_error_sigmas = 1.0;
  int min_blocks = 4;
};

inline void VisitFields(ClusterConfig& c, FieldVisitor& v) {
  v.Number("min_measured", c.min_measured, "(0, 1]",
           "share of a block's pixels that must have depth");
  v.Number("max_block_error", c.max_block_error, "(0, inf)",
           "largest mean squared error of a block about its own plane, in units of the noise");
  v.Number("max_jump_sigmas", c.max_jump_sigmas, "(0, inf)",
           "largest jump between neighbouring pixels of a block, in standard deviations; a "
           "larger one is a depth step");
  v.Named("merge_rule", c.merge_rule, {"added_error", "mean_error"},
          "what bounds a merge: the error that it adds, or the mean error, as in PEAC");
  v.Number("max_merge_chi2", c.max_merge_chi2, "(0, inf)",
           "largest chi-square (3 degrees of freedom) that a merge of two regions may add");
  v.Number(
      "model_error_sigmas", c.model_error_sigmas, "[0, inf)",
      "distance, in standard deviations, by which parts of one real surface may differ for "
      "other reasons than noise (calibration, warp of the sensor)");
  v.Integer("min_blocks", c.min_blocks, "[1, 100000]", "smallest number of blocks of a region");
}

}  // namespace slam
