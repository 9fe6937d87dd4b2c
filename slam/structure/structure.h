#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slam/structure/manhattan_world.h"
#include "slam/structure/parallel_planes.h"
#include "slam/structure/supposed_planes.h"

namespace slam {

/// What is assumed of how planes stand to each other.
enum class StructureMode {
  kFree,       ///< "none": nothing
  kParallel,   ///< some are parallel or perpendicular: eq19, eq20
  kManhattan,  ///< all that matter face along three axes of the world
  kMixture,    ///< some two or three stand at right angles: many Manhattan frames
  kSupposed    ///< at right angles to a surface another goes on at its straight edges
};

inline const std::vector<std::string>& StructureModeNames() {
  static const std::vector<std::string> names = {"none", "parallel", "manhattan", "mixture",
                                                 "supposed"};
  return names;
}

struct StructureConfig {
  StructureMode mode = StructureMode::kParallel;  // helps a little everywhere: docs/back_end.md
  bool edges_alone = true;  // desks are lost in the dark without: docs/points.md
  ParallelConfig parallel;
  ManhattanConfig manhattan;
  SupposedConfig supposed;
};

inline void VisitFields(StructureConfig& c, FieldVisitor& v) {
  v.Named(
      "mode", c.mode, StructureModeNames(),
      "nothing; parallel and perpendicular planes; one Manhattan frame; many; planes supposed "
      "at edges");
  v.Flag("edges_alone", c.edges_alone,
         "where points fail, planes supposed at edges hold the pose too, whatever the mode");
  v.Section("parallel", "planes parallel and perpendicular", c.parallel);
  v.Section("manhattan", "one or many Manhattan frames", c.manhattan);
  v.Section("supposed", "planes supposed at straight edges", c.supposed);
}

/// Adds to `problem` what the assumption says of the frame's pose, at the pose that it has.
void AddStructure(const Frame& frame, const Map& map, const StructureConfig& config,
                  PoseProblem& problem);

/// The same for a frame of which points say little: adds the planes supposed at its edges, unless
/// AddStructure has. They hold what planes that all face one way do not.
void AddEdgesAlone(const Frame& frame, const Map& map, const StructureConfig& config,
                   PoseProblem& problem);

/// Takes into the map what the assumption needs of the frame, at the pose that it has.
/// @param keyframe  that was made of the frame, if one was
/// @param keep      share of old information that is kept, as of AddObservation
void LearnStructure(const Frame& frame, std::optional<int> keyframe, double keep,
                    const StructureConfig& config, Map& map);

}  // namespace slam
