#include "slam/segment/plane_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/segment/plane_workspace.h"

namespace slam {
namespace {

/// Grows the planes of clusters from the middles of their blocks, and drops the useless ones.
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

}  // namespace

PlaneExtractor::PlaneExtractor(const Camera& camera, const cv::Mat2d& rays,
                               const SensorModel& sensor, const PlaneExtractionConfig& config)
    : work_(std::make_unique<Workspace>()) {
  work_->sensor = sensor;
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
  const DepthNoise& noise = work_->sensor.noise;
  DepthGrid& grid = work_->grid;
  PixelGrowth& growth = work_->growth;
  SetDepth(frame.depth_m, noise, work_->sensor.max_depth_m, grid);

  // Planar blocks grouped into planes, again with wider bounds where the sensor bends them.
  const BlockClusters& clusters =
      work_->clustering.Cluster(grid, {}, settings.block_px, noise, settings.coarse);
  const double warp =
      work_->warp.Measure(clusters, work_->clustering.SumsOfBlocks(), noise, settings);
  const PlaneExtractionConfig config = AllowWarp(settings, warp);
  if (warp > 0.0) work_->clustering.MergeAgain(config.coarse);

  // The planes grow over pixels; what they do not explain is clustered in finer blocks.
  growth.Begin(grid, config.growth);
  AddClusters(grid, clusters, noise, growth);
  growth.MarkExplained(config.coarse.model_error_sigmas,
                       config.max_block_bias_sigmas * std::sqrt(noise.correlated_px),
                       work_->explained);
  AddClusters(grid,
              work_->clustering.Cluster(grid, work_->explained, config.fine_block_px, noise,
                                        config.fine),
              noise, growth);

  // Parts of one plane are joined, where they touch and across what hides them.
  const std::vector<PlaneSums> unknown;
  const std::vector<PlaneSums>& blocks =
      config.block_px == config.growth.block_px ? work_->clustering.SumsOfBlocks() : unknown;
  PatchJoining& patches = work_->patches;
  patches.MergeEqualNeighbours(grid, blocks, noise, config, growth);
  const PatchUnion& joined =
      patches.JoinBentParts(grid, blocks, noise, config, growth, warp > 0.0);
  const LabelRuns& segments = work_->parts.Segment(grid, joined, patches.runs(), noise, config);

  // Segments that can be measured become planes of the frame.
  work_->parts.SumSegments(grid, joined, work_->sums);
  KeepMeasured(work_->sums, noise, config, work_->kept);
  frame.plane_labels.create(grid.height, grid.width);
  DrawLabels(segments, static_cast<int>(work_->sums.size()), work_->kept, work_->drawn_value,
             frame.plane_labels);
  work_->Describe(frame);
}

}  // namespace slam
