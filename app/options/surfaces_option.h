#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "eval/formats/run/run.h"
#include "eval/report/evaluate.h"
#include "eval/surfaces/score_surfaces.h"

namespace app {

/// What says where a pixel of depth lies: the camera and, where depth is not laid on colour,
/// the file that says how.
struct DepthCamera {
  std::string camera, registration;  ///< as given; empty: not given
};

/// --depth-registration, the same for all commands that read depth with its truth.
void AddRegistrationOption(CLI::App& command, std::string& registration);

/// The depth of a sequence from its true poses.
/// @param run  may tell the camera with which it was made
/// @throws InputError when no camera is known, and of the readers
eval::DepthViews ViewsOf(const eval::Sequence& sequence, const eval::Run& run,
                         const DepthCamera& camera);

/// The options of `pas eval` that score a run on surfaces.
struct SurfacesOption {
  std::string file;           ///< of pas surfaces, "true" or "true-on-depth"
  std::string pictures;       ///< folder for the worst frames
  double min_area_m2 = 0.15;  ///< with "true"
  DepthCamera camera;
};
void AddSurfacesOption(CLI::App& command, SurfacesOption& option);

/// Which surface each pixel of a view shows.
/// @param file   of pas surfaces, "true" or "true-on-depth"
/// @param views  has to outlive what is returned
eval::LabelView LabelsOf(const std::string& file, double min_area_m2,
                         const eval::Sequence& sequence, const eval::DepthViews& views);

/// @param force  an older folder of pictures is replaced
/// Scores the run and writes the pictures when they are asked for. Nothing without --surfaces.
std::optional<eval::SurfaceScore> ScoreOnSurfaces(const eval::Run& run,
                                                  const eval::Sequence& sequence,
                                                  const SurfacesOption& option, bool force);

}  // namespace app
