#include "slam/extract/plane_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "slam/extract/occluded_parts.h"
#include "slam/extract/patches.h"
#include "slam/extract/roughness.h"
#include "slam/extract/sensor_warp.h"

namespace slam {
namespace {

constexpr int kMostSegments = 254;  // 8-bit label image, 0 = none

void AddClusters(const DepthGrid& grid, const BlockClusters& clusters, const DepthNoise& noise,
                 PixelGrowth& growth) {
  const int first = static_cast<int>(growth.planes().size());
  for (std::size_t r = 0; r < clusters.planes.size(); ++r) {
    const InverseDepthPlane& plane = clusters.planes[r];
    growth.AddPlane({plane, GrazingFactor(clusters.sums[r], plane, noise)});
  }
  const int half = clusters.block_px / 2;
  for (int block = 0; block < clusters.cols * clusters.rows; ++block) {
    const int region = clusters.region[static_cast<std::size_t>(block)];
    if (region < 0) continue;
    const int u = std::min(block % clusters.cols * clusters.block_px + half, grid.width - 1);
    const int v = std::min(block / clusters.cols * clusters.block_px + half, grid.height - 1);
    growth.Seed(growth.BlockAt(u, v), first + region);
  }
  growth.Grow();
  growth.DropUseless();
}

/// A segment on its way into the frame.
struct Segment {
  int id = 0;  ///< in the label image
  PlaneSums sums;
  LabelPlane plane;
  PlaneSigmas sigmas;
  cv::Point low, high;  ///< first and last row and column
};

/// The segments that are large and precise enough, largest first.
void KeepMeasured(const std::vector<PlaneSums>& sums, const PlaneExtractionConfig& config,
                  std::vector<Segment>& kept) {
  kept.clear();
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (!(sums[k].n >= config.min_pixels)) continue;
    const std::optional<PlaneFit> fit = Fit(sums[k]);
    if (!fit) continue;
    const double grazing = GrazingFactor(sums[k], fit->plane, config.noise);
    const double dof = std::max(sums[k].n - 3.0, 1.0);
    const double scale = std::max(grazing, std::sqrt(fit->error / dof));
    const PlaneSigmas sigmas = Sigmas(sums[k], fit->plane, config.noise, scale);
    if (!(sigmas.angle_rad < config.max_angle_sigma_rad)) continue;
    kept.push_back({static_cast<int>(k), sums[k], {fit->plane, grazing}, sigmas, {}, {}});
  }
  std::sort(kept.begin(), kept.end(), [](const Segment& a, const Segment& b) {
    return a.sums.n != b.sums.n ? a.sums.n > b.sums.n : a.id < b.id;
  });
  if (kept.size() > kMostSegments) kept.resize(kMostSegments);
}

/// Writes the label image (position in `kept` + 1) and the bounds of each segment.
/// @param value  scratch
void DrawLabels(const LabelRuns& segments, int count, std::vector<Segment>& kept,
                std::vector<std::uint8_t>& value, cv::Mat1b& out) {
  value.assign(static_cast<std::size_t>(count), 0);
  const int none = std::numeric_limits<int>::max();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    value[static_cast<std::size_t>(kept[k].id)] = static_cast<std::uint8_t>(k + 1);
    kept[k].low = {none, none}, kept[k].high = {-1, -1};
  }
  for (int v = 0; v < out.rows; ++v) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = segments.rows[row]; k < segments.rows[row + 1]; ++k) {
      const auto [begin, end, label] = segments.runs[k];
      const std::uint8_t drawn =
          label == kNoLabel ? std::uint8_t{0} : value[static_cast<std::size_t>(label)];
      std::fill(out[v] + begin, out[v] + end, drawn);
      if (drawn == 0) continue;
      Segment& segment = kept[static_cast<std::size_t>(drawn - 1)];
      segment.low = {std::min(segment.low.x, begin), std::min(segment.low.y, v)};
      segment.high = {std::max(segment.high.x, end - 1), v};
    }
  }
}

/// Thinned points and the visible area. A pixel of dx dy on the ray plane covers
/// |(a, b, c)| / q^3 dx dy of the surface.
void SamplePoints(const DepthGrid& grid, const cv::Mat1b& labels, const Segment& segment,
                  const Camera& camera, int step, FramePlane& out) {
  const InverseDepthPlane& p = segment.plane.plane;
  const double norm = std::sqrt(p.a * p.a + p.b * p.b + p.c * p.c);
  double area = 0.0;
  int sampled = 0;
  const auto first = [step](int from) { return (from + step - 1) / step * step; };
  for (int v = first(segment.low.y); v <= segment.high.y; v += step) {
    for (int u = first(segment.low.x); u <= segment.high.x; u += step) {
      if (labels(v, u) != out.index + 1) continue;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const double x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
      const double z = 1.0 / static_cast<double>(grid.q[i]);
      out.points_c.emplace_back(x * z, y * z, z);
      const double q = p.InverseDepth(x, y);
      area += norm / (q * q * q * camera.fx * camera.fy);
      ++sampled;
    }
  }
  if (sampled > 0) out.area_m2 = area / sampled * out.pixel_count;
}

/// Some thousand pixels say how rough a segment is, to a few per cent.
int RoughnessStep(int pixels) {
  return std::clamp(static_cast<int>(std::sqrt(pixels / 1000.0)), 1, 8);
}

FramePlane MakeFramePlane(const Segment& segment, int index) {
  FramePlane out;
  out.index = index;
  out.pi_c = segment.plane.plane.Hessian();
  const Eigen::Vector3d ray(segment.sums.wx / segment.sums.w, segment.sums.wy / segment.sums.w,
                            1.0);
  out.centroid_c = ray / segment.plane.plane.InverseDepth(ray.x(), ray.y());
  out.pixel_count = static_cast<int>(segment.sums.n);
  out.offset_sigma_m = segment.sigmas.offset_m;
  out.angle_sigma_rad = segment.sigmas.angle_rad;
  out.inverse_depth_covariance = segment.sigmas.covariance;
  return out;
}

}  // namespace

struct PlaneExtractor::Workspace {
  Camera camera;
  PlaneExtractionConfig config;
  DepthGrid grid;
  BlockClustering clustering;
  WarpMeasurement warp;
  PixelGrowth growth;
  std::vector<std::uint8_t> settled;
  PatchJoining patches;
  PartSegmentation parts;
  LabelImage labels;  ///< of segments
  std::vector<PlaneSums> sums;
  std::vector<Segment> kept;
  std::vector<std::uint8_t> drawn_value;
  OuterContours contours;
  std::vector<double> areas_m2;  ///< visible, of the frame's planes
  /// Planes of the frame's last image, whose points' memory serves again.
  std::vector<FramePlane> old_planes;

  void TakeMemory(std::vector<FramePlane>& planes);
  void GiveMemory(FramePlane& plane);
  void Describe(Frame& frame);
};

/// Empties a frame's planes, but keeps the memory of their points.
void PlaneExtractor::Workspace::TakeMemory(std::vector<FramePlane>& planes) {
  if (old_planes.size() < planes.size()) old_planes.resize(planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    old_planes[k].points_c.swap(planes[k].points_c);
    old_planes[k].edge_points.swap(planes[k].edge_points);
  }
  planes.clear();
}

void PlaneExtractor::Workspace::GiveMemory(FramePlane& plane) {
  const auto k = static_cast<std::size_t>(plane.index);
  if (k >= old_planes.size()) return;
  plane.points_c.swap(old_planes[k].points_c);
  plane.edge_points.swap(old_planes[k].edge_points);
  plane.points_c.clear(), plane.edge_points.clear();
}

/// Fills the frame's planes from the segments that are kept and its label image.
void PlaneExtractor::Workspace::Describe(Frame& frame) {
  contours.Trace(frame.plane_labels);
  TakeMemory(frame.planes);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    FramePlane plane = MakeFramePlane(kept[k], static_cast<int>(k));
    GiveMemory(plane);
    SamplePoints(grid, frame.plane_labels, kept[k], camera, config.point_grid_px, plane);
    plane.roughness = MeasureRoughness(
        grid, frame.plane_labels, cv::Rect(kept[k].low, kept[k].high + cv::Point(1, 1)),
        static_cast<std::uint8_t>(plane.index + 1), kept[k].plane.plane, config.noise,
        RoughnessStep(plane.pixel_count));
    frame.planes.push_back(std::move(plane));
  }
  areas_m2.clear();
  for (const FramePlane& plane : frame.planes) areas_m2.push_back(plane.area_m2);
  for (FramePlane& plane : frame.planes) {
    FindEdgePoints(grid, contours, plane.index + 1,
                   kept[static_cast<std::size_t>(plane.index)].plane, areas_m2, config.edges,
                   plane.edge_points);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
  }
}

PlaneExtractor::PlaneExtractor(const Camera& camera, const cv::Mat2d& rays,
                               const PlaneExtractionConfig& config)
    : work_(std::make_unique<Workspace>()) {
  work_->config = config;
  Use(camera, rays);
}
PlaneExtractor::PlaneExtractor(PlaneExtractor&&) noexcept = default;
PlaneExtractor& PlaneExtractor::operator=(PlaneExtractor&&) noexcept = default;
PlaneExtractor::~PlaneExtractor() = default;

void PlaneExtractor::Use(const Camera& camera, const cv::Mat2d& rays) {
  work_->camera = camera;
  SetRays(rays, work_->grid);
}

void PlaneExtractor::Extract(Frame& frame) {
  const PlaneExtractionConfig& settings = work_->config;
  DepthGrid& grid = work_->grid;
  PixelGrowth& growth = work_->growth;
  SetDepth(frame.depth_m, settings.noise, settings.max_depth_m, grid);
  const BlockClusters& clusters =
      work_->clustering.Cluster(grid, {}, settings.block_px, settings.noise, settings.coarse);
  const double warp = work_->warp.Measure(clusters, work_->clustering.SumsOfBlocks(), settings);
  const PlaneExtractionConfig config = AllowWarp(settings, warp);
  if (warp > 0.0)
    work_->clustering.Cluster(grid, {}, config.block_px, config.noise, config.coarse);
  growth.Begin(grid, config.growth);
  AddClusters(grid, clusters, config.noise, growth);
  growth.MarkSettled(config.coarse.model_error_sigmas,
                     config.max_block_bias_sigmas * std::sqrt(config.noise.correlated_px),
                     work_->settled);
  AddClusters(grid,
              work_->clustering.Cluster(grid, work_->settled, config.fine_block_px,
                                        config.noise, config.fine),
              config.noise, growth);
  const std::vector<PlaneSums> unknown;
  const std::vector<PlaneSums>& blocks =
      config.block_px == config.growth.block_px ? work_->clustering.SumsOfBlocks() : unknown;
  PatchJoining& patches = work_->patches;
  patches.MergeEqualNeighbours(grid, blocks, config, growth);
  const PatchUnion& joined = patches.JoinBentParts(grid, blocks, config, growth, warp > 0.0);
  const LabelRuns& segments = work_->parts.Segment(grid, joined, patches.runs(), config);
  DrawRuns(segments, work_->labels);
  const int count = work_->parts.segment_count();
  growth.SumOtherLabels(work_->labels, count, work_->sums);
  KeepMeasured(work_->sums, config, work_->kept);
  frame.plane_labels.create(grid.height, grid.width);
  DrawLabels(segments, count, work_->kept, work_->drawn_value, frame.plane_labels);
  work_->Describe(frame);
}

void ExtractPlanes(Frame& frame, const Camera& camera, const cv::Mat2d& rays,
                   const PlaneExtractionConfig& config) {
  PlaneExtractor(camera, rays, config).Extract(frame);
}

}  // namespace slam
