#include "slam/extract/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slam {
namespace {

constexpr int kGrid_px = 8;
constexpr std::size_t kLines = 5;
constexpr float kBehind_sigmas = 2.0f;  // other parts of the plane scatter about it

// Of lines all over two parts.
constexpr std::size_t kEnds = 12;      // of each part
constexpr float kClear_sigmas = 3.0f;  // no other part of the plane scatters so far
constexpr int kClear_px = 3;           // in a row, as single pixels beside an edge may err
constexpr double kLeastInFront = 0.5;  // share of the lines
constexpr double kMostBeyond = 0.05;   // share of the lines

int Square(int k) { return k * k; }

/// Distance of a number from an interval.
int Outside(int k, int low, int high) { return std::max({low - k, 0, k - high}); }

}  // namespace

void SightLines::Begin(const DepthGrid& grid, const LabelRuns& runs,
                       const std::vector<int>& part, int part_count,
                       double unsure_side_sigmas) {
  grid_ = &grid, runs_ = &runs, part_ = &part;
  behind_sigmas_ = std::max(kBehind_sigmas, static_cast<float>(unsure_side_sigmas));
  samples_.clear();
  for (int v = 0; v < grid.height; v += kGrid_px) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      if (part[k] < 0) continue;
      const LabelRun& run = runs.runs[k];
      for (int u = (run.begin + kGrid_px - 1) / kGrid_px * kGrid_px; u < run.end; u += kGrid_px)
        samples_.push_back({part[k], {u, v}});
    }
  }
  AddMissed(part_count);
  std::size_t place = 0;
  for (Part& p : parts_) {
    const std::size_t count = p.end;
    p.begin = p.end = place;
    place += count;
  }
  pixels_.resize(samples_.size());
  for (const Sample& sample : samples_) {
    Part& p = parts_[static_cast<std::size_t>(sample.part)];
    pixels_[p.end++] = sample.at;
    p.low = {std::min(p.low.u, sample.at.u), std::min(p.low.v, sample.at.v)};
    p.high = {std::max(p.high.u, sample.at.u), std::max(p.high.v, sample.at.v)};
  }
}

/// Counts the samples of each part in Part::end, and adds the first pixel of a part that the
/// grid has missed.
void SightLines::AddMissed(int part_count) {
  const int none = std::numeric_limits<int>::max();
  parts_.assign(static_cast<std::size_t>(part_count), Part{0, 0, {none, none}, {-1, -1}});
  for (const Sample& sample : samples_) ++parts_[static_cast<std::size_t>(sample.part)].end;
  for (int v = 0; v < grid_->height; ++v) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = runs_->rows[row]; k < runs_->rows[row + 1]; ++k) {
      const int part = (*part_)[k];
      if (part < 0 || parts_[static_cast<std::size_t>(part)].end > 0) continue;
      parts_[static_cast<std::size_t>(part)].end = 1;
      samples_.push_back({part, {runs_->runs[k].begin, v}});
    }
  }
}

void SightLines::FindNearestLines(int a, int b) {
  const Part &from_part = parts_[static_cast<std::size_t>(a)],
             &to_part = parts_[static_cast<std::size_t>(b)];
  lines_.clear();
  for (std::size_t i = from_part.begin; i < from_part.end; ++i) {
    const Pixel from = pixels_[i];
    const int longest =
        lines_.size() < kLines ? std::numeric_limits<int>::max() : lines_.back().length2;
    const int least = Square(Outside(from.u, to_part.low.u, to_part.high.u)) +
                      Square(Outside(from.v, to_part.low.v, to_part.high.v));
    if (least >= longest) continue;
    Line nearest{longest, from, from};
    for (std::size_t j = to_part.begin; j < to_part.end; ++j) {
      const Pixel to = pixels_[j];
      const int length2 = Square(to.u - from.u) + Square(to.v - from.v);
      if (length2 < nearest.length2) nearest = {length2, from, to};
    }
    if (nearest.length2 == longest) continue;
    const auto longer =
        std::upper_bound(lines_.begin(), lines_.end(), nearest,
                         [](const Line& p, const Line& q) { return p.length2 < q.length2; });
    lines_.insert(longer, nearest);
    if (lines_.size() > kLines) lines_.pop_back();
  }
}

double SightLines::ShareBehind(int a, int b, const LabelPlane& plane) {
  FindNearestLines(a, b);
  int behind = 0, measured = 0;
  for (const Line& line : lines_) {
    const int du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
    const int steps = std::max(std::abs(du), std::abs(dv));
    for (int s = 1; s < steps; ++s) {
      const int u = line.from.u + du * s / steps, v = line.from.v + dv * s / steps;
      const auto i = static_cast<std::size_t>(grid_->Index(u, v));
      if (!(grid_->g[i] > 0)) continue;
      const int part = (*part_)[runs_->At(u, v)];
      if (part == a || part == b) continue;
      ++measured;
      behind += ResidualSigmas(*grid_, i, plane) < -behind_sigmas_ ? 1 : 0;
    }
  }
  return measured > 0 ? static_cast<double>(behind) / measured : 0.0;
}

SightLines::Sight SightLines::Look(const Line& line, int a, int b,
                                   const LabelPlane& plane) const {
  const float clear = std::max(kClear_sigmas, behind_sigmas_);
  const int du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
  const int steps = std::max(std::abs(du), std::abs(dv));
  int beyond = 0, in_front = 0;
  for (int s = 1; s < steps; ++s) {
    const int u = line.from.u + du * s / steps, v = line.from.v + dv * s / steps;
    const auto i = static_cast<std::size_t>(grid_->Index(u, v));
    if (!(grid_->g[i] > 0)) continue;
    const float residual = ResidualSigmas(*grid_, i, plane);
    const bool is_beyond = residual < -clear;
    if (residual > clear) ++in_front;
    const int part = is_beyond ? (*part_)[runs_->At(u, v)] : a;
    beyond = is_beyond && part != a && part != b ? beyond + 1 : 0;
    if (beyond == kClear_px) return Sight::kBeyond;
  }
  return in_front < kClear_px ? Sight::kPlaneOrNothing : Sight::kInFront;
}

bool SightLines::AreSidesOfSomethingInFront(int a, int b, const LabelPlane& plane) const {
  const auto end = [&](int part, std::size_t k) {  // of kEnds, in equal steps
    const Part& p = parts_[static_cast<std::size_t>(part)];
    return pixels_[p.begin + (p.end - p.begin) * (2 * k + 1) / (2 * kEnds)];
  };
  int in_front = 0, beyond = 0;
  for (std::size_t j = 0; j < kEnds; ++j) {
    for (std::size_t k = 0; k < kEnds; ++k) {
      const Sight sight = Look({0, end(a, j), end(b, k)}, a, b, plane);
      in_front += sight == Sight::kInFront ? 1 : 0;
      beyond += sight == Sight::kBeyond ? 1 : 0;
    }
    if (beyond > kMostBeyond * kEnds * kEnds) return false;
  }
  return in_front >= kLeastInFront * kEnds * kEnds;
}

}  // namespace slam
