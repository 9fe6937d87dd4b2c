#include "slam/segment/plane_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "slam/segment/ahc.h"
#include "slam/segment/joining/local_planes.h"
#include "slam/segment/joining/surface_joining.h"
#include "slam/segment/plane_workspace.h"

namespace slam {
namespace {

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
  work_->camera = camera;
  SetRays(rays, work_->grid);
}
PlaneExtractor::PlaneExtractor(PlaneExtractor&&) noexcept = default;
PlaneExtractor& PlaneExtractor::operator=(PlaneExtractor&&) noexcept = default;
PlaneExtractor::~PlaneExtractor() = default;

/// Grows the planes of clusters from the middles of their blocks, and drops the useless ones.
/// @param joined  which of them are one surface, by block_parts; null: none
void PlaneExtractor::Workspace::AddClusters(const BlockClusters& clusters,
                                            const JoinedLabels* joined) {
  const int first = static_cast<int>(growth.planes().size());
  for (std::size_t r = 0; r < clusters.planes.size(); ++r) {
    const bool is_part = joined != nullptr && joined->into[r] != static_cast<int>(r);
    const PlaneSums& own = joined != nullptr && !is_part ? joined->sums[r] : clusters.sums[r];
    const std::optional<PlaneFit> fit = Fit(own);
    const InverseDepthPlane plane = fit ? fit->plane : clusters.planes[r];
    const LabelPlane label_plane{plane, GrazingFactor(own, plane, sensor.noise)};
    std::vector<LabelPlane> local;
    if (joined != nullptr && !is_part && joined->bent[r] != 0)
      local = FitLocally(block_parts, joined->into, static_cast<int>(r), label_plane,
                         sensor.noise, here.joining);
    growth.AddPlane(label_plane, local);
  }

  const int half = clusters.block_px / 2;
  for (int block = 0; block < clusters.cols * clusters.rows; ++block) {
    int region = clusters.region[static_cast<std::size_t>(block)];
    if (region < 0) continue;
    if (joined != nullptr) region = joined->into[static_cast<std::size_t>(region)];
    const int u = std::min(block % clusters.cols * clusters.block_px + half, grid.width - 1);
    const int v = std::min(block / clusters.cols * clusters.block_px + half, grid.height - 1);
    growth.Seed(growth.BlockAt(u, v), first + region);
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

/// How many pixels of one label touch another, for every two.
ContactPixels PlaneExtractor::Workspace::CountContacts(std::size_t label_count) const {
  ContactPixels contacts;
  contacts.Clear(static_cast<int>(label_count));
  VisitBoundaryPieces(runs, [&](std::size_t, std::size_t, int n, std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax(runs.runs[a].label, runs.runs[b].label);
    if (low != kNoLabel) contacts.Of(low, high) += 2 * n;
  });
  return contacts;
}

/// Joins labels that continue each other, and grows the planes of what has become one anew.
void PlaneExtractor::Workspace::JoinTouching() {
  const std::size_t count = growth.planes().size();
  growth.SumParts(block_sums, block_parts);
  growth.DrawLabels(grid.width, grid.height, labels);
  FindRuns(labels, grid.width, grid.height, runs);
  ContactPixels contacts = CountContacts(count);
  std::vector<std::uint8_t> bent(count);
  for (std::size_t k = 0; k < count; ++k) bent[k] = growth.IsLocal(static_cast<int>(k)) ? 1 : 0;
  const JoinedLabels joined =
      JoinSurfaces(block_parts, count, &contacts, bent, sensor.noise, here.joining);

  std::vector<LabelPlane> planes = growth.planes();
  std::vector<std::vector<LabelPlane>> local(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (joined.into[k] != static_cast<int>(k)) continue;
    if (const auto fit = Fit(joined.sums[k]))
      planes[k] = {fit->plane, GrazingFactor(joined.sums[k], fit->plane, sensor.noise)};
    if (joined.bent[k] != 0)
      local[k] = FitLocally(block_parts, joined.into, static_cast<int>(k), planes[k],
                            sensor.noise, here.joining);
  }
  growth.Replace(planes, joined.into, local);

  growth.SumParts(block_sums, block_parts);
  const std::vector<PlaneSums> label_sums = SumParts(block_parts, count);
  surfaces.clear();
  for (std::size_t k = 0; k < count; ++k) {
    Surface surface{label_sums[k], planes[k], joined.bent[k] != 0};
    if (const auto fit = Fit(surface.sums))
      surface.plane = {fit->plane, GrazingFactor(surface.sums, fit->plane, sensor.noise)};
    surfaces.push_back(surface);
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
  const JoinedLabels joined = JoinClusters(clusters);
  AddClusters(clusters, &joined);
  block_sums = std::move(clusters.block_sums);
  const std::vector<PixelSet> unexplained =
      growth.FindUnexplained(config.coarse.model_error_sigmas,
                             config.max_block_bias_sigmas * std::sqrt(noise.correlated_px));
  AddClusters(clustering.Cluster(blocks, unexplained, kQuarter_px, noise, config.fine),
              nullptr);

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
  work.kept = KeepMeasured(segments, work.sensor, work.config);
  frame.plane_labels.create(work.grid.height, work.grid.width);
  DrawLabels(segments.runs, static_cast<int>(segments.sums.size()), work.kept, work.drawn_value,
             frame.plane_labels);
  work.Describe(frame);
}

}  // namespace slam
