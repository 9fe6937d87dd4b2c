#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/draw/paint.h"
#include "eval/formats/run/run.h"

namespace eval {

/// The plane a map plane ended up in.
const RunMapPlane* FinalPlane(const std::vector<RunMapPlane>& map, int id);

/// How a plane of a frame goes by in every picture: a plane that was merged later by the name
/// and colour of the plane it ended up in, so that one surface has one of each.
struct PlaneName {
  std::optional<Colour> colour;  ///< nothing: it belongs to no map plane
  std::string text;  ///< "12 book", "not flat enough", or empty where there is nothing to say
};
PlaneName NameOfPlane(const RunFramePlane& plane, const std::vector<RunMapPlane>& map);

/// What became of a plane of a frame, as the legend names it.
enum class DecisionMark { kMatched, kNew, kBad, kOpen };
DecisionMark MarkOf(const RunFramePlane& plane);
Colour ColourOf(DecisionMark mark);
const char* Meaning(DecisionMark mark);

}  // namespace eval
