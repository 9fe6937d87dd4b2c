#include "slam/segment/pixels/label_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "slam/segment/pixels/label_components.h"

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

void DrawRuns(const LabelRuns& runs, LabelImage& out) {
  const auto width = static_cast<std::size_t>(runs.width);
  out.resize(runs.rows.empty() ? 0 : (runs.rows.size() - 1) * width);
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    std::int16_t* to = out.data() + row * width;
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      const LabelRun& run = runs.runs[k];
      std::fill(to + run.begin, to + run.end, static_cast<std::int16_t>(run.label));
    }
  }
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
    const LabelImage labels = Blotches(width, height);
    LabelComponents found;
    FindRuns(labels, width, height, found.runs);
    ConnectRuns(found);
    const std::vector<int> expected = Flood(labels, width);
    std::vector<int> pixels(found.list.size(), 0);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const int u = static_cast<int>(i) % width, v = static_cast<int>(i) / width;
      ASSERT_EQ(found.component[found.runs.At(u, v)], expected[i]) << width;
      if (expected[i] < 0) continue;
      const LabelComponent& c = found.list[static_cast<std::size_t>(expected[i])];
      EXPECT_EQ(c.label, labels[i]);
      ++pixels[static_cast<std::size_t>(expected[i])];
    }
    for (std::size_t k = 0; k < pixels.size(); ++k) EXPECT_EQ(found.list[k].pixels, pixels[k]);
  }
}

TEST(LabelContacts, CountEverySideOfAPixelOnce) {
  const int width = 37, height = 23;
  const LabelImage labels = Blotches(width, height);
  LabelRuns runs;
  FindRuns(labels, width, height, runs);
  LabelContacts found = CountContacts(runs, 3);
  std::map<std::pair<int, int>, int> shared, expected;
  std::vector<int> around(3, 0);
  const auto meet = [&](int a, int b) {
    if (a == b) return;
    for (const int label : {a, b})
      if (label != kNoLabel) ++around[static_cast<std::size_t>(label)];
    if (a != kNoLabel && b != kNoLabel) ++expected[std::minmax(a, b)];
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto w = static_cast<std::size_t>(width);
    if (i % w + 1 < w) meet(labels[i], labels[i + 1]);
    if (i + w < labels.size()) meet(labels[i], labels[i + w]);
  }
  found.shared.VisitSorted([&](int a, int b, int sides) { shared[{a, b}] = sides; });
  EXPECT_EQ(shared, expected);
  EXPECT_EQ(found.around, around);
}

TEST(LabelRuns, AreDrawnAsTheyWereFound) {
  const int width = 37, height = 23;
  const LabelImage labels = Blotches(width, height);
  LabelRuns runs;
  FindRuns(labels, width, height, runs);
  LabelImage drawn;
  DrawRuns(runs, drawn);
  EXPECT_EQ(drawn, labels);
}

}  // namespace
}  // namespace slam
