#include "slam/extract/plane_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "slam/base/require.h"
#include "slam/extract/plane_edges.h"

namespace slam {
namespace {

constexpr int kMostSegments = 254;  // 8-bit label image, 0 = none
constexpr int kLeastContacts = 4;   // pixel sides that two segments must share to touch

void AddClusters(const DepthGrid& grid, const BlockClusters& clusters, const DepthNoise& noise,
                 PixelGrowth& growth) {
  std::vector<std::vector<int>> blocks(clusters.planes.size());
  const int half = clusters.block_px / 2;
  for (int block = 0; block < clusters.cols * clusters.rows; ++block) {
    const int region = clusters.region[static_cast<std::size_t>(block)];
    if (region < 0) continue;
    const int u = std::min(block % clusters.cols * clusters.block_px + half, grid.width - 1);
    const int v = std::min(block / clusters.cols * clusters.block_px + half, grid.height - 1);
    blocks[static_cast<std::size_t>(region)].push_back(growth.BlockAt(u, v));
  }
  for (std::size_t r = 0; r < blocks.size(); ++r) {
    const InverseDepthPlane& plane = clusters.planes[r];
    growth.AddPlane({plane, GrazingFactor(clusters.sums[r], plane, noise)}, blocks[r]);
  }
  growth.Grow();
  growth.DropUseless();
}

/// Marks the pixels that need no second look: labelled, in a block whose mean residual from the
/// label's plane is what noise and model error explain.
std::vector<std::uint8_t> SettledPixels(const DepthGrid& grid, const PixelGrowth& found,
                                        const PlaneExtractionConfig& config) {
  const LabelImage& labels = found.labels();
  std::vector<std::uint8_t> settled(labels.size(), 0);
  const int size = config.block_px;
  std::vector<double> sum(found.planes().size(), 0.0);
  std::vector<int> count(found.planes().size(), 0);
  std::vector<int> present;
  for (int v0 = 0; v0 < grid.height; v0 += size) {
    for (int u0 = 0; u0 < grid.width; u0 += size) {
      const int v1 = std::min(v0 + size, grid.height), u1 = std::min(u0 + size, grid.width);
      present.clear();
      const auto each = [&](const auto& visit) {
        for (int v = v0; v < v1; ++v) {
          for (int u = u0; u < u1; ++u) {
            const auto i = static_cast<std::size_t>(grid.Index(u, v));
            if (labels[i] != kNoLabel) visit(i, static_cast<std::size_t>(labels[i]));
          }
        }
      };
      each([&](std::size_t i, std::size_t label) {
        if (count[label]++ == 0) present.push_back(labels[i]);
        sum[label] += static_cast<double>(ResidualSigmas(grid, i, found.planes()[label]));
      });
      each([&](std::size_t i, std::size_t label) {
        const double n = count[label];
        const double bound =
            config.coarse.model_error_sigmas +
            config.max_block_bias_sigmas * std::sqrt(config.noise.correlated_px / n);
        settled[i] = std::abs(sum[label]) < bound * n ? 1 : 0;
      });
      for (const int label : present) {
        sum[static_cast<std::size_t>(label)] = 0.0, count[static_cast<std::size_t>(label)] = 0;
      }
    }
  }
  return settled;
}

/// How many pixel sides each pair of labels (lower, higher) shares.
std::map<std::pair<int, int>, int> Contacts(const DepthGrid& grid, const LabelImage& labels) {
  std::map<std::pair<int, int>, int> contacts;
  const auto touch = [&](std::size_t i, std::size_t j) {
    const int a = labels[i], b = labels[j];
    if (a != b && a != kNoLabel && b != kNoLabel) ++contacts[std::minmax(a, b)];
  };
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (u + 1 < grid.width) touch(i, i + 1);
      if (v + 1 < grid.height) touch(i, i + static_cast<std::size_t>(grid.width));
    }
  }
  return contacts;
}

/// Squared distance of two planes over the pixels of the smaller, divided by what is allowed;
/// below 1 they are one plane.
double RelativeGap(const PlaneSums& a, const PlaneSums& b, const LabelPlane& plane_a,
                   const LabelPlane& plane_b, const PlaneExtractionConfig& config) {
  const bool a_smaller = a.n < b.n;
  const PlaneSums& smaller = a_smaller ? a : b;
  const double grazing = (a_smaller ? plane_a : plane_b).grazing;
  const double gap2 =
      MeanSquaredGap(smaller, plane_a.plane, plane_b.plane) / (grazing * grazing);
  const double allowed = config.max_merge_gap_sigmas * config.max_merge_gap_sigmas +
                         config.coarse.max_merge_chi2 * config.noise.correlated_px / smaller.n;
  return gap2 / allowed;
}

/// Merges touching labels that are one plane, closest pair first, refits every plane to its
/// pixels and grows them anew.
void MergeNeighbours(const DepthGrid& grid, const PlaneExtractionConfig& config,
                     PixelGrowth& growth) {
  const LabelImage& labels = growth.labels();
  std::vector<LabelPlane> planes = growth.planes();
  std::vector<PlaneSums> sums = SumLabels(grid, labels, static_cast<int>(planes.size()));
  const auto refit = [&](std::size_t k) {
    const std::optional<PlaneFit> fit = Fit(sums[k]);
    if (!fit) return;
    planes[k] = {fit->plane, GrazingFactor(sums[k], fit->plane, config.noise)};
  };
  for (std::size_t k = 0; k < planes.size(); ++k) refit(k);

  std::vector<int> into(planes.size());
  std::iota(into.begin(), into.end(), 0);
  std::map<std::pair<int, int>, int> contacts = Contacts(grid, labels);
  while (true) {
    double least = 1.0;
    std::pair<int, int> best{-1, -1};
    for (const auto& [pair, count] : contacts) {
      if (count < kLeastContacts) continue;
      const auto a = static_cast<std::size_t>(pair.first),
                 b = static_cast<std::size_t>(pair.second);
      const double gap = RelativeGap(sums[a], sums[b], planes[a], planes[b], config);
      if (gap < least) least = gap, best = pair;
    }
    if (best.first < 0) break;
    const auto a = static_cast<std::size_t>(best.first),
               b = static_cast<std::size_t>(best.second);
    sums[a] += sums[b], sums[b] = {};
    into[b] = best.first;
    refit(a);
    std::map<std::pair<int, int>, int> renamed;
    for (const auto& [pair, count] : contacts) {
      const int x = pair.first == best.second ? best.first : pair.first;
      const int y = pair.second == best.second ? best.first : pair.second;
      if (x != y) renamed[std::minmax(x, y)] += count;
    }
    contacts = std::move(renamed);
  }
  for (std::size_t k = 0; k < into.size(); ++k) {
    into[k] = into[static_cast<std::size_t>(into[k])];  // chains end: a target is lower
  }
  growth.Replace(std::move(planes), into);
}

/// Labels that are one plane though nothing joins them in the image: the smaller lies on the
/// larger's extension, and what surrounds the smaller is in front of it, so that it can pass
/// behind. Two book tops of one height are surrounded by the desk behind them and stay apart.
void JoinAcrossOccluders(const LabelImage& labels, const DepthGrid& grid,
                         const std::vector<LabelPlane>& planes,
                         const PlaneExtractionConfig& config, LabelComponents& components) {
  std::vector<int> behind(planes.size(), 0), in_front(planes.size(), 0);
  for (const LabelComponent& c : components.list) {
    behind[static_cast<std::size_t>(c.label)] += c.behind;
    in_front[static_cast<std::size_t>(c.label)] += c.in_front;
  }
  const std::vector<PlaneSums> sums = SumLabels(grid, labels, static_cast<int>(planes.size()));
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sums[a].n > sums[b].n; });
  std::vector<int> into(planes.size());
  std::iota(into.begin(), into.end(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::size_t small = order[k];
    if (!(sums[small].n >= 3)) break;
    if (behind[small] > config.max_island_behind * (behind[small] + in_front[small])) continue;
    double least = 1.0;
    for (std::size_t j = 0; j < k; ++j) {
      const std::size_t large = order[j];
      if (into[large] != static_cast<int>(large)) continue;
      const double gap =
          RelativeGap(sums[small], sums[large], planes[small], planes[large], config);
      if (gap < least) least = gap, into[small] = static_cast<int>(large);
    }
  }
  for (LabelComponent& c : components.list) c.label = into[static_cast<std::size_t>(c.label)];
}

/// Which segment each connected component belongs to; -1 = none. A label's largest component
/// makes a segment; another one joins it if what separates them is in front, makes a segment of
/// its own if it is large enough, or is dropped.
std::vector<int> SegmentsOfComponents(const LabelComponents& components,
                                      std::size_t label_count,
                                      const PlaneExtractionConfig& config, int& segment_count) {
  std::vector<int> main(label_count, -1);
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    int& largest = main[static_cast<std::size_t>(components.list[k].label)];
    if (largest < 0 ||
        components.list[k].pixels > components.list[static_cast<std::size_t>(largest)].pixels) {
      largest = static_cast<int>(k);
    }
  }
  std::vector<int> segment(components.list.size(), -1);
  segment_count = 0;
  for (const int k : main) {
    if (k >= 0) segment[static_cast<std::size_t>(k)] = segment_count++;
  }
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    const LabelComponent& c = components.list[k];
    if (segment[k] >= 0 || c.pixels < config.min_island_pixels) continue;
    if (c.behind <= config.max_island_behind * (c.behind + c.in_front)) {
      segment[k] = segment[static_cast<std::size_t>(main[static_cast<std::size_t>(c.label)])];
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
std::vector<Segment> KeepMeasured(const DepthGrid& grid, const LabelImage& labels, int count,
                                  const PlaneExtractionConfig& config) {
  const std::vector<PlaneSums> sums = SumLabels(grid, labels, count);
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
      const std::int16_t label = labels[static_cast<std::size_t>(grid.Index(u, v))];
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

}  // namespace

void ExtractPlanes(Frame& frame, const Camera& camera, const cv::Mat2d& rays,
                   const PlaneExtractionConfig& config) {
  const DepthGrid grid = MakeDepthGrid(frame.depth_m, rays, config.noise, config.max_depth_m);
  PixelGrowth growth(grid, config.growth);
  AddClusters(grid, ClusterBlocks(grid, {}, config.block_px, config.noise, config.coarse),
              config.noise, growth);
  const std::vector<std::uint8_t> settled = SettledPixels(grid, growth, config);
  AddClusters(grid,
              ClusterBlocks(grid, settled, config.fine_block_px, config.noise, config.fine),
              config.noise, growth);
  MergeNeighbours(grid, config, growth);

  LabelImage labels = growth.labels();
  LabelComponents components = ConnectedComponents(grid, labels, growth.planes());
  JoinAcrossOccluders(labels, grid, growth.planes(), config, components);
  int count = 0;
  const std::vector<int> segment_of =
      SegmentsOfComponents(components, growth.planes().size(), config, count);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoLabel) continue;
    labels[i] = static_cast<std::int16_t>(
        segment_of[static_cast<std::size_t>(components.component[i])]);
  }

  const std::vector<Segment> kept = KeepMeasured(grid, labels, count, config);
  const std::vector<cv::Rect> bounds =
      DrawLabels(grid, labels, count, kept, frame.plane_labels);
  const EdgeConfig edge_config{.step_px = config.edge_step_px};
  frame.planes.clear();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    FramePlane plane = MakeFramePlane(kept[k], static_cast<int>(k));
    SamplePoints(grid, frame.plane_labels, bounds[k], kept[k], camera, config.point_grid_px,
                 plane);
    plane.edge_points = TraceEdges(grid, frame.plane_labels, plane.index + 1, bounds[k],
                                   kept[k].plane, edge_config);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
    frame.planes.push_back(std::move(plane));
  }
}

}  // namespace slam
