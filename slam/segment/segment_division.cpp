#include "slam/segment/segment_division.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/segment/measured_segments.h"
#include "slam/segment/seam_evidence.h"

namespace slam {
namespace {

constexpr int kSpacing_px = 2, kWideSpacing_px = 8;  // of the pixels that are compared
constexpr double kLarge_px = 6000.0;                 // from here on the wide one
constexpr int kRows = 8;                             // rows kSpacing_px apart that are kept
constexpr double kAlike_sigmas = 1.5;                // mean product, in its standard errors
constexpr int kLeastStep_px = 2;  // between the pixels that a line is sought in
constexpr double kMostPixels = 600.0;

/// Pixels between which errors are hardly shared.
int LagOf(double correlated_px, int spacing_px) {
  const double most = (kRows - 1) * kSpacing_px / spacing_px;
  return spacing_px *
         static_cast<int>(std::min(std::ceil(std::sqrt(correlated_px) / spacing_px), most));
}

void AddPixel(const DepthGrid& grid, std::size_t i, PlaneSums& sums) {
  const double g = static_cast<double>(grid.g[i]);
  sums.Add(static_cast<double>(grid.x[i]), static_cast<double>(grid.y[i]),
           static_cast<double>(grid.q[i]), g * g);
}

void Draw(const LabelRuns& runs, int width, LabelImage& labels) {
  labels.resize((runs.rows.size() - 1) * static_cast<std::size_t>(width));
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    std::int16_t* at = labels.data() + row * static_cast<std::size_t>(width);
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k)
      std::fill(at + runs.runs[k].begin, at + runs.runs[k].end,
                static_cast<std::int16_t>(runs.runs[k].label));
  }
}

}  // namespace

SegmentDivision::Part SegmentDivision::MakePart(const PlaneSums& sums, const cv::Rect& bounds,
                                                const PlaneExtractionConfig& config) {
  Part part;
  part.low = bounds.tl(), part.high = bounds.br();
  if (!(sums.n >= 2.0 * config.min_pixels)) return part;
  const std::optional<PlaneFit> fit = Fit(sums);
  if (!fit) return part;
  part.plane = {fit->plane, GrazingFactor(sums, fit->plane, config.noise)};
  part.spacing_px = sums.n < kLarge_px ? kSpacing_px : kWideSpacing_px;
  return part;
}

/// Sets bounds, and sums products of residuals of pixels beside and above each other.
void SegmentDivision::Compare(const DepthGrid& grid, const LabelRuns& runs,
                              double correlated_px) {
  residuals_.assign(static_cast<std::size_t>(kRows * grid.width), {});
  const int lag_px = LagOf(correlated_px, kSpacing_px);
  const int wide_lag_px = LagOf(correlated_px, kWideSpacing_px);
  for (int v = 0; v < grid.height; ++v) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      const LabelRun& run = runs.runs[k];
      if (run.label == kNoLabel) continue;
      Part& part = parts_[static_cast<std::size_t>(run.label)];
      if (part.spacing_px == 0) continue;
      part.low = {std::min(part.low.x, run.begin), std::min(part.low.y, v)};
      part.high = {std::max(part.high.x, run.end), v + 1};
      if (v % part.spacing_px != 0) continue;
      CompareRun(grid, run, v, part.spacing_px == kSpacing_px ? lag_px : wide_lag_px, part);
    }
  }
}

void SegmentDivision::CompareRun(const DepthGrid& grid, const LabelRun& run, int row,
                                 int lag_px, Part& part) {
  const auto row_of = [&](int v) {
    return residuals_.data() + v / kSpacing_px % kRows * grid.width;
  };
  Residual* here = row_of(row);
  const Residual* above = row >= lag_px ? row_of(row - lag_px) : nullptr;
  const auto label = static_cast<std::int16_t>(run.label);
  const auto compare = [&](float r, const Residual& other, int v) {
    if (other.label != label || other.row != v) return;
    part.products += static_cast<double>(r * other.sigmas), part.pairs += 1.0;
  };
  const int spacing = part.spacing_px;
  for (int u = (run.begin + spacing - 1) / spacing * spacing; u < run.end; u += spacing) {
    const auto i = static_cast<std::size_t>(grid.Index(u, row));
    const float r = ResidualSigmas(grid, i, part.plane);
    here[u] = {r, label, static_cast<std::int16_t>(row)};
    if (above != nullptr) compare(r, above[u], row - lag_px);
    if (u >= lag_px) compare(r, here[u - lag_px], row);
  }
}

/// Whether residuals a lag apart are alike, more than chance makes them.
bool SegmentDivision::IsAlike(const Part& part, double correlated_px) const {
  const double spacing2 = part.spacing_px * part.spacing_px;
  const double independent = part.pairs * std::min(1.0, spacing2 / correlated_px);
  return part.products * std::sqrt(independent) > kAlike_sigmas * part.pairs;
}

/// Makes every `step_px`-th pixel of every such row a cell.
void SegmentDivision::MakeSmallCells(const DepthGrid& grid, int label, int step_px) {
  const cv::Rect bounds = parts_[static_cast<std::size_t>(label)].Bounds();
  small_.clear();
  for (int v = bounds.y; v < bounds.y + bounds.height; v += step_px) {
    for (int u = bounds.x; u < bounds.x + bounds.width; u += step_px) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels_[i] != label) continue;
      small_.push_back({static_cast<double>(u), static_cast<double>(v), {}});
      AddPixel(grid, i, small_.back().sums);
    }
  }
}

/// Makes one of 2 x 2 small cells.
void SegmentDivision::MakeLargeCells(const cv::Rect& bounds, int small_px) {
  const int side = 2 * small_px, cols = (bounds.width + side - 1) / side;
  const int rows = (bounds.height + side - 1) / side;
  large_.clear();
  large_at_.assign(static_cast<std::size_t>(cols * rows), -1);
  for (const SeamCell& cell : small_) {
    const int c = (static_cast<int>(cell.u) - bounds.x) / side;
    const int r = (static_cast<int>(cell.v) - bounds.y) / side;
    int& at = large_at_[static_cast<std::size_t>(r * cols + c)];
    if (at < 0) {
      at = static_cast<int>(large_.size());
      large_.push_back(
          {bounds.x + c * side + 0.5 * (side - 1), bounds.y + r * side + 0.5 * (side - 1), {}});
    }
    large_[static_cast<std::size_t>(at)].sums += cell.sums;
  }
}

bool SegmentDivision::DivideOne(const DepthGrid& grid, const PlaneExtractionConfig& config,
                                int label, std::vector<PlaneSums>& sums) {
  const auto at = static_cast<std::size_t>(label);
  const Part& part = parts_[at];
  int step_px = kLeastStep_px;
  while (sums[at].n > kMostPixels * step_px * step_px) step_px *= 2;
  MakeSmallCells(grid, label, step_px);
  MakeLargeCells(part.Bounds(), step_px);
  const double looked_at = 1.0 / (step_px * step_px);  // of the pixels
  const double shared = std::max(1.0, config.noise.correlated_px * looked_at);
  const SegmentDivisionConfig& division = config.division;
  const double grazing = part.plane.grazing;
  const std::optional<Seam> seam = search_.Find(
      small_, large_, step_px,
      {config.min_pixels * looked_at, division.min_chi2 * shared * grazing * grazing});
  if (!seam) return false;
  const std::optional<SeamEvidence> evidence =
      WeighSeam(grid, labels_, {label, part.Bounds(), grazing, step_px}, *seam, config.noise);
  if (!evidence || !(evidence->chi2 > division.min_chi2) ||
      !(evidence->gap_sigmas > division.min_gap_sigmas) ||
      !(evidence->share > division.min_share)) {
    return false;
  }
  return Cut(grid, config, label, *seam, sums);
}

/// Makes what is beyond a line a segment of its own, if both can be measured.
bool SegmentDivision::Cut(const DepthGrid& grid, const PlaneExtractionConfig& config, int label,
                          const Seam& seam, std::vector<PlaneSums>& sums) {
  const auto at = static_cast<std::size_t>(label);
  const cv::Rect bounds = parts_[at].Bounds();
  PlaneSums beyond;
  moved_.clear();
  for (int v = bounds.y; v < bounds.y + bounds.height; ++v) {
    for (int u = bounds.x; u < bounds.x + bounds.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels_[i] != label || !(seam.Beyond(u, v) > 0.0)) continue;
      moved_.push_back(i);
      AddPixel(grid, i, beyond);
    }
  }
  const PlaneSums rest = Without(sums[at], beyond);
  if (!Measure(rest, 0, config) || !Measure(beyond, 0, config)) return false;
  const auto to = static_cast<std::int16_t>(sums.size());
  for (const std::size_t i : moved_) labels_[i] = to;
  sums[at] = rest;
  sums.push_back(beyond);
  parts_[at] = MakePart(rest, bounds, config);
  parts_.push_back(MakePart(beyond, bounds, config));
  return true;
}

bool SegmentDivision::Divide(const DepthGrid& grid, const LabelRuns& runs,
                             const PlaneExtractionConfig& config,
                             std::vector<PlaneSums>& sums) {
  if (!config.division.enabled) return false;
  parts_.clear();
  const cv::Rect none(grid.width, grid.height, -grid.width, -grid.height);
  for (const PlaneSums& s : sums) parts_.push_back(MakePart(s, none, config));
  Compare(grid, runs, config.noise.correlated_px);
  const std::size_t count = sums.size();
  bool drawn = false;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const bool is_new = k >= count;
    if (!is_new && !IsAlike(parts_[k], config.noise.correlated_px)) continue;
    if (!drawn) Draw(runs, grid.width, labels_);
    drawn = true;
    while (parts_[k].spacing_px > 0 && DivideOne(grid, config, static_cast<int>(k), sums)) {
    }
  }
  if (sums.size() == count) return false;
  FindRuns(labels_, grid.width, grid.height, runs_);
  return true;
}

}  // namespace slam
