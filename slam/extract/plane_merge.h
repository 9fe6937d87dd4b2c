#pragma once

#include <utility>
#include <vector>

#include "slam/extract/block_clusters.h"
#include "slam/extract/pixel_growth.h"

namespace slam {

/// When two labels are parts of one plane.
struct MergeConfig {
  /// Two touching segments are one plane if along their common boundary the planes are closer
  /// than this (root mean square, in sigmas, after their uncertainty); and what does not touch,
  /// over the pixels of the smaller. Domain (0, inf).
  double max_gap_sigmas = 1.5;
  /// How far a real sensor may bend a flat surface: gap over the smaller patch, and angle
  /// between two touching parts. Domain (0, inf).
  double max_bend_sigmas = 3.0;
  double max_bend_rad = 0.12;
};

/// A label's plane and the pixels that it was fitted to.
struct Patch {
  PlaneSums sums;
  LabelPlane plane;
};

/// The pixels on either side of the common boundary of two labels, a < b.
struct Contact {
  int a = 0, b = 0;
  PlaneSums sums;
};

/// Finds which labels are one plane. Memory is used again from frame to frame.
class PlaneMerging {
 public:
  PlaneMerging(const DepthNoise& noise, const ClusterConfig& clusters,
               const MergeConfig& config)
      : noise_(noise), clusters_(clusters), config_(config) {}

  /// Fits every label to its pixels and finds which labels touch.
  void Start(const DepthGrid& grid, const PixelGrowth& growth);

  /// Merges touching labels that are one plane within the noise, closest pair first.
  void MergeEqual();

  /// Joins touching labels that are parts of one surface which the sensor has bent: a real step
  /// stands all along the boundary, while the parts of a bent surface meet there. So the planes
  /// of the two labels must agree along the boundary, and those of the segments that they
  /// belong to must agree within the wider bounds on bending.
  void JoinBent();

  /// Squared distance of two planes over the pixels of the smaller, over what noise and
  /// `max_gap_sigmas` allow: below 1 they are one plane.
  double PatchGap(const Patch& a, const Patch& b, double max_gap_sigmas) const;

  int Root(int k) const { return into_[static_cast<std::size_t>(k)]; }
  const Patch& At(int k) const { return patches_[static_cast<std::size_t>(Root(k))]; }
  int Count() const { return static_cast<int>(patches_.size()); }
  /// What each label has become part of.
  const std::vector<int>& into() const { return into_; }
  /// Plane of each label; those merged into another keep their last.
  const std::vector<LabelPlane>& Planes();

 private:
  void FindContacts(const DepthGrid& grid, const LabelImage& labels);
  void AddContact(const DepthGrid& grid, int a, int b, std::size_t i, std::size_t j);
  void Refit(Patch& patch) const;
  double AllowedGap2(const Patch& a, const Patch& b, double max_gap_sigmas) const;
  double ContactGap(const Patch& a, const Patch& b, const PlaneSums& contact) const;
  void Join(int a, int b);

  DepthNoise noise_;
  ClusterConfig clusters_;
  MergeConfig config_;
  std::vector<Patch> patches_;
  std::vector<int> into_;
  std::vector<Contact> contacts_;
  // Scratch.
  std::vector<PlaneSums> sums_;
  std::vector<int> contact_of_;  ///< [a][b], -1 = none
  std::vector<double> gaps_;     ///< of each contact
  std::vector<std::pair<double, int>> meeting_;
  std::vector<LabelPlane> planes_;
};

}  // namespace slam
