#include "slam/segment/ahc.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "slam/base/index.h"

namespace slam {
namespace {

// All bounds are the defaults of the authors' program.
constexpr int kAhcBlock_px = 10;
constexpr double kMinSupport_px = 3000.0;
constexpr double kNoise_per_m = 1.6e-3;  // standard deviation of depth is this times z^2
constexpr double kFirstTolerance_m = 0.005, kMergeTolerance_m = 0.008;  // added to it
constexpr float kJumpRatio = 0.04f, kJump_m = 0.02f;  // a jump: more than their sum, with z
// The largest angle between the normals of two blocks beside a third, from near to far.
constexpr double kNear_m = 0.5, kFar_m = 4.0;
constexpr double kNear_rad = 15.0 * std::numbers::pi / 180.0, kFar_rad = std::numbers::pi / 2.0;
// The same of what merges, first and after pixels have grown: cosines of 60 and 30 degrees.
constexpr double kMergeCosine = 0.5, kRefineCosine = 0.86602540378443865;
constexpr double kGrowthSigmas = 3.0;   // a plane grows over pixels as near as this
constexpr double kRounding_m2 = 1e-11;  // besides, so that a plane without noise grows

double MaxError(double z_m, double tolerance_m) {
  const double sigma = kNoise_per_m * z_m * z_m + tolerance_m;
  return sigma * sigma;
}

/// Least cosine of the angle between blocks at this distance.
double MinBlockCosine(double z_m) {
  const double share = std::clamp((z_m - kNear_m) / (kFar_m - kNear_m), 0.0, 1.0);
  return std::cos(kNear_rad + share * (kFar_rad - kNear_rad));
}

/// Moments of points and the plane through them.
struct PointPlane {
  double n = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  double error = 0.0;  ///< mean of squared distances, m^2

  void Add(const Eigen::Vector3d& p) {
    n += 1.0, sum += p;
    products.noalias() += p * p.transpose();
  }
  void Fit() {
    center = sum / n;
    const Eigen::Matrix3d covariance = products / n - center * center.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    error = std::max(solver.eigenvalues()[0], 0.0);
    normal = solver.eigenvectors().col(0);
  }
  double Cosine(const PointPlane& o) const { return std::abs(normal.dot(o.normal)); }
};

PointPlane Union(const PointPlane& a, const PointPlane& b) {
  PointPlane both;
  both.n = a.n + b.n, both.sum = a.sum + b.sum, both.products = a.products + b.products;
  both.Fit();
  return both;
}

/// Planes that may merge, and which have.
class PlaneGraph {
 public:
  void Add(const PointPlane& plane) {
    into_.push_back(static_cast<int>(planes_.size()));
    planes_.push_back(plane);
    neighbours_.emplace_back();
    complete_.push_back(false);
  }
  void Connect(int a, int b) {
    Neighbours(a).push_back(b);
    Neighbours(b).push_back(a);
  }
  int size() const { return static_cast<int>(planes_.size()); }
  const PointPlane& At(int k) const { return planes_[Index(k)]; }
  /// What a plane has become part of, or itself.
  int Root(int k) {
    int& up = into_[Index(k)];
    return up == k ? k : up = Root(up);
  }
  /// The plane of least error merges with the neighbour with which it has least, as long as
  /// that is within the bound. A plane for which it is not is complete: nothing takes it in later.
  void Merge();

 private:
  std::vector<int>& Neighbours(int k) { return neighbours_[Index(k)]; }
  void TidyNeighbours(int k);

  std::vector<PointPlane> planes_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<int> into_;
  std::vector<bool> complete_;
};

/// The neighbours as they are now that may still merge, each once, in order.
void PlaneGraph::TidyNeighbours(int k) {
  std::vector<int>& list = Neighbours(k);
  for (int& other : list) other = Root(other);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  std::erase_if(list, [&](int other) { return other == k || complete_[Index(other)]; });
}

void PlaneGraph::Merge() {
  using Entry = std::tuple<double, int, double>;  // error, plane, points when it was put there
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
  const auto put = [&](int k) { heap.emplace(At(k).error, k, At(k).n); };
  for (int k = 0; k < size(); ++k) put(k);
  while (!heap.empty()) {
    const auto [error, k, n] = heap.top();
    heap.pop();
    if (Root(k) != k || At(k).n != n) continue;
    TidyNeighbours(k);
    PointPlane best;
    int partner = -1;
    for (const int other : Neighbours(k)) {
      if (At(k).Cosine(At(other)) < kMergeCosine) continue;
      const PointPlane both = Union(At(k), At(other));
      if (partner < 0 || both.error < best.error) best = both, partner = other;
    }
    if (partner < 0 || best.error > MaxError(best.center.z(), kMergeTolerance_m)) {
      complete_[Index(k)] = true;
      continue;
    }
    planes_[Index(k)] = best;
    into_[Index(partner)] = k;
    std::vector<int>& theirs = Neighbours(partner);
    Neighbours(k).insert(Neighbours(k).end(), theirs.begin(), theirs.end());
    theirs.clear();
    put(k);
  }
}

/// Segments one image.
class AhcSegmentation {
 public:
  explicit AhcSegmentation(const DepthGrid& grid)
      : grid_(grid), cols_(grid.width / kAhcBlock_px), rows_(grid.height / kAhcBlock_px) {}
  LabelImage Run();

 private:
  Eigen::Vector3d PointAt(std::size_t i) const {
    const double z = 1.0 / static_cast<double>(grid_.q[i]);
    return {static_cast<double>(grid_.x[i]) * z, static_cast<double>(grid_.y[i]) * z, z};
  }
  int NodeAt(int c, int r) const { return node_[Index(r * cols_ + c)]; }
  bool IsSmooth(int u0, int v0) const;
  void AddBlocks();
  void ConnectLine(int a, int middle, int b);
  void ConnectBlocks();
  void KeepInteriors();
  void GrowPixels();
  void Spread(int from, int to, int label);
  LabelImage MergeGrown();

  const DepthGrid& grid_;
  int cols_, rows_;
  PlaneGraph graph_;
  std::vector<int> node_;           ///< one a block; -1 = not planar
  std::vector<PointPlane> planes_;  ///< large ones of the first clustering
  LabelImage labels_;               ///< which of them each pixel belongs to
  std::vector<float> distance_m_;   ///< of a pixel from its plane; 0 in the interior of one
  std::queue<std::pair<int, int>> front_;  ///< pixels from which a plane grows, and its label
  std::vector<std::pair<int, int>> contacts_;  ///< planes that have met in growing
};

/// Whether everything in a block is measured and nothing jumps.
bool AhcSegmentation::IsSmooth(int u0, int v0) const {
  const auto jumps = [&](float z, std::size_t other) {
    return !(std::abs(z - 1.0f / grid_.q[other]) <= kJumpRatio * z + kJump_m);
  };
  for (int v = v0; v < v0 + kAhcBlock_px; ++v) {
    for (int u = u0; u < u0 + kAhcBlock_px; ++u) {
      const auto i = static_cast<std::size_t>(grid_.Index(u, v));
      if (!(grid_.q[i] > 0.0f)) return false;
      const float z = 1.0f / grid_.q[i];
      if (u + 1 < u0 + kAhcBlock_px && jumps(z, i + 1)) return false;
      if (v + 1 < v0 + kAhcBlock_px && jumps(z, i + static_cast<std::size_t>(grid_.width)))
        return false;
    }
  }
  return true;
}

void AhcSegmentation::AddBlocks() {
  node_.assign(static_cast<std::size_t>(cols_ * rows_), -1);
  for (int block = 0; block < cols_ * rows_; ++block) {
    const int u0 = block % cols_ * kAhcBlock_px, v0 = block / cols_ * kAhcBlock_px;
    if (!IsSmooth(u0, v0)) continue;
    PointPlane plane;
    for (int v = v0; v < v0 + kAhcBlock_px; ++v) {
      for (int u = u0; u < u0 + kAhcBlock_px; ++u)
        plane.Add(PointAt(static_cast<std::size_t>(grid_.Index(u, v))));
    }
    plane.Fit();
    if (plane.error > MaxError(plane.center.z(), kFirstTolerance_m)) continue;
    node_[Index(block)] = graph_.size();
    graph_.Add(plane);
  }
}

/// Connects a block with those on both sides of it if their normals agree. @param b  may be middle
void AhcSegmentation::ConnectLine(int a, int middle, int b) {
  if (a < 0 || middle < 0 || b < 0) return;
  const double min_cosine = MinBlockCosine(graph_.At(middle).center.z());
  if (graph_.At(a).Cosine(graph_.At(b)) < min_cosine) return;
  graph_.Connect(a, middle);
  if (b != middle) graph_.Connect(middle, b);
}

void AhcSegmentation::ConnectBlocks() {
  // The last of a row or column has none beyond it: its own normal is asked.
  for (int r = 0; r < rows_; ++r)
    for (int c = 1; c < cols_; ++c)
      ConnectLine(NodeAt(c - 1, r), NodeAt(c, r), NodeAt(std::min(c + 1, cols_ - 1), r));
  for (int r = 1; r < rows_; ++r)
    for (int c = 0; c < cols_; ++c)
      ConnectLine(NodeAt(c, r - 1), NodeAt(c, r), NodeAt(c, std::min(r + 1, rows_ - 1)));
}

/// Labels the blocks all of whose neighbours in the image are of one large plane; those of its border,
/// which may lie across an edge, are left to the pixels that grow from here.
void AhcSegmentation::KeepInteriors() {
  std::vector<int> label_of(static_cast<std::size_t>(graph_.size()), -1);
  const auto label_at = [&](int c, int r) {
    c = std::clamp(c, 0, cols_ - 1), r = std::clamp(r, 0, rows_ - 1);
    if (NodeAt(c, r) < 0) return -1;
    const int root = graph_.Root(NodeAt(c, r));
    int& label = label_of[Index(root)];
    if (label < 0 && graph_.At(root).n >= kMinSupport_px) {
      label = static_cast<int>(planes_.size());
      planes_.push_back(graph_.At(root));
    }
    return label;
  };
  labels_.assign(grid_.q.size(), kNoLabel);
  distance_m_.assign(grid_.q.size(), std::numeric_limits<float>::infinity());
  for (int block = 0; block < cols_ * rows_; ++block) {
    const int c = block % cols_, r = block / cols_, label = label_at(c, r);
    if (label < 0 || label_at(c - 1, r) != label || label_at(c + 1, r) != label ||
        label_at(c, r - 1) != label || label_at(c, r + 1) != label)
      continue;
    for (int v = r * kAhcBlock_px; v < (r + 1) * kAhcBlock_px; ++v) {
      const int row = grid_.Index(c * kAhcBlock_px, v);
      std::fill_n(labels_.begin() + row, kAhcBlock_px, static_cast<std::int16_t>(label));
      std::fill_n(distance_m_.begin() + row, kAhcBlock_px, 0.0f);
      const bool inside = v > r * kAhcBlock_px && v + 1 < (r + 1) * kAhcBlock_px;
      for (int u = 0; u < kAhcBlock_px; u += inside ? kAhcBlock_px - 1 : 1)
        front_.emplace(row + u, label);
    }
  }
}

/// Lets a plane have a pixel beside one of its own, if it is near and no other plane is nearer.
void AhcSegmentation::Spread(int from, int to, int label) {
  const auto i = static_cast<std::size_t>(to);
  if (labels_[Index(from)] != label || labels_[i] == label || !(grid_.q[i] > 0.0f)) return;
  const PointPlane& plane = planes_[Index(label)];
  const double offset_m = plane.normal.dot(PointAt(i) - plane.center);
  if (!(offset_m * offset_m < kGrowthSigmas * kGrowthSigmas * plane.error + kRounding_m2))
    return;
  const auto distance = static_cast<float>(std::abs(offset_m));
  if (labels_[i] != kNoLabel) contacts_.push_back(std::minmax<int>(label, labels_[i]));
  if (!(distance < distance_m_[i])) return;
  distance_m_[i] = distance;
  labels_[i] = static_cast<std::int16_t>(label);
  front_.emplace(to, label);
}

void AhcSegmentation::GrowPixels() {
  while (!front_.empty()) {
    const auto [pixel, label] = front_.front();
    front_.pop();
    const int u = pixel % grid_.width;
    if (u > 0) Spread(pixel, pixel - 1, label);
    if (u + 1 < grid_.width) Spread(pixel, pixel + 1, label);
    if (pixel >= grid_.width) Spread(pixel, pixel - grid_.width, label);
    if (pixel + grid_.width < static_cast<int>(labels_.size()))
      Spread(pixel, pixel + grid_.width, label);
  }
}

/// Clusters the planes that have met, and drops what is too small.
LabelImage AhcSegmentation::MergeGrown() {
  std::vector<PointPlane> grown(planes_.size());
  for (std::size_t i = 0; i < labels_.size(); ++i)
    if (labels_[i] != kNoLabel) grown[Index(labels_[i])].Add(PointAt(i));
  PlaneGraph merged;
  for (std::size_t k = 0; k < grown.size(); ++k) {
    if (grown[k].n > 0) grown[k].Fit();
    merged.Add(grown[k]);
  }
  std::sort(contacts_.begin(), contacts_.end());
  contacts_.erase(std::unique(contacts_.begin(), contacts_.end()), contacts_.end());
  for (const auto& [a, b] : contacts_)
    if (merged.At(a).Cosine(merged.At(b)) >= kRefineCosine) merged.Connect(a, b);
  merged.Merge();

  std::vector<std::int16_t> number(planes_.size(), kNoLabel);
  std::int16_t count = 0;
  for (int k = 0; k < merged.size(); ++k)
    if (merged.Root(k) == k && merged.At(k).n >= kMinSupport_px) number[Index(k)] = count++;
  for (std::int16_t& label : labels_)
    if (label != kNoLabel) label = number[Index(merged.Root(label))];
  return std::move(labels_);
}

LabelImage AhcSegmentation::Run() {
  AddBlocks();
  ConnectBlocks();
  graph_.Merge();
  KeepInteriors();
  GrowPixels();
  return MergeGrown();
}

}  // namespace

LabelImage SegmentByAhc(const DepthGrid& grid) { return AhcSegmentation(grid).Run(); }

}  // namespace slam
