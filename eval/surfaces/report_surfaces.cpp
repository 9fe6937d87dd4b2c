#include "eval/surfaces/report_surfaces.h"

#include <fmt/format.h>

namespace eval {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson FiguresJson(const SurfaceFigures& f) {
  return {{"whole", f.whole},         {"covered", f.covered},
          {"purity", f.purity},       {"segments_per_frame", f.segments_per_frame},
          {"coverage", f.coverage},   {"identity", f.identity},
          {"landmarks", f.landmarks}, {"no_decision", f.no_decision},
          {"frames", f.frames},       {"pixels", f.pixels}};
}

std::string FiguresRow(const std::string& name, const SurfaceFigures& f) {
  return fmt::format(
      "  {:<8}{:>7.3f}{:>9.3f}{:>8.3f}{:>10.2f}{:>10.3f}{:>10.3f}{:>11.1f}{:>13.3f}{:>8}\n",
      name, f.whole, f.covered, f.purity, f.segments_per_frame, f.coverage, f.identity,
      f.landmarks, f.no_decision, f.frames);
}

}  // namespace

void AddSurfaces(const SurfaceScore& score, const std::string& surfaces, OrderedJson& metrics) {
  OrderedJson each = OrderedJson::array();
  for (const auto& [id, figures] : score.surfaces) {
    OrderedJson one{{"id", id}};
    one.update(FiguresJson(figures));
    each.push_back(one);
  }
  OrderedJson group = FiguresJson(score.total);
  const std::size_t undecided = score.events.size();
  group["no_decision_in_map"] = {
      {"share", score.known_surfaces > 0 ? OrderedJson(double(undecided) / score.known_surfaces)
                                         : OrderedJson(nullptr)},
      {"events", undecided},
      {"surfaces", score.known_surfaces}};
  if (score.known_surfaces == 0) {
    metrics["reasons"]["surfaces/no_decision_in_map/share"] =
        "no frame shows a large surface that has a landmark, after the first second";
  }
  group["each"] = each;
  metrics["surfaces"] = group;
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
