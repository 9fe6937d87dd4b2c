#include "slam/segment/block_assignment.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "slam/geometry/camera.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

// Some sizes have rows of whole lanes and one word, others neither.
TEST(BlockAssignment, GivesPixelsToTheLeastCostOfThePlanesNearAndTheFirstOfEqualOnes) {
  std::mt19937 random(5);
  for (const int size : {8, 5, 11}) {
    const std::size_t words = WordsOfSet(size);
    const auto count = static_cast<std::size_t>((size * size + 7) / 8 * 8);
    for (int turn = 0; turn < 50; ++turn) {
      constexpr std::size_t kPlanes = 4;
      std::vector<std::vector<std::uint64_t>> near(kPlanes, std::vector<std::uint64_t>(words));
      std::vector<std::vector<std::uint64_t>> owned = near;
      std::vector<std::vector<float>> costs(
          kPlanes, std::vector<float>(count, std::numeric_limits<float>::infinity()));
      std::vector<CompetingPlane> planes;
      for (std::size_t r = 0; r < kPlanes; ++r) {
        for (int k = 0; k < size * size; ++k) {
          if (random() % 3 == 0) continue;
          PutInSet(near[r].data(), size, k % size, k / size);
          costs[r][static_cast<std::size_t>(k)] = static_cast<float>(random() % 4);
        }
        owned[r].assign(words, ~std::uint64_t{0});  // of what was there before
        planes.push_back({near[r].data(), costs[r].data(), owned[r].data(), 0});
      }
      AssignPixels(planes.data(), static_cast<int>(kPlanes), size);
      std::vector<int> pixels(kPlanes);
      for (int k = 0; k < size * size; ++k) {
        std::size_t best = kPlanes;
        for (std::size_t r = 0; r < kPlanes; ++r) {
          if (!IsInSet(near[r].data(), size, k % size, k / size)) continue;
          const auto at = static_cast<std::size_t>(k);
          if (best == kPlanes || costs[r][at] < costs[best][at]) best = r;
        }
        for (std::size_t r = 0; r < kPlanes; ++r)
          EXPECT_EQ(IsInSet(owned[r].data(), size, k % size, k / size), r == best);
        if (best < kPlanes) ++pixels[best];
      }
      for (std::size_t r = 0; r < kPlanes; ++r) EXPECT_EQ(planes[r].pixels, pixels[r]);
    }
  }
}

TEST(BlockAssignment, IsDrawnWithNobodysPixelsWithinTheImageAlone) {
  Camera camera;
  camera.width = 21, camera.height = 19;
  const DepthGrid grid =
      MakeDepthGrid(cv::Mat1f(19, 21, 1.0f), PixelRays(camera), DepthNoise{}, 10.0);
  for (const int size : {8, 5}) {
    LabelImage labels(grid.q.size(), 99), expected = labels;
    std::vector<std::uint8_t> marks(grid.q.size(), 1), expected_marks = marks;
    for (int v0 = 0; v0 < grid.height; v0 += size) {
      for (int u0 = 0; u0 < grid.width; u0 += size) {
        const BlockPixels block = BlockAt(grid, u0, v0, size);
        std::vector<std::uint64_t> sets[2] = {std::vector<std::uint64_t>(WordsOfSet(size)),
                                              std::vector<std::uint64_t>(WordsOfSet(size))};
        for (int v = 0; v < block.height; ++v) {
          for (int u = 0; u < block.width; ++u) {
            const auto i = static_cast<std::size_t>(grid.Index(u0 + u, v0 + v));
            const int who = v0 == 0 ? 0 : (u * 3 + v) % 4;  // one block has a single owner
            expected[i] = static_cast<std::int16_t>(who == 0 ? 300 : who == 1 ? 7 : kNoLabel);
            if (who < 2) PutInSet(sets[who].data(), size, u, v);
            if (who == 1) expected_marks[i] = 0;
          }
        }
        const BlockOwner owners[2] = {{300, sets[0].data()}, {7, sets[1].data()}};
        const auto first = static_cast<std::size_t>(grid.Index(u0, v0));
        DrawOwners(block, owners, 2, labels.data() + first);
        ClearMarks(block, sets[1].data(), marks.data() + first);
      }
    }
    EXPECT_EQ(labels, expected);
    EXPECT_EQ(marks, expected_marks);
  }
}

}  // namespace
}  // namespace slam
