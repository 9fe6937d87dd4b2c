#include "slam/extract/plane_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "slam/base/require.h"
#include "slam/extract/plane_edges.h"
#include "slam/extract/plane_merge.h"
#include "slam/extract/sight_lines.h"

namespace slam {

struct PlaneWorkspace::Memory {
  DepthGrid grid;
  std::vector<PlaneSums> coarse_sums, fine_sums, segment_sums;
  ClusterScratch cluster_scratch;
  BlockClusters clusters;
  PixelGrowth growth;
  std::vector<int> labels_of_clusters;
  std::vector<std::uint8_t> settled;
  LabelImage labels;
  LabelComponents components;
  SightLines sight_lines;
};

PlaneWorkspace::PlaneWorkspace() : memory_(std::make_unique<Memory>()) {}
PlaneWorkspace::~PlaneWorkspace() = default;
PlaneWorkspace::PlaneWorkspace(PlaneWorkspace&&) noexcept = default;
PlaneWorkspace& PlaneWorkspace::operator=(PlaneWorkspace&&) noexcept = default;

namespace {

constexpr int kMostSegments = 254;  // 8-bit label image, 0 = none

/// Adds the clusters as planes, with the blocks of `layout` that they are made of, and lets
/// them grow.
void AddClusters(const BlockLayout& layout, const DepthNoise& noise,
                 PlaneWorkspace::Memory& m) {
  m.labels_of_clusters.clear();
  for (std::size_t r = 0; r < m.clusters.planes.size(); ++r) {
    const InverseDepthPlane& plane = m.clusters.planes[r];
    m.labels_of_clusters.push_back(
        m.growth.AddPlane({plane, GrazingFactor(m.clusters.sums[r], plane, noise)}));
  }
  const BlockLayout& growing = m.growth.layout();
  for (int block = 0; block < layout.Count(); ++block) {
    const int region = m.clusters.region[static_cast<std::size_t>(block)];
    if (region < 0) continue;
    const int u = (layout.Left(block) + layout.Right(block)) / 2;
    const int v = (layout.Top(block) + layout.Bottom(block)) / 2;
    m.growth.Reach(v / growing.block_px * growing.cols + u / growing.block_px,
                   m.labels_of_clusters[static_cast<std::size_t>(region)]);
  }
  m.growth.Grow();
  m.growth.Settle();
  m.growth.DropUseless();
}

/// Planes of what lies on none, in blocks of `fine_block_px`.
void AddFinePlanes(const PlaneExtractionConfig& config, PlaneWorkspace::Memory& m) {
  m.growth.MarkSettled(config.coarse.model_error_sigmas, config.max_block_bias_sigmas,
                       config.noise.correlated_px, m.settled);
  const BlockLayout layout(m.grid, config.fine_block_px);
  m.fine_sums.assign(static_cast<std::size_t>(layout.Count()), PlaneSums{});
  for (int block = 0; block < layout.Count(); ++block) {
    // Most blocks are settled: look at two corners before summing.
    m.fine_sums[static_cast<std::size_t>(block)] =
        SumBlock(m.grid, layout, block, m.settled.data());
  }
  ClusterBlocks(m.grid, layout, m.fine_sums, config.noise, config.fine, m.cluster_scratch,
                m.clusters);
  AddClusters(layout, config.noise, m);
}

/// The largest component of each label; -1 = none.
std::vector<int> LargestComponents(const LabelComponents& components, std::size_t labels) {
  std::vector<int> largest(labels, -1);
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    int& best = largest[static_cast<std::size_t>(components.list[k].label)];
    if (best < 0 ||
        components.list[k].pixels > components.list[static_cast<std::size_t>(best)].pixels) {
      best = static_cast<int>(k);
    }
  }
  return largest;
}

/// Is what separates two components of one plane in front of it? Either what surrounds the
/// smaller one is, or what lies between the two.
bool CutByOccluder(int small, int large, const LabelPlane& plane,
                   const PlaneExtractionConfig& config, const PlaneWorkspace::Memory& m) {
  const LabelComponent& c = m.components.list[static_cast<std::size_t>(small)];
  if (c.behind <= config.max_island_behind * (c.behind + c.in_front)) return true;
  return m.sight_lines.ShareBehind(m.grid, m.components, m.labels, small, large, plane) <=
         config.max_island_behind;
}

/// Labels that are one plane though nothing joins them in the image: the smaller lies on the
/// larger's extension, and what cuts it off is in front of it, so that it can pass behind. Two
/// book tops of one height have the desk between them, behind, and stay apart.
void JoinAcrossOccluders(const PlaneMerging& patches, const PlaneExtractionConfig& config,
                         PlaneWorkspace::Memory& m) {
  const auto count = static_cast<std::size_t>(patches.Count());
  const std::vector<int> largest = LargestComponents(m.components, count);
  std::vector<int> order;
  for (std::size_t k = 0; k < count; ++k) {
    const bool own = patches.Root(static_cast<int>(k)) == static_cast<int>(k);
    if (own && largest[k] >= 0 && patches.At(static_cast<int>(k)).sums.n >= 3) {
      order.push_back(static_cast<int>(k));
    }
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return patches.At(a).sums.n > patches.At(b).sums.n; });
  std::vector<int> into(count);
  std::iota(into.begin(), into.end(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto small = static_cast<std::size_t>(order[k]);
    double least = 1.0;
    for (std::size_t j = 0; j < k; ++j) {
      const int large = order[j];
      if (into[static_cast<std::size_t>(large)] != large) continue;
      const double gap = patches.PatchGap(patches.At(order[k]), patches.At(large),
                                          config.merge.max_gap_sigmas);
      if (!(gap < least)) continue;
      if (!CutByOccluder(largest[small], largest[static_cast<std::size_t>(large)],
                         patches.At(large).plane, config, m)) {
        continue;
      }
      least = gap, into[small] = large;
    }
  }
  for (LabelComponent& c : m.components.list) c.label = into[static_cast<std::size_t>(c.label)];
}

/// Which segment each connected component belongs to; -1 = none. A label's largest component
/// makes a segment; another one joins it if what separates them is in front, makes a segment of
/// its own if it is large enough, or is dropped.
std::vector<int> SegmentsOfComponents(const PlaneMerging& patches,
                                      const PlaneExtractionConfig& config,
                                      const PlaneWorkspace::Memory& m, int& segment_count) {
  const LabelComponents& components = m.components;
  const std::vector<int> main =
      LargestComponents(components, static_cast<std::size_t>(patches.Count()));
  std::vector<int> segment(components.list.size(), -1);
  segment_count = 0;
  for (const int k : main) {
    if (k >= 0) segment[static_cast<std::size_t>(k)] = segment_count++;
  }
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    const LabelComponent& c = components.list[k];
    if (segment[k] >= 0 || c.pixels < config.min_island_pixels) continue;
    const int largest = main[static_cast<std::size_t>(c.label)];
    if (CutByOccluder(static_cast<int>(k), largest, patches.At(c.label).plane, config, m)) {
      segment[k] = segment[static_cast<std::size_t>(largest)];
    } else if (c.pixels >= config.min_pixels) {
      segment[k] = segment_count++;
    }
  }
  return segment;
}

/// A segment on its way into the frame.
struct Segment {
  int id = 0;  ///< in the label image
  PlaneSums sums;
  LabelPlane plane;
  PlaneSigmas sigmas;
};

/// The segments that are large and precise enough, largest first.
std::vector<Segment> KeepMeasured(const std::vector<PlaneSums>& sums,
                                  const PlaneExtractionConfig& config) {
  std::vector<Segment> kept;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (!(sums[k].n >= config.min_pixels)) continue;
    const std::optional<PlaneFit> fit = Fit(sums[k]);
    if (!fit) continue;
    const double grazing = GrazingFactor(sums[k], fit->plane, config.noise);
    const double dof = std::max(sums[k].n - 3.0, 1.0);
    const double scale = std::max(grazing, std::sqrt(fit->error / dof));
    const PlaneSigmas sigmas = Sigmas(sums[k], fit->plane, config.noise, scale);
    if (!(sigmas.angle_rad < config.max_angle_sigma_rad)) continue;
    kept.push_back({static_cast<int>(k), sums[k], {fit->plane, grazing}, sigmas});
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Segment& a, const Segment& b) { return a.sums.n > b.sums.n; });
  if (kept.size() > kMostSegments) kept.resize(kMostSegments);
  return kept;
}

/// Writes the label image (position in `kept` + 1) and the bounds of each segment.
std::vector<cv::Rect> DrawLabels(const DepthGrid& grid, const LabelImage& labels, int count,
                                 const std::vector<Segment>& kept, cv::Mat1b& out) {
  std::vector<std::uint8_t> value(static_cast<std::size_t>(count), 0);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    value[static_cast<std::size_t>(kept[k].id)] = static_cast<std::uint8_t>(k + 1);
  }
  const int none = std::numeric_limits<int>::max();
  std::vector<cv::Vec4i> bounds(kept.size(), cv::Vec4i(none, none, -1, -1));
  out.create(grid.height, grid.width);
  for (int v = 0; v < grid.height; ++v) {
    std::uint8_t* row = out[v];
    for (int u = 0; u < grid.width; ++u) {
      const std::int32_t label = labels[static_cast<std::size_t>(grid.Index(u, v))];
      row[u] = label == kNoLabel ? std::uint8_t{0} : value[static_cast<std::size_t>(label)];
      if (row[u] == 0) continue;
      cv::Vec4i& b = bounds[static_cast<std::size_t>(row[u] - 1)];
      b = {std::min(b[0], u), std::min(b[1], v), std::max(b[2], u), std::max(b[3], v)};
    }
  }
  std::vector<cv::Rect> rects;
  for (const cv::Vec4i& b : bounds)
    rects.emplace_back(b[0], b[1], b[2] - b[0] + 1, b[3] - b[1] + 1);
  return rects;
}

/// Thinned points and the visible area. A pixel of dx dy on the ray plane covers
/// |(a, b, c)| / q^3 dx dy of the surface.
void SamplePoints(const DepthGrid& grid, const cv::Mat1b& labels, const cv::Rect& bounds,
                  const Segment& segment, const Camera& camera, int step, FramePlane& out) {
  const InverseDepthPlane& p = segment.plane.plane;
  const double norm = std::sqrt(p.a * p.a + p.b * p.b + p.c * p.c);
  double area = 0.0;
  int sampled = 0;
  const auto first = [step](int from) { return (from + step - 1) / step * step; };
  for (int v = first(bounds.y); v < bounds.y + bounds.height; v += step) {
    for (int u = first(bounds.x); u < bounds.x + bounds.width; u += step) {
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
  return out;
}

/// Gives each pixel the number of its segment. @returns how many there are.
int NumberSegments(const PlaneMerging& joined, const PlaneExtractionConfig& config,
                   PlaneWorkspace::Memory& m, const std::vector<LabelPlane>& planes) {
  m.labels = m.growth.labels();
  for (std::int32_t& label : m.labels) {
    if (label != kNoLabel) label = joined.Root(label);
  }
  FindComponents(m.grid, m.labels, planes, m.components);
  m.sight_lines.Start(m.grid, m.components, m.labels);
  JoinAcrossOccluders(joined, config, m);
  int count = 0;
  const std::vector<int> segment_of = SegmentsOfComponents(joined, config, m, count);
  for (std::size_t i = 0; i < m.labels.size(); ++i) {
    if (m.labels[i] == kNoLabel) continue;
    m.labels[i] = segment_of[static_cast<std::size_t>(m.components.component[i])];
  }
  return count;
}

void FillFrame(Frame& frame, const Camera& camera, const PlaneExtractionConfig& config,
               int count, PlaneWorkspace::Memory& m) {
  m.growth.SumSegments(m.labels, count, m.segment_sums);
  const std::vector<Segment> kept = KeepMeasured(m.segment_sums, config);
  const std::vector<cv::Rect> bounds =
      DrawLabels(m.grid, m.labels, count, kept, frame.plane_labels);
  frame.planes.clear();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    FramePlane plane = MakeFramePlane(kept[k], static_cast<int>(k));
    SamplePoints(m.grid, frame.plane_labels, bounds[k], kept[k], camera, config.point_grid_px,
                 plane);
    plane.edge_points = TraceEdges(m.grid, frame.plane_labels, plane.index + 1, bounds[k],
                                   kept[k].plane, config.edges);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
    frame.planes.push_back(std::move(plane));
  }
}

}  // namespace

void ExtractPlanes(Frame& frame, const Camera& camera, const cv::Mat2d& rays,
                   const PlaneExtractionConfig& config, PlaneWorkspace& workspace) {
  PlaneWorkspace::Memory& m = workspace.memory();
  FillDepthGrid(frame.depth_m, rays, config.noise, config.max_depth_m, m.grid);
  const BlockLayout layout(m.grid, config.block_px);
  m.coarse_sums.resize(static_cast<std::size_t>(layout.Count()));
  for (int block = 0; block < layout.Count(); ++block) {
    m.coarse_sums[static_cast<std::size_t>(block)] = SumBlock(m.grid, layout, block, nullptr);
  }
  ClusterBlocks(m.grid, layout, m.coarse_sums, config.noise, config.coarse, m.cluster_scratch,
                m.clusters);
  m.growth.Start(m.grid, layout, m.coarse_sums, config.growth);
  AddClusters(layout, config.noise, m);
  AddFinePlanes(config, m);

  PlaneMerging merging(config.noise, config.coarse, config.merge);
  merging.Start(m.grid, m.growth);
  merging.MergeEqual();
  m.growth.Replace(merging.Planes(), merging.into());
  m.growth.Settle();
  merging.Start(m.grid, m.growth);
  merging.JoinBent();
  const int count = NumberSegments(merging, config, m, merging.Planes());
  FillFrame(frame, camera, config, count, m);
}

void ExtractPlanes(Frame& frame, const Camera& camera, const cv::Mat2d& rays,
                   const PlaneExtractionConfig& config) {
  PlaneWorkspace workspace;
  ExtractPlanes(frame, camera, rays, config, workspace);
}

}  // namespace slam
