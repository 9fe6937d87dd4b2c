#include "sim/families/families.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "io/input_error.h"
#include "sim/scene/check.h"
#include "sim/scene/geometry.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "sim/shapes/planes.h"
#include "tests/support/refusal.h"

namespace sim {
namespace {

using test_support::RefusalOf;

constexpr std::uint64_t kDeskSeeds = 100;

bool Inside(const Object& box, const Eigen::Vector3d& x_w, double margin_m) {
  const Eigen::Vector3d x_o = box.q_wo.inverse() * (x_w - box.center_w);
  return ((box.size / 2 - x_o.cwiseAbs()).array() > margin_m).all();
}

/// Points of a box: a grid all through it, dense along the edges.
std::vector<Eigen::Vector3d> DensePointsOf(const Object& box) {
  std::vector<Eigen::Vector3d> points;
  constexpr int kGrid = 7, kAlong = 41;
  const auto add = [&](double a, double b, double c) {
    const Eigen::Vector3d part = Eigen::Vector3d(a, b, c) - Eigen::Vector3d::Constant(0.5);
    points.push_back(box.center_w + box.q_wo * part.cwiseProduct(box.size));
  };
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const double last = kGrid - 1;
    add(i % kGrid / last, i / kGrid % kGrid / last, i / kGrid / kGrid / last);
  }
  for (int i = 0; i < kAlong; ++i) {
    const double at = i / (kAlong - 1.0);
    for (const double a : {0.0, 1.0}) {
      for (const double b : {0.0, 1.0}) {
        add(at, a, b);
        add(a, at, b);
        add(a, b, at);
      }
    }
  }
  return points;
}

// Sampled points know nothing of separating axes.
TEST(DeskFamily, PutsNoPointOfAnObjectInsideAnother) {
  for (std::uint64_t seed = 1; seed <= kDeskSeeds; ++seed) {
    const Scene scene = MakeScene("desk", seed);
    for (const Object& a : scene.objects) {
      const auto points = DensePointsOf(a);
      for (const Object& b : scene.objects) {
        if (a.id == b.id) continue;
        const double reach = (a.size.norm() + b.size.norm()) / 2;
        if ((a.center_w - b.center_w).norm() > reach) continue;
        for (const Eigen::Vector3d& x_w : points) {
          ASSERT_FALSE(Inside(b, x_w, kTouch_m))
              << "seed " << seed << ": " << a.name << " in " << b.name;
        }
      }
    }
  }
}

TEST(DeskFamily, SampledPointsSeeAPlantedOverlap) {
  Scene scene = MakeScene("desk", 1);
  Object moved = scene.objects.back();
  moved.center_w += Eigen::Vector3d(0.005, 0, 0);
  bool seen = false;
  for (const Eigen::Vector3d& x_w : DensePointsOf(moved)) {
    seen = seen || Inside(scene.objects.back(), x_w, kTouch_m);
  }
  EXPECT_TRUE(seen);
}

/// Whether all four lower corners stand on one top face.
bool Stands(const Scene& scene, const Object& object) {
  for (const Object& below : scene.objects) {
    if (below.id == object.id || below.shape != ShapeKind::kBox) continue;
    int held = 0;
    for (std::size_t i = 0; i < 4; ++i) {  // the corners with -z
      const Eigen::Vector3d x_o = below.q_wo.inverse() * (Corners(object)[i] - below.center_w);
      const Eigen::Vector3d slack = below.size / 2 - x_o.cwiseAbs();
      held += std::abs(x_o.z() - below.size.z() / 2) < 1e-5 && slack.x() > 0 && slack.y() > 0;
    }
    if (held == 4) return true;
  }
  return false;
}

TEST(DeskFamily, StandsEveryThingWhollyOnWhatIsBelowIt) {
  for (std::uint64_t seed = 1; seed <= kDeskSeeds; ++seed) {
    const Scene scene = MakeScene("desk", seed);
    std::map<int, int> standing;  // of each thing that is detected as one
    for (const Object& object : scene.objects) {
      if (object.role == Role::kStructure) continue;
      if (object.detection_group != 0) {
        standing[object.detection_group] += Stands(scene, object) ? 1 : 0;
      } else {
        EXPECT_TRUE(Stands(scene, object)) << "seed " << seed << ": " << object.name;
      }
    }
    for (const auto& [group, count] : standing) EXPECT_GE(count, 1) << "seed " << seed;
  }
}

TEST(DeskFamily, HoldsEightToFourteenThingsOfTheKindsADeskHas) {
  std::set<std::size_t> counts;
  for (std::uint64_t seed = 1; seed <= kDeskSeeds; ++seed) {
    const Scene scene = MakeScene("desk", seed);
    std::set<std::string> things, classes;
    for (const Object& object : scene.objects) {
      if (object.role == Role::kStructure) continue;
      classes.insert(object.class_name);
      const int group = object.detection_group;
      things.insert(group != 0 ? "group " + std::to_string(group) : object.name);
    }
    counts.insert(things.size());
    EXPECT_GE(things.size(), 8u) << "seed " << seed;
    EXPECT_LE(things.size(), 14u) << "seed " << seed;
    for (const char* kind :
         {"book", "keyboard", "laptop", "tv", "cell phone", "box", "teddy bear"}) {
      EXPECT_EQ(classes.count(kind), 1u) << "seed " << seed << " lacks a " << kind;
    }
  }
  EXPECT_GE(counts.size(), 5u) << "hardly any variety";
}

TEST(DeskFamily, KeepsTheMeasuresOfRealDesks) {
  std::uint64_t desks = 0;
  for (std::uint64_t seed = 1; seed <= kDeskSeeds; ++seed) {
    for (const Object& object : MakeScene("desk", seed).objects) {
      if (object.name != "desk") continue;
      ++desks;
      EXPECT_GE(object.size.x(), 1.2 - 1e-9);
      EXPECT_LE(object.size.x(), 1.8 + 1e-9);
      EXPECT_GE(object.size.y(), 0.6 - 1e-9);
      EXPECT_LE(object.size.y(), 0.8 + 1e-9);
      const double top_z = object.center_w.z() + object.size.z() / 2;
      EXPECT_GE(top_z, 0.70 - 1e-9);
      EXPECT_LE(top_z, 0.76 + 1e-9);
    }
  }
  EXPECT_EQ(desks, kDeskSeeds);
}

TEST(MakeScene, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
  for (const Family& family : Families()) {
    std::set<std::string> hashes;
    for (std::uint64_t seed = 0; seed <= 20; ++seed) {
      const std::string hash = SceneHash(MakeScene(family.name, seed));
      EXPECT_EQ(hash, SceneHash(MakeScene(family.name, seed)));
      hashes.insert(hash);
    }
    EXPECT_EQ(hashes.size(), 21u) << family.name;
  }
}

TEST(MakeScene, RefusesWhatNoFamilyOffers) {
  EXPECT_THROW(MakeScene("kitchen", 1), io::InputError);
  EXPECT_THROW(MakeScene("plates", 1, {{"step", 20}}), io::InputError);
  EXPECT_THROW(MakeScene("plates", 1, {{"step_mm", -1}}), io::InputError);
  EXPECT_THROW(MakeScene("plates", 1, {{"step_mm", std::nan("")}}), io::InputError);
  EXPECT_THROW(MakeScene("stack", 1, {{"count", 2.5}}), io::InputError);
}

TEST(MakeScene, DoesNotBlameTheFamilyDeskForTheDeskOfAnother) {
  const std::string text = RefusalOf([] { MakeScene("revisit", 14597, {{"objects", 14}}); });
  EXPECT_EQ(text.find("family desk"), std::string::npos) << text;
  EXPECT_EQ(text.find("objects: no room for 14"), 0u) << text;
}

// What draws a value when it is 0 has a least value of its own besides.
TEST(MakeScene, RefusesLessThanTheLeastButTakesNothingForADraw) {
  using Given = std::map<std::string, double>;
  const std::tuple<std::string, std::string, Given, Given> cases[] = {
      {"desk", "of 0 or from 5 on", {{"objects", 3}}, {{"objects", 5}}},
      {"revisit", "of 0 or from 8 on", {{"objects", 7}}, {{"objects", 8}}},
      {"tilted", "of 0 or from 0.1 on", {{"lift_mm", 0.004}}, {{"lift_mm", 0.1}}},
      {"passer", "of 0 or from 0.05 on", {{"speed_m_s", 0.03}}, {{"speed_m_s", 0.05}}}};
  for (const auto& [family, expected, low, least] : cases) {
    const std::string text =
        RefusalOf([&name = family, &given = low] { MakeScene(name, 1, given); });
    EXPECT_NE(text.find("family " + family), std::string::npos) << text;
    EXPECT_NE(text.find(expected), std::string::npos) << text;
    const Scene scene = MakeScene(family, 1, least);
    EXPECT_EQ(SceneText(ParseScene(SceneText(scene), "scene.yaml")), SceneText(scene));
    EXPECT_NO_THROW(MakeScene(family, 1, {{low.begin()->first, 0}}));
  }
}

// The slowest way that comes most often is still one that a scene file may hold.
TEST(PasserFamily, WritesTheLongestWayAsAFileThatCanBeRead) {
  for (const double kind : {1, 2, 3}) {
    const Scene scene = MakeScene(
        "passer", 2, {{"kind", kind}, {"times", 20}, {"speed_m_s", 0.05}, {"objects", 2}});
    EXPECT_NO_THROW(ParseScene(SceneText(scene), "scene.yaml")) << kind;
  }
}

TEST(MakeScene, HangsThePanelsOfALampElsewhereForAnotherSeed) {
  for (const char* family : {"desk", "office"}) {
    std::set<std::pair<double, double>> places;
    constexpr std::uint64_t kScenes = 5;
    for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
      const Scene scene = MakeScene(family, seed, {{"lamps", 4}});
      ASSERT_EQ(scene.lights.back().kind, LightKind::kArea);
      const Eigen::Vector3d over = scene.lights.back().center_w - scene.motion.target_w;
      places.insert({std::round(1000 * over.x()), std::round(1000 * over.y())});
    }
    EXPECT_EQ(places.size(), kScenes) << family;
  }
}

/// Mean speed across the view, of the whiles in which something moves.
double SpeedAcross(const Object& moving) {
  double way_m = 0, time_s = 0;
  for (std::size_t i = 1; i < moving.way.size(); ++i) {
    const Waypoint &a = moving.way[i - 1], &b = moving.way[i];
    const double step_m = std::abs(b.center_w.x() - a.center_w.x());
    if (step_m < 1e-5) continue;  // rests
    way_m += step_m;
    time_s += b.time_s - a.time_s;
  }
  return way_m / time_s;
}

TEST(PasserFamily, MovesAsFastAsAsked) {
  for (const int kind : {1, 2, 3}) {
    for (const double speed_m_s : {0.3, 1.5}) {
      const Scene scene = MakeScene("passer", 3, {{"kind", kind}, {"speed_m_s", speed_m_s}});
      int moving = 0;
      for (const Object& object : scene.objects) {
        if (object.way.empty()) continue;
        ++moving;
        EXPECT_NEAR(SpeedAcross(object), speed_m_s, 0.01 * speed_m_s) << kind;
      }
      EXPECT_EQ(moving, kind == 3 ? 2 : 1);
    }
  }
}

TEST(BoardFamily, MakesTheBoardsAsThickAsAsked) {
  for (const double thickness_mm : {3.0, 20.0}) {
    const Scene scene = MakeScene("board", 2, {{"count", 4}, {"thickness_mm", thickness_mm}});
    int boards = 0;
    for (const Object& object : scene.objects) {
      // Beside the screen and the tablet; the blocks that hold a board are low.
      if (object.class_name != "book" || object.size.z() < 0.1) continue;
      ++boards;
      EXPECT_NEAR(1000 * object.size.minCoeff(), thickness_mm, 0.002);
    }
    EXPECT_EQ(boards, 2) << thickness_mm;
  }
}

TEST(MakeScene, TiltsThePlateAsAsked) {
  const Scene scene =
      MakeScene("plates", 1, {{"tilt_deg", 10}, {"step_mm", 5}, {"gap_mm", 30}});
  const ScenePlane top = ScenePlanes(scene).at(17);
  EXPECT_NEAR(top.n_w.z(), std::cos(10 * M_PI / 180), 1e-12);
  // The edge at the gap is at x = 15 mm and 5 mm above the first top, which is at 20 mm.
  EXPECT_NEAR(top.n_w.dot(Eigen::Vector3d(0.015, 0, 0.025)) + top.d, 0, 2e-6);
}

}  // namespace
}  // namespace sim
