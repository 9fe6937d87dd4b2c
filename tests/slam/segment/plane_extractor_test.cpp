#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "slam/segment/pixels/pixel_labels.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/cameras.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

struct SizedView {
  Camera camera;
  cv::Mat1f depth_m;
};

/// Books on a desk, more of them the larger `books`.
SizedView BooksView(int width, int height, int books) {
  closed_form::World world = closed_form::Desk();
  for (int k = 0; k < books; ++k)
    closed_form::PutOnDesk(world, 0.16 * k - 0.2, 0.05 * k, {0.12, 0.17, 0.03 + 0.01 * k},
                           0.3 * k, "book");
  const Camera camera = CameraOfSize(width, height);
  const Pose T_cw = closed_form::LookAt({0.05, -0.6, 0.6}, {0, 0, 0});
  const closed_form::View view = closed_form::Render(world, camera, T_cw);
  return {camera, closed_form::AddKinectNoise(view.depth_m, 7u + static_cast<unsigned>(books))};
}

void ExpectTheSame(const Frame& a, const Frame& b) {
  ASSERT_EQ(a.plane_labels.size(), b.plane_labels.size());
  EXPECT_TRUE(std::equal(a.plane_labels.begin(), a.plane_labels.end(), b.plane_labels.begin()));
  ASSERT_EQ(a.planes.size(), b.planes.size());
  for (std::size_t k = 0; k < a.planes.size(); ++k) {
    const FramePlane &p = a.planes[k], &q = b.planes[k];
    EXPECT_EQ(p.pi_c.n, q.pi_c.n);
    EXPECT_EQ(p.pi_c.d, q.pi_c.d);
    EXPECT_EQ(p.pixel_count, q.pixel_count);
    EXPECT_EQ(p.area_m2, q.area_m2);
    EXPECT_EQ(p.angle_sigma_rad, q.angle_sigma_rad);
    EXPECT_EQ(p.points_c, q.points_c);
    ASSERT_EQ(p.edge_points.size(), q.edge_points.size());
    for (std::size_t e = 0; e < p.edge_points.size(); ++e) {
      EXPECT_EQ(p.edge_points[e].p_c, q.edge_points[e].p_c);
      EXPECT_EQ(p.edge_points[e].kind, q.edge_points[e].kind);
    }
  }
}

TEST(PlaneExtractor, FitsItsPlanesToThePixelsThatItDraws) {
  // Sums of labels, less what of them is another segment or none, are those of the pixels.
  int segments = 0;
  for (int books = 1; books <= 4; ++books) {
    SizedView view = BooksView(320, 240, books);
    Frame frame = closed_form::MakeFrame(view.depth_m);
    // A pole in front cuts all behind it, and a hole leaves islands.
    view.depth_m(cv::Rect(150, 0, 6, 200)).setTo(0.3f);
    for (int u = 30; u < 60; u += 5) view.depth_m(cv::Rect(u, 120, 2, 100)).setTo(0.0f);
    const cv::Mat2d rays = PixelRays(view.camera);
    ExtractPlanes(frame, rays, {});
    const DepthGrid grid =
        MakeDepthGrid(view.depth_m, rays, DepthNoise{}, SensorModel{}.max_depth_m);
    LabelImage drawn;
    for (const std::uint8_t value : frame.plane_labels)
      drawn.push_back(static_cast<std::int16_t>(value - 1));
    const std::vector<PlaneSums> sums =
        SumLabels(grid, drawn, static_cast<int>(frame.planes.size()));
    for (std::size_t k = 0; k < frame.planes.size(); ++k, ++segments) {
      EXPECT_EQ(frame.planes[k].pixel_count, sums[k].n);
      const Plane fit = Fit(sums[k])->plane.Hessian();
      EXPECT_LT((frame.planes[k].pi_c.n - fit.n).norm(), 1e-9);
      EXPECT_NEAR(frame.planes[k].pi_c.d, fit.d, 1e-9);
    }
  }
  EXPECT_GT(segments, 12);
}

TEST(PlaneExtractor, GivesTheSameWhateverItHasSeenBefore) {
  std::vector<SizedView> views{BooksView(320, 240, 4), BooksView(320, 240, 1),
                               BooksView(320, 240, 2)};
  views.push_back({CameraOfSize(320, 240), cv::Mat1f(240, 320, 0.0f)});
  views.push_back(views.front());
  PlaneExtractor used(PixelRays(views[0].camera), {}, {});
  for (std::size_t k = 0; k < views.size(); ++k) {
    SCOPED_TRACE(k);
    Frame by_used = closed_form::MakeFrame(views[k].depth_m);
    Frame by_fresh = closed_form::MakeFrame(views[k].depth_m);
    used.Extract(by_used);
    ExtractPlanes(by_fresh, PixelRays(views[k].camera), {});
    if (k == 0) {
      EXPECT_GT(by_fresh.planes.size(), 4u);
    }
    ExpectTheSame(by_used, by_fresh);
  }
}

}  // namespace
}  // namespace slam
