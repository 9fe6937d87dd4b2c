#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// What the pictures of a map show, all in frame v: metres, z up.
struct MapScene {
  struct Estimate {
    int id = 0;
    std::string class_name;  ///< may be empty
    Plane pi_v;
    std::vector<Eigen::Vector3d> hull_v, vertices_v;
    Eigen::Vector3d centre_v = Eigen::Vector3d::Zero();
    int observations = 0;
    double area_m2 = 0;
  };
  struct Truth {
    std::string class_name;
    Plane pi_v;
    std::vector<Eigen::Vector3d> vertices_v;
  };
  std::vector<Estimate> planes;  ///< those that no merge took away, lowest first
  std::vector<Truth> truth;      ///< scored planes; empty without gt/scene.json
  std::vector<Eigen::Vector3d> run_path_v, truth_path_v;
  bool on_truth = false;  ///< the run is laid on the truth
  bool levelled = false;  ///< turned until the main level plane lies level (MapGauge)
};

/// Collects a run and its truth in the frame that ChooseMapGauge gives.
MapScene CollectMap(const Run& run, const Sequence& sequence);

/// Looks down on v: x to the right, y up the page.
struct MapScale {
  double x0_m = 0, y1_m = 0;  ///< the upper left corner
  double pixels_per_m = 1;
  cv::Rect2d page;  ///< where on the picture
  cv::Point2d At(const Eigen::Vector3d& p_v) const {
    return {page.x + (p_v.x() - x0_m) * pixels_per_m, page.y + (y1_m - p_v.y()) * pixels_per_m};
  }
  std::vector<cv::Point2d> At(const std::vector<Eigen::Vector3d>& points_v) const;
};

/// Fits map and paths into the page's width and at most its height; page.height shrinks to fit.
/// Planes that few frames saw may be cut off.
MapScale FitMap(const MapScene& scene, cv::Rect2d page);

/// Level planes look up: n . z above this, about 10 degrees.
inline constexpr double kLevel_cos = 0.985;

/// Height of the plane below or above a point of v.
double HeightAt(const Plane& pi_v, const Eigen::Vector3d& p_v);

/// Whether a convex outline contains the point, seen from above; in either direction of turning.
bool Contains(const std::vector<Eigen::Vector3d>& convex_v, const Eigen::Vector3d& p_v);

/// A point of the plane on the page that no level plane above it covers: its centre, or, for a
/// floor under a desk, one towards its border. The centre when there is none.
Eigen::Vector3d OpenPoint(const MapScene& scene, const MapScene::Estimate& plane,
                          const MapScale& scale);

/// The level plane that most smaller ones stand on, over it and up to 0.4 m above (the desk,
/// usually); on ties that of most area times observations. Nothing without a level plane.
std::optional<std::size_t> BasePlane(const MapScene& scene);

/// The true level plane under the centre of an estimated one: nearest in height, within 50 mm.
const MapScene::Truth* TrueLevelPlane(const MapScene& scene, const MapScene::Estimate& plane);

}  // namespace eval
