#include "slam/segment/joining/surface_joining.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "slam/base/index.h"
#include "slam/segment/joining/surfaces.h"

namespace slam {
namespace {

constexpr int kReach_blocks = 2;       // around a place: a strip is short against the bend
constexpr int kMinContact_sides = 4;   // of pixels; fewer may touch by stray pixels
constexpr double kMinStrip_px = 24.0;  // pixels; with fewer a strip is noise
constexpr double kOverlap = 2.0 * kReach_blocks + 1;  // places that share a strip

/// The mean of squares less what noise adds to them.
struct NoisySquares {
  double weight = 0.0, sum = 0.0, variance = 0.0;

  /// @param square, noise  of a place, and what noise alone would make it
  void Add(double square, double noise) {
    constexpr double kFloor = 0.1;  // a place never says more than ten of noise 1
    const double w = 1.0 / (noise + kFloor);
    weight += w, sum += w * (square - noise), variance += 2.0 * w * w * noise * noise;
  }
  NoisySquares& operator+=(const NoisySquares& o) {
    weight += o.weight, sum += o.sum, variance += o.variance;
    return *this;
  }
  double Mean() const { return sum / weight; }
  double Sigma() const { return std::sqrt(kOverlap * variance) / weight; }
};

/// What lies along the common border of two labels.
struct Border {
  NoisySquares step;  ///< in sigmas of a pixel
  NoisySquares turn;  ///< of the slope, in slopes of the bend

  Border& operator+=(const Border& o) {
    step += o.step, turn += o.turn;
    return *this;
  }
};

/// Second moments of a strip's pixels about their middle.
struct Strip {
  double w, x, y, q, xx, xy, yy, xq, yq;

  explicit Strip(const PlaneSums& s)
      : w(s.w),
        x(s.wx / s.w),
        y(s.wy / s.w),
        q(s.wq / s.w),
        xx(s.wxx - s.wx * x),
        xy(s.wxy - s.wx * y),
        yy(s.wyy - s.wy * y),
        xq(s.wqx - s.wx * q),
        yq(s.wqy - s.wy * q) {}
};

/// Adds what two strips on either side of a place say.
void AddPlace(const PlaneSums& sums_a, const PlaneSums& sums_b, const DepthNoise& noise,
              const JoinConfig& config, Border& border) {
  const Strip A(sums_a), B(sums_b);
  const double xx = A.xx + B.xx, xy = A.xy + B.xy, yy = A.yy + B.yy, det = xx * yy - xy * xy;
  constexpr double kMinSpread = 1e-3;  // below, the rays of both strips lie on a line
  if (!(det > kMinSpread * xx * yy)) return;
  const double xq = A.xq + B.xq, yq = A.yq + B.yq;
  const double a = (yy * xq - xy * yq) / det, b = (xx * yq - xy * xq) / det;

  // The step between two planes of one slope.
  const double dx = A.x - B.x, dy = A.y - B.y;
  const double x = 0.5 * (A.x + B.x), y = 0.5 * (A.y + B.y), q = 0.5 * (A.q + B.q);
  const double grazing =
      noise.GrazingFactor(1.0 / q, InverseDepthPlane{a, b, q - a * x - b * y}.Cosine(x, y));
  const double pixel2 = 0.5 * (sums_a.n / A.w + sums_b.n / B.w) * grazing * grazing;
  const double step = A.q - B.q - a * dx - b * dy;
  const double information =
      1.0 / A.w + 1.0 / B.w + (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / det;
  const double noise2 = noise.correlated_px * grazing * grazing;
  border.step.Add(step * step / pixel2, noise2 * information / pixel2);

  // The turn of the slope across the border, of two planes of their own.
  const double det_a = A.xx * A.yy - A.xy * A.xy, det_b = B.xx * B.yy - B.xy * B.xy;
  if (!(det_a > kMinSpread * A.xx * A.yy) || !(det_b > kMinSpread * B.xx * B.yy)) return;
  const double length = std::hypot(dx, dy);
  if (!(length > 0.0)) return;  // neither lies beside the other
  const double ex = dx / length, ey = dy / length;
  const auto slope = [&](const Strip& s, double d) {
    return (ex * (s.yy * s.xq - s.xy * s.yq) + ey * (s.xx * s.yq - s.xy * s.xq)) / d;
  };
  const auto variance = [&](const Strip& s, double d) {
    return noise2 * (s.yy * ex * ex - 2 * s.xy * ex * ey + s.xx * ey * ey) / d;
  };
  const double turn = slope(A, det_a) - slope(B, det_b);
  const double bent = config.bend_ratio * q;
  const double unit2 =
      (bent * bent + pixel2) / (config.bend_length_rad * config.bend_length_rad);
  border.turn.Add(turn * turn / unit2, (variance(A, det_a) + variance(B, det_b)) / unit2);
}

class SurfaceJoining {
 public:
  SurfaceJoining(const PartsOnBlocks& on, std::vector<std::uint8_t> bent,
                 const DepthNoise& noise, const JoinConfig& config)
      : on_(on),
        noise_(noise),
        config_(config),
        candidates_(bent.size()),
        bent_(std::move(bent)) {
    sums_ = SumParts(on, bent_.size());
    into_.resize(bent_.size());
    std::iota(into_.begin(), into_.end(), 0);
  }
  void MeasureBorders(LabelPairs<int>* contacts);
  void JoinBest();
  JoinedLabels Joined() && { return {std::move(into_), std::move(sums_), std::move(bent_)}; }

 private:
  struct Pair {
    int a, b;
    Border border;
    bool may_be_one;
  };
  struct Candidate {
    bool asked = false, possible = false;
    int last_block = -1;
    Border border;
  };

  void Look(const BlockPart& a, const BlockPart& b, int block, LabelPairs<int>* contacts);
  bool MayBeOne(int a, int b) const;
  bool IsSmooth(const Border& border) const;
  void Join(int a, int b);

  const PartsOnBlocks& on_;
  const DepthNoise& noise_;
  const JoinConfig& config_;
  LabelPairs<Candidate> candidates_;
  std::vector<Pair> pairs_;
  std::vector<int> into_;
  std::vector<PlaneSums> sums_;
  std::vector<std::uint8_t> bent_;
};

/// Measures how two labels meet around a block.
void SurfaceJoining::Look(const BlockPart& a, const BlockPart& b, int block,
                          LabelPairs<int>* contacts) {
  if (a.label == b.label) return;
  const auto [low, high] = std::minmax(a.label, b.label);
  Candidate& candidate = candidates_.Of(low, high);
  if (!candidate.asked) {
    candidate.asked = true;
    candidate.possible =
        (contacts == nullptr || contacts->Of(low, high) >= kMinContact_sides) &&
        MayBeOne(low, high);
  }
  if (!candidate.possible || candidate.last_block == block) return;
  candidate.last_block = block;
  const int c = block % on_.cols, r = block / on_.cols;
  PlaneSums strip_a, strip_b;
  on_.VisitWindow(c - kReach_blocks, r - kReach_blocks, c + kReach_blocks, r + kReach_blocks,
                  [&, first = low, second = high](const BlockPart& part) {
                    if (part.label == first) strip_a += part.sums;
                    if (part.label == second) strip_b += part.sums;
                  });
  if (strip_a.n < kMinStrip_px || strip_b.n < kMinStrip_px) return;
  AddPlace(strip_a, strip_b, noise_, config_, candidate.border);
}

void SurfaceJoining::MeasureBorders(LabelPairs<int>* contacts) {
  for (int block = 0; block < on_.cols * on_.rows; ++block) {
    const auto first = on_.first[Index(block)],
               end = on_.first[static_cast<std::size_t>(block) + 1];
    const int c = block % on_.cols, r = block / on_.cols;
    for (std::size_t k = first; k < end; ++k) {
      const BlockPart& part = on_.parts[k];
      const auto look = [&](const BlockPart& other) { Look(part, other, block, contacts); };
      for (std::size_t j = k + 1; j < end; ++j) look(on_.parts[j]);
      if (c + 1 < on_.cols) on_.VisitWindow(c + 1, r, c + 1, r, look);
      if (r + 1 < on_.rows) on_.VisitWindow(c, r + 1, c, r + 1, look);
    }
  }
  candidates_.VisitSorted([&](int low, int high, const Candidate& candidate) {
    if (candidate.border.step.weight > 0) pairs_.push_back({low, high, candidate.border, true});
  });
}

/// Whether two labels as one plane keep within the bend.
bool SurfaceJoining::MayBeOne(int a, int b) const {
  return UnionChi2(sums_[Index(a)], sums_[Index(b)], noise_, config_) < config_.max_union_chi2;
}

bool SurfaceJoining::IsSmooth(const Border& border) const {
  const auto square = [](double x) { return x * x; };
  return border.step.Mean() < square(config_.max_step_sigmas) &&
         (border.turn.weight == 0.0 ||
          border.turn.Mean() - border.turn.Sigma() < square(config_.max_turn_bends));
}

/// Joins two labels; their borders with a third become one.
void SurfaceJoining::Join(int a, int b) {
  sums_[Index(a)] += std::exchange(sums_[Index(b)], {});
  bent_[Index(a)] = config_.bend_ratio > 0.0 ? 1 : 0;
  for (int& target : into_) target = target == b ? a : target;
  std::vector<Pair> kept;
  for (Pair pair : pairs_) {
    if (pair.a == b) pair.a = a;
    if (pair.b == b) pair.b = a;
    if (pair.a == pair.b) continue;
    if (pair.a > pair.b) std::swap(pair.a, pair.b);
    if (pair.a == a || pair.b == a) {
      const auto same = std::find_if(kept.begin(), kept.end(), [&](const Pair& other) {
        return other.a == pair.a && other.b == pair.b;
      });
      if (same != kept.end()) {
        same->border += pair.border;
        continue;
      }
      pair.may_be_one = MayBeOne(pair.a, pair.b);
    }
    kept.push_back(pair);
  }
  pairs_ = std::move(kept);
}

/// The pair that meets best joins, as long as there is one.
void SurfaceJoining::JoinBest() {
  while (true) {
    const Pair* best = nullptr;
    for (const Pair& pair : pairs_) {
      if (!pair.may_be_one || !IsSmooth(pair.border)) continue;
      if (best == nullptr || pair.border.step.Mean() < best->border.step.Mean()) best = &pair;
    }
    if (best == nullptr) return;
    Join(best->a, best->b);
  }
}

}  // namespace

JoinedLabels JoinSurfaces(const PartsOnBlocks& on, std::size_t label_count,
                          LabelPairs<int>* contacts, std::vector<std::uint8_t> bent,
                          const DepthNoise& noise, const JoinConfig& config) {
  bent.resize(label_count);
  SurfaceJoining joining(on, std::move(bent), noise, config);
  joining.MeasureBorders(contacts);
  joining.JoinBest();
  return std::move(joining).Joined();
}

}  // namespace slam
