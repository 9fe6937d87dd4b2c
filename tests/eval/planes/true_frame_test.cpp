// What the truth says of a frame, against pixels counted one by one.
#include "eval/planes/true_frame.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "eval/formats/stamps.h"
#include "io/input_error.h"
#include "tests/eval/tiny_world.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using testing::TinyFrame;
using testing::TinyWorld;

class TrueFrameOfTinyWorld : public ::testing::Test {
 protected:
  TrueFrameOfTinyWorld() {
    world_.WriteSequence(folder_);
    sequence_ = ReadSequence(folder_);
  }

  TrueFrame Read(const TinyFrame& frame) const {
    return ReadTrueFrame(sequence_, frame.stamp_s, frame.T_gc);
  }

  TinyWorld world_;
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
  Sequence sequence_;
};

struct Counted {
  int pixels = 0;
  double incidence_deg = 0.0;  ///< at the mean of the pixels
};

Counted CountPixels(const TinyFrame& frame, const testing::TinyPlane& plane) {
  Counted counted;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < frame.plane_ids.rows; ++y) {
    for (int x = 0; x < frame.plane_ids.cols; ++x) {
      if (frame.plane_ids(y, x) != plane.id) continue;
      ++counted.pixels;
      sum += TinyWorld::Ray(x, y);
    }
  }
  const Eigen::Vector3d sight_g = frame.T_gc.R * sum.normalized();
  counted.incidence_deg = std::acos(-plane.pi_g.n.dot(sight_g)) * 180.0 / std::numbers::pi;
  return counted;
}

TEST_F(TrueFrameOfTinyWorld, HasThePixelsAndTheIncidenceOfEachPlane) {
  int compared = 0;
  for (std::size_t i = 0; i < world_.frames.size(); i += 11) {
    const TinyFrame& frame = world_.frames[i];
    const TrueFrame truth = Read(frame);
    for (const testing::TinyPlane& plane : world_.planes) {
      const Counted counted = CountPixels(frame, plane);
      const SeenPlane* seen = truth.Find(plane.id);
      ASSERT_EQ(seen != nullptr, counted.pixels > 0) << plane.id;
      if (seen == nullptr) continue;
      EXPECT_EQ(seen->plane->id, plane.id);
      EXPECT_EQ(seen->object->id, plane.object);
      EXPECT_EQ(seen->pixels, counted.pixels);
      EXPECT_NEAR(seen->incidence_deg, counted.incidence_deg, 1e-6);
      // 1,000 pixels at 640 x 480 are 62.5 here.
      EXPECT_EQ(seen->counted, counted.pixels >= 63 && counted.incidence_deg <= 75.0);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

TEST_F(TrueFrameOfTinyWorld, HasTheCornersThatAreInViewAndNotHidden) {
  const TinyFrame& frame = world_.frames[20];
  const TrueFrame truth = Read(frame);
  int tops = 0;
  for (const testing::TinyPlane& plane : world_.planes) {
    const SeenPlane* seen = truth.Find(plane.id);
    if (seen == nullptr || plane.id == TinyWorld::kDeskTop)
      continue;  // others hide parts of the desk
    ASSERT_EQ(seen->corners_c.size(), plane.corners_g.size());
    for (std::size_t k = 0; k < plane.corners_g.size(); ++k) {
      EXPECT_NEAR((frame.T_gc * seen->corners_c[k] - plane.corners_g[k]).norm(), 0.0, 1e-9);
      if (plane.id == TinyWorld::kThickTop || plane.id == TinyWorld::kThinTop) {
        EXPECT_EQ(seen->corner_in_view[k], TinyWorld::InImage(frame.T_gc, plane.corners_g[k]));
        ++tops;
      }
    }
  }
  EXPECT_GT(tops, 0) << "corners of the books' tops";
}

TEST_F(TrueFrameOfTinyWorld, SeesCornersThroughTheLens) {
  sequence_.plane_id_files = {};
  Camera& camera = *sequence_.true_camera;
  camera.distortion = {-0.35, 0.1, 0.004, -0.003, 0.0};  // a wide one draws the border in
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  int beside_the_pinhole = 0;
  for (const TinyFrame& frame : world_.frames) {
    for (const SeenPlane& seen : Read(frame).planes) {
      for (std::size_t k = 0; k < seen.corners_c.size(); ++k) {
        const Eigen::Vector3d& x_c = seen.corners_c[k];
        if (!(x_c.z() > 0) || (x_c.head<2>() / x_c.z()).norm() > 0.8) continue;  // may fold
        std::vector<cv::Point2d> pixel;
        cv::projectPoints(std::vector<cv::Point3d>{{x_c.x(), x_c.y(), x_c.z()}},
                          cv::Vec3d::all(0), cv::Vec3d::all(0), K, camera.distortion, pixel);
        const bool in_view = pixel[0].x >= 0 && pixel[0].x <= camera.width - 1 &&
                             pixel[0].y >= 0 && pixel[0].y <= camera.height - 1;
        EXPECT_EQ(seen.corner_in_view[k], in_view) << pixel[0];
        beside_the_pinhole += in_view != TinyWorld::InImage(frame.T_gc, frame.T_gc * x_c);
      }
    }
  }
  EXPECT_GT(beside_the_pinhole, 0);
}

// Where no image tells which part of a face is seen, it is looked at in its middle.
TEST_F(TrueFrameOfTinyWorld, HasTheIncidenceAtTheMiddleOfAFaceWithoutImages) {
  sequence_.plane_id_files = {};
  int compared = 0;
  for (const int i : {0, 20, 44}) {
    const TinyFrame& frame = world_.frames[static_cast<std::size_t>(i)];
    const TrueFrame truth = Read(frame);
    for (const testing::TinyPlane& plane : world_.planes) {
      const SeenPlane* seen = truth.Find(plane.id);
      if (seen == nullptr) continue;
      const Eigen::Vector3d middle_g = (plane.corners_g[0] + plane.corners_g[2]) / 2;
      const double cosine = plane.pi_g.n.dot((frame.T_gc.t - middle_g).normalized());
      EXPECT_NEAR(seen->incidence_deg, std::acos(cosine) * 180.0 / std::numbers::pi, 1e-6);
      ++compared;
    }
  }
  EXPECT_GT(compared, 5);
}

TEST_F(TrueFrameOfTinyWorld, NeedsTheCameraOfTheSequence) {
  std::filesystem::remove(folder_ / "camera.yaml");
  sequence_ = ReadSequence(folder_);
  EXPECT_THROW(Read(world_.frames[0]), io::InputError);
}

TEST_F(TrueFrameOfTinyWorld, WithoutImagesIsThatOfItsStampAlsoWhenItIsARoundingOff) {
  sequence_.plane_id_files = {};
  const TinyFrame& frame = world_.frames[7];
  const std::size_t seen = Read(frame).planes.size();
  ASSERT_GT(seen, 0u);
  for (const double rounding_s : {-0.5 * kSameStamp_s, 0.5 * kSameStamp_s}) {
    EXPECT_EQ(ReadTrueFrame(sequence_, frame.stamp_s + rounding_s, frame.T_gc).planes.size(),
              seen);
  }
}

// The outermost pixels of this lens look 40 degrees aside. Its formula goes on beyond, turns round
// there, and has a pixel in the middle of the image for what is 61 degrees aside.
TEST(TrueFrame, HasNoCornerInViewThatTheLensModelFoldsBackIntoTheImage) {
  Camera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 150, camera.cx = 79.5, camera.cy = 59.5;
  camera.distortion = {-0.3, 0, 0, 0, 0};
  TruthPlane wall;
  wall.id = 4;
  wall.scored = true;
  wall.pi_g = {Eigen::Vector3d(0, 0, -1), 1.0};
  wall.vertices_g = {{-0.2, -0.3, 1}, {1.8, 0, 1}, {-0.2, 0.3, 1}};
  const Eigen::Vector2d folded = PixelOf(camera, wall.vertices_g[1]);
  ASSERT_TRUE(folded.x() > 0 && folded.x() < camera.width - 1) << folded.transpose();
  Sequence sequence;
  sequence.true_camera = camera;
  sequence.scene.emplace().planes = {wall};
  sequence.frame_truth = {{1.0, {}, {{wall.id, 4000}}}};
  const TrueFrame frame = ReadTrueFrame(sequence, 1.0, {});
  ASSERT_EQ(frame.planes.size(), 1u);
  EXPECT_EQ(frame.planes[0].corner_in_view, (std::vector<bool>{true, false, true}));
}

}  // namespace
}  // namespace eval
