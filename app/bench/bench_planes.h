#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/planes/corners.h"
#include "eval/planes/segmentation_score.h"
#include "eval/surfaces/surface_scorer.h"
#include "slam/run/config.h"

namespace app {

/// Milliseconds of processor time, one entry a frame.
struct PlaneTimes {
  std::vector<double> extraction_ms, processing_ms;
  std::vector<double> plain_pass_ms;  ///< one read of the depth image, back-projected to points
};

/// Found of all, by what they are.
struct Share {
  int found = 0, all = 0;
  void Add(bool is_found) { ++all, found += is_found ? 1 : 0; }
  double Ratio() const { return all > 0 ? static_cast<double>(found) / all : 0.0; }
};

/// Faces that look up, by the height of their step in millimetres and their distance in
/// decimetres, both rounded down to a bin's start.
using StepTable = std::map<std::pair<int, int>, Share>;

/// What a bench of plane extraction and processing counts; adds up over sequences.
struct PlaneBench {
  int frames = 0, scored_frames = 0;
  int segments = 0;
  PlaneTimes times;
  eval::HooverScore hoover;       ///< trusted planes, summed over frames
  eval::PanopticCounts panoptic;  ///< the same
  std::vector<double> normal_deg, offset_mm;
  eval::CornerCounts corners;  ///< corners of top faces of regular objects
  Share thin_tops;             ///< step of 10 mm or more, within 1.2 m: separated
  StepTable steps;
  /// Of the largest level plane of each frame, where camera poses are known and plane truth is
  /// not: its normal in the world, and its share of the measured pixels.
  std::vector<Eigen::Vector3d> level_normals_w;
  std::vector<double> level_shares;
  std::optional<eval::SurfaceFigures> surfaces;  ///< of one sequence, with a surfaces file

  /// True planes that share a found one with others.
  int Merged() const { return hoover.truth - hoover.correct - hoover.over - hoover.missed; }
  void Add(const PlaneBench& o);
};

/// What of a sequence is looked at.
struct BenchChoice {
  int at_most = 0;  ///< 0 = all
  int every = 1;
  bool unmeasured = false;  ///< count true pixels that have no depth as well
  /// Of a recording: by how much its depth is stamped later than its true poses.
  double depth_delay_ms = 0.0;
  std::string surfaces;  ///< of a recording: file of `pas surfaces`; empty: none
};

/// Runs (B) and (C) on every frame of a sequence, on this thread, and scores them when the
/// sequence has truth: true planes of at least 1,000 pixels at incidence up to 75 degrees, as
/// `pas eval` does.
/// @param camera  see slam::ChooseCamera
/// @throws InputError of slam or eval.
PlaneBench BenchPlanes(const std::filesystem::path& sequence, const std::string& camera,
                       const slam::Config& config, const BenchChoice& choice);

}  // namespace app
