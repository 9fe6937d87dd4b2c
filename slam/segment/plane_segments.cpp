#include "slam/segment/plane_segments.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "slam/base/index.h"
#include "slam/segment/ahc.h"
#include "slam/segment/clusters/block_clusters.h"
#include "slam/segment/describe_segments.h"
#include "slam/segment/growth/pixel_growth.h"
#include "slam/segment/joining/local_planes.h"
#include "slam/segment/joining/surface_joining.h"
#include "slam/segment/measured_segments.h"
#include "slam/segment/occluded_parts.h"

namespace slam {
namespace {

/// Writes the label image (position in `kept` + 1) and the bounds of each segment.
void DrawLabels(const PartSegments& segments, std::vector<Segment>& kept, cv::Mat1b& out) {
  std::vector<std::uint8_t> value(segments.sums.size());
  for (std::size_t k = 0; k < kept.size(); ++k)
    value[Index(kept[k].id)] = static_cast<std::uint8_t>(k + 1);
  for (int v = 0; v < out.rows; ++v) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = segments.runs.rows[row]; k < segments.runs.rows[row + 1]; ++k) {
      const auto [begin, end, label] = segments.runs.runs[k];
      const std::uint8_t drawn = label == kNoLabel ? std::uint8_t{0} : value[Index(label)];
      std::fill(out[v] + begin, out[v] + end, drawn);
      if (drawn != 0) kept[Index(drawn - 1)].bounds |= cv::Rect(begin, v, end - begin, 1);
    }
  }
}

JoinedLabels Apart(const std::vector<PlaneSums>& sums) {
  JoinedLabels apart{std::vector<int>(sums.size()), sums,
                     std::vector<std::uint8_t>(sums.size())};
  std::iota(apart.into.begin(), apart.into.end(), 0);
  return apart;
}

}  // namespace

/// What the extractor works with from frame to frame.
struct PlaneExtractor::Workspace {
  SensorModel sensor;
  PlaneExtractionConfig config;
  PlaneExtractionConfig here;  ///< the same, with what the sensor is seen to bend in the frame
  DepthGrid grid;
  BlockClustering clustering;
  ImageBlocks blocks;
  PixelGrowth growth;
  std::vector<PlaneSums> block_sums;  ///< sums of the measured pixels of each block
  PartsOnBlocks block_parts;
  LabelImage labels;
  LabelRuns runs;
  std::vector<Surface> surfaces;  ///< one a label

  void AddClusters(const BlockClusters& clusters, const JoinedLabels& joined);
  JoinedLabels JoinClusters(const BlockClusters& clusters);
  void JoinTouching();
  PartSegments SegmentBySteps();
  PartSegments SegmentAsPeac() const;
};

PlaneExtractor::PlaneExtractor(const cv::Mat2d& rays, const SensorModel& sensor,
                               const PlaneExtractionConfig& config)
    : work_(std::make_unique<Workspace>()) {
  work_->sensor = sensor;
  work_->config = config;
  SetRays(rays, work_->grid);
}
PlaneExtractor::PlaneExtractor(PlaneExtractor&&) noexcept = default;
PlaneExtractor& PlaneExtractor::operator=(PlaneExtractor&&) noexcept = default;
PlaneExtractor::~PlaneExtractor() = default;

/// Grows the planes of clusters from their blocks, and drops the useless ones.
/// @param joined  which of them are one surface, by block_parts
void PlaneExtractor::Workspace::AddClusters(const BlockClusters& clusters,
                                            const JoinedLabels& joined) {
  const int first = static_cast<int>(growth.planes().size());
  for (std::size_t r = 0; r < clusters.planes.size(); ++r) {
    const bool is_part = joined.into[r] != static_cast<int>(r);
    const LabelPlane plane =
        FitLabelPlane(is_part ? clusters.sums[r] : joined.sums[r], sensor.noise)
            .value_or(LabelPlane{clusters.planes[r]});
    std::vector<LabelPlane> local;
    if (!is_part && joined.bent[r] != 0)
      local = FitLocally(block_parts, joined.into, static_cast<int>(r), plane, sensor.noise,
                         here.joining);
    growth.AddPlane(plane, local);
  }

  const int split = kBlock_px / clusters.block_px;
  for (int block = 0; block < clusters.cols * clusters.rows; ++block) {
    const int region = clusters.region[Index(block)];
    if (region < 0) continue;
    const int c = block % clusters.cols / split, r = block / clusters.cols / split;
    growth.Seed(r * blocks.cols + c, first + joined.into[Index(region)]);
  }
  growth.Grow();
  growth.DropUseless();
}

/// Which clusters of the whole image continue each other; block_parts are theirs. What is joined
/// tells how much the sensor bends here, and with that it is joined once more.
JoinedLabels PlaneExtractor::Workspace::JoinClusters(const BlockClusters& clusters) {
  block_parts.Begin(clusters.cols, clusters.rows);
  for (std::size_t block = 0; block < clusters.region.size(); ++block) {
    block_parts.first.push_back(block_parts.parts.size());
    const int region = clusters.region[block];
    if (region >= 0) block_parts.parts.push_back({region, clusters.block_sums[block]});
  }
  block_parts.first.push_back(block_parts.parts.size());
  const auto join = [&] {
    return JoinSurfaces(block_parts, clusters.planes.size(), nullptr, {}, sensor.noise,
                        here.joining);
  };
  here.joining.bend_ratio = SeenBend(join().sums, sensor.noise, here.joining);
  return join();
}

/// Joins labels that continue each other, and grows the planes of what has become one anew.
void PlaneExtractor::Workspace::JoinTouching() {
  const std::size_t count = growth.planes().size();
  growth.SumParts(block_sums, block_parts);
  growth.DrawLabels(grid.width, grid.height, labels);
  FindRuns(labels, grid.width, grid.height, runs);
  LabelContacts contacts = CountContacts(runs, count);
  std::vector<std::uint8_t> bent(count);
  for (std::size_t k = 0; k < count; ++k) bent[k] = growth.IsLocal(static_cast<int>(k)) ? 1 : 0;
  const JoinedLabels joined =
      JoinSurfaces(block_parts, count, &contacts.shared, bent, sensor.noise, here.joining);

  std::vector<LabelPlane> planes = growth.planes();
  std::vector<std::vector<LabelPlane>> local(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (joined.into[k] != static_cast<int>(k)) continue;
    planes[k] = FitLabelPlane(joined.sums[k], sensor.noise).value_or(planes[k]);
    if (joined.bent[k] != 0)
      local[k] = FitLocally(block_parts, joined.into, static_cast<int>(k), planes[k],
                            sensor.noise, here.joining);
  }
  growth.Replace(planes, joined.into, local);

  growth.SumParts(block_sums, block_parts);
  const std::vector<PlaneSums> label_sums = SumParts(block_parts, count);
  surfaces.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const LabelPlane plane = FitLabelPlane(label_sums[k], sensor.noise).value_or(planes[k]);
    surfaces.push_back({label_sums[k], plane, joined.bent[k] != 0});
  }
  growth.DrawLabels(grid.width, grid.height, labels);
  FindRuns(labels, grid.width, grid.height, runs);
}

/// Our segmentation.
PartSegments PlaneExtractor::Workspace::SegmentBySteps() {
  const DepthNoise& noise = sensor.noise;
  here = config;

  // The planes of clusters of blocks grow over pixels; what they do not explain is clustered in
  // quarters of blocks.
  SetBlocks(grid, blocks);
  growth.Begin(blocks, config.growth);
  BlockClusters clusters =
      clustering.Cluster(blocks, blocks.measured, kBlock_px, noise, config.coarse);
  AddClusters(clusters, JoinClusters(clusters));
  block_sums = std::move(clusters.block_sums);
  const std::vector<PixelSet> unexplained =
      growth.FindUnexplained(config.coarse.model_error_sigmas,
                             config.max_block_bias_sigmas * std::sqrt(noise.correlated_px));
  const BlockClusters fine =
      clustering.Cluster(blocks, unexplained, kQuarter_px, noise, config.fine);
  AddClusters(fine, Apart(fine.sums));

  // Parts of one surface are joined, where they touch and across what hides them.
  JoinTouching();
  return SegmentParts(grid, surfaces, runs, noise, here);
}

/// The same by PEAC.
PartSegments PlaneExtractor::Workspace::SegmentAsPeac() const {
  PartSegments out;
  const LabelImage segments = SegmentByAhc(grid);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i] == kNoLabel) continue;
    const auto label = static_cast<std::size_t>(segments[i]);
    if (label >= out.sums.size()) out.sums.resize(label + 1);
    AddPixel(grid, i, out.sums[label]);
  }
  FindRuns(segments, grid.width, grid.height, out.runs);
  return out;
}

void PlaneExtractor::Extract(Frame& frame) {
  Workspace& work = *work_;
  SetDepth(frame.depth_m, work.sensor.noise, work.sensor.max_depth_m, work.grid);
  const PartSegments segments = work.config.segmentation == Segmentation::kAhc
                                    ? work.SegmentAsPeac()
                                    : work.SegmentBySteps();

  // Segments that can be measured become planes of the frame.
  std::vector<Segment> kept = KeepMeasured(segments, work.sensor, work.config);
  frame.plane_labels.create(work.grid.height, work.grid.width);
  DrawLabels(segments, kept, frame.plane_labels);
  frame.planes =
      DescribeSegments(work.grid, frame.plane_labels, kept, work.sensor.noise, work.config);
}

}  // namespace slam
