#include "sim/trace/box_outline.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/base/random.h"
#include "sim/trace/exact_cast.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

int PixelsByCasting(const Object& box, const Pose& T_wc, const Camera& camera) {
  Scene scene;
  scene.objects = {box};
  const ExactCaster caster(BuildMesh(scene).triangles);
  int count = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      count += caster.Nearest(T_wc.t, T_wc.R * camera.Ray(u, v), 0).triangle >= 0 ? 1 : 0;
    }
  }
  return count;
}

void ExpectTheSameAsByCasting(const Camera& camera, int views) {
  const ImageRays rays(camera);
  const cv::Rect all(0, 0, camera.width, camera.height);
  int seen = 0;
  for (int i = 0; i < views; ++i) {
    Random random{77, static_cast<std::uint64_t>(i)};
    const auto draw = [&](double reach) {
      return Eigen::Vector3d(random.Between(-reach, reach), random.Between(-reach, reach),
                             random.Between(-reach, reach));
    };
    // Some reach behind the camera, some hold it.
    Object box = BoxObject(1, "box", Role::kRegular, draw(0.8),
                           draw(0.6).cwiseAbs() + Eigen::Vector3d::Constant(0.001));
    box.q_wo = Eigen::AngleAxisd(random.Between(-3, 3), draw(1).normalized());
    const Pose T_wc = LookAt(draw(0.8), draw(0.3));
    const int expected = PixelsByCasting(box, T_wc, camera);
    seen += expected > 0 ? 1 : 0;
    cv::Mat1b covered(all.size(), uchar{0});
    EXPECT_EQ(BoxOutline(box, T_wc).PixelsInside(camera, rays, all, &covered), expected)
        << "view " << i;
    EXPECT_EQ(cv::countNonZero(covered), expected) << "view " << i;
  }
  EXPECT_GT(seen, views / 4);
}

TEST(BoxOutline, HoldsThePixelsWhoseRaysMeetTheBox) {
  ExpectTheSameAsByCasting(Resize(Camera{}, 64, 48), 60);
}

TEST(BoxOutline, HoldsThePixelsWhoseRaysMeetTheBoxBehindALens) {
  ExpectTheSameAsByCasting(WithLens(Resize(Camera{}, 64, 48), {-0.2, 0.05, 0.002, -0.001, 0.0}),
                           20);
}

// Pixels whose rays lie in a side's plane, as good as exactly: rounding must go the same way.
TEST(BoxOutline, AsksPixelsBehindALensAsMeetsDoes) {
  const Camera camera = WithLens(Resize(Camera{}, 64, 48), {0.26, -0.95, -0.005, 0.003, 1.1});
  const ImageRays rays(camera);
  Random random{78};
  for (int i = 0; i < 300; ++i) {
    Pose T_wc;  // at the world's origin
    const int u = random.Below(camera.width), v = random.Below(camera.height);
    const Eigen::Vector3d corner = random.Between(0.5, 2) * rays.At(u, v);
    const Object box = BoxObject(1, "box", Role::kRegular,
                                 corner + Eigen::Vector3d(0.1, 0.15, 0.2), {0.2, 0.3, 0.4});
    const BoxOutline outline(box, T_wc);
    const cv::Rect area(std::max(u - 9, 0), std::max(v - 7, 0),
                        std::min(19, camera.width - std::max(u - 9, 0)),
                        std::min(15, camera.height - std::max(v - 7, 0)));
    int expected = 0;
    for (int y = area.y; y < area.br().y; ++y) {
      for (int x = area.x; x < area.br().x; ++x) {
        expected += outline.Meets(rays.At(x, y)) ? 1 : 0;
      }
    }
    EXPECT_EQ(outline.PixelsInside(camera, rays, area), expected) << "box " << i;
  }
}

}  // namespace
}  // namespace sim
