#include "slam/extract/plane_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "slam/extract/box_split.h"
#include "slam/extract/measured_segments.h"
#include "slam/extract/occluded_parts.h"
#include "slam/extract/patches.h"
#include "slam/extract/roughness.h"
#include "slam/extract/sensor_warp.h"

namespace slam {
namespace {

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

/// Some two thousand pixels say how rough a segment is.
int RoughnessStep(int pixels) {
  return std::clamp(static_cast<int>(std::sqrt(pixels / 2000.0)), 1, 6);
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

/// Places of the boxes that may hold thin things, the smallest first whatever their order.
void SortBoxes(const std::vector<Detection>& detections, double min_score,
               std::vector<Box>& boxes_px) {
  boxes_px.clear();
  for (const Detection& detection : detections) {
    if (detection.kind == ClassKind::kRegular && detection.score > min_score)
      boxes_px.push_back(detection.box_px);
  }
  const auto rank = [](const Box& b) {
    return std::array<double, 4>{b.area(), b.min.y(), b.min.x(), b.max.x()};
  };
  std::sort(boxes_px.begin(), boxes_px.end(),
            [&](const Box& a, const Box& b) { return rank(a) < rank(b); });
}

constexpr double kFull = 0.7;  // of a box, by what belongs to it: nothing is missing

bool LiesIn(const Box& segment_px, const Box& box_px) {
  constexpr double kInBox = 0.8;
  return Intersection(segment_px, box_px).area() > kInBox * segment_px.area();
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
  BoxSplit box_split;
  std::vector<Box> boxes_px;              ///< of detections that may hold thin things
  std::vector<std::size_t> own_segments;  ///< that lie in a box
  /// Planes of the frame's last image, whose points' memory serves again.
  std::vector<FramePlane> old_planes;

  void TakeMemory(std::vector<FramePlane>& planes);
  void GiveMemory(FramePlane& plane);
  void Describe(Frame& frame);
  bool SplitInBox(const Box& box_px, Frame& frame);
  bool TakeRegion(std::size_t host, cv::Mat1b& drawn);
  void Renumber(cv::Mat1b& drawn);
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
    FindEdgePoints(grid, contours, plane.index + 1, kept[k].plane, config.edges,
                   plane.edge_points);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
    frame.planes.push_back(std::move(plane));
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

/// Gives the region that was found in a segment to one of the box's own that it agrees with, or
/// makes it a new one, if what it is and what is left can be measured.
bool PlaneExtractor::Workspace::TakeRegion(std::size_t host, cv::Mat1b& drawn) {
  PlaneSums region;
  for (const int i : box_split.pixels()) {
    const auto k = static_cast<std::size_t>(i);
    const double g = static_cast<double>(grid.g[k]);
    region.Add(static_cast<double>(grid.x[k]), static_cast<double>(grid.y[k]),
               static_cast<double>(grid.q[k]), g * g);
  }
  const std::optional<Segment> rest =
      Measure(Without(kept[host].sums, region), kept[host].id, config);
  const std::optional<Segment> top = Measure(region, 0, config);
  if (!rest || !top) return false;
  std::size_t into = kept.size();
  double least_gap = 1.0;
  for (const std::size_t own : own_segments) {
    const double gap = PatchGap({kept[own].sums, kept[own].plane}, {region, top->plane},
                                config.max_merge_gap_sigmas, config);
    if (gap < least_gap) least_gap = gap, into = own;
  }
  const cv::Point low = box_split.bounds().tl();
  const cv::Point high = box_split.bounds().br() - cv::Point(1, 1);
  if (into == kept.size()) {
    if (kept.size() == static_cast<std::size_t>(kMostSegments)) return false;
    kept.push_back(*top);
    kept[into].low = low, kept[into].high = high;
  } else {
    Extend(region, low, high, config, kept[into]);
  }
  kept[host].sums = rest->sums, kept[host].plane = rest->plane;
  kept[host].sigmas = rest->sigmas;
  for (const int i : box_split.pixels())
    drawn(i / grid.width, i % grid.width) = static_cast<std::uint8_t>(into + 1);
  return true;
}

bool PlaneExtractor::Workspace::SplitInBox(const Box& box_px, Frame& frame) {
  Box own_px;
  own_segments.clear();
  for (std::size_t k = 0; k < frame.planes.size(); ++k) {
    const Box& bounds_px = frame.planes[k].box_px;
    if (!LiesIn(bounds_px, box_px)) continue;
    own_segments.push_back(k);
    own_px.Include(bounds_px.min), own_px.Include(bounds_px.max);
  }
  const std::array<int, 256> pixels = CountLabels(frame.plane_labels, box_px);
  double own_pixels = 0.0;
  for (const std::size_t own : own_segments) own_pixels += pixels[own + 1];
  if (own_pixels > kFull * box_px.area()) return false;
  const double least =
      std::max(1.0 * config.min_pixels, BoxSplit::kLeastFilled * box_px.area());
  bool split = false;
  for (std::size_t k = 0; k < frame.planes.size(); ++k) {
    if (pixels[k + 1] < least || LiesIn(frame.planes[k].box_px, box_px)) continue;
    if (box_split.Find(grid, frame.plane_labels, static_cast<std::uint8_t>(k + 1),
                       kept[k].plane, box_px, own_px, config)) {
      split = TakeRegion(k, frame.plane_labels) || split;
    }
  }
  return split;
}

/// Sorts the segments by size again, and their values in the label image with them.
void PlaneExtractor::Workspace::Renumber(cv::Mat1b& drawn) {
  for (std::size_t k = 0; k < kept.size(); ++k) kept[k].id = static_cast<int>(k);
  SortBySize(kept);
  std::array<std::uint8_t, 256> value{};
  for (std::size_t k = 0; k < kept.size(); ++k)
    value[static_cast<std::size_t>(kept[k].id + 1)] = static_cast<std::uint8_t>(k + 1);
  for (int v = 0; v < drawn.rows; ++v) {
    for (int u = 0; u < drawn.cols; ++u) drawn(v, u) = value[drawn(v, u)];
  }
}

void PlaneExtractor::SplitInBoxes(Frame& frame) {
  if (!work_->config.box_split.enabled) return;
  SortBoxes(frame.detections, work_->config.box_split.min_score, work_->boxes_px);
  bool split = false;
  for (const Box& box_px : work_->boxes_px) split = work_->SplitInBox(box_px, frame) || split;
  if (!split) return;
  work_->Renumber(frame.plane_labels);
  work_->Describe(frame);
}

void ExtractPlanes(Frame& frame, const Camera& camera, const cv::Mat2d& rays,
                   const PlaneExtractionConfig& config) {
  PlaneExtractor(camera, rays, config).Extract(frame);
}

}  // namespace slam
