#include "slam/features/match_features.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "slam/base/index.h"

namespace slam {
namespace {

constexpr double kCell_px = 20.0;  // side of a grid cell: about the usual search radius
constexpr int kTooFar = 257;       // more than any two descriptors differ

/// The two nearest candidates of a query.
struct Nearest {
  int index = kNone, distance = kTooFar, octave = -1;
  int second_distance = kTooFar, second_octave = -1;

  void Offer(int candidate, int candidate_distance, int candidate_octave) {
    if (candidate_distance < distance) {
      second_distance = distance, second_octave = octave;
      index = candidate, distance = candidate_distance, octave = candidate_octave;
    } else if (candidate_distance < second_distance) {
      second_distance = candidate_distance, second_octave = candidate_octave;
    }
  }
  bool Accepted(const PointMatchConfig& config) const {
    if (index == kNone || distance > config.max_distance) return false;
    return octave != second_octave || distance <= config.max_ratio * second_distance;
  }
};

/// Compares the query with the free features near it.
Nearest Search(const PointQuery& query, const std::vector<PointFeature>& features,
               const FeatureGrid& grid, const std::vector<bool>& taken) {
  Nearest nearest;
  for (const int f :
       grid.Near(query.u_px, query.radius_px, query.min_octave, query.max_octave)) {
    if (!taken.empty() && taken[Index(f)]) continue;
    const PointFeature& feature = features[Index(f)];
    nearest.Offer(f, DescriptorDistance(query.descriptor, feature.descriptor), feature.octave);
  }
  return nearest;
}

}  // namespace

int DescriptorDistance(const Descriptor& a, const Descriptor& b) {
  std::array<std::uint64_t, 4> x, y;
  static_assert(sizeof(x) == sizeof(Descriptor));
  std::memcpy(x.data(), a.data(), sizeof(x));
  std::memcpy(y.data(), b.data(), sizeof(y));
  // Bits are summed in bytes, four words at a time: std::popcount calls a function for each
  // word where the machine's own instruction may not be assumed.
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint64_t v = x[i] ^ y[i];
    v -= (v >> 1) & 0x5555555555555555ull;
    v = (v & 0x3333333333333333ull) + ((v >> 2) & 0x3333333333333333ull);
    bytes += (v + (v >> 4)) & 0x0F0F0F0F0F0F0F0Full;
  }
  // Bytes hold at most 32 each; their sum, at most 256, needs more than the top byte.
  bytes = (bytes & 0x00FF00FF00FF00FFull) + ((bytes >> 8) & 0x00FF00FF00FF00FFull);
  return static_cast<int>((bytes * 0x0001000100010001ull) >> 48);
}

FeatureGrid::FeatureGrid(const std::vector<PointFeature>& features, const Camera& camera)
    : features_(features),
      columns_(std::max(1, static_cast<int>(std::ceil(camera.width / kCell_px)))),
      rows_(std::max(1, static_cast<int>(std::ceil(camera.height / kCell_px)))),
      cells_(Index(columns_ * rows_)) {
  for (int i = 0; i < static_cast<int>(features.size()); ++i) {
    const Eigen::Vector2d& u_px = features[Index(i)].u_px;
    cells_[Index(RowOf(u_px.y()) * columns_ + ColumnOf(u_px.x()))].push_back(i);
  }
}

int FeatureGrid::ColumnOf(double u_px) const {
  return static_cast<int>(std::clamp(std::floor(u_px / kCell_px), 0.0, columns_ - 1.0));
}

int FeatureGrid::RowOf(double v_px) const {
  return static_cast<int>(std::clamp(std::floor(v_px / kCell_px), 0.0, rows_ - 1.0));
}

std::vector<int> FeatureGrid::Near(const Eigen::Vector2d& u_px, double radius_px,
                                   int min_octave, int max_octave) const {
  std::vector<int> near;
  if (!u_px.allFinite()) return near;
  for (int r = RowOf(u_px.y() - radius_px); r <= RowOf(u_px.y() + radius_px); ++r) {
    for (int c = ColumnOf(u_px.x() - radius_px); c <= ColumnOf(u_px.x() + radius_px); ++c) {
      for (const int f : cells_[Index(r * columns_ + c)]) {
        const PointFeature& feature = features_[Index(f)];
        if (feature.octave < min_octave || feature.octave > max_octave) continue;
        const Eigen::Vector2d away = (feature.u_px - u_px).cwiseAbs();
        if (away.x() <= radius_px && away.y() <= radius_px) near.push_back(f);
      }
    }
  }
  return near;
}

std::vector<int> MatchQueries(const std::vector<PointQuery>& queries,
                              const std::vector<PointFeature>& features,
                              const FeatureGrid& grid, const std::vector<bool>& taken,
                              const PointMatchConfig& config) {
  // Each query takes its nearest feature; of two that want one, the nearer query has it.
  std::vector<int> matches(features.size(), kNone);
  std::vector<int> distances(features.size(), kTooFar);
  for (int q = 0; q < static_cast<int>(queries.size()); ++q) {
    const Nearest nearest = Search(queries[Index(q)], features, grid, taken);
    if (!nearest.Accepted(config)) continue;
    if (nearest.distance >= distances[Index(nearest.index)]) continue;
    matches[Index(nearest.index)] = q;
    distances[Index(nearest.index)] = nearest.distance;
  }

  // Wrong matches turn at random: keep those that turn as most do.
  std::vector<double> turns_deg(features.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (matches[f] == kNone) continue;
    const float seen_deg = queries[Index(matches[f])].angle_deg;
    if (seen_deg >= 0) turns_deg[f] = static_cast<double>(features[f].angle_deg - seen_deg);
  }
  const std::vector<bool> consistent = ConsistentTurns(turns_deg);
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!consistent[f]) matches[f] = kNone;
  }
  return matches;
}

bool HasDouble(const PointFeature& feature, const std::vector<PointFeature>& features,
               const FeatureGrid& grid, const FeatureScale& scale, double reach_px,
               int max_distance) {
  constexpr double kSameCorner_px = 3.0;  // FAST's ring: nearer than that it is one corner
  const double size = scale.Scale(feature.octave);
  const auto near =
      grid.Near(feature.u_px, reach_px * size, feature.octave - 1, feature.octave + 1);
  return std::any_of(near.begin(), near.end(), [&](int index) {
    const PointFeature& other = features[Index(index)];
    return (other.u_px - feature.u_px).norm() > kSameCorner_px * size &&
           DescriptorDistance(other.descriptor, feature.descriptor) <= max_distance;
  });
}

std::vector<FeaturePair> MatchDescriptors(const std::vector<PointFeature>& first,
                                          const std::vector<PointFeature>& second,
                                          const std::vector<bool>& use_second,
                                          const PointMatchConfig& config) {
  // Compare all with all, and note the nearest of each on both sides.
  std::vector<Nearest> of_first(first.size());
  std::vector<int> of_second(second.size(), kNone);
  std::vector<int> distance_of_second(second.size(), kTooFar);
  for (int i = 0; i < static_cast<int>(first.size()); ++i) {
    for (int j = 0; j < static_cast<int>(second.size()); ++j) {
      if (!use_second.empty() && !use_second[Index(j)]) continue;
      const int d = DescriptorDistance(first[Index(i)].descriptor, second[Index(j)].descriptor);
      of_first[Index(i)].Offer(j, d, 0);  // the ratio is asked whatever the octave
      if (d < distance_of_second[Index(j)]) {
        distance_of_second[Index(j)] = d;
        of_second[Index(j)] = i;
      }
    }
  }
  // Keep pairs in which each is the other's nearest, near enough, and clearly so.
  std::vector<FeaturePair> pairs;
  std::vector<double> turns_deg;
  for (int i = 0; i < static_cast<int>(first.size()); ++i) {
    const Nearest& nearest = of_first[Index(i)];
    if (nearest.index == kNone || of_second[Index(nearest.index)] != i) continue;
    if (nearest.distance > config.max_distance) continue;
    if (!(nearest.distance <= config.max_ratio * nearest.second_distance)) continue;
    pairs.push_back({i, nearest.index});
    turns_deg.push_back(static_cast<double>(second[Index(nearest.index)].angle_deg -
                                            first[Index(i)].angle_deg));
  }
  const std::vector<bool> consistent = ConsistentTurns(turns_deg);
  std::vector<FeaturePair> kept;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (consistent[k]) kept.push_back(pairs[k]);
  }
  return kept;
}

std::vector<bool> ConsistentTurns(const std::vector<double>& turns_deg) {
  constexpr int kBins = 30, kKept = 3;  // bins of 12 degrees; values of ORB-SLAM2
  constexpr double kMinShare = 0.1;     // share of the fullest bin that a kept one has
  const auto bin_of = [](double turn_deg) {
    const double turns = turn_deg / 360.0;
    const int bin = static_cast<int>(std::lround((turns - std::floor(turns)) * kBins));
    return Index(bin % kBins);
  };
  // Histogram of the turns.
  std::array<int, kBins> counts{};
  for (const double turn : turns_deg) {
    if (std::isfinite(turn)) ++counts[bin_of(turn)];
  }
  // The fullest bins stay, and what lies in them.
  std::array<std::size_t, kBins> order;
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
  std::array<bool, kBins> kept{};
  for (std::size_t k = 0; k < kKept; ++k) {
    kept[order[k]] = counts[order[k]] >= kMinShare * counts[order[0]];
  }
  std::vector<bool> consistent(turns_deg.size());
  for (std::size_t i = 0; i < turns_deg.size(); ++i) {
    consistent[i] = !std::isfinite(turns_deg[i]) || kept[bin_of(turns_deg[i])];
  }
  return consistent;
}

}  // namespace slam
