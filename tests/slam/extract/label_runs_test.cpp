#include "slam/extract/label_runs.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "slam/extract/pixel_labels.h"

namespace slam {
namespace {

/// Blotches of three labels with specks of none, of an odd width.
LabelImage Blotches(int width, int height) {
  LabelImage labels;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int blotch = (u / 5 * 31 + v / 4 * 17 + u / 5 * (v / 4)) % 3;
      labels.push_back(static_cast<std::int16_t>((u * 13 + v * 29) % 11 == 0 ? -1 : blotch));
    }
  }
  return labels;
}

/// Components by flooding, in order of their first pixel.
std::vector<int> Flood(const LabelImage& labels, int width) {
  std::vector<int> component(labels.size(), -1);
  int count = 0;
  for (std::size_t start = 0; start < labels.size(); ++start) {
    if (labels[start] == kNoLabel || component[start] >= 0) continue;
    std::vector<std::size_t> open{start};
    component[start] = count;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      const auto w = static_cast<std::size_t>(width);
      const auto visit = [&](std::size_t j) {
        if (labels[j] != labels[i] || component[j] >= 0) return;
        component[j] = count;
        open.push_back(j);
      };
      if (i % w > 0) visit(i - 1);
      if (i % w + 1 < w) visit(i + 1);
      if (i >= w) visit(i - w);
      if (i + w < labels.size()) visit(i + w);
    }
    ++count;
  }
  return component;
}

TEST(LabelRuns, MakeTheComponentsThatFloodingMakes) {
  for (const int width : {1, 2, 5, 37}) {
    const int height = 23;
    DepthGrid grid;
    grid.width = width, grid.height = height;
    const LabelImage labels = Blotches(width, height);
    const LabelComponents found = ConnectedComponents(grid, labels);
    EXPECT_EQ(found.component, Flood(labels, width)) << width;
    std::vector<int> pixels(found.list.size(), 0);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (found.component[i] < 0) continue;
      const LabelComponent& c = found.list[static_cast<std::size_t>(found.component[i])];
      EXPECT_EQ(c.label, labels[i]);
      if (pixels[static_cast<std::size_t>(found.component[i])]++ == 0) {
        EXPECT_EQ(c.first_pixel, static_cast<int>(i));
      }
    }
    for (std::size_t k = 0; k < pixels.size(); ++k) EXPECT_EQ(found.list[k].pixels, pixels[k]);
  }
}

TEST(LabelRuns, MeetEveryBoundaryOnce) {
  const int width = 37, height = 23;
  const LabelImage labels = Blotches(width, height);
  LabelRuns runs;
  FindRuns(labels, width, height, runs);
  std::multiset<std::pair<std::size_t, std::size_t>> met, expected;
  VisitBoundaries(runs, [&](std::size_t i, std::size_t j) { met.emplace(i, j); });
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto w = static_cast<std::size_t>(width);
    if (i % w + 1 < w && labels[i] != labels[i + 1]) expected.emplace(i, i + 1);
    if (i + w < labels.size() && labels[i] != labels[i + w]) expected.emplace(i, i + w);
  }
  EXPECT_EQ(met, expected);
}

}  // namespace
}  // namespace slam
