#include "eval/draw/plane_name.h"

#include <algorithm>

namespace eval {

const RunMapPlane* FinalPlane(const std::vector<RunMapPlane>& map, int id) {
  const RunMapPlane* plane = nullptr;
  for (std::size_t steps = 0; steps <= map.size(); ++steps) {
    const auto found = std::find_if(map.begin(), map.end(),
                                    [&](const RunMapPlane& other) { return other.id == id; });
    if (found == map.end()) return plane;
    plane = &*found;
    if (!found->merged_into) return plane;
    id = *found->merged_into;
  }
  return plane;
}

namespace {

constexpr std::size_t kMaxClass_chars = 24;  // on a chip; the longest class of COCO has 14

/// The reasons of frame_planes.jsonl that do not speak for themselves.
std::string ReasonInWords(const std::string& bad) {
  if (bad == "far") return "too far";
  if (bad == "inliers") return "not flat enough";
  if (bad == "border") return "cut off by the border";
  if (bad == "structure") return "no rectangle";
  return bad;
}

}  // namespace

PlaneName NameOfPlane(const RunFramePlane& plane, const std::vector<RunMapPlane>& map) {
  PlaneName name;
  if (plane.map_plane) {
    const RunMapPlane* last = FinalPlane(map, *plane.map_plane);
    const int id = last == nullptr ? *plane.map_plane : last->id;
    name.colour = ColourOfPlane(id);
    name.text = std::to_string(id);
    const auto& class_name = last == nullptr ? plane.plane_class : last->plane_class;
    if (class_name) name.text.append(" ").append(*class_name, 0, kMaxClass_chars);
  }
  if (plane.bad)
    name.text.append(name.text.empty() ? "" : ": ").append(ReasonInWords(*plane.bad));
  return name;
}

DecisionMark MarkOf(const RunFramePlane& plane) {
  if (plane.bad) return DecisionMark::kBad;
  if (plane.decision == "matched") return DecisionMark::kMatched;
  return plane.decision == "new" ? DecisionMark::kNew : DecisionMark::kOpen;
}

Colour ColourOf(DecisionMark mark) {
  switch (mark) {
    case DecisionMark::kMatched:
      return {110, 215, 110};
    case DecisionMark::kNew:
      return {60, 190, 255};
    case DecisionMark::kBad:
      return {80, 80, 245};
    case DecisionMark::kOpen:
      break;
  }
  return {170, 170, 170};
}

const char* Meaning(DecisionMark mark) {
  switch (mark) {
    case DecisionMark::kMatched:
      return "matched with the map";
    case DecisionMark::kNew:
      return "new in the map";
    case DecisionMark::kBad:
      return "not trusted, with the reason";
    case DecisionMark::kOpen:
      break;
  }
  return "no decision";
}

}  // namespace eval
