#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// What a block's corners do not tell: rods and a board thinner than a pixel, a chip smaller than a
/// block, and bodies that stand in one another, so that no edge is where one ends.
Scene ThinAndCrossing() {
  Scene scene = OneBoard(2.0);
  const auto add = [&](const Eigen::Vector3d& center_w, const Eigen::Vector3d& size,
                       double turn) {
    const int id = static_cast<int>(scene.objects.size()) + 1;
    scene.objects.push_back(BoxObject(id, "book", Role::kRegular, center_w, size));
    scene.objects.back().q_wo = Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 2, 3).normalized());
  };
  for (int i = 0; i < 5; ++i) {
    add({0.12 * i - 0.3, 1.0, 0}, {0.0012, 0.0012, 0.9}, 0.3 * i);
    add({0, 1.2, 0.13 * i - 0.3}, {0.9, 0.0012, 0.0012}, 0.2 * i);
    add({0.15 * i - 0.37, 0.9, 0.11 * i - 0.23}, {0.004, 0.001, 0.004}, 0.7 * i);
  }
  add({0.1, 1.5, 0}, {0.8, 0.0005, 0.8}, 1.1);
  add({-0.55, 1.3, -0.3}, {0.3, 0.4, 0.3}, 0.8);
  add({-0.5, 1.3, -0.25}, {0.2, 0.5, 0.4}, 2.1);
  return scene;
}

/// Views of a part of the rows cast a ray for every pixel.
void ExpectAsWithoutFilling(const Camera& camera) {
  const FrameRenderer renderer(ThinAndCrossing(), camera);
  const Pose T_wc = LookAt({0.05, 0, 0.1}, {0, 1, 0});
  RenderOptions options{.colour = false};
  const Rendering whole = renderer.Render(T_wc, options);
  Rendering parts;
  for (const cv::Range& rows : {cv::Range(0, 100), cv::Range(100, camera.height)}) {
    options.rows = rows;
    renderer.Render(T_wc, options, parts);
  }
  EXPECT_EQ(cv::countNonZero(whole.object_id != parts.object_id), 0);
  EXPECT_EQ(cv::countNonZero(whole.plane_id != parts.plane_id), 0);
  EXPECT_EQ(cv::countNonZero(whole.depth_m != parts.depth_m), 0);
}

TEST(FilledBlocks, ShowWhatARayAPixelShows) { ExpectAsWithoutFilling(Camera{}); }

TEST(FilledBlocks, ShowItBehindALens) {
  ExpectAsWithoutFilling(WithLens(Camera{}, {-0.2, 0.05, 0.002, -0.001, 0.0}));
}

}  // namespace
}  // namespace sim
