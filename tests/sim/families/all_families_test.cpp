#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/input_error.h"
#include "sim/families/families.h"
#include "sim/families/twin.h"
#include "sim/scene/geometry.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "sim/shapes/planes.h"

namespace sim {
namespace {

constexpr std::uint64_t kSeeds = 4;

class EveryFamily : public testing::TestWithParam<std::string> {};

Eigen::Vector3d InFrameOf(const Object& object, const Eigen::Vector3d& x_w) {
  return object.q_wo.inverse() * (x_w - object.center_w);
}

/// A grid all through the box and points along its edges.
std::vector<Eigen::Vector3d> PointsOf(const Object& box) {
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](double a, double b, double c) {
    points.push_back(box.center_w +
                     box.q_wo * Eigen::Vector3d(a, b, c).cwiseProduct(box.size / 2));
  };
  for (int i = 0; i < 5 * 5 * 5; ++i) {
    add(i % 5 / 2.0 - 1, i / 5 % 5 / 2.0 - 1, i / 25 / 2.0 - 1);
  }
  for (int i = 0; i <= 40; ++i) {
    const double at = i / 20.0 - 1;
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        add(at, a, b);
        add(a, at, b);
        add(a, b, at);
      }
    }
  }
  return points;
}

// Sampled points know nothing of separating axes.
TEST_P(EveryFamily, PutsNoPointOfAnObjectInsideAnother) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = MakeScene(GetParam(), seed);
    for (const Object& a : scene.objects) {
      const auto points = PointsOf(a);
      for (const Object& b : scene.objects) {
        const double reach = (a.size.norm() + b.size.norm()) / 2;
        if (a.id == b.id || (a.center_w - b.center_w).norm() > reach) continue;
        for (const Eigen::Vector3d& x_w : points) {
          const Eigen::Vector3d slack = b.size / 2 - InFrameOf(b, x_w).cwiseAbs();
          ASSERT_LE(slack.minCoeff(), kTouch_m)
              << "seed " << seed << ": " << a.name << " in " << b.name;
        }
      }
    }
  }
}

/// Where the thing (boxes that are detected as one) touches what is not part of it.
std::vector<Eigen::Vector2d> Contacts(const Scene& scene,
                                      const std::vector<const Object*>& thing) {
  constexpr double kContact_m = 2e-5;
  std::vector<Eigen::Vector2d> contacts;
  const auto touches = [&](const Object& solid, const Eigen::Vector3d& x_w) {
    return std::abs(DistanceToBox(solid, x_w)) < kContact_m;
  };
  for (const Object* part : thing) {
    const auto own = PointsOf(*part);
    const auto under = [&](const Eigen::Vector3d& x_w) {
      return InFrameOf(*part, x_w).z() < 0;
    };
    for (const Object& other : scene.objects) {
      if (std::find(thing.begin(), thing.end(), &other) != thing.end()) continue;
      const double reach = (part->size.norm() + other.size.norm()) / 2 + kContact_m;
      if ((part->center_w - other.center_w).norm() > reach) continue;
      for (const Eigen::Vector3d& x_w : own) {
        if (under(x_w) && touches(other, x_w)) contacts.push_back(x_w.head<2>());
      }
      for (const Eigen::Vector3d& x_w : PointsOf(other)) {
        if (under(x_w) && touches(*part, x_w)) contacts.push_back(x_w.head<2>());
      }
    }
  }
  return contacts;
}

/// Whether the point is in the convex hull: no line through it has all points on one side.
bool InHull(const Eigen::Vector2d& x, const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 3) return false;
  for (int i = 0; i < 720; ++i) {
    const Eigen::Vector2d axis(std::cos(M_PI * i / 360), std::sin(M_PI * i / 360));
    if (std::all_of(points.begin(), points.end(),
                    [&](const Eigen::Vector2d& p) { return axis.dot(p - x) > 1e-9; })) {
      return false;
    }
  }
  return true;
}

TEST_P(EveryFamily, RestsEveryThingUnderItsCentreOfMass) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = MakeScene(GetParam(), seed);
    std::map<std::string, std::vector<const Object*>> things;
    for (const Object& object : scene.objects) {
      if (object.class_name == "floor" || object.class_name == "wall") continue;
      if (!object.way.empty()) continue;  // it hangs or walks
      const int group = object.detection_group;
      things[group != 0 ? "group " + std::to_string(group) : object.name].push_back(&object);
    }
    for (const auto& [name, thing] : things) {
      double volume = 0;
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const Object* part : thing) {
        volume += part->size.prod();
        middle += part->size.prod() * part->center_w.head<2>();
      }
      // The middle of an open laptop would be over its hinge; a real base holds the weight.
      if (thing[0]->class_name == "laptop") middle = thing[0]->center_w.head<2>() * volume;
      EXPECT_TRUE(InHull(middle / volume, Contacts(scene, thing)))
          << "seed " << seed << ": " << name << " " << thing[0]->name << " would fall";
    }
  }
}

// At moments between the points of the way too, which the check of scenes does not look at.
TEST_P(EveryFamily, MovesNothingThroughWhatStands) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = MakeScene(GetParam(), seed);
    for (const Object& moving : scene.objects) {
      if (moving.way.empty()) continue;
      EXPECT_EQ(moving.role, Role::kUnstructured);
      for (double time_s = 0; time_s < moving.way.back().time_s + 1; time_s += 0.037) {
        const Object there = ObjectAt(moving, time_s);
        for (const Object& other : scene.objects) {
          if (!other.way.empty()) continue;
          ASSERT_LE(OverlapDepth(there, other), 0.005)
              << seed << " " << other.name << " at " << time_s << " s";
        }
      }
    }
  }
}

TEST_P(EveryFamily, ReadsBackFromItsFile) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = MakeScene(GetParam(), seed, {{"texture", 0.5}});
    EXPECT_EQ(SceneText(ParseScene(SceneText(scene), "text")), SceneText(scene));
  }
}

TEST_P(EveryFamily, DialsTheTextureOfEveryPrint) {
  const Scene rich = MakeScene(GetParam(), 1);
  const Scene poor = MakeScene(GetParam(), 1, {{"texture", 0.25}});
  const Scene bare = MakeScene(GetParam(), 1, {{"texture", 0}});
  ASSERT_EQ(poor.objects.size(), rich.objects.size());
  for (std::size_t i = 0; i < rich.objects.size(); ++i) {
    for (std::size_t face = 0; face < 6; ++face) {
      const double full = rich.objects[i].faces[face].richness;
      EXPECT_NEAR(poor.objects[i].faces[face].richness, 0.25 * full, 1e-6);
      EXPECT_EQ(bare.objects[i].faces[face].richness, 0);
    }
    EXPECT_EQ(poor.objects[i].center_w, rich.objects[i].center_w);
  }
}

std::vector<std::string> FamilyNames() {
  std::vector<std::string> names;
  for (const Family& family : Families()) names.push_back(family.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily, testing::ValuesIn(FamilyNames()),
                         [](const auto& one) { return one.param; });

// Recorded baselines stand on these very bytes.
TEST(MakeScene, StillGivesTheFirstFamiliesByteForByte) {
  const std::map<std::string, std::array<const char*, 4>> first{
      {"desk",
       {"cb13707138251e70", "463ab21b811b4b28", "859fe6e7226e95d2", "dbdf656d6f0c28ac"}},
      {"plates",
       {"124d472fbdd0f32d", "4282074874e043d8", "126c589e753ae7f4", "5a74d5f6715cdb82"}},
      {"stack",
       {"37301172cea8f578", "45e9e4e88e8b04f2", "2aa80bcad83ceb07", "441a3a88c12b4cc9"}}};
  for (const auto& [family, hashes] : first) {
    for (std::uint64_t seed = 0; seed < hashes.size(); ++seed) {
      EXPECT_EQ(SceneHash(MakeScene(family, seed)).substr(0, 16), hashes[seed])
          << family << " " << seed;
    }
  }
}

// The pages' figures stand on these bytes, whichever compiler built the program. Draws among the
// arguments of one call have no order of their own: the hand with a toy, which draws most, once differed.
TEST(MakeScene, GivesTheOtherFamiliesAndTheTwinsByteForByteByAnyCompiler) {
  const std::map<std::string, std::string> expected{{"coplanar", "38139799796ebbd5"},
                                                    {"tilted", "74019b4d2ef64f55"},
                                                    {"board", "379a205b786a2090"},
                                                    {"twins", "6c4dd53fa014f254"},
                                                    {"revisit", "1649f555756ddead"},
                                                    {"office", "35d143be753b2319"},
                                                    {"room", "1afbf41c4af75fec"},
                                                    {"cabinet", "364e4104c2dc06b3"},
                                                    {"wall", "a12c80e96de3a71c"},
                                                    {"passer", "f8bbced38f70091a"},
                                                    {"fr1-360", "e515dfe4a5ece7b5"},
                                                    {"fr1-desk", "343069f77f6ea6d8"},
                                                    {"fr1-desk2", "54a0f242055442eb"},
                                                    {"fr1-room", "ca7c2b4835d815aa"},
                                                    {"fr1-rpy", "f32ba03d3ae49d8b"},
                                                    {"fr1-xyz", "172194e9e215696c"},
                                                    {"fr2-desk", "42fd725df347a1c7"},
                                                    {"fr2-xyz", "23018b9b2bad878c"},
                                                    {"fr2-rpy", "aa5a77202d83cb1d"},
                                                    {"fr3-cabinet", "84dd47dc223cd741"},
                                                    {"fr3-l-cabinet", "715d4039725315a5"},
                                                    {"fr3-loh", "09f80acecce14c38"},
                                                    {"fr3-snf", "029044039a28c1e9"},
                                                    {"fr3-snn", "322b93e8de12e376"},
                                                    {"fr3-stf", "1231a4a9402f1a65"},
                                                    {"fr3-stn", "4b161e6f6c278c88"},
                                                    {"passer with a toy", "130668c6f91e1b63"}};
  std::map<std::string, std::string> made;
  const auto add = [&](const std::string& name, const Scene& scene) {
    made[name] = SceneHash(scene).substr(0, 16);
  };
  for (const std::string& family : FamilyNames()) add(family, MakeScene(family, 1));
  for (const Twin& twin : Twins()) add(twin.name, MakeTwin(twin.name, 1));
  for (const char* tested_above : {"desk", "plates", "stack"}) made.erase(tested_above);
  add("passer with a toy", MakeScene("passer", 1, {{"kind", 3}}));
  EXPECT_EQ(made, expected);
}

TEST(CoplanarFamily, KeepsStepAndGapOfEveryPair) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = MakeScene("coplanar", seed, {{"step_mm", 1.5}, {"gap_mm", 25}});
    std::vector<const Object*> boxes;
    for (const Object& object : scene.objects) {
      if (object.role == Role::kRegular) boxes.push_back(&object);
    }
    ASSERT_EQ(boxes.size(), 4u);
    for (std::size_t i = 0; i < 4; i += 2) {
      const Object &left = *boxes[i], &right = *boxes[i + 1];
      EXPECT_NE(left.class_name, right.class_name);
      EXPECT_NEAR(right.size.z() - left.size.z(), 0.0015, 2e-6);
      EXPECT_NEAR(-OverlapDepth(left, right), 0.025, 5e-6);
    }
  }
}

TEST(TiltedFamily, LeansEveryBookByTheLiftOverTheReach) {
  const Scene scene = MakeScene("tilted", 4, {{"lift_mm", 30}, {"count", 2}});
  int leaning = 0;
  for (const ScenePlane& plane : ScenePlanes(scene)) {
    if (plane.face != Face::kPlusZ || plane.n_w.z() > 0.9999 || plane.n_w.z() < 0.5) continue;
    ++leaning;
    const double tilt_deg = std::acos(plane.n_w.z()) * 180 / M_PI;
    EXPECT_GT(tilt_deg, 5);
    EXPECT_LT(tilt_deg, 17);
  }
  EXPECT_EQ(leaning, 2);
}

TEST(TwinsFamily, RepeatsTheDeskButForWhatIsMissing) {
  const Scene scene = MakeScene("twins", 2, {{"missing", 2}, {"apart_m", 2}});
  int left = 0, right = 0, matched = 0;
  for (const Object& object : scene.objects) {
    if (object.role == Role::kStructure) continue;
    (object.center_w.x() < 0 ? left : right) += 1;
    for (const Object& other : scene.objects) {
      const Eigen::Vector3d shift = other.center_w - object.center_w;
      matched += (shift - Eigen::Vector3d(2, 0, 0)).norm() < 5e-6 && other.size == object.size;
    }
  }
  EXPECT_LT(right, left);
  EXPECT_EQ(matched, right);
}

TEST(Twins, AreSixteenScenesThatKnowHowToBeRecorded) {
  ASSERT_EQ(Twins().size(), 16u);
  for (const Twin& twin : Twins()) {
    const Scene scene = MakeTwin(twin.name, 1);
    EXPECT_EQ(scene.motion.preset, twin.preset);
    ASSERT_TRUE(scene.capture.has_value());
    EXPECT_LE(scene.capture->frames, 900) << twin.name;
    const Scene read = ParseScene(SceneText(scene), "text");
    EXPECT_EQ(SceneText(read), SceneText(scene)) << twin.name;
    EXPECT_EQ(read.capture->fx, scene.capture->fx);
    EXPECT_EQ(read.capture->distortion, scene.capture->distortion);
  }
  EXPECT_EQ(MakeTwin("fr1-xyz", 1).capture->fx, 517.3);
  EXPECT_THROW(MakeTwin("fr4-desk", 1), io::InputError);
}

TEST(Twins, FindRoomWhateverTheSeed) {
  for (const char* name : {"fr1-desk", "fr1-desk2"}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      EXPECT_NO_THROW(MakeTwin(name, seed)) << name << " " << seed;
    }
  }
}

TEST(DeskFamily, TakesAsFewAsFiveThings) {
  for (int count = 5; count <= 7; ++count) {
    std::set<std::string> things;
    for (const Object& object : MakeScene("desk", 3, {{"objects", count}}).objects) {
      if (object.role == Role::kStructure) continue;
      const int group = object.detection_group;
      things.insert(group != 0 ? "group " + std::to_string(group) : object.name);
    }
    EXPECT_EQ(things.size(), static_cast<std::size_t>(count));
  }
}

TEST(PasserFamily, CarriesAToyUnderTheHand) {
  for (int kind = 1; kind <= 3; ++kind) {
    const Scene scene = MakeScene("passer", 5, {{"kind", kind}});
    std::vector<const Object*> moving;
    for (const Object& object : scene.objects) {
      if (!object.way.empty()) moving.push_back(&object);
    }
    ASSERT_EQ(moving.size(), kind == 3 ? 2u : 1u);
    EXPECT_EQ(moving[0]->class_name, "person");
    const auto& way = moving[0]->way;
    for (std::size_t i = 1; i < way.size(); ++i) {
      const double speed =
          (way[i].center_w - way[i - 1].center_w).norm() / (way[i].time_s - way[i - 1].time_s);
      EXPECT_LT(speed, 1.6) << "no jumps";
    }
  }
}

TEST(OfficeFamily, PutsAsManyThingsOnTheDesksAsAsked) {
  const auto things = [](int objects) {
    std::set<std::string> names;
    for (const Object& object : MakeScene("office", 1, {{"objects", objects}}).objects) {
      if (object.role == Role::kStructure) continue;
      const int group = object.detection_group;
      names.insert(group != 0 ? "group " + std::to_string(group) : object.name);
    }
    return names.size();
  };
  EXPECT_EQ(things(3), things(2) + 1);
  EXPECT_EQ(things(4), things(2) + 2);
}

TEST(DeskFamily, TakesFortyThingsOnALargeDesk) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::set<std::string> things, classes;
    for (const Object& object : MakeScene("desk", seed, {{"objects", 40}}).objects) {
      if (object.role == Role::kStructure) continue;
      const int group = object.detection_group;
      things.insert(group != 0 ? "group " + std::to_string(group) : object.name);
      classes.insert(object.class_name);
    }
    EXPECT_EQ(things.size(), 40u);
    EXPECT_GE(classes.size(), 12u) << "hardly any variety";
  }
  EXPECT_THROW(MakeScene("desk", 1, {{"objects", 41}}), io::InputError);
}

}  // namespace
}  // namespace sim
