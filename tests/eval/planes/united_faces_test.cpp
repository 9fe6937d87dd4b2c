// Which faces of a scene are one true plane.
#include "eval/planes/united_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "eval/planes/polygon.h"
#include "tests/support/image_files.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using ::testing::ElementsAre;

/// Rectangles that face -y, in one scene; every face is an object of its own.
class UnitedFaces : public ::testing::Test {
 protected:
  /// @param y_m  its plane; faces at 0 are the usual ones
  void AddFace(int id, double x0_m, double x1_m, int group, double y_m = 0, double z0_m = 0,
               double z1_m = 0.8) {
    TruthObject object;
    object.id = id;
    object.role = Role::kRegular;
    object.regular = true;
    object.detection_group = group;
    TruthPlane face;
    face.id = face.object = id;
    face.pi_g = {Eigen::Vector3d(0, -1, 0), y_m};
    face.area_m2 = (x1_m - x0_m) * (z1_m - z0_m);
    face.vertices_g = {
        {x0_m, y_m, z0_m}, {x1_m, y_m, z0_m}, {x1_m, y_m, z1_m}, {x0_m, y_m, z1_m}};
    face.scored = true;
    scene_.objects.push_back(object);
    scene_.planes.push_back(face);
  }
  Sequence AsRead() const {
    Sequence sequence;
    sequence.scene = scene_;
    return sequence;
  }
  std::vector<int> Ids() const {
    const Sequence united = WithUnitedFaces(AsRead());
    std::vector<int> ids;
    for (const TruthPlane& plane : united.scene->planes) ids.push_back(plane.id);
    return ids;
  }

  SceneTruth scene_;
};

TEST_F(UnitedFaces, AreTheTwoDoorsOfACabinetWithTheCornersOfBoth) {
  AddFace(4, 0, 0.400, 7);
  AddFace(9, 0.404, 0.804, 7);
  const Sequence united = WithUnitedFaces(AsRead());
  ASSERT_EQ(united.scene->planes.size(), 1u);
  const TruthPlane& front = united.scene->planes[0];
  EXPECT_EQ(front.id, 4);
  EXPECT_NEAR(front.area_m2, 2 * 0.4 * 0.8, 1e-12) << "the joint is no area";
  ASSERT_EQ(front.vertices_g.size(), 4u) << "the ends of the joint are no corners";
  const Polygon2 outline = Project(ChartOf(front.pi_g, {0, 0, 0}), front.vertices_g);
  EXPECT_NEAR(Area(outline), 0.804 * 0.8, 1e-12);
}

TEST_F(UnitedFaces, AreABlockOfThreeThatMeetInTurn) {
  AddFace(1, 0, 0.2, 3);
  AddFace(2, 0.44, 0.6, 3);  // meets the third only
  AddFace(5, 0.22, 0.42, 3);
  EXPECT_THAT(Ids(), ElementsAre(1));
}

TEST_F(UnitedFaces, AreThoseOfOneObjectThatIsInNoGroup) {
  AddFace(1, 0, 0.4, 0);
  AddFace(2, 0.4, 0.8, 0);
  scene_.planes[1].object = 1;
  EXPECT_THAT(Ids(), ElementsAre(1));
}

TEST_F(UnitedFaces, AreNotThoseOfTwoThings) {
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0.4, 0.8, 8);
  AddFace(3, 0.8, 1.2, 0);  // a thing by itself each
  AddFace(4, 1.2, 1.6, 0);
  EXPECT_THAT(Ids(), ElementsAre(1, 2, 3, 4));
}

TEST_F(UnitedFaces, AreNotApartByMoreThanAJoint) {
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0.431, 0.8, 7);
  EXPECT_THAT(Ids(), ElementsAre(1, 2));
  scene_ = {};
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0.429, 0.8, 7);
  EXPECT_THAT(Ids(), ElementsAre(1));
}

// Corners of the small one are beside the middle of the large one's side, whose own are far off.
TEST_F(UnitedFaces, MeetAlsoWhereOnlyTheCornersOfTheLatterAreNear) {
  for (const int small : {1, 2}) {
    for (const double gap_m : {0.029, 0.031}) {
      scene_ = {};
      for (const int id : {1, 2}) {
        if (id == small) AddFace(id, 0.4 + gap_m, 0.8, 7, 0, 0.3, 0.5);
        if (id != small) AddFace(id, 0, 0.4, 7);
      }
      EXPECT_EQ(Ids().size(), gap_m < 0.03 ? 1u : 2u) << small << ", " << gap_m;
    }
  }
}

TEST_F(UnitedFaces, HaveNoStepBetweenThem) {
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0.4, 0.8, 7, 0.0005);
  EXPECT_THAT(Ids(), ElementsAre(1, 2));
}

TEST_F(UnitedFaces, HaveNoAngleBetweenThem) {
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0.4, 0.8, 7);
  for (Eigen::Vector3d& vertex : scene_.planes[1].vertices_g) {
    vertex.y() = 0.001 * (vertex.x() - 0.4);  // 0.4 mm at its far edge
  }
  EXPECT_THAT(Ids(), ElementsAre(1, 2));
}

TEST_F(UnitedFaces, AreNotFrontAndBack) {
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0, 0.4, 7);
  scene_.planes[1].pi_g.n *= -1;
  EXPECT_THAT(Ids(), ElementsAre(1, 2));
}

TEST_F(UnitedFaces, LeaveWhatIsNotScoredAlone) {
  AddFace(1, 0, 0.4, 7);
  AddFace(2, 0.4, 0.8, 7);
  scene_.planes[1].scored = false;
  EXPECT_THAT(Ids(), ElementsAre(1, 2));
}

TEST_F(UnitedFaces, GoByOneIdInImagesAndCountsToo) {
  AddFace(4, 0, 0.4, 7);
  AddFace(9, 0.4, 0.8, 7);
  AddFace(11, 3, 4, 0);
  const test_support::TemporaryFolder folder;
  cv::Mat1w ids(1, 4);
  ids << 4, 9, 11, 0;
  test_support::WriteImageFile(folder / "1.000000.png", ids);
  Sequence sequence = AsRead();
  sequence.plane_id_files = StampedFiles(folder.path());
  sequence.frame_truth = {{1.0, {}, {{4, 100}, {9, 40}, {11, 5}}}};
  const Sequence united = WithUnitedFaces(sequence);
  const auto shown = ReadPlaneIds(united, 1.0);
  ASSERT_TRUE(shown);
  EXPECT_THAT(std::vector<int>(shown->begin(), shown->end()), ElementsAre(4, 4, 11, 0));
  const std::vector<VisiblePlane>& seen = united.frame_truth[0].planes;
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].id, 4);
  EXPECT_EQ(seen[0].pixels, 140);
  EXPECT_EQ(seen[1].pixels, 5);
}

TEST_F(UnitedFaces, AreNotThoseOfAGroupAndOfAThingWhoseIdIsItsNumber) {
  AddFace(2, 0.4, 0.8, 5);
  AddFace(5, 0, 0.4, 0);
  EXPECT_THAT(Ids(), ElementsAre(2, 5));
}

TEST_F(UnitedFaces, HaveTheHolesOfAll) {
  for (const double x_m : {0.0, 0.4, 0.8}) {
    AddFace(static_cast<int>(scene_.planes.size()) + 1, x_m, x_m + 0.4, 7);
    scene_.planes.back().holes_g = {
        {{x_m + 0.1, 0, 0.1}, {x_m + 0.2, 0, 0.1}, {x_m + 0.2, 0, 0.2}}};
  }
  const Sequence united = WithUnitedFaces(AsRead());
  ASSERT_EQ(united.scene->planes.size(), 1u);
  const auto& holes_g = united.scene->planes[0].holes_g;
  ASSERT_EQ(holes_g.size(), 3u);
  for (std::size_t i = 0; i < holes_g.size(); ++i)
    EXPECT_TRUE(holes_g[i] == scene_.planes[i].holes_g[0]) << i;
}

}  // namespace
}  // namespace eval
