#include "slam/associate/frame_relations.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/associate/plane_comparison.h"
#include "slam/associate/side_by_side.h"

namespace slam {
namespace {

/// A step where they meet that neither noise nor what neighbours have in common explains.
std::optional<FrameStep> FindStep(const SideBySide& neighbours, std::size_t f, std::size_t g,
                                  const AssociationConfig& config) {
  const double common_m = 0.5 * config.offset_floor_m;
  const auto between = neighbours.Between(f, g);
  if (!between) return std::nullopt;
  const double sigma_m = std::hypot(between->sigma_m, common_m);
  if (!(std::abs(between->step_m) > kCertainStep_sigmas * sigma_m)) return std::nullopt;
  return FrameStep{static_cast<int>(f), static_cast<int>(g), between->step_m, sigma_m};
}

}  // namespace

bool OnTwoObjects(const FramePlane& one, const FramePlane& other,
                  const std::vector<Detection>& detections) {
  constexpr double kDouble = 0.4;  // IoU from which boxes of two classes may be of one object
  constexpr double kPart = 0.5;    // of the smaller box; of one class it may be a part's box
  if (!one.detection || !other.detection || *one.detection == *other.detection) return false;
  const auto d = static_cast<std::size_t>(*one.detection);
  const auto e = static_cast<std::size_t>(*other.detection);
  if (d >= detections.size() || e >= detections.size()) return false;
  const Box &a = detections[d].box_px, &b = detections[e].box_px;
  if (detections[d].class_name != detections[e].class_name) return Iou(a, b) < kDouble;
  return Intersection(a, b).area() < kPart * std::min(a.area(), b.area());
}

FrameRelations RelateFramePlanes(const Frame& frame, const Camera& camera,
                                 const AssociationConfig& config) {
  const std::size_t count = frame.planes.size();
  FrameRelations out;
  out.pieces.assign(count, std::vector<Pieces>(count, Pieces::kOfTwo));
  std::optional<SideBySide> neighbours;
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t g = f + 1; g < count; ++g) {
      const FramePlane &one = frame.planes[f], &other = frame.planes[g];
      if (OnTwoObjects(one, other, frame.detections)) continue;
      // Measured from both sides: the answer must not depend on which comes first.
      const double chi2 = std::max(ComparePlanes(one, other, config).chi2,
                                   ComparePlanes(other, one, config).chi2);
      if (!(chi2 < config.new_chi2)) continue;
      Pieces pieces = Pieces::kUnsure;
      if (chi2 < config.max_chi2) {
        if (!neighbours) neighbours.emplace(frame, camera);
        if (const auto step = FindStep(*neighbours, f, g, config)) {
          out.steps.push_back(*step);
        } else {
          pieces = Pieces::kOfOne;
        }
      }
      out.pieces[f][g] = out.pieces[g][f] = pieces;
    }
  }
  return out;
}

}  // namespace slam
