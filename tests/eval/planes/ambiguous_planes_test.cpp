// Frame planes that a run left as ambiguous: which of them count, and which are events of their own.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "eval/planes/plane_events.h"

namespace eval {
namespace {

using ::testing::ElementsAre;

constexpr int kNoise = 0, kTable = 7, kLeaflet = 9;  // true planes
constexpr auto kNone = std::nullopt;

struct Piece {
  int truth = 0, pixels = 0;
  std::optional<std::string> by;
  std::optional<int> map_plane;
};

/// Half of the image, of 1000 pixels, is a desk, 4 % are a book on it; a frame comes every 0.5 s.
class AmbiguousPlanes : public ::testing::Test {
 protected:
  AmbiguousPlanes() {
    table_.id = kTable;
    leaflet_.id = kLeaflet;
  }

  void Show(int frame, const std::vector<Piece>& pieces) {
    FrameEvidence e;
    e.number = frame;
    e.truth.stamp_s = 0.5 * frame;
    e.truth.image_px = 1000.0;
    e.truth.planes = {Seen(table_, 500), Seen(leaflet_, 40)};
    for (const Piece& piece : pieces) {
      RunFramePlane plane;
      plane.index = static_cast<int>(e.planes.size());
      plane.pixels = piece.pixels;
      plane.by = piece.by;
      plane.map_plane = piece.map_plane;
      plane.decision = piece.map_plane ? "matched" : "none";
      e.truth_of[plane.index] = piece.truth;
      e.planes.push_back(plane);
    }
    history_.Add(e);
  }

  /// Frame, surface and pixels of each that counts.
  std::vector<std::string> Counted() const {
    std::vector<std::string> texts;
    for (const AmbiguousPlane& plane : FindAmbiguous(history_)) {
      texts.push_back(fmt::format("{} {} {}", plane.frame, plane.truth, plane.pixels));
    }
    return texts;
  }

  /// Kind, frame, surface, its map plane, pixels and cue of each.
  std::vector<std::string> Events(const std::vector<RunMapPlane>& map) const {
    const SceneTruth scene;
    const std::optional<Alignment> gauge;
    const std::vector<RunEvent> events = FindPlaneEvents(
        history_, FindUndecided(history_), FindAmbiguous(history_), {map, scene, gauge});
    std::vector<std::string> texts;
    for (const RunEvent& event : events) {
      texts.push_back(fmt::format("{} {} {} {} {} {}", NameOf(event.kind), event.frame,
                                  event.truth.value(), event.right_map_plane.value(),
                                  event.pixels.value(), event.cue));
    }
    return texts;
  }

 private:
  static SeenPlane Seen(const TruthPlane& plane, int pixels) {
    SeenPlane seen;
    seen.plane = &plane;
    seen.pixels = pixels;
    seen.counted = true;
    return seen;
  }

  TruthPlane table_, leaflet_;
  DecisionHistory history_;
};

TEST_F(AmbiguousPlanes, CountWhereTheirSurfaceHasALandmarkOfAnEarlierFrame) {
  Show(0, {{kTable, 480, "unmatched", 1},
           {kNoise, 30, "unmatched", 3},
           {kLeaflet, 40, "ambiguous", kNone}});
  Show(1, {{kLeaflet, 25, "unmatched", 2}, {kLeaflet, 15, "ambiguous", kNone}});
  Show(2, {{kLeaflet, 38, "ambiguous", kNone},  // the only one that counts
           {kNoise, 30, "ambiguous", kNone},
           {kTable, 470, kNone, kNone}});
  Show(3, {{kLeaflet, 39, "ambiguous", 2}, {kTable, 460, "candidate", kNone}});
  EXPECT_THAT(Counted(), ElementsAre("2 9 38"));
}

TEST_F(AmbiguousPlanes, AreEventsButForTheOneThatALargeSurfaceIsJudgedBy) {
  Show(0, {{kTable, 480, "unmatched", 1}, {kLeaflet, 40, "unmatched", 2}});
  Show(1, {{kTable, 460, "ambiguous", kNone}});  // too early for `no decision`
  Show(3, {{kTable, 180, "ambiguous", kNone},
           {kTable, 300, "ambiguous", kNone},  // the desk's `no decision`
           {kLeaflet, 38, "ambiguous", kNone}});
  Show(4, {{kTable, 290, "candidate", kNone}, {kTable, 170, "ambiguous", kNone}});
  Show(5, {{kTable, 280, "overlap", 1}, {kTable, 160, "ambiguous", kNone}});
  std::vector<RunMapPlane> map(3);
  map[0].id = 1, map[1].id = 2, map[2].id = 5;
  map[0].merged_into = 5;
  EXPECT_THAT(Events(map),
              ElementsAre("no decision 3 7 5 500 ambiguous", "no decision 4 7 5 500 candidate",
                          "ambiguous 1 7 5 460 ambiguous", "ambiguous 3 7 5 180 ambiguous",
                          "ambiguous 4 7 5 170 ambiguous", "ambiguous 5 7 5 160 ambiguous",
                          "ambiguous 3 9 2 38 ambiguous"));
  // All but one of the count are events of their kind.
  EXPECT_EQ(Counted().size(), 6u);
}

}  // namespace
}  // namespace eval
