#include "slam/faces/select.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

/// A plane 1 m away, tied to a book, complete: nothing is wrong with it.
struct GoodBook {
  GoodBook() {
    Detection book;
    book.class_name = "book", book.kind = ClassKind::kRegular, book.score = 0.9;
    book.box_px = {Eigen::Vector2d(100, 100), Eigen::Vector2d(200, 200)};
    detections = {book};
    plane.centroid_c = {0, 0, 1};
    plane.inlier_ratio = 0.95;
    plane.detection = 0;
    SetEdge(0.0, EdgeKind::kSurface);
    plane.lines_c.resize(4);
    plane.vertices_c.resize(4);
  }
  /// 100 edge points down the box, the first `share` of them at the left border of the image.
  void SetEdge(double share, EdgeKind kind) {
    plane.edge_points.clear();
    plane.box_px = {};
    for (int k = 0; k < 100; ++k) {
      const bool at_border = k < 100 * share;
      const Eigen::Vector2d u(at_border ? 0.0 : 150.0, 100.0 + k);
      plane.edge_points.push_back(
          {Eigen::Vector3d(0, 0, 1), u, at_border ? EdgeKind::kBorder : kind});
      plane.box_px.Include(u);
    }
    plane.box_px.Include({110, 190});
  }
  std::optional<BadReason> Fault() const {
    return FindFault(plane, detections, 0.3, usual, camera, config);
  }
  FramePlane plane;
  UsualRoughness usual{.coarse = 0.9, .growth = 2.0};
  std::vector<Detection> detections;
  Camera camera;
  SelectConfig config;
};

TEST(Select, TrustsACompleteBook) {
  GoodBook book;
  EXPECT_EQ(book.Fault(), std::nullopt);
  book.config.structure = StructureRule::kComplete;
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, RefusesAPlaneBeyondTheDistanceAndKeepsOneWithin) {
  GoodBook book;
  book.plane.centroid_c = {0, 0, book.config.max_distance_m + 0.01};
  EXPECT_EQ(book.Fault(), BadReason::kFar);
  book.plane.centroid_c = {0, 0, book.config.max_distance_m - 0.01};
  EXPECT_EQ(book.Fault(), std::nullopt);
  book.plane.centroid_c.z() = std::nan("");
  EXPECT_EQ(book.Fault(), BadReason::kFar);
}

TEST(Select, MeasuresTheDistanceFromTheCameraAsWellOffItsAxis) {
  GoodBook book;
  const Eigen::Vector3d aside = Eigen::Vector3d(0.5, -0.4, 0.9).normalized();
  book.plane.centroid_c = (book.config.max_distance_m + 0.01) * aside;
  EXPECT_EQ(book.Fault(), BadReason::kFar);
  book.plane.centroid_c = (book.config.max_distance_m - 0.01) * aside;
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, RefusesAPlaneThatNoPointLiesOn) {
  GoodBook book;
  book.plane.inlier_ratio = 0;
  EXPECT_EQ(book.Fault(), BadReason::kInliers);
  book.plane.inlier_ratio = 0.01;
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, RefusesWhatIsRougherThanMostOfTheFrame) {
  GoodBook book;
  book.plane.roughness = {.fine = 0.45, .coarse = 0.9 * book.config.max_roughness + 0.01};
  EXPECT_EQ(book.Fault(), BadReason::kInliers);
  book.usual.coarse = 1.0;  // a noisier frame
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, TrustsASurfaceAsNoisyOverEightPixelsAsItsNeighboursAre) {
  GoodBook book;  // five times the variance of the others
  book.plane.roughness = {.fine = 2.25, .coarse = 4.5 * book.config.max_roughness - 0.01};
  EXPECT_EQ(book.Fault(), std::nullopt);
  book.plane.roughness.coarse += 0.02;
  EXPECT_EQ(book.Fault(), BadReason::kInliers);
}

TEST(Select, RefusesWhatIsRoundBeyondNoiseAndBend) {
  GoodBook book;
  const double round_per_m = book.config.max_curvature_per_m + 0.01;
  book.plane.curvature = {round_per_m, round_per_m / 3.01};
  EXPECT_EQ(book.Fault(), BadReason::kInliers);
  book.plane.curvature.sigma_per_m = round_per_m / 2.99;
  EXPECT_EQ(book.Fault(), std::nullopt);
  book.plane.curvature.sigma_per_m = book.plane.bend_curvature_per_m = round_per_m / 4.25;
  EXPECT_EQ(book.Fault(), BadReason::kInliers);  // 1 / 3.005 together
  book.plane.bend_curvature_per_m = round_per_m / 4.2;
  book.plane.curvature.sigma_per_m = round_per_m / 4.2;
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, TrustsWhatIsSurelyCurvedButHardly) {
  GoodBook book;  // a desk that hangs through
  book.plane.curvature = {book.config.max_curvature_per_m - 0.01, 0.001};
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, CallsNothingRoughThatIsCleanerThanTheModel) {
  GoodBook book;
  book.usual = {.coarse = 1e-6, .growth = 1.0};
  book.plane.roughness = {.fine = 1e-6, .coarse = 1e-3};
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, FindsTheRoughnessOfMostPixels) {
  const auto face = [](int pixels, double fine, double coarse) {
    FramePlane plane;
    plane.pixel_count = pixels, plane.roughness = {fine, coarse};
    return plane;
  };
  const auto usual = [](const std::vector<FramePlane>& planes) {
    const UsualRoughness found = FindUsualRoughness(planes);
    return std::pair(found.coarse, found.growth);
  };
  EXPECT_EQ(usual({}), std::pair(0.0, 0.0));
  EXPECT_EQ(usual({face(500, 1.0, 0.0)}), std::pair(0.0, 0.0));  // narrow: unknown
  EXPECT_EQ(usual({face(500, 0.0, 0.7)}), std::pair(0.7, 0.0));
  // Medians over pixels, each of its own order; what is narrow counts in neither.
  EXPECT_EQ(usual({face(100, 1.0, 3.0), face(100, 0.5, 2.5), face(1000, 0.9, 0.9),
                   face(500, 0.2, 0.8), face(300, 0.3, 0.6), face(9000, 1.0, 0.0)}),
            std::pair(0.9, 1.0));
  EXPECT_EQ(usual({face(400, 1.0, 2.0), face(300, 0.5, 1.5), face(500, 4.0, 4.0)}),
            std::pair(2.0, 2.0));
}

TEST(Select, AsPrintedRefusesAFaceAtTheBorder) {
  GoodBook book;
  book.config.structure = StructureRule::kComplete;
  book.SetEdge(0.10, EdgeKind::kSurface);
  EXPECT_EQ(book.Fault(), BadReason::kBorder);
  book.SetEdge(0.04, EdgeKind::kSurface);
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, AsPrintedTakesForTheBorderWhatIsAtItAndWhatTheContourCallsSo) {
  GoodBook book;
  book.config.structure = StructureRule::kComplete;
  book.SetEdge(0.10, EdgeKind::kSurface);
  for (EdgePoint& edge : book.plane.edge_points) edge.kind = EdgeKind::kSurface;
  EXPECT_EQ(book.Fault(), BadReason::kBorder);  // by their place
  book.SetEdge(0.10, EdgeKind::kSurface);
  for (EdgePoint& edge : book.plane.edge_points) edge.u_px.x() = 150;
  EXPECT_EQ(book.Fault(), BadReason::kBorder);  // by their kind
}

TEST(Select, AsPrintedRefusesAFaceWithoutFourVertices) {
  GoodBook book;
  book.config.structure = StructureRule::kComplete;
  book.plane.vertices_c.resize(3);
  EXPECT_EQ(book.Fault(), BadReason::kStructure);
}

TEST(Select, KeepsAPartlyHiddenOrCutFaceByDefault) {
  GoodBook book;
  book.plane.lines_c.clear();
  book.plane.vertices_c.resize(1);
  EXPECT_EQ(book.Fault(), std::nullopt);
  book.SetEdge(0.6, EdgeKind::kSurface);
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, AsksNoStructureOfAPlaneWithoutABox) {
  GoodBook book;
  book.plane.detection.reset();
  book.plane.lines_c.clear();
  book.plane.vertices_c.clear();
  book.config.structure = StructureRule::kComplete;
  EXPECT_EQ(book.Fault(), std::nullopt);
}

TEST(Select, RefusesAPlaneInThePersonsBox) {
  GoodBook book;
  book.plane.detection.reset();
  Detection person = book.detections[0];
  person.class_name = "person", person.kind = ClassKind::kUnstructured;
  book.detections = {person};
  EXPECT_EQ(book.Fault(), BadReason::kUnstructured);
  book.detections[0].box_px.max.y() = 140.0;  // 41 of the 100 edge points
  EXPECT_EQ(book.Fault(), std::nullopt);
}

// Detectors that write all they have tell a person of .06 in any box.
TEST(Select, LeavesAPlaneToADetectionThatIsHardlyBelieved) {
  GoodBook book;
  book.plane.detection.reset();
  Detection person;
  person.class_name = "person", person.kind = ClassKind::kUnstructured;
  person.box_px = book.plane.box_px;
  for (const double score : {0.06, 0.3, 0.31}) {
    person.score = score;
    book.detections = {person};
    EXPECT_EQ(book.Fault().has_value(), score > 0.3) << score;
  }
}

TEST(Select, RefusesAPlaneOfAThingThatFitsBetterWhateverOtherThingsFitWorse) {
  GoodBook book;
  Detection person, plant;
  person.class_name = "person", person.kind = ClassKind::kUnstructured;
  person.score = 0.9;
  person.box_px = {Eigen::Vector2d(0, 0), Eigen::Vector2d(400, 479)};
  plant.class_name = "potted plant", plant.kind = ClassKind::kUnstructured;
  plant.score = 0.9;
  plant.box_px = book.plane.box_px;
  const Detection own = book.detections[0];
  book.detections = {own, person, plant};
  EXPECT_EQ(book.Fault(), BadReason::kUnstructured);
  book.detections = {own, plant, person};
  EXPECT_EQ(book.Fault(), BadReason::kUnstructured);
}

TEST(Select, KeepsABookInFrontOfAPersonWhenItsOwnBoxFitsBetter) {
  GoodBook book;
  Detection person;
  person.class_name = "person", person.kind = ClassKind::kUnstructured;
  person.score = 0.9;
  person.box_px = {Eigen::Vector2d(0, 0), Eigen::Vector2d(400, 479)};
  book.detections.push_back(person);
  EXPECT_EQ(book.Fault(), std::nullopt);
}

}  // namespace
}  // namespace slam
