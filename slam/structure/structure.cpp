#include "slam/structure/structure.h"

#include "slam/model/map_queries.h"
#include "slam/structure/manhattan_mixture.h"

namespace slam {
namespace {

Eigen::Matrix3d AxesInWorld(const Map& map, const ManhattanFrame& known) {
  return KeyframePose(map, known.keyframe).R.transpose() * known.axes_k;
}

/// The rotation that the axes give by themselves: free of drift where they are.
void AddRotation(const Frame& frame, const std::vector<AxisObservation>& axes,
                 PoseProblem& problem) {
  const auto rotation = RotationFromAxes(axes, frame.T_cw.R);
  if (rotation) problem.rotations.push_back(*rotation);
}

/// Looks for the one frame of the map until it is found.
void LearnManhattanWorld(int keyframe, const ManhattanConfig& config, Map& map) {
  if (!map.manhattan.empty()) return;
  const auto axes_w = FindManhattanAxes(map.planes, config);
  if (!axes_w) return;
  ManhattanFrame found;
  found.keyframe = keyframe;
  found.axes_k = KeyframePose(map, keyframe).R * *axes_w;
  map.manhattan.push_back(found);
}

}  // namespace

void AddStructure(const Frame& frame, const Map& map, const StructureConfig& config,
                  PoseProblem& problem) {
  switch (config.mode) {
    case StructureMode::kFree:
      return;
    case StructureMode::kParallel:
      AddParallelPlanes(frame, map, config.parallel, problem);
      return;
    case StructureMode::kManhattan:
      if (map.manhattan.empty()) return;
      AddRotation(frame,
                  SeenAxes(frame, AxesInWorld(map, map.manhattan.front()), config.manhattan),
                  problem);
      return;
    case StructureMode::kMixture:
      AddRotation(frame, SeenManhattanFrame(frame, map, config.manhattan), problem);
      return;
    case StructureMode::kSupposed:
      AddSupposedPlanes(frame, map, config.supposed, problem);
      return;
  }
}

void AddEdgesAlone(const Frame& frame, const Map& map, const StructureConfig& config,
                   PoseProblem& problem) {
  if (config.edges_alone && config.mode != StructureMode::kSupposed)
    AddSupposedPlanes(frame, map, config.supposed, problem);
}

void LearnStructure(const Frame& frame, std::optional<int> keyframe, double keep,
                    const StructureConfig& config, Map& map) {
  if (config.edges_alone || config.mode == StructureMode::kSupposed)
    LearnSupposedPlanes(frame, keep, config.supposed, map);
  switch (config.mode) {
    case StructureMode::kFree:
    case StructureMode::kParallel:
    case StructureMode::kSupposed:
      return;
    case StructureMode::kManhattan:
      if (keyframe) LearnManhattanWorld(*keyframe, config.manhattan, map);
      return;
    case StructureMode::kMixture:
      if (keyframe) LearnManhattanFrames(frame, *keyframe, config.manhattan, map);
      return;
  }
}

}  // namespace slam
