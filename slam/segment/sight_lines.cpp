#include "slam/segment/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/segment/block_pixels.h"

namespace slam {
namespace {

constexpr int kGrid_px = 8;             // spacing of samples; balances time against small parts
constexpr std::size_t kLines = 5;       // nearest lines; one alone may end in a stray pixel
constexpr float kBehind_sigmas = 2.0f;  // other parts of the plane scatter about it

// Lines all over two parts.
constexpr std::size_t kEnds = 12;         // samples of each part that they join; balances time
constexpr float kClear_sigmas = 3.0f;     // no other part of the plane scatters so far
constexpr int kClear_px = 3;              // in a row, as single pixels beside an edge may err
constexpr double kMinInFrontShare = 0.5;  // of the lines: most of them
constexpr double kMaxBeyondShare = 0.05;  // of the lines: stray pixels let a few through

int Square(int k) { return k * k; }

/// Distance of a number from an interval.
int DistanceFrom(int k, int low, int high) { return std::max({low - k, 0, k - high}); }

}  // namespace

void SightLines::Begin(const DepthGrid& grid, const LabelRuns& runs,
                       const std::vector<int>& part, int part_count) {
  grid_ = &grid, runs_ = &runs, part_ = &part;

  // Samples on the grid, and one of each part that it misses.
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

  // Sorted by part, with the bounds of each.
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

  // Where a search may go on after a row that is too far away.
  row_end_.resize(pixels_.size());
  for (const Part& p : parts_) {
    for (std::size_t k = p.end; k-- > p.begin;) {
      const bool last = k + 1 == p.end || pixels_[k + 1].v != pixels_[k].v;
      row_end_[k] = last ? k + 1 : row_end_[k + 1];
    }
  }
}

/// Counts the samples of each part in Part::end, and adds the first pixel of a part that the
/// grid has missed.
void SightLines::AddMissed(int part_count) {
  const int none = std::numeric_limits<int>::max();
  parts_.assign(static_cast<std::size_t>(part_count), Part{0, 0, {none, none}, {-1, -1}});
  for (const Sample& sample : samples_) ++parts_[static_cast<std::size_t>(sample.part)].end;
  auto missed =
      std::count_if(parts_.begin(), parts_.end(), [](const Part& p) { return p.end == 0; });
  for (int v = 0; v < grid_->height && missed > 0; ++v) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = runs_->rows[row]; k < runs_->rows[row + 1]; ++k) {
      const int part = (*part_)[k];
      if (part < 0 || parts_[static_cast<std::size_t>(part)].end > 0) continue;
      parts_[static_cast<std::size_t>(part)].end = 1;
      samples_.push_back({part, {runs_->runs[k].begin, v}});
      --missed;
    }
  }
}

void SightLines::FindNearestLines(int a, int b) {
  const Part &from_part = parts_[static_cast<std::size_t>(a)],
             &to_part = parts_[static_cast<std::size_t>(b)];
  lines_.clear();
  // From each sample the nearest of the other part, if it is nearer than the lines so far.
  for (std::size_t i = from_part.begin; i < from_part.end; ++i) {
    const Pixel from = pixels_[i];
    const int longest =
        lines_.size() < kLines ? std::numeric_limits<int>::max() : lines_.back().length2;
    const int shortest = Square(DistanceFrom(from.u, to_part.low.u, to_part.high.u)) +
                         Square(DistanceFrom(from.v, to_part.low.v, to_part.high.v));
    if (shortest >= longest) continue;
    Line nearest{longest, from, from};
    for (std::size_t j = to_part.begin; j < to_part.end;) {
      const std::size_t row_end = row_end_[j];
      const int dv2 = Square(pixels_[j].v - from.v);
      if (dv2 >= nearest.length2) {
        j = row_end;
        continue;
      }
      for (; j < row_end; ++j) {
        const Pixel to = pixels_[j];
        const int length2 = Square(to.u - from.u) + dv2;
        if (length2 < nearest.length2) nearest = {length2, from, to};
      }
    }
    if (nearest.length2 == longest) continue;
    const auto longer =
        std::upper_bound(lines_.begin(), lines_.end(), nearest,
                         [](const Line& p, const Line& q) { return p.length2 < q.length2; });
    lines_.insert(longer, nearest);
    if (lines_.size() > kLines) lines_.pop_back();
  }
}

/// Visits the pixels between the ends until told to stop, without a division: along the longer
/// side one at a time, along the other what the division would have rounded towards `from`.
template <typename Visit>
void SightLines::Walk(const Line& line, const Visit& visit) const {
  const int du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
  const int across = du < 0 ? -1 : 1, down = dv < 0 ? -grid_->width : grid_->width;
  const bool is_level = std::abs(du) >= std::abs(dv);
  const int steps = std::max(std::abs(du), std::abs(dv));
  const int shorter = std::min(std::abs(du), std::abs(dv));
  const int always = is_level ? across : down, sometimes = is_level ? down : across;
  int i = grid_->Index(line.from.u, line.from.v);
  for (int s = 1, rest = 0; s < steps; ++s) {
    rest += shorter;
    const bool over = rest >= steps;
    rest -= over ? steps : 0;
    i += always + (over ? sometimes : 0);
    if (!visit(static_cast<std::size_t>(i))) return;
  }
}

int SightLines::PartAt(std::size_t i) const {
  const int pixel = static_cast<int>(i);
  return (*part_)[runs_->At(pixel % grid_->width, pixel / grid_->width)];
}

double SightLines::ShareBehind(int a, int b, const LabelPlane& plane, double unsure_sigmas) {
  const float clear = std::max(kBehind_sigmas, static_cast<float>(unsure_sigmas));
  FindNearestLines(a, b);
  const PixelPlane in_float(plane);
  int behind = 0, measured = 0;
  for (const Line& line : lines_) {
    Walk(line, [&](std::size_t i) {
      if (!(grid_->g[i] > 0)) return true;
      const int part = PartAt(i);
      if (part == a || part == b) return true;
      ++measured;
      behind += ResidualSigmas(*grid_, i, in_float) < -clear ? 1 : 0;
      return true;
    });
  }
  return measured > 0 ? static_cast<double>(behind) / measured : 0.0;
}

SightLines::Sight SightLines::Look(const Line& line, int a, int b, const PixelPlane& plane,
                                   float clear) const {
  int beyond = 0, in_front = 0;
  const DepthGrid& grid = *grid_;
  Walk(line, [&](std::size_t i) {
    if (!(grid.g[i] > 0)) return true;
    const float residual = ResidualSigmas(grid, i, plane);
    if (!(residual < -clear)) {
      in_front += residual > clear ? 1 : 0;
      beyond = 0;
      return true;
    }
    const int part = PartAt(i);
    beyond = part != a && part != b ? beyond + 1 : 0;
    return beyond < kClear_px;
  });
  if (beyond == kClear_px) return Sight::kBeyond;
  return in_front < kClear_px ? Sight::kPlaneOrNothing : Sight::kInFront;
}

bool SightLines::AreSidesOfSomethingInFront(int a, int b, const LabelPlane& plane,
                                            double unsure_sigmas) const {
  const float clear = std::max(kClear_sigmas, static_cast<float>(unsure_sigmas));
  constexpr double kAll = kEnds * kEnds;
  const PixelPlane in_float(plane);
  const auto end = [&](int part, std::size_t k) {  // one of kEnds, in equal steps
    const Part& p = parts_[static_cast<std::size_t>(part)];
    return pixels_[p.begin + (p.end - p.begin) * (2 * k + 1) / (2 * kEnds)];
  };
  int beyond = 0, not_in_front = 0;
  for (std::size_t j = 0; j < kEnds; ++j) {
    const Pixel from = end(a, j);
    for (std::size_t k = 0; k < kEnds; ++k) {
      const Sight sight = Look({0, from, end(b, k)}, a, b, in_float, clear);
      not_in_front += sight == Sight::kInFront ? 0 : 1;
      beyond += sight == Sight::kBeyond ? 1 : 0;
      // What is left cannot change the answer.
      if (beyond > kMaxBeyondShare * kAll || kAll - not_in_front < kMinInFrontShare * kAll)
        return false;
    }
  }
  return true;
}

}  // namespace slam
