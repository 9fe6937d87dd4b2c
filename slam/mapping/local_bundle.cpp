#include "slam/mapping/local_bundle.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "slam/mapping/bundle_terms.h"
#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"

namespace slam {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

/// What takes part, in the order of ids: it fixes the order of the solver's sums. Blocks of one
/// kind stand side by side, because the solver orders them by address.
struct Window {
  std::vector<int> keyframes;  ///< free ones, then fixed ones
  std::size_t free_count = 0;
  std::vector<int> points;
  std::vector<PoseBlock> poses;                  ///< parallel to keyframes
  std::vector<std::array<double, 3>> positions;  ///< parallel to points

  struct Observation {
    int keyframe, point, feature;      ///< ids
    std::size_t pose_at, position_at;  ///< into the blocks
    bool inlier = true;
  };
  std::vector<Observation> observations;
};

std::vector<int> PointsOf(const Map& map, const std::vector<int>& keyframes) {
  std::vector<int> points;
  for (const int keyframe : keyframes) {
    for (const int point : map.keyframes[Index(keyframe)].map_points) {
      if (point != kNone) points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Keyframes outside that see the most of the points, at most `count` of them, ascending.
std::vector<int> Witnesses(const Map& map, const std::vector<int>& points,
                           const std::set<int>& inside, int count) {
  std::map<int, int> seen;
  for (const int point : points) {
    for (const auto& [keyframe, feature] : map.points[Index(point)].observations) {
      if (inside.count(keyframe) == 0) ++seen[keyframe];
    }
  }
  std::vector<int> witnesses;
  for (const auto& [keyframe, shared] : seen) witnesses.push_back(keyframe);
  std::stable_sort(witnesses.begin(), witnesses.end(),
                   [&](int a, int b) { return seen.at(a) > seen.at(b); });
  if (witnesses.size() > Index(count)) witnesses.resize(Index(count));
  std::sort(witnesses.begin(), witnesses.end());
  return witnesses;
}

/// Blocks and observations of the window's keyframes and points.
void FillWindow(const Map& map, Window& window) {
  std::map<int, std::size_t> pose_at;
  for (const int id : window.keyframes) {
    pose_at[id] = window.poses.size();
    window.poses.push_back(BlockOf(map.keyframes[Index(id)].T_cw));
  }
  for (const int id : window.points) {
    const MapPoint& point = map.points[Index(id)];
    for (const auto& [seen_by, feature] : point.observations) {
      const auto at = pose_at.find(seen_by);
      if (at == pose_at.end()) continue;
      window.observations.push_back(
          {seen_by, id, feature, at->second, window.positions.size()});
    }
    window.positions.push_back({point.p_w.x(), point.p_w.y(), point.p_w.z()});
  }
}

/// Everything: all keyframes but the first are free.
Window MakeFullWindow(const Map& map) {
  Window window;
  for (const Keyframe& keyframe : map.keyframes) {
    if (!keyframe.culled && keyframe.id != 0) window.keyframes.push_back(keyframe.id);
  }
  window.free_count = window.keyframes.size();
  window.keyframes.push_back(0);
  window.points = PointsOf(map, window.keyframes);
  FillWindow(map, window);
  return window;
}

Window MakeWindow(const Map& map, int keyframe, const LocalBundleConfig& config) {
  std::vector<int> inside = BestCovisible(map, keyframe, config.max_keyframes - 1);
  inside.push_back(keyframe);
  std::sort(inside.begin(), inside.end());

  Window window;
  window.points = PointsOf(map, inside);
  std::vector<int> fixed =
      Witnesses(map, window.points, {inside.begin(), inside.end()}, config.max_fixed_keyframes);
  // The first keyframe is the world; without any witness the oldest holds the gauge.
  if (inside.front() == 0 || fixed.empty()) {
    fixed.push_back(inside.front());
    inside.erase(inside.begin());
  }
  window.free_count = inside.size();
  window.keyframes = inside;
  window.keyframes.insert(window.keyframes.end(), fixed.begin(), fixed.end());
  FillWindow(map, window);
  return window;
}

class Solver {
 public:
  Solver(const Map& map, Window& window, const Camera& camera, const LocalBundleConfig& config)
      : map_(map), window_(window), config_(config) {
    for (const Window::Observation& observation : window.observations) {
      const PointFeature& feature = FeatureOf(observation);
      terms_.push_back(std::make_unique<BundleTerm>(feature, camera, config.bf_px_m,
                                                    config.scales.Scale(feature.octave),
                                                    config.depth_sigma_px));
    }
  }

  ceres::Solver::Summary Solve(bool robust, int iterations) {
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    ceres::HuberLoss stereo(std::sqrt(config_.stereo_chi2)), mono(std::sqrt(config_.mono_chi2));
    PoseManifold manifold;
    for (std::size_t i = 0; i < window_.poses.size(); ++i) {
      problem.AddParameterBlock(window_.poses[i].data(), 7, &manifold);
      if (i >= window_.free_count) problem.SetParameterBlockConstant(window_.poses[i].data());
    }
    ceres::ParameterBlockOrdering* order = new ceres::ParameterBlockOrdering;
    for (auto& position : window_.positions) {
      problem.AddParameterBlock(position.data(), 3);
      order->AddElementToGroup(position.data(), 0);
    }
    for (PoseBlock& pose : window_.poses) order->AddElementToGroup(pose.data(), 1);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Window::Observation& o = window_.observations[i];
      if (!o.inlier) continue;
      ceres::LossFunction* loss = FeatureOf(o).depth_m > 0 ? &stereo : &mono;
      problem.AddResidualBlock(terms_[i].get(), robust ? loss : nullptr,
                               window_.poses[o.pose_at].data(),
                               window_.positions[o.position_at].data());
    }
    ceres::Solver::Options options;
    constexpr std::size_t kDense = 50;  // poses; beyond, most pairs share no point
    options.linear_solver_type =
        window_.free_count > kDense ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
    options.linear_solver_ordering.reset(order);
    options.num_threads = 1;
    options.max_num_iterations = iterations;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary;
  }

  /// Observations of points behind their camera have no derivative to follow.
  void LeaveOutThoseBehind() {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      window_.observations[i].inlier = Residual(i).x() < BundleTerm::kBehind;
    }
  }

  /// Observations beyond the chi-square of their kind are no inliers any more.
  void Classify() {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      Window::Observation& o = window_.observations[i];
      const double gate = FeatureOf(o).depth_m > 0 ? config_.stereo_chi2 : config_.mono_chi2;
      o.inlier = Residual(i).squaredNorm() <= gate;
    }
  }

 private:
  const PointFeature& FeatureOf(const Window::Observation& o) const {
    return map_.keyframes[Index(o.keyframe)].features[Index(o.feature)];
  }

  Eigen::Vector3d Residual(std::size_t i) const {
    const Window::Observation& o = window_.observations[i];
    const double* blocks[] = {window_.poses[o.pose_at].data(),
                              window_.positions[o.position_at].data()};
    Eigen::Vector3d residual;
    terms_[i]->Evaluate(blocks, residual.data(), nullptr);
    return residual;
  }

  const Map& map_;
  Window& window_;
  const LocalBundleConfig& config_;
  std::vector<std::unique_ptr<BundleTerm>> terms_;
};

bool AllFinite(const Window& window) {
  const auto finite = [](const auto& block) {
    return std::all_of(block.begin(), block.end(), [](double x) { return std::isfinite(x); });
  };
  return std::all_of(window.poses.begin(), window.poses.end(), finite) &&
         std::all_of(window.positions.begin(), window.positions.end(), finite);
}

void WriteBack(const Window& window, const ScalePyramid& scales, Map& map) {
  for (std::size_t i = 0; i < window.free_count; ++i) {
    map.keyframes[Index(window.keyframes[i])].T_cw = PoseOf(window.poses[i].data());
  }
  for (std::size_t i = 0; i < window.points.size(); ++i) {
    const auto& p = window.positions[i];
    map.points[Index(window.points[i])].p_w = {p[0], p[1], p[2]};
  }
  for (const Window::Observation& o : window.observations) {
    if (!o.inlier) RemoveObservation(map, o.point, o.keyframe);
  }
  for (const int id : window.points) UpdatePoint(map, id, scales);
}

/// Two rounds: robust, then plain without the outliers.
LocalBundleReport Adjust(Map& map, Window& window, const Camera& camera,
                         const LocalBundleConfig& config) {
  LocalBundleReport report;
  report.keyframes = static_cast<int>(window.free_count);
  report.fixed_keyframes = static_cast<int>(window.keyframes.size() - window.free_count);
  report.points = static_cast<int>(window.points.size());
  report.observations = static_cast<int>(window.observations.size());
  if (window.free_count == 0 || window.observations.empty()) return report;

  Solver solver(map, window, camera, config);
  solver.LeaveOutThoseBehind();
  const ceres::Solver::Summary first = solver.Solve(true, config.first_iterations);
  solver.Classify();
  const ceres::Solver::Summary last = solver.Solve(false, config.last_iterations);
  solver.Classify();
  report.initial_cost = first.initial_cost;
  report.final_cost = last.final_cost;
  report.usable = first.IsSolutionUsable() && last.IsSolutionUsable() && AllFinite(window);
  if (!report.usable) return report;
  report.outliers =
      static_cast<int>(std::count_if(window.observations.begin(), window.observations.end(),
                                     [](const Window::Observation& o) { return !o.inlier; }));
  WriteBack(window, config.scales, map);
  return report;
}

}  // namespace

LocalBundleReport AdjustLocalBundle(Map& map, int keyframe, const Camera& camera,
                                    const LocalBundleConfig& config) {
  Window window = MakeWindow(map, keyframe, config);
  return Adjust(map, window, camera, config);
}

LocalBundleReport AdjustFullBundle(Map& map, const Camera& camera,
                                   const LocalBundleConfig& config, int iterations) {
  if (map.keyframes.empty()) return {};
  Window window = MakeFullWindow(map);
  LocalBundleConfig rounds = config;
  rounds.first_iterations = rounds.last_iterations = iterations;
  return Adjust(map, window, camera, rounds);
}

}  // namespace slam
