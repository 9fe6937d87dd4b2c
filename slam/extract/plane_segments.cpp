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

constexpr int kMostSegments = 254;    // 8-bit label image, 0 = none
constexpr double kLeastContacts = 8;  // pixels along the common boundary of what touches

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

/// The pixels on either side of the common boundary of each pair of labels (lower, higher).
using Contacts = std::map<std::pair<int, int>, PlaneSums>;

Contacts FindContacts(const DepthGrid& grid, const LabelImage& labels) {
  Contacts contacts;
  std::pair<int, int> last{-1, -1};  // neighbouring pixels touch the same pair: look it up once
  PlaneSums* sums = nullptr;
  const auto touch = [&](std::size_t i, std::size_t j) {
    const int a = labels[i], b = labels[j];
    if (a == b || a == kNoLabel || b == kNoLabel) return;
    const std::pair<int, int> pair = std::minmax(a, b);
    if (pair != last) sums = &contacts[pair], last = pair;
    for (const std::size_t k : {i, j}) {
      const double g = static_cast<double>(grid.g[k]);
      sums->Add(static_cast<double>(grid.x[k]), static_cast<double>(grid.y[k]),
                static_cast<double>(grid.q[k]), g * g);
    }
  };
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels[i] == kNoLabel) continue;
      if (u + 1 < grid.width) touch(i, i + 1);
      if (v + 1 < grid.height) touch(i, i + static_cast<std::size_t>(grid.width));
    }
  }
  return contacts;
}

/// A label's plane and the pixels that it was fitted to.
struct Patch {
  PlaneSums sums;
  LabelPlane plane;
};

/// Squared distance of two planes over the pixels of the smaller, in sigmas of those.
double PatchGap2(const Patch& a, const Patch& b) {
  const Patch& smaller = a.sums.n < b.sums.n ? a : b;
  return MeanSquaredGap(smaller.sums, a.plane.plane, b.plane.plane) /
         (smaller.plane.grazing * smaller.plane.grazing);
}

/// What noise adds to a squared gap, with what else is allowed.
double AllowedGap2(const Patch& a, const Patch& b, double max_gap_sigmas,
                   const PlaneExtractionConfig& config) {
  return max_gap_sigmas * max_gap_sigmas + config.coarse.max_merge_chi2 *
                                               config.noise.correlated_px /
                                               std::min(a.sums.n, b.sums.n);
}

/// Squared distance of two planes along their common boundary over what is allowed there.
double ContactGap(const Patch& a, const Patch& b, const PlaneSums& contact,
                  const PlaneExtractionConfig& config) {
  const double grazing = std::max(a.plane.grazing, b.plane.grazing);
  const double gap2 =
      MeanSquaredGap(contact, a.plane.plane, b.plane.plane) / (grazing * grazing);
  return gap2 / AllowedGap2(a, b, config.max_merge_gap_sigmas, config);
}

double PatchGap(const Patch& a, const Patch& b, double max_gap_sigmas,
                const PlaneExtractionConfig& config) {
  return PatchGap2(a, b) / AllowedGap2(a, b, max_gap_sigmas, config);
}

void Refit(Patch& patch, const DepthNoise& noise) {
  const std::optional<PlaneFit> fit = Fit(patch.sums);
  if (!fit) return;
  patch.plane = {fit->plane, GrazingFactor(patch.sums, fit->plane, noise)};
}

std::vector<Patch> FittedPatches(const DepthGrid& grid, const PixelGrowth& growth,
                                 const DepthNoise& noise) {
  const std::vector<PlaneSums> sums =
      SumLabels(grid, growth.labels(), static_cast<int>(growth.planes().size()));
  std::vector<Patch> patches;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    patches.push_back({sums[k], growth.planes()[k]});
    Refit(patches.back(), noise);
  }
  return patches;
}

/// Which patch each patch has become part of.
class PatchUnion {
 public:
  explicit PatchUnion(std::vector<Patch> patches)
      : patches_(std::move(patches)), into_(patches_.size()) {
    std::iota(into_.begin(), into_.end(), 0);
  }
  /// The lower number stays.
  void Join(int a, int b, const DepthNoise& noise) {
    if (b < a) std::swap(a, b);
    patches_[Index(a)].sums += patches_[Index(b)].sums;
    patches_[Index(b)].sums = {};
    Refit(patches_[Index(a)], noise);
    for (int& target : into_) target = target == b ? a : target;
  }
  int Root(int k) const { return into_[Index(k)]; }
  const Patch& At(int k) const { return patches_[Index(Root(k))]; }
  const std::vector<int>& into() const { return into_; }
  std::vector<LabelPlane> Planes() const {
    std::vector<LabelPlane> planes;
    for (const Patch& patch : patches_) planes.push_back(patch.plane);
    return planes;
  }

 private:
  static std::size_t Index(int k) { return static_cast<std::size_t>(k); }
  std::vector<Patch> patches_;
  std::vector<int> into_;
};

/// Merges touching labels that are one plane within the noise, closest pair first, refits every
/// plane to its pixels and grows them anew.
void MergeEqualNeighbours(const DepthGrid& grid, const PlaneExtractionConfig& config,
                          PixelGrowth& growth) {
  PatchUnion merged(FittedPatches(grid, growth, config.noise));
  const Contacts contacts = FindContacts(grid, growth.labels());
  while (true) {
    double least = 1.0;
    std::pair<int, int> best{-1, -1};
    for (const auto& [pair, contact] : contacts) {
      const int a = merged.Root(pair.first), b = merged.Root(pair.second);
      if (a == b || contact.n < kLeastContacts) continue;
      const double gap =
          std::max(PatchGap(merged.At(a), merged.At(b), config.max_merge_gap_sigmas, config),
                   ContactGap(merged.At(a), merged.At(b), contact, config));
      if (gap < least) least = gap, best = {a, b};
    }
    if (best.first < 0) break;
    merged.Join(best.first, best.second, config.noise);
  }
  growth.Replace(merged.Planes(), merged.into());
}

/// Joins touching labels that are parts of one surface which the sensor has bent: a real step
/// stands all along the boundary, while the parts of a bent surface meet there. So the planes
/// of the two labels must agree along the boundary, and those of the segments that they belong
/// to must agree within the wider bounds on bending. The labels keep their own planes, and with
/// them their pixels.
PatchUnion JoinBentParts(const DepthGrid& grid, const PlaneExtractionConfig& config,
                         const PixelGrowth& growth) {
  const std::vector<Patch> parts = FittedPatches(grid, growth, config.noise);
  PatchUnion joined(parts);
  std::vector<std::pair<double, std::pair<int, int>>> meeting;
  for (const auto& [pair, contact] : FindContacts(grid, growth.labels())) {
    if (contact.n < kLeastContacts) continue;
    const double gap =
        ContactGap(parts[static_cast<std::size_t>(pair.first)],
                   parts[static_cast<std::size_t>(pair.second)], contact, config);
    if (gap < 1.0) meeting.emplace_back(gap, pair);
  }
  std::sort(meeting.begin(), meeting.end());
  bool changed = true;
  while (changed) {
    changed = false;
    for (const auto& [gap, pair] : meeting) {
      const int a = joined.Root(pair.first), b = joined.Root(pair.second);
      if (a == b) continue;
      const Patch &A = joined.At(a), &B = joined.At(b);
      const double angle = Angle(A.plane.plane.Hessian().n, B.plane.plane.Hessian().n);
      if (!(angle < config.max_bend_rad)) continue;
      if (!(PatchGap(A, B, config.max_bend_sigmas, config) < 1.0)) continue;
      joined.Join(a, b, config.noise);
      changed = true;
    }
  }
  return joined;
}

/// Labels that are one plane though nothing joins them in the image: the smaller lies on the
/// larger's extension, and what surrounds the smaller is in front of it, so that it can pass
/// behind. Two book tops of one height are surrounded by the desk behind them and stay apart.
void JoinAcrossOccluders(const PatchUnion& patches, std::size_t count,
                         const PlaneExtractionConfig& config, LabelComponents& components) {
  std::vector<int> behind(count, 0), in_front(count, 0);
  std::vector<int> order;
  for (std::size_t k = 0; k < count; ++k) {
    const bool own = patches.Root(static_cast<int>(k)) == static_cast<int>(k);
    if (own && patches.At(static_cast<int>(k)).sums.n >= 3)
      order.push_back(static_cast<int>(k));
  }
  for (const LabelComponent& c : components.list) {
    behind[static_cast<std::size_t>(c.label)] += c.behind;
    in_front[static_cast<std::size_t>(c.label)] += c.in_front;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return patches.At(a).sums.n > patches.At(b).sums.n; });
  std::vector<int> into(count);
  std::iota(into.begin(), into.end(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto small = static_cast<std::size_t>(order[k]);
    if (behind[small] > config.max_island_behind * (behind[small] + in_front[small])) continue;
    double least = 1.0;
    for (std::size_t j = 0; j < k; ++j) {
      const int large = order[j];
      if (into[static_cast<std::size_t>(large)] != large) continue;
      const double gap = PatchGap(patches.At(order[k]), patches.At(large),
                                  config.max_merge_gap_sigmas, config);
      if (gap < least) least = gap, into[small] = large;
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
  MergeEqualNeighbours(grid, config, growth);

  const PatchUnion joined = JoinBentParts(grid, config, growth);
  const std::vector<LabelPlane> planes = joined.Planes();
  LabelImage labels = growth.labels();
  for (std::int16_t& label : labels) {
    if (label != kNoLabel) label = static_cast<std::int16_t>(joined.Root(label));
  }
  LabelComponents components = ConnectedComponents(grid, labels, planes);
  JoinAcrossOccluders(joined, planes.size(), config, components);
  int count = 0;
  const std::vector<int> segment_of =
      SegmentsOfComponents(components, planes.size(), config, count);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoLabel) continue;
    labels[i] = static_cast<std::int16_t>(
        segment_of[static_cast<std::size_t>(components.component[i])]);
  }

  const std::vector<Segment> kept = KeepMeasured(grid, labels, count, config);
  const std::vector<cv::Rect> bounds =
      DrawLabels(grid, labels, count, kept, frame.plane_labels);
  frame.planes.clear();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    FramePlane plane = MakeFramePlane(kept[k], static_cast<int>(k));
    SamplePoints(grid, frame.plane_labels, bounds[k], kept[k], camera, config.point_grid_px,
                 plane);
    plane.edge_points = TraceEdges(grid, frame.plane_labels, plane.index + 1, bounds[k],
                                   kept[k].plane, config.edges);
    for (const EdgePoint& point : plane.edge_points) plane.box_px.Include(point.u_px);
    frame.planes.push_back(std::move(plane));
  }
}

}  // namespace slam
