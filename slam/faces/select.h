#pragma once

#include <optional>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/model/detection.h"
#include "slam/model/frame_plane.h"

namespace slam {

/// How much a regular object's face must show.
enum class StructureRule {
  /// Default: a face cut by the image border or hidden in part is evidence, not a fault.
  kIgnored,
  /// As printed: bad near the image border, and without two pairs of parallel lines or four
  /// vertices.
  kComplete
};

/// A `max_` bound is passed strictly below it, a `min_` bound strictly above it.
struct SelectConfig {
  double max_distance_m = 5.0;
  double max_roughness = 1.3;        // more are stairs
  double max_curvature_per_m = 5.0;  // cups and bottles are rounder: a radius of 20 cm
  double max_unstructured_share = 0.5;
  StructureRule structure = StructureRule::kIgnored;
  double border_px = 3.0;
  double max_border_share = 0.05;
};

inline void VisitFields(SelectConfig& c, FieldVisitor& v) {
  v.Number("max_distance_m", c.max_distance_m, "(0, inf)",
           "largest distance of a plane's centroid from the camera");
  v.Number("max_roughness", c.max_roughness, "[1, inf)",
           "largest roughness over 8 pixels, in small images fewer, as a multiple of "
           "what noise makes it");
  v.Number("max_curvature_per_m", c.max_curvature_per_m, "(0, inf)",
           "largest curvature, 1 / radius, of a surface that is surely curved");
  v.Number("max_unstructured_share", c.max_unstructured_share, "(0, 1]",
           "largest share of edge points in the box of an unstructured object");
  v.Named("structure", c.structure, {"ignored", "complete"},
          "how much the face of a regular object must show");
  v.Number("border_px", c.border_px, "[0, inf)", "width of the image border");
  v.Number("max_border_share", c.max_border_share, "(0, 1]",
           "with complete: largest share of edge points at the image border");
}

/// What a sensor's noise comes to in a frame, medians over the pixels of its planes; 0 when none
/// is known. Noise may be several times as large on one surface as on another, by distance and
/// slant or by what it is made of, but it spreads alike over pixels.
struct UsualRoughness {
  double coarse = 0.0;  ///< Roughness::coarse
  double growth = 0.0;  ///< Roughness::coarse over fine
};
UsualRoughness FindUsualRoughness(const std::vector<FramePlane>& planes);

/// The first reason why a plane is not to be trusted, or nothing. In the paper's order:
///   1. too far from the camera                                          kFar
///   2. no point on it after the re-fit; stairs: rougher than the frame's
///      other surfaces and than its own noise makes it; or round         kInliers
///   3. tied to a regular object's box, but at the border, or without
///      the structure of a rectangle (StructureRule)                     kBorder, kStructure
///   4. most edge points in the box of an unstructured object, unless a
///      regular object's box holds it too and fits it better             kUnstructured
///
/// @param min_score  of a detection that counts, as in BoxLinkConfig
/// Source: PAS-SLAM, Plane Selection.
std::optional<BadReason> FindFault(const FramePlane& plane,
                                   const std::vector<Detection>& detections, double min_score,
                                   const UsualRoughness& usual, const Camera& camera,
                                   const SelectConfig& config);

}  // namespace slam
