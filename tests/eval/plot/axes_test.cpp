// Ticks, styles and legends of plots.
#include "eval/plot/axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

namespace eval {
namespace {

using ::testing::ElementsAre;
using ::testing::Pointwise;

TEST(RoundTicks, AreMultiplesOfOneTwoOrFiveAndStayInside) {
  EXPECT_THAT(RoundTicks(0, 10), ElementsAre(0, 2, 4, 6, 8, 10));
  const std::vector<double> tenths = {0, 0.2, 0.4, 0.6, 0.8, 1.0};
  EXPECT_THAT(RoundTicks(0, 1), Pointwise(::testing::DoubleEq(), tenths));
  EXPECT_THAT(RoundTicks(-3, 4), ElementsAre(-2, 0, 2, 4));
  for (const double size : {1e-9, 3e-5, 0.7, 42.0, 6e11}) {
    const std::vector<double> ticks = RoundTicks(-0.3 * size, size);
    EXPECT_GE(ticks.size(), 3u);
    EXPECT_LE(ticks.size(), 8u);
    EXPECT_GE(ticks.front(), -0.3001 * size);
    EXPECT_LE(ticks.back(), 1.0001 * size);
  }
}

TEST(StyleOfSeries, TellsFourteenSeriesApartAndNoneIsTheTruths) {
  std::set<std::tuple<double, double, double, double>> styles;
  const auto add = [&](const SeriesStyle& s) {
    styles.emplace(s.red, s.green, s.blue, s.dash_pt);
  };
  for (std::size_t i = 0; i < 14; ++i) add(StyleOfSeries(i));
  add(StyleOfTruth());
  EXPECT_EQ(styles.size(), 15u);
}

/// Pixels of a panel, 0 to 2 by 0 to 2, in which a line is.
int PixelsOfLine(const std::vector<PlotPoint>& points) {
  cairo_surface_t* const surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 300, 300);
  cairo_t* const context = cairo_create(surface);
  SeriesStyle red;
  red.red = 1, red.width_pt = 3;
  Axes(context, {50, 50, 200, 200}, {"x", 0, 2}, {"y", 0, 2}).Line(points, red);
  cairo_surface_flush(surface);
  int count = 0;
  for (int v = 0; v < 300; ++v) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(
        cairo_image_surface_get_data(surface) + v * cairo_image_surface_get_stride(surface));
    for (int u = 0; u < 300; ++u) count += (row[u] & 0xffffff) == 0xff0000 ? 1 : 0;
  }
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  return count;
}

/// Columns left of a panel at 100 in which anything is drawn, of an axis up to that number.
std::set<int> ColumnsBeside(double max) {
  cairo_surface_t* const surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 300, 300);
  cairo_t* const context = cairo_create(surface);
  cairo_set_source_rgb(context, 1, 1, 1);
  cairo_paint(context);
  Axes(context, {100, 50, 150, 200}, {"x", 0, 2}, {"y", -max, max});
  cairo_surface_flush(surface);
  std::set<int> columns;
  for (int v = 0; v < 300; ++v) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(
        cairo_image_surface_get_data(surface) + v * cairo_image_surface_get_stride(surface));
    for (int u = 0; u < 96; ++u) {
      if ((row[u] & 0xffffff) != 0xffffff) columns.insert(u);
    }
  }
  cairo_destroy(context);
  cairo_surface_destroy(surface);
  return columns;
}

// A label over the names of ticks hides a sign.
TEST(Axes, PutTheLabelBesideTheNamesOfTicks) {
  for (const double max : {2.0, 0.06, 0.0021}) {
    const std::set<int> columns = ColumnsBeside(max);
    ASSERT_FALSE(columns.empty());
    int gaps = 0, last = *columns.begin();
    for (const int u : columns) {
      gaps += u - last > 2 ? 1 : 0;
      last = u;
    }
    EXPECT_GE(gaps, 1) << max;  // label, gap, names
    EXPECT_GE(*columns.begin(), 100 - static_cast<int>(kAxisLeft_pt)) << max;
  }
}

TEST(Axes, LeaveAGapWhereALineIsNotKnown) {
  const double unknown = std::nan("");
  const int all = PixelsOfLine({{0, 1}, {0.5, 1}, {1, 1}, {1.5, 1}, {2, 1}});
  const int half = PixelsOfLine({{0, 1}, {0.5, 1}, {1, unknown}, {1.5, 1}, {2, 1}});
  EXPECT_GT(all, 190);
  EXPECT_NEAR(half, all / 2, 12);
}

TEST(Legend, WrapsWhatIsTooWide) {
  const std::vector<LegendEntry> entries(6, {"a name of some length", {}});
  EXPECT_GT(LegendHeight(200, entries), LegendHeight(2000, entries));
}

}  // namespace
}  // namespace eval
