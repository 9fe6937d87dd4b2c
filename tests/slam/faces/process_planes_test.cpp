#include "slam/faces/process_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// A book on a desk, its box around all that is seen of it.
struct BookOnDesk {
  explicit BookOnDesk(bool noisy) {
    world = closed_form::Desk();
    closed_form::PutOnDesk(world, 0.0, 0.0, {0.15, 0.22, 0.025}, 0.4, "book");
    T_cw = closed_form::LookAt({0.05, -0.5, 0.6}, {0, 0, 0});
    const closed_form::View view = closed_form::Render(world, camera, T_cw);
    frame = closed_form::MakeFrame(noisy ? closed_form::AddKinectNoise(view.depth_m, 5)
                                         : view.depth_m);
    Detection book;
    book.class_name = "book", book.kind = ClassKind::kRegular, book.score = 0.9;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        if (view.face(v, u) >= closed_form::FaceId(1, 0)) book.box_px.Include({u, v});
      }
    }
    frame.detections = {book};
    ExtractPlanes(frame, PixelRays(camera), {});
    ProcessPlanes(frame, camera, {}, {});
  }
  /// Largest distance of a found vertex from the nearest true corner; -1 unless there are four.
  double WorstVertex_m() const {
    for (const FramePlane& plane : frame.planes) {
      if (plane.class_name != "book" || plane.vertices_c.size() != 4) continue;
      double worst = 0.0;
      for (const Eigen::Vector3d& corner_w : closed_form::TopCorners(world.boxes[1])) {
        double nearest = 1e9;
        for (const Vertex& v : plane.vertices_c) {
          nearest = std::min(nearest, (v.p_c - T_cw * corner_w).norm());
        }
        worst = std::max(worst, nearest);
      }
      return worst;
    }
    return -1.0;
  }
  Camera camera;
  closed_form::World world;
  Pose T_cw;
  Frame frame;
};

TEST(ProcessPlanes, FindTheFourCornersOfABook) {
  const BookOnDesk exact(false), noisy(true);
  // A pixel is 1.5 x 2 mm on the book: silhouettes are exact to half of it, and noise bends
  // them.
  EXPECT_GE(exact.WorstVertex_m(), 0.0);
  EXPECT_LT(exact.WorstVertex_m(), 0.003);
  EXPECT_GE(noisy.WorstVertex_m(), 0.0);
  EXPECT_LT(noisy.WorstVertex_m(), 0.008);
}

TEST(ProcessPlanes, TieTheBookAndNotTheDesk) {
  const BookOnDesk scene(true);
  int books = 0, desks = 0;
  for (const FramePlane& plane : scene.frame.planes) {
    books += plane.class_name == "book" ? 1 : 0;
    if (plane.pixel_count > 60000) {
      EXPECT_EQ(plane.class_name, "") << "the desk";
      ++desks;
    }
    EXPECT_EQ(plane.bad, std::nullopt);
    EXPECT_GT(plane.inlier_ratio, 0.9);
  }
  EXPECT_GE(books, 1);
  EXPECT_GE(desks, 1);
}

TEST(ProcessPlanes, TakeAThingOfAnUnknownKindForOneThatNoDetectionSpeaksFor) {
  BookOnDesk known(false), unknown(false);
  known.frame.detections.clear();
  unknown.frame.detections[0].class_name = "atlas";
  unknown.frame.detections[0].kind = ClassKind::kOther;
  ProcessPlanes(known.frame, known.camera, {}, {});
  ProcessPlanes(unknown.frame, unknown.camera, {}, {});
  ASSERT_EQ(known.frame.planes.size(), unknown.frame.planes.size());
  std::size_t corners = 0;
  for (std::size_t k = 0; k < known.frame.planes.size(); ++k) {
    EXPECT_EQ(unknown.frame.planes[k].lines_c.size(), known.frame.planes[k].lines_c.size());
    EXPECT_EQ(unknown.frame.planes[k].vertices_c.size(),
              known.frame.planes[k].vertices_c.size());
    corners += unknown.frame.planes[k].vertices_c.size();
  }
  EXPECT_GE(corners, 4u);
}

TEST(ProcessPlanes, DrawNoLinesOnAnUnstructuredObject) {
  BookOnDesk scene(false);
  scene.frame.detections[0].class_name = "teddy bear";
  scene.frame.detections[0].kind = ClassKind::kUnstructured;
  ProcessPlanes(scene.frame, scene.camera, {}, {});
  int bad = 0;
  for (const FramePlane& plane : scene.frame.planes) {
    if (plane.class_name != "teddy bear") continue;
    EXPECT_TRUE(plane.lines_c.empty());
    EXPECT_TRUE(plane.vertices_c.empty());
    bad += plane.bad == BadReason::kUnstructured ? 1 : 0;
  }
  EXPECT_GE(bad, 1);
}

// A detector that names everything now and then sees a person in all of the picture.
TEST(ProcessPlanes, BelieveOfUnstructuredThingsWhatTheyBelieveOfOthers) {
  BookOnDesk scene(false);
  const PlaneProcessingConfig config;
  Detection person;
  person.class_name = "person", person.kind = ClassKind::kUnstructured;
  person.box_px = scene.camera.ImageBox();
  scene.frame.detections = {person};
  for (const double beside : {-0.01, 0.01}) {
    scene.frame.detections[0].score = config.box_link.min_score + beside;
    ProcessPlanes(scene.frame, scene.camera, {}, config);
    ASSERT_FALSE(scene.frame.planes.empty());
    for (const FramePlane& plane : scene.frame.planes)
      EXPECT_EQ(plane.bad == BadReason::kUnstructured, beside > 0);
  }
}

TEST(ProcessPlanes, FindTheFourCornersOfABookThatNoDetectionSpeaksFor) {
  BookOnDesk scene(true);
  scene.frame.detections.clear();
  ProcessPlanes(scene.frame, scene.camera, {}, {});
  double worst = 1.0;
  for (const FramePlane& plane : scene.frame.planes) {
    if (plane.vertices_c.size() != 4 || plane.area_m2 > 0.1) continue;  // the desk is larger
    for (const Eigen::Vector3d& corner_w : closed_form::TopCorners(scene.world.boxes[1])) {
      double nearest = 1e9;
      for (const Vertex& v : plane.vertices_c) {
        nearest = std::min(nearest, (v.p_c - scene.T_cw * corner_w).norm());
      }
      worst = worst == 1.0 ? nearest : std::max(worst, nearest);
    }
  }
  EXPECT_LT(worst, 0.012);
}

TEST(ProcessPlanes, AcceptAFrameWithoutPlanes) {
  Frame frame;
  ProcessPlanes(frame, Camera{}, {}, {});
  EXPECT_TRUE(frame.planes.empty());
}

/// Corners of a sheet in front of a wall, both seen frontally, that leans sideways in its plane.
std::size_t CornersOfSheet(double lean_rad, bool detected,
                           ClassKind kind = ClassKind::kRegular) {
  const Camera camera;
  Frame frame = closed_form::MakeFrame(cv::Mat1f(camera.height, camera.width, 1.2f));
  Detection sheet;
  sheet.class_name = "book", sheet.kind = kind, sheet.score = 0.9;
  for (int v = 170; v < 310; ++v) {
    const double middle = 320 + std::tan(lean_rad) * (v - 240);
    for (int u = 0; u < camera.width; ++u) {
      if (std::abs(u - middle) > 100) continue;
      frame.depth_m(v, u) = 1.0f;
      sheet.box_px.Include({u, v});
    }
  }
  if (detected) frame.detections = {sheet};
  ExtractPlanes(frame, PixelRays(camera), {});
  ProcessPlanes(frame, camera, {}, {});
  std::size_t sheets = 0, corners = 0;
  for (const FramePlane& plane : frame.planes) {
    if (std::abs(plane.centroid_c.z() - 1.0) > 0.05) continue;
    EXPECT_EQ(plane.detection.has_value(), detected);
    ++sheets, corners += plane.vertices_c.size();
  }
  EXPECT_EQ(sheets, 1u);
  return corners;
}

TEST(ProcessPlanes, TakeCornersOffTheSquareOnlyWhereADetectionSpeaksForThem) {
  const UnlinkedConfig unlinked;
  const double nearly_square_rad = 0.5 * unlinked.max_square_error_rad;
  const double oblique_rad =
      0.5 * (unlinked.max_square_error_rad + VertexConfig{}.max_square_error_rad);
  EXPECT_EQ(CornersOfSheet(nearly_square_rad, false), 4u);
  EXPECT_EQ(CornersOfSheet(nearly_square_rad, true), 4u);
  EXPECT_EQ(CornersOfSheet(oblique_rad, true), 4u);
  EXPECT_EQ(CornersOfSheet(oblique_rad, false), 0u) << "its shape alone is no rectangle's";
  EXPECT_EQ(CornersOfSheet(oblique_rad, true, ClassKind::kOther), 0u)
      << "nor does a thing's name say so that may be of any shape";
}

/// Puts a cylinder that stands upright on the desk into a view of it. @returns where it is seen
cv::Mat1b PutCup(const Camera& camera, const Pose& T_cw, double radius_m, double height_m,
                 cv::Mat1f& depth_m) {
  const Pose T_wc = Inverse(T_cw);
  cv::Mat1b seen(depth_m.size(), std::uint8_t{0});
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = T_wc.R * camera.Backproject({u, v}, 1.0);
      const Eigen::Vector2d r = ray.head<2>(), m = T_wc.t.head<2>();
      const double a = r.dot(r), b = r.dot(m), c = m.dot(m) - radius_m * radius_m;
      const double root = b * b - a * c;
      if (root < 0) continue;
      const double z = (-b - std::sqrt(root)) / a, up_m = T_wc.t.z() + z * ray.z();
      if (up_m < 0 || up_m > height_m || z > static_cast<double>(depth_m(v, u))) continue;
      depth_m(v, u) = static_cast<float>(z);
      seen(v, u) = 255;
    }
  }
  return seen;
}

// Noise hides how round the narrowest are.
TEST(ProcessPlanes, TrustFewPiecesOfACup) {
  const Camera camera;
  const closed_form::World desk = closed_form::Desk();
  int pieces = 0, trusted = 0;
  for (const double radius_m : {0.03, 0.04, 0.06}) {
    for (const double away_m : {0.5, 0.7, 0.9}) {
      SCOPED_TRACE(testing::Message() << radius_m << " m, from " << away_m << " m");
      const Pose T_cw = closed_form::LookAt({0.05, -away_m, 0.5 * away_m}, {0, 0, 0.05});
      cv::Mat1f depth_m = closed_form::Render(desk, camera, T_cw).depth_m;
      const cv::Mat1b cup = PutCup(camera, T_cw, radius_m, 0.12, depth_m);
      Frame frame = closed_form::MakeFrame(closed_form::AddKinectNoise(depth_m, 7));
      ExtractPlanes(frame, PixelRays(camera), {});
      ProcessPlanes(frame, camera, {}, {});
      for (const FramePlane& plane : frame.planes) {
        const int on_cup = cv::countNonZero((frame.plane_labels == plane.index + 1) & cup);
        if (2 * on_cup < plane.pixel_count) {
          EXPECT_FALSE(plane.bad) << "the desk";
          continue;
        }
        ++pieces, trusted += plane.bad ? 0 : 1;
      }
    }
  }
  EXPECT_GE(pieces, 12);
  EXPECT_LE(4 * trusted, pieces) << trusted;
}

}  // namespace
}  // namespace slam
