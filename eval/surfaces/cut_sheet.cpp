#include "eval/surfaces/cut_sheet.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "eval/surfaces/depth_error.h"

namespace eval {
namespace {

constexpr int kStepBaseline_cells = 2;  // the blur of a depth edge at 1 m is as wide
// Within which two parts meet: wider than the rim of an edge.
constexpr double kRing_cells = 10;
constexpr double kMaxEmpty_cells = 10;  // that a bridge may cross: a gap of 10 cm is a gap
constexpr int kMinPart_cells = 40;      // smaller parts are judged cell by cell
constexpr int kMinRing_cells = 5;       // fewer cells tell no height
constexpr int kMinHits = 3;             // of a cell; a point or two is noise

/// Cells that hold something.
CellMask OccupiedCells(const Sheet& sheet) {
  CellMask occupied(sheet.hits.size(), std::uint8_t(0));
  for (int v = 0; v < occupied.rows; ++v) {
    for (int u = 0; u < occupied.cols; ++u) {
      const int hits = sheet.hits(v, u);
      if (hits >= kMinHits && hits > sheet.passes(v, u)) occupied(v, u) = 255;
    }
  }
  return occupied;
}

/// Occupied cells where no height changes by a step.
CellMask SmoothCells(const Sheet& sheet, const CellMask& occupied, const DepthError& error) {
  CellMask smooth = occupied.clone();
  const auto compare = [&](cv::Point a, cv::Point b) {
    if (!sheet.Holds(b) || occupied(a) == 0 || occupied(b) == 0) return;
    const double step_m = error.OfStep_m(0.5 * (sheet.depth_m(a) + sheet.depth_m(b)),
                                         std::min(sheet.hits(a), sheet.hits(b)));
    if (std::abs(sheet.height_m(a) - sheet.height_m(b)) < step_m) return;
    smooth(a) = smooth(b) = smooth((a + b) / 2) = 0;
  };
  for (int v = 0; v < occupied.rows; ++v) {
    for (int u = 0; u < occupied.cols; ++u) {
      compare({u, v}, {u + kStepBaseline_cells, v});
      compare({u, v}, {u, v + kStepBaseline_cells});
    }
  }
  return smooth;
}

/// Mean height and depth of the cells of a mask that a second one holds as well.
struct MeanCell {
  double height_m = 0.0, depth_m = 0.0;
  int cells = 0;
};
MeanCell MeanOf(const Sheet& sheet, const CellMask& mask, const CellMask& where) {
  MeanCell mean;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) == 0 || where(v, u) == 0) continue;
      mean.height_m += sheet.height_m(v, u);
      mean.depth_m += sheet.depth_m(v, u);
      ++mean.cells;
    }
  }
  if (mean.cells == 0) return mean;
  mean.height_m /= mean.cells;
  mean.depth_m /= mean.cells;
  return mean;
}

/// How far each cell is from a mask, and where the nearest cell of the mask is.
class DistanceTo {
 public:
  explicit DistanceTo(const CellMask& mask) {
    cv::distanceTransform(mask == 0, cells_, labels_, cv::DIST_L2, cv::DIST_MASK_5,
                          cv::DIST_LABEL_PIXEL);
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        if (mask(v, u) == 0) continue;
        const auto label = std::size_t(labels_(v, u));
        if (at_.size() <= label) at_.resize(label + 1);
        at_[label] = {u, v};
      }
    }
  }
  float operator()(cv::Point cell) const { return cells_(cell); }
  CellMask Within(double cells) const {
    CellMask within;
    within = cells_ <= cells;
    return within;
  }
  cv::Point Nearest(cv::Point cell) const { return at_[std::size_t(labels_(cell))]; }

 private:
  cv::Mat1f cells_;
  cv::Mat1i labels_;
  std::vector<cv::Point> at_;
};

/// Whether the way between two cells is seen to be empty, for the most part or over a wide gap:
/// rays passed through it, or ended on something lower. What is higher hides it.
bool IsEmptyBetween(const Sheet& sheet, cv::Point a, cv::Point b, const DepthError& error) {
  constexpr int kAbout_cells = 2;  // rays through a plane are told of more thinly than hits
  const double level_m = 0.5 * (sheet.height_m(a) + sheet.height_m(b));
  int empty = 0;
  cv::LineIterator line(sheet.hits, a, b);
  for (int i = 0; i < line.count; ++i, ++line) {
    const cv::Point cell = line.pos();
    const cv::Rect about = cv::Rect(cell.x - kAbout_cells, cell.y - kAbout_cells,
                                    2 * kAbout_cells + 1, 2 * kAbout_cells + 1) &
                           cv::Rect({0, 0}, sheet.hits.size());
    const int hits = sheet.hits(cell);
    const bool is_lower = hits >= kMinHits && level_m - sheet.height_m(cell) >
                                                  error.OfStep_m(sheet.depth_m(cell), hits);
    const bool is_passed = cv::sum(sheet.passes(about))[0] > cv::sum(sheet.hits(about))[0];
    empty += is_lower || is_passed ? 1 : 0;
  }
  return empty > std::min(kMaxEmpty_cells, 0.5 * line.count);
}

/// The same of most of the ways from the side of a part that faces the group.
bool IsMostlyEmptyBetween(const Sheet& sheet, const DistanceTo& to_group, const CellMask& part,
                          const DepthError& error) {
  constexpr float kSide_cells = 5;  // further than the nearest cell, and on the same side still
  constexpr std::size_t kMaxWays = 50;  // that are looked at, evenly
  float nearest = std::numeric_limits<float>::infinity();
  std::vector<cv::Point> cells;
  cv::findNonZero(part, cells);
  for (const cv::Point& cell : cells) nearest = std::min(nearest, to_group(cell));
  std::vector<cv::Point> side;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(side),
               [&](const cv::Point& cell) { return to_group(cell) <= nearest + kSide_cells; });
  const std::size_t step = (side.size() + kMaxWays - 1) / kMaxWays;
  int ways = 0, empty = 0;
  for (std::size_t i = 0; i < side.size(); i += step) {
    ++ways;
    empty += IsEmptyBetween(sheet, side[i], to_group.Nearest(side[i]), error) ? 1 : 0;
  }
  return 2 * empty > ways;
}

bool IsOneSurface(const Sheet& sheet, const CellMask& group, const DistanceTo& to_group,
                  const CellMask& part, const DepthError& error) {
  // Where they meet, their heights must agree to a step.
  const MeanCell at_group = MeanOf(sheet, part, to_group.Within(kRing_cells));
  if (at_group.cells >= kMinRing_cells) {
    const MeanCell at_part = MeanOf(sheet, group, DistanceTo(part).Within(kRing_cells));
    const double step_m = error.OfStep_m(at_group.depth_m, kMinHits * at_group.cells);
    return std::abs(at_group.height_m - at_part.height_m) < step_m;
  }

  // Where they do not, to the bend, and the way from one to the other must not be empty.
  const MeanCell mean_part = MeanOf(sheet, part, part),
                 mean_group = MeanOf(sheet, group, group);
  const double bend_m =
      2 * DepthError::OfMean_m(std::max(mean_part.depth_m, mean_group.depth_m));
  if (!(std::abs(mean_part.height_m - mean_group.height_m) < bend_m)) return false;
  return !IsMostlyEmptyBetween(sheet, to_group, part, error);
}

/// Connected parts of a mask with enough cells, largest first.
std::vector<CellMask> PartsOf(const CellMask& mask) {
  cv::Mat1i labels;
  cv::Mat statistics, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centres, 4);
  std::vector<std::pair<int, int>> by_size;
  for (int label = 1; label < count; ++label) {
    const int cells = statistics.at<int>(label, cv::CC_STAT_AREA);
    if (cells >= kMinPart_cells) by_size.emplace_back(-cells, label);
  }
  std::sort(by_size.begin(), by_size.end());
  std::vector<CellMask> parts;
  for (const auto& [size, label] : by_size) parts.emplace_back() = labels == label;
  return parts;
}

/// The parts put together that are one surface.
std::vector<CellMask> GroupsOf(const Sheet& sheet, const std::vector<CellMask>& parts,
                               const DepthError& error) {
  std::vector<CellMask> groups;
  for (const CellMask& part : parts) {
    const auto joined = std::find_if(groups.begin(), groups.end(), [&](const CellMask& group) {
      return IsOneSurface(sheet, group, DistanceTo(group), part, error);
    });
    if (joined == groups.end()) {
      groups.push_back(part.clone());
    } else {
      *joined |= part;
    }
  }
  return groups;
}

/// Gives edge cells and small parts to the group beside them, where their height is the
/// group's: the rim of a thing that lies on a desk is desk again.
void TakeLevelCells(const Sheet& sheet, const CellMask& occupied, const DepthError& error,
                    CellMask& group) {
  constexpr int kSide = 11;  // cells over which the group's height is averaged: a ring's
  cv::Mat1d heights, cells;
  cv::Mat1d in_group;
  group.convertTo(in_group, CV_64F, 1.0 / 255);
  cv::boxFilter(in_group, cells, CV_64F, {kSide, kSide}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(in_group.mul(sheet.height_m), heights, CV_64F, {kSide, kSide}, {-1, -1}, false,
                cv::BORDER_CONSTANT);
  for (int v = 0; v < group.rows; ++v) {
    for (int u = 0; u < group.cols; ++u) {
      if (occupied(v, u) == 0 || group(v, u) != 0 || !(cells(v, u) > 0.5)) continue;
      const double off_m = sheet.height_m(v, u) - heights(v, u) / cells(v, u);
      if (std::abs(off_m) < error.OfStep_m(sheet.depth_m(v, u), sheet.hits(v, u)))
        group(v, u) = 255;
    }
  }
}

}  // namespace

std::vector<CellMask> CutSheet(const Sheet& sheet, double min_area_m2, double noise_per_m) {
  const DepthError error{noise_per_m};
  const CellMask occupied = OccupiedCells(sheet);
  const int min_cells = int(min_area_m2 / (Sheet::kCell_m * Sheet::kCell_m));
  std::vector<CellMask> surfaces;
  for (CellMask& group : GroupsOf(sheet, PartsOf(SmoothCells(sheet, occupied, error)), error)) {
    TakeLevelCells(sheet, occupied, error, group);
    if (cv::countNonZero(group) >= min_cells) surfaces.push_back(group);
  }
  return surfaces;
}

}  // namespace eval
