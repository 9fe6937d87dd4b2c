#include "eval/surfaces/report_surfaces.h"

#include <fmt/format.h>

namespace eval {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Figures of one surface, or of all; what is a share of nothing is null, with the reason.
/// @param place  of the figures in metrics.json: "surfaces/"
OrderedJson FiguresJson(const SurfaceFigures& f, const std::string& place,
                        OrderedJson& reasons) {
  OrderedJson json;
  const auto put = [&](const char* key, double value, bool defined, const char* reason) {
    json[key] = defined ? OrderedJson(value) : OrderedJson(nullptr);
    if (!defined) reasons[place + key] = reason;
  };
  const bool seen = f.pixels > 0;
  const char* const unseen = "no frame shows a surface";
  put("whole", f.whole, seen, unseen);
  put("covered", f.covered, seen, unseen);
  put("purity", f.purity, f.segment_pixels > 0, "no segment shows it mostly");
  put("segments_per_frame", f.segments_per_frame, f.frames > 0, unseen);
  put("coverage", f.coverage, seen, unseen);
  put("identity", f.identity, f.landmark_pixels > 0, "none of it is in a landmark");
  put("landmarks", f.landmarks, seen, unseen);
  put("no_decision", f.no_decision, f.large_frames > 0, "it is large in no frame");
  json["frames"] = f.frames;
  json["pixels"] = f.pixels;
  return json;
}

std::string FiguresRow(const std::string& name, const SurfaceFigures& f) {
  return fmt::format(
      "  {:<8}{:>7.3f}{:>9.3f}{:>8.3f}{:>10.2f}{:>10.3f}{:>10.3f}{:>11.1f}{:>13.3f}{:>8}\n",
      name, f.whole, f.covered, f.purity, f.segments_per_frame, f.coverage, f.identity,
      f.landmarks, f.no_decision, f.frames);
}

}  // namespace

void AddSurfaces(const SurfaceScore& score, const std::string& surfaces, OrderedJson& metrics) {
  OrderedJson each = OrderedJson::array(), reasons = OrderedJson::object();
  for (const auto& [id, figures] : score.surfaces) {
    OrderedJson one{{"id", id}};
    one.update(FiguresJson(figures, fmt::format("surfaces/each/{}/", each.size()), reasons));
    each.push_back(one);
  }
  OrderedJson group = FiguresJson(score.total, "surfaces/", reasons);
  const std::size_t undecided = score.events.size();
  group["no_decision_in_map"] = {
      {"share", score.known_surfaces > 0 ? OrderedJson(double(undecided) / score.known_surfaces)
                                         : OrderedJson(nullptr)},
      {"events", undecided},
      {"surfaces", score.known_surfaces}};
  if (score.known_surfaces == 0) {
    reasons["surfaces/no_decision_in_map/share"] =
        "no frame shows a large surface that has a landmark, after the first second";
  }
  group["each"] = each;
  metrics["surfaces"] = group;
  if (!reasons.empty()) metrics["reasons"].update(reasons);
  metrics["rules"]["surfaces"] =
      "surfaces of " + surfaces +
      "; a pixel shows a surface by its depth, the true pose and the outline; whole, covered: "
      "share of a surface in its largest segment of a frame, in any, over frames by pixels; "
      "purity: of a segment's pixels on surfaces, the share on its commonest; coverage: share "
      "in planes with a landmark, merges followed; identity: of those, the share in the "
      "commonest; landmarks: that hold 2 % of a surface, mean over surfaces; no_decision: of "
      "surfaces over 5 % of a frame, the share whose largest segment has no landmark; "
      "segments_per_frame: all of a frame, of a surface those that show it mostly; "
      "no_decision_in_map: the same as no_decision of surfaces whose largest segment had a "
      "landmark in an earlier frame, after the first second";
}

std::string SurfacesTable(const SurfaceScore& score) {
  std::string text =
      "Surfaces\n  id        whole  covered  purity  segments  coverage  identity  landmarks  "
      "no decision  frames\n";
  text += FiguresRow("all", score.total);
  for (const auto& [id, figures] : score.surfaces)
    text += FiguresRow(std::to_string(id), figures);
  if (score.known_surfaces > 0) {
    text += fmt::format(
        "  no decision on {} of {} large surfaces of frames that have a landmark "
        "({:.3f})\n",
        score.events.size(), score.known_surfaces,
        double(score.events.size()) / score.known_surfaces);
  }
  return text;
}

}  // namespace eval
