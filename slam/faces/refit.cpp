#include "slam/faces/refit.h"

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/msac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/geometry/plane_sums.h"

namespace slam {
namespace {

constexpr std::size_t kMinPoints = 3;  // a plane has three parameters
// Cosine of 87 degrees: the bound must not vanish for a plane that is seen from its edge.
constexpr double kMinCosine = 0.05;

/// Distance of a point from a plane along its ray, in sigmas of its depth.
double DistanceSigmas(const InverseDepthPlane& plane, double grazing,
                      const Eigen::Vector3d& x_c, const DepthNoise& noise) {
  const double z = x_c.z();
  const double q = plane.InverseDepth(x_c.x() / z, x_c.y() / z);
  return std::abs(1.0 / z - q) * z * z / (noise.Sigma(z) * grazing);
}

struct Candidate {
  InverseDepthPlane plane;
  double grazing = 1.0;
};

Candidate SeenFrom(const Plane& pi_c, const Eigen::Vector3d& centroid_c,
                   const DepthNoise& noise) {
  const InverseDepthPlane plane = SeenAlongRays(pi_c);
  return {plane, GrazingFactor(centroid_c, plane, noise)};
}

/// Squared errors in sigmas^2, each cut at the inlier bound; what MSAC minimises.
double TruncatedError(const std::vector<Eigen::Vector3d>& points_c, const Candidate& candidate,
                      const DepthNoise& noise, double max_sigmas) {
  double sum = 0.0;
  for (const Eigen::Vector3d& x_c : points_c) {
    const double e =
        std::min(DistanceSigmas(candidate.plane, candidate.grazing, x_c, noise), max_sigmas);
    sum += e * e;
  }
  return sum;
}

/// PCL reports failed samples on stderr; a library does not print.
void SilencePcl() {
  static const bool done = [] {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    return true;
  }();
  static_cast<void>(done);
}

/// PCL's robust plane, refined on its inliers; nothing when it finds none.
std::optional<Plane> RobustPlane(const FramePlane& plane, const DepthNoise& noise,
                                 const RefitConfig& config) {
  // The points, thinned evenly.
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const std::size_t max_points =
      std::max(static_cast<std::size_t>(std::max(config.max_sample_points, 0)), kMinPoints);
  const std::size_t step = (plane.points_c.size() + max_points - 1) / max_points;
  for (std::size_t k = 0; k < plane.points_c.size(); k += std::max<std::size_t>(step, 1)) {
    const Eigen::Vector3f p = plane.points_c[k].cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  if (cloud->size() < kMinPoints) return std::nullopt;
  SilencePcl();
  const bool random_seed = false;
  const auto model =
      pcl::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(cloud, random_seed);

  // The bound is along the ray; the distance that PCL measures is along the normal.
  const Candidate segment = SeenFrom(plane.pi_c, plane.centroid_c, noise);
  const double x = plane.centroid_c.x() / plane.centroid_c.z();
  const double y = plane.centroid_c.y() / plane.centroid_c.z();
  const double cosine = segment.plane.Cosine(x, y) * std::sqrt(x * x + y * y + 1.0);
  const double bound = config.max_inlier_sigmas * noise.Sigma(plane.centroid_c.z()) *
                       segment.grazing * std::max(cosine, kMinCosine);
  pcl::MEstimatorSampleConsensus<pcl::PointXYZ> msac(model, bound);
  msac.setMaxIterations(config.max_iterations);
  if (!msac.computeModel()) return std::nullopt;

  // MSAC's plane, fitted again to its inliers.
  Eigen::VectorXf coefficients;
  pcl::Indices inliers;
  msac.getModelCoefficients(coefficients);
  msac.getInliers(inliers);
  Eigen::VectorXf refined = coefficients;
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  const Eigen::Vector4d p = refined.head<4>().cast<double>();
  const double norm = p.head<3>().norm();
  if (!(norm > 0)) return std::nullopt;
  const Plane out = FacingOrigin({p.head<3>() / norm, p.w() / norm});
  return out.d > 0 ? std::optional<Plane>(out) : std::nullopt;
}

/// Weighted least squares on the points near `start`; nothing when they lie on a line.
std::optional<Plane> WeightedPlane(const FramePlane& plane, const Plane& start,
                                   const DepthNoise& noise, double max_sigmas) {
  const Candidate candidate = SeenFrom(start, plane.centroid_c, noise);
  PlaneSums sums;
  for (const Eigen::Vector3d& x_c : plane.points_c) {
    if (!(DistanceSigmas(candidate.plane, candidate.grazing, x_c, noise) < max_sigmas))
      continue;
    const double z = x_c.z(), g = z * z / noise.Sigma(z);
    sums.Add(x_c.x() / z, x_c.y() / z, 1.0 / z, g * g);
  }
  const std::optional<PlaneFit> fit = Fit(sums);
  return fit ? std::optional<Plane>(fit->plane.Hessian()) : std::nullopt;
}

Plane ChoosePlane(const FramePlane& plane, const DepthNoise& noise, const RefitConfig& config) {
  const std::optional<Plane> robust = RobustPlane(plane, noise, config);
  if (!robust) return plane.pi_c;
  if (config.method == RefitMethod::kPcl) return *robust;
  Plane weighted =
      WeightedPlane(plane, *robust, noise, config.max_inlier_sigmas).value_or(*robust);
  if (config.method == RefitMethod::kWeighted) return weighted;
  const auto error = [&](const Plane& pi_c) {
    return TruncatedError(plane.points_c, SeenFrom(pi_c, plane.centroid_c, noise), noise,
                          config.max_inlier_sigmas);
  };
  return error(weighted) + config.min_improvement_chi2 < error(plane.pi_c) ? weighted
                                                                           : plane.pi_c;
}

}  // namespace

void RefitPlane(FramePlane& plane, const SensorModel& sensor, const RefitConfig& config) {
  const DepthNoise& noise = sensor.noise;
  if (plane.points_c.size() < kMinPoints) {
    plane.inlier_ratio = 0.0;
    return;
  }
  plane.pi_c = ChoosePlane(plane, noise, config);
  plane.centroid_c = ProjectOnto(plane.pi_c, plane.centroid_c);

  // Points off the plane go.
  const Candidate now = SeenFrom(plane.pi_c, plane.centroid_c, noise);
  const auto off = [&](const Eigen::Vector3d& x_c, double max_sigmas) {
    return !(DistanceSigmas(now.plane, now.grazing, x_c, noise) < max_sigmas);
  };
  // How flat it is: a sensor that bends makes flat things uneven by as much.
  const auto flat = [&](const Eigen::Vector3d& x_c) {
    const double sigma_m = noise.Sigma(x_c.z()) * now.grazing;
    const double allowed = std::hypot(1.0, sensor.bend_ratio * x_c.z() / sigma_m);
    return !off(x_c, config.max_inlier_sigmas * allowed);
  };
  plane.inlier_ratio =
      static_cast<double>(std::count_if(plane.points_c.begin(), plane.points_c.end(), flat)) /
      static_cast<double>(plane.points_c.size());
  std::erase_if(plane.points_c,
                [&](const Eigen::Vector3d& x_c) { return off(x_c, config.max_inlier_sigmas); });

  // Edge points off the plane go too; the others move along their rays onto it.
  std::erase_if(plane.edge_points,
                [&](const EdgePoint& e) { return off(e.p_c, config.max_edge_sigmas); });
  plane.box_px = {};
  for (EdgePoint& e : plane.edge_points) {
    const double x = e.p_c.x() / e.p_c.z(), y = e.p_c.y() / e.p_c.z();
    e.p_c = Eigen::Vector3d(x, y, 1.0) / now.plane.InverseDepth(x, y);
    plane.box_px.Include(e.u_px);
  }
}

}  // namespace slam
