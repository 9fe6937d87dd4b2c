#include "eval/surfaces/sheet.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

/// A wall across the whole view of a camera that looks along z.
PlanePatch PatchAcross(double z_m) {
  PlanePatch patch{{-Eigen::Vector3d::UnitZ(), z_m}, {}};
  for (double x = -0.6; x <= 0.6; x += Sheet::kCell_m) {
    for (double y = -0.5; y <= 0.5; y += Sheet::kCell_m) {
      patch.surfels.emplace_back().p_g = {x, y, z_m};
    }
  }
  return patch;
}

// Two planes nearer to each other than their tolerances: a thin book's top and the desk, of which
// one side of the image shows the one and the other side the other.
TEST(AddToSheets, GivesAPixelToThePlaneThatItLiesOnBestInAnyOrderOfThem) {
  constexpr int kCols = 80, kRows = 60, kOfBook = 30;
  constexpr double kFocal_px = 100, kBook_m = 1.200, kDesk_m = 1.208, kNoise_per_m = 0.0016;
  DepthView view;
  view.depth_m = cv::Mat1f(kRows, kCols, float(kDesk_m));
  view.depth_m.colRange(0, kOfBook).setTo(kBook_m);
  cv::Mat2d rays(kRows, kCols);
  for (int v = 0; v < kRows; ++v) {
    for (int u = 0; u < kCols; ++u)
      rays(v, u) = {(u - 39.5) / kFocal_px, (v - 29.5) / kFocal_px};
  }
  const LocalNormals local = FitLocalNormals(view.depth_m, rays, 1);
  for (const bool book_first : {true, false}) {
    std::vector<Sheet> sheets;
    for (const bool book : {book_first, !book_first})
      sheets.push_back(SheetOver(PatchAcross(book ? kBook_m : kDesk_m)));
    AddToSheets(view, rays, local, 1, kNoise_per_m, sheets);
    const auto hits = [&](bool book) {
      return cv::sum(sheets[book == book_first ? 0 : 1].hits)[0];
    };
    EXPECT_EQ(hits(true), kOfBook * kRows);
    EXPECT_EQ(hits(false), (kCols - kOfBook) * kRows);
  }
}

}  // namespace
}  // namespace eval
