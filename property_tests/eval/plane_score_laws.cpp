#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>
#include <random>

#include "eval/planes/association.h"
#include "eval/planes/clear_score.h"
#include "eval/planes/corners.h"
#include "eval/planes/hota_score.h"
#include "eval/planes/hungarian.h"
#include "eval/planes/identity_score.h"
#include "eval/planes/partition_score.h"
#include "eval/planes/polygon.h"
#include "eval/planes/segmentation_score.h"

namespace eval {
namespace {

using Random = std::mt19937_64;

Random AnyRandom() { return Random(*rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>())); }
int Below(Random& random, int count) { return static_cast<int>(random() % unsigned(count)); }
double Uniform(Random& random) { return std::uniform_real_distribution<double>()(random); }

std::vector<AssociationRecord> AnyRecords() {
  Random random = AnyRandom();
  const int frames = *rc::gen::resize(100, rc::gen::inRange(1, 40));
  const int truths = 1 + Below(random, 6), maps = 1 + Below(random, 8);
  std::vector<AssociationRecord> records;
  for (int frame = 0; frame < frames; ++frame) {
    for (int i = Below(random, 6); i > 0; --i) {
      records.push_back({frame, Below(random, truths + 1), 100 + Below(random, maps)});
    }
  }
  return records;
}

void AssertBounded(const PrecisionRecall& s) {
  RC_ASSERT(s.precision >= 0.0 && s.precision <= 1.0 + 1e-12);
  RC_ASSERT(s.recall >= 0.0 && s.recall <= 1.0 + 1e-12);
  RC_ASSERT(s.f1 <= std::max(s.precision, s.recall) + 1e-12);
  RC_ASSERT(s.f1 >= std::min(s.precision, s.recall) - 1e-12);
}

RC_GTEST_PROP(AssociationP39, StaysWithinItsBounds, ()) {
  const AssociationScore score = ScoreAssociation(AnyRecords());
  AssertBounded(score.pair);
  AssertBounded(score.b_cubed);
  AssertBounded(score.decision.scores);
}

RC_GTEST_PROP(AssociationP39, IsPerfectWhenEveryTruthHasItsOwnMapPlane, ()) {
  std::vector<AssociationRecord> records = AnyRecords();
  for (AssociationRecord& r : records) {
    r.truth += 1;
    r.map_plane = 1000 + r.truth;
  }
  const AssociationScore score = ScoreAssociation(records);
  RC_ASSERT(score.decision.fp == 0 && score.decision.fn == 0 && score.decision.spurious == 0);
  RC_ASSERT(score.merged_map_planes == 0 && score.split_truth_planes == 0);
  if (score.pair_truth > 0) RC_ASSERT(score.pair.precision == 1.0 && score.pair.recall == 1.0);
}

RC_GTEST_PROP(AssociationP39, DoesNotDependOnNamesOrOnTheOrderWithinAFrame, ()) {
  const std::vector<AssociationRecord> plain = AnyRecords();
  std::vector<AssociationRecord> renamed = plain;
  for (AssociationRecord& r : renamed) r.map_plane = 5000 - 7 * r.map_plane;
  std::stable_sort(renamed.begin(), renamed.end(), [](const auto& a, const auto& b) {
    return a.frame != b.frame ? a.frame < b.frame : a.map_plane < b.map_plane;
  });
  const AssociationScore a = ScoreAssociation(plain), b = ScoreAssociation(renamed);
  RC_ASSERT(a.decision.tp == b.decision.tp && a.decision.fp == b.decision.fp);
  RC_ASSERT(a.decision.fn == b.decision.fn && a.decision.tn == b.decision.tn);
  RC_ASSERT(a.pair_tp == b.pair_tp && a.pair_predicted == b.pair_predicted);
  RC_ASSERT(a.merged_map_planes == b.merged_map_planes);
}

RC_GTEST_PROP(CornersP39, ClaimingACornerTwiceNeverRaisesThePrecision, ()) {
  Random random = AnyRandom();
  std::vector<Eigen::Vector3d> truth, claimed;
  for (int i = 0; i < 4; ++i) truth.push_back(0.1 * Eigen::Vector3d(i % 2, i / 2, 0));
  for (int i = 1 + Below(random, 6); i > 0; --i) {
    const double x = Uniform(random), y = Uniform(random), z = Uniform(random);
    claimed.push_back(0.2 * Eigen::Vector3d(x, y, 0.2 * z));
  }
  const auto precision = [&] {
    const std::vector<int> match = MatchCorners(claimed, truth, kMaxCornerError_m);
    const auto matched =
        std::count_if(match.begin(), match.end(), [](int m) { return m >= 0; });
    return static_cast<double>(matched) / static_cast<double>(claimed.size());
  };
  // Only a twin can be called a duplicate: give each claim at most one true corner to reach.
  for (std::size_t i = 1; i < truth.size(); ++i) truth[i] *= 10.0;
  const double before = precision();
  claimed.push_back(claimed[random() % claimed.size()]);
  RC_ASSERT(precision() <= before);
}

RC_GTEST_PROP(HungarianAssignment, IsNeverBeatenByAnotherPermutation, ()) {
  Random random = AnyRandom();
  const int rows = 1 + Below(random, 5), cols = 1 + Below(random, 5);
  Eigen::MatrixXd weight(rows, cols);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < cols; ++j) weight(i, j) = Below(random, 4) * 0.25;
  }
  const std::vector<int> ours = AssignMaxWeight(weight);
  double total = 0.0;
  for (int i = 0; i < rows; ++i) {
    if (ours[std::size_t(i)] >= 0) total += weight(i, ours[std::size_t(i)]);
  }
  std::vector<int> order(std::size_t(std::max(rows, cols)));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = int(i);
  do {
    double other = 0.0;
    for (int i = 0; i < rows; ++i) {
      if (order[std::size_t(i)] < cols) other += weight(i, order[std::size_t(i)]);
    }
    RC_ASSERT(other <= total + 1e-12);
  } while (std::next_permutation(order.begin(), order.end()));
}

cv::Mat1w AnyLabels(Random& random, int regions) {
  cv::Mat1w labels(24, 32, std::uint16_t(0));
  for (int i = 1; i <= regions; ++i) {
    const int x = Below(random, 24), y = Below(random, 18);
    labels(cv::Rect(x, y, 2 + Below(random, 32 - x - 1), 2 + Below(random, 24 - y - 1)))
        .setTo(i);
  }
  return labels;
}

RC_GTEST_PROP(SegmentationP39, BooksEveryRegionOnceAndStaysWithinItsBounds, ()) {
  Random random = AnyRandom();
  const cv::Mat1w truth = AnyLabels(random, 1 + Below(random, 6));
  const cv::Mat1w machine = AnyLabels(random, 1 + Below(random, 6));
  const Overlap overlap = CountOverlap(truth, machine);
  const HooverScore hoover = ScoreHoover(overlap);
  RC_ASSERT(hoover.correct + hoover.over + hoover.missed <= hoover.truth);
  RC_ASSERT(hoover.correct + hoover.under + hoover.noise <= hoover.machine);
  const PanopticCounts panoptic = CountPanoptic(overlap);
  RC_ASSERT(panoptic.fp >= 0 && panoptic.fn >= 0);
  RC_ASSERT(panoptic.Pq() >= 0.0 && panoptic.Pq() <= 1.0);
  const Overlap itself = CountOverlap(truth, truth);
  RC_ASSERT(CountPanoptic(itself).Pq() == 1.0);
  RC_ASSERT(ScoreHoover(itself).correct == hoover.truth);
}

RC_GTEST_PROP(PartitionP39, CountsThePairsThatTwoImagesKeepTogetherOrApart, ()) {
  Random random = AnyRandom();
  const cv::Mat1w whole = AnyLabels(random, 5), other = AnyLabels(random, 4);
  const cv::Rect part(4, 4, 12, 10);
  const cv::Mat1w truth = whole(part).clone(), machine = other(part).clone();
  double agree = 0.0, pairs = 0.0;
  for (auto a = truth.begin(); a != truth.end(); ++a) {
    for (auto b = truth.begin(); b != a; ++b) {
      const auto m_a = machine.begin() + (a - truth.begin());
      const auto m_b = machine.begin() + (b - truth.begin());
      agree += (*a == *b) == (*m_a == *m_b) ? 1.0 : 0.0;
      pairs += 1.0;
    }
  }
  const PartitionScore score = ScorePartition(CountPairs(truth, machine));
  RC_ASSERT(std::abs(score.rand_index - agree / pairs) < 1e-12);
}

RC_GTEST_PROP(PartitionP39, IsSymmetricBoundedAndPerfectForItselfUnderOtherNames, ()) {
  Random random = AnyRandom();
  const cv::Mat1w truth = AnyLabels(random, 1 + Below(random, 6));
  const cv::Mat1w machine = AnyLabels(random, 1 + Below(random, 6));
  const PartitionScore one = ScorePartition(CountPairs(truth, machine));
  const PartitionScore other = ScorePartition(CountPairs(machine, truth));
  RC_ASSERT(std::abs(one.rand_index - other.rand_index) < 1e-12);
  RC_ASSERT(std::abs(one.covering - other.covering) < 1e-12);
  RC_ASSERT(std::abs(one.VoiBits() - other.VoiBits()) < 1e-12);
  RC_ASSERT(one.purity == other.inverse_purity && one.inverse_purity == other.purity);
  for (const double share : {one.rand_index, one.covering, one.purity, one.inverse_purity})
    RC_ASSERT(share > 0.0 && share <= 1.0 + 1e-12);
  cv::Mat1w renamed = truth.clone();
  for (std::uint16_t& label : renamed) label = static_cast<std::uint16_t>(40 - 3 * label);
  const PartitionScore same = ScorePartition(CountPairs(truth, renamed));
  RC_ASSERT(same.rand_index == 1.0 && std::abs(same.covering - 1.0) < 1e-12);
  RC_ASSERT(same.purity == 1.0 && same.inverse_purity == 1.0 && same.VoiBits() == 0.0);
}

// Unlike any index of pairs, the variation of information is a distance (Meila 2003).
RC_GTEST_PROP(PartitionP39, VariationOfInformationKeepsTheTriangleInequality, ()) {
  Random random = AnyRandom();
  const cv::Mat1w a = AnyLabels(random, 4), b = AnyLabels(random, 3), c = AnyLabels(random, 5);
  const auto voi = [](const cv::Mat1w& x, const cv::Mat1w& y) {
    return ScorePartition(CountPairs(x, y)).VoiBits();
  };
  RC_ASSERT(voi(a, c) <= voi(a, b) + voi(b, c) + 1e-12);
}

RC_GTEST_PROP(PolygonOverlap, IsSymmetricAndBoundedByEitherArea, ()) {
  Random random = AnyRandom();
  const auto any_hull = [&] {
    Polygon2 points;
    for (int i = 0; i < 8; ++i) {
      const double x = Uniform(random), y = Uniform(random);
      points.emplace_back(x, y);
    }
    return ConvexHull(points);
  };
  const Polygon2 a = any_hull(), b = any_hull();
  const double both = IntersectionArea(a, b);
  RC_ASSERT(std::abs(both - IntersectionArea(b, a)) < 1e-12);
  RC_ASSERT(both <= std::min(Area(a), Area(b)) + 1e-12);
  RC_ASSERT(std::abs(IntersectionArea(a, a) - Area(a)) < 1e-12);
}

/// Three to eight corners on an ellipse as thin as a millionth, turned and shifted.
Polygon2 AnyConvex(Random& random) {
  const double thin = std::pow(10.0, -6 * Uniform(random)), turn = 6.28 * Uniform(random);
  const double x_0 = 2 * Uniform(random) - 1, y_0 = 2 * Uniform(random) - 1;
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn).toRotationMatrix();
  Polygon2 points;
  const int corners = 3 + Below(random, 6);
  for (int k = 0; k < corners; ++k) {
    const double a = 6.28 * (k + 0.9 * Uniform(random)) / corners;  // never two alike
    points.emplace_back(R * Eigen::Vector2d(std::cos(a), thin * std::sin(a)) +
                        Eigen::Vector2d(x_0, y_0));
  }
  return ConvexHull(points);
}

/// Image under x -> R x + t, or mirrored in between; its corners again counter-clockwise.
Polygon2 Placed(const Polygon2& polygon, const Eigen::Matrix2d& A, const Eigen::Vector2d& t) {
  Polygon2 placed;
  for (const Eigen::Vector2d& p : polygon) placed.emplace_back(A * p + t);
  if (A.determinant() < 0) std::reverse(placed.begin(), placed.end());
  return placed;
}

RC_GTEST_PROP(PolygonOverlap, IsNothingOfWhatOnlyTouchesAndAllOfWhatIsInside, ()) {
  Random random = AnyRandom();
  const Polygon2 a = AnyConvex(random);
  RC_ASSERT(a.size() >= 3u);
  // Mirrored in one of its sides it touches all along that.
  const auto k = std::size_t(Below(random, int(a.size())));
  const Eigen::Vector2d& p = a[k];
  const Eigen::Vector2d along = (a[(k + 1) % a.size()] - p).normalized();
  const Eigen::Matrix2d M = 2 * along * along.transpose() - Eigen::Matrix2d::Identity();
  const Polygon2 beyond = Placed(a, M, p - M * p);
  RC_ASSERT(IntersectionArea(a, beyond) < 1e-12);
  RC_ASSERT(IntersectionArea(beyond, a) < 1e-12);
  RC_ASSERT(std::abs(Area(beyond) - Area(a)) < 1e-12);
  // Through a corner it touches in a point.
  const Eigen::Matrix2d turned = -Eigen::Matrix2d::Identity();
  RC_ASSERT(IntersectionArea(a, Placed(a, turned, 2 * p)) < 1e-12);
  // Far away nothing is left.
  RC_ASSERT(IntersectionArea(a, Placed(a, Eigen::Matrix2d::Identity(), {9, 0})) == 0.0);
  // Shrunk towards a point inside it, it is inside.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : a) middle += corner / double(a.size());
  const double s = Uniform(random);
  const Polygon2 inside = Placed(a, s * Eigen::Matrix2d::Identity(), (1 - s) * middle);
  RC_ASSERT(std::abs(IntersectionArea(a, inside) - s * s * Area(a)) < 1e-12);
  RC_ASSERT(std::abs(IntersectionArea(inside, a) - s * s * Area(a)) < 1e-12);
}

/// By support functions: h(u) = max u . x says how far a convex set reaches towards u, and the distance
/// of two such sets is the largest difference of their h over all directions.
RC_GTEST_PROP(PolygonHausdorff, IsTheLargestDifferenceOfSupportFunctions, ()) {
  Random random = AnyRandom();
  const Polygon2 a = AnyConvex(random), b = AnyConvex(random);
  const auto reach = [](const Polygon2& polygon, const Eigen::Vector2d& u) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& corner : polygon) farthest = std::max(farthest, u.dot(corner));
    return farthest;
  };
  constexpr int kDirections = 2000;
  double largest = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const double turn = 2 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d u(std::cos(turn), std::sin(turn));
    largest = std::max(largest, std::abs(reach(a, u) - reach(b, u)));
  }
  // A step of direction changes h by less than 4 m, which the polygons reach to at most, times it.
  const double distance = HausdorffDistance(a, b);
  RC_ASSERT(distance >= largest - 1e-12);
  RC_ASSERT(distance <= largest + 4 * 2 * std::numbers::pi / kDirections);
  RC_ASSERT(distance == HausdorffDistance(b, a));
  RC_ASSERT(HausdorffDistance(a, a) < 1e-12);
}

RC_GTEST_PROP(PolygonOverlap, OfSliversIsSymmetricBoundedAndMovesWithBoth, ()) {
  Random random = AnyRandom();
  const Polygon2 a = AnyConvex(random), b = AnyConvex(random);
  const double both = IntersectionArea(a, b);
  RC_ASSERT(both >= 0 && both <= std::min(Area(a), Area(b)) + 1e-12);
  RC_ASSERT(std::abs(both - IntersectionArea(b, a)) < 1e-12);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(6.28 * Uniform(random)).toRotationMatrix();
  const double x = 20 * Uniform(random) - 10, y = 20 * Uniform(random) - 10;
  const Eigen::Vector2d t(x, y);
  RC_ASSERT(std::abs(IntersectionArea(Placed(a, R, t), Placed(b, R, t)) - both) < 1e-9);
  // Mirrored, and so clipped the other way round.
  const Eigen::Matrix2d M = Eigen::Vector2d(-1, 1).asDiagonal();
  RC_ASSERT(std::abs(IntersectionArea(Placed(a, M, t), Placed(b, M, t)) - both) < 1e-9);
}

bool IsInside(const Polygon2& polygon, const Eigen::Vector2d& x) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Eigen::Vector2d to_x = x - polygon[i];
    if (edge.x() * to_x.y() - edge.y() * to_x.x() < 0) return false;
  }
  return true;
}

// 2e5 points over one of the two: five standard errors of the share are 0.0056 at most.
TEST(PolygonOverlap, IsTheShareOfPointsThatLieInBoth) {
  constexpr int kPoints = 200000;
  Random random(32);
  int partly = 0;
  for (int pair = 0; pair < 20; ++pair) {
    const auto any_hull = [&] {
      Polygon2 points;
      for (int i = 0; i < 6; ++i) {
        const double x = Uniform(random), y = Uniform(random);
        points.emplace_back(x, y);
      }
      return ConvexHull(points);
    };
    const Polygon2 a = any_hull(), b = any_hull();
    int in_both = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double x = Uniform(random), y = Uniform(random);
      const Eigen::Vector2d point(x, y);
      in_both += IsInside(a, point) && IsInside(b, point) ? 1 : 0;
    }
    const double expected = double(in_both) / kPoints;
    EXPECT_NEAR(IntersectionArea(a, b), expected, 0.0056) << pair;
    partly += expected > 0.02 ? 1 : 0;
  }
  EXPECT_GT(partly, 10);  // or it was only asked of polygons that are apart
}

RC_GTEST_PROP(TrackingP39, StaysWithinItsBoundsAndIsPerfectForTheTruth, ()) {
  Random random = AnyRandom();
  std::vector<TrackingFrame> frames, perfect;
  for (int f = 1 + Below(random, 12); f > 0; --f) {
    TrackingFrame frame;
    for (int id = 1; id <= 4; ++id) {
      if (Below(random, 3) > 0) frame.truth_ids.push_back(id);
      if (Below(random, 3) > 0) frame.predicted_ids.push_back(10 * id);
    }
    TrackingFrame same{frame.truth_ids, frame.truth_ids, {}};
    const auto n = Eigen::Index(frame.truth_ids.size());
    same.similarity = Eigen::MatrixXd::Identity(n, n);
    perfect.push_back(same);
    frame.similarity.resize(n, Eigen::Index(frame.predicted_ids.size()));
    for (Eigen::Index i = 0; i < n; ++i) {
      // Shares of one mask: a row sums to one at most, as IoUs of disjoint masks do.
      for (Eigen::Index j = 0; j < frame.similarity.cols(); ++j) {
        frame.similarity(i, j) = Uniform(random) / static_cast<double>(frame.similarity.cols());
      }
    }
    frames.push_back(frame);
  }
  const HotaScore hota = ScoreHota(frames);
  const IdentityScore identity = ScoreIdentity(frames);
  for (const double value : {hota.hota, hota.det_a, hota.ass_a, identity.idf1}) {
    RC_ASSERT(value >= 0.0 && value <= 1.0 + 1e-12);
  }
  RC_ASSERT(ScoreClear(frames).mota <= 1.0);
  const bool any = std::any_of(perfect.begin(), perfect.end(),
                               [](const TrackingFrame& f) { return !f.truth_ids.empty(); });
  if (!any) return;
  RC_ASSERT(std::abs(ScoreHota(perfect).hota - 1.0) < 1e-12);
  RC_ASSERT(ScoreIdentity(perfect).idf1 == 1.0);
  RC_ASSERT(ScoreClear(perfect).mota == 1.0);
}

}  // namespace
}  // namespace eval
