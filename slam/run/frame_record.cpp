#include "slam/run/frame_record.h"

#include "slam/base/require.h"

namespace slam {
namespace {

using Json = nlohmann::ordered_json;

Json NumberJson(double x) {
  Require(std::isfinite(x), "frame_planes.jsonl: a number to write is not finite");
  return x == 0 ? 0.0 : x;  // no -0
}

/// What settled the decision, or null.
const char* DecidedBy(const PlaneMatch& match) {
  if (match.decision == PlaneDecision::kTrial) return "candidate";
  const bool split = match.reason == MatchReason::kSplit;
  if (match.decision == PlaneDecision::kNew && !split) return "unmatched";
  switch (match.reason) {
    case MatchReason::kNothing:
      return nullptr;
    case MatchReason::kParameters:
      return "parameters";
    case MatchReason::kOverlap:
      return "overlap";
    case MatchReason::kClass:
      return "class";
    case MatchReason::kBox:
      return "iou";
    case MatchReason::kRankTest:
      return "ranksum";
    case MatchReason::kAmbiguous:
      return "ambiguous";
    case MatchReason::kSplit:
      return "split";
  }
  throw std::invalid_argument("DecidedBy: unknown reason");
}

/// In the world, where they stand still while the camera turns.
Json AxesJson(const Frame& frame) {
  Json axes = Json::array();
  for (const MotionAxis& axis : frame.degenerate) {
    axes.push_back(
        {{axis.turn ? "about" : "along", VectorJson(frame.T_cw.R.transpose() * axis.axis_c)}});
  }
  return axes;
}

Json PlaneJson(const FramePlane& plane, const PlaneMatch& match) {
  Json json;
  json["index"] = plane.index;
  json["normal"] = VectorJson(plane.pi_c.n);
  json["d"] = NumberJson(plane.pi_c.d);
  json["centroid"] = VectorJson(plane.centroid_c);
  json["pixels"] = plane.pixel_count;
  json["inlier_ratio"] = NumberJson(plane.inlier_ratio);
  json["class"] = plane.class_name.empty() ? Json(nullptr) : Json(plane.class_name);
  json["detection"] = plane.detection ? Json(*plane.detection) : Json(nullptr);
  json["bad"] = plane.bad ? Json(BadReasonText(*plane.bad)) : Json(nullptr);
  json["lines"] = Json::array();
  for (const Line& line : plane.lines_c)
    json["lines"].push_back(Json::array({VectorJson(line.P), VectorJson(line.V)}));
  json["vertices"] = Json::array();
  for (const Vertex& vertex : plane.vertices_c)
    json["vertices"].push_back(VectorJson(vertex.p_c));
  json["map_plane"] = match.ShowsLandmark() ? Json(match.map_plane) : Json(nullptr);
  json["decision"] = DecisionText(match.decision);
  const char* by = DecidedBy(match);
  json["by"] = by != nullptr ? Json(by) : Json(nullptr);
  return json;
}

}  // namespace

const char* BadReasonText(BadReason reason) {
  switch (reason) {
    case BadReason::kFar:
      return "far";
    case BadReason::kInliers:
      return "inliers";
    case BadReason::kBorder:
      return "border";
    case BadReason::kStructure:
      return "structure";
    case BadReason::kUnstructured:
      return "unstructured";
  }
  throw std::invalid_argument("BadReasonText: unknown reason");
}

const char* DecisionText(PlaneDecision decision) {
  switch (decision) {
    case PlaneDecision::kUnmatched:
    case PlaneDecision::kTrial:
      return "none";
    case PlaneDecision::kMatched:
      return "matched";
    case PlaneDecision::kNew:
      return "new";
  }
  throw std::invalid_argument("DecisionText: unknown decision");
}

Json VectorJson(const Eigen::Vector3d& x) {
  return Json::array({NumberJson(x.x()), NumberJson(x.y()), NumberJson(x.z())});
}

Json FramePlanesRecord(const Frame& frame, bool tracked, const char* state) {
  Require(frame.plane_matches.empty() || frame.plane_matches.size() == frame.planes.size(),
          "FramePlanesRecord: the matches are not parallel to the planes");
  Json json;
  json["timestamp"] = NumberJson(frame.timestamp_s);
  json["tracked"] = tracked;
  if (*state != 0) json["state"] = state;
  if (tracked && !frame.degenerate.empty()) json["degenerate"] = AxesJson(frame);
  json["planes"] = Json::array();
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    const PlaneMatch match =
        frame.plane_matches.empty() ? PlaneMatch{} : frame.plane_matches[i];
    Require(match.decision == PlaneDecision::kUnmatched || match.map_plane >= 0,
            "FramePlanesRecord: a decision without a map plane");
    json["planes"].push_back(PlaneJson(frame.planes[i], match));
  }
  return json;
}

}  // namespace slam
