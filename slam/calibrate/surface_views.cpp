#include "slam/calibrate/surface_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace slam {
namespace {

constexpr double kMinPartShare = 0.1;        // of a cell: enough for its mean to show a step
constexpr double kMinCellShare = 0.5;        // of a cell, to speak for the middle of it
constexpr double kMinImageShare = 0.05;      // balances: a plane takes 3 numbers of its view
constexpr double kMaxOff_spreads = 2.5;      // rms of a piece off the common plane; 1 in 80
constexpr double kMaxCellOff_spreads = 4.0;  // 1 in 16,000: what is farther is another thing
constexpr double kMaxStep = 0.0015;  // of the depth; balances: a bend in half a cell, a book
constexpr int kMinSharedCells = 3;   // fewer show no line along which two segments touch
constexpr double kUneven = 0.001;    // of the depth; measured: 0.0005 and 0.0015 are as good
constexpr int kStep_px = 2;  // noise of neighbours is shared: every other pixel tells all

/// What one segment shows in one cell.
struct CellPart {
  int cell = 0, label = 0;
  double n = 0.0;                    ///< pixels
  double x = 0.0, y = 0.0, q = 0.0;  ///< means
};

/// Segments of one surface.
struct SurfaceGroup {
  std::vector<int> parts;  ///< positions in the list of all parts
  PlaneSums sums;
};

/// How two segments meet in the cells that show both.
struct Contact {
  int first = 0, second = 0;  ///< labels, first < second
  int cells = 0;
  double step = 0.0;  ///< sum over the cells, as a part of the inverse depth
};

/// The parts of all segments, by cells.
std::vector<CellPart> PartsOfCells(const cv::Mat1f& depth_m, const cv::Mat1b& labels,
                                   const cv::Mat2d& rays, const WarpCells& cells) {
  std::vector<CellPart> parts;
  std::array<int, 256> at;  // of a label, among the parts of the cell
  for (int cell = 0; cell < cells.count(); ++cell) {
    const int row = cell / cells.cols, col = cell % cells.cols;
    at.fill(-1);
    const std::size_t begin = parts.size();
    for (int v = cells.Top(row); v < cells.Top(row + 1); v += kStep_px) {
      for (int u = cells.Left(col); u < cells.Left(col + 1); u += kStep_px) {
        const std::uint8_t label = labels(v, u);
        const double z = static_cast<double>(depth_m(v, u));
        if (label == 0 || !(z > 0)) continue;
        if (at[label] < 0) {
          at[label] = static_cast<int>(parts.size());
          parts.push_back({cell, label});
        }
        CellPart& part = parts[static_cast<std::size_t>(at[label])];
        const cv::Vec2d& ray = rays(v, u);
        part.n += 1, part.x += ray[0], part.y += ray[1], part.q += 1 / z;
      }
    }
    // Sums become means; slivers are left out.
    const int pixels =
        (cells.Left(col + 1) - cells.Left(col)) * (cells.Top(row + 1) - cells.Top(row));
    const auto sliver = [&](const CellPart& part) {
      return kStep_px * kStep_px * part.n < kMinPartShare * pixels;
    };
    parts.erase(
        std::remove_if(parts.begin() + static_cast<std::ptrdiff_t>(begin), parts.end(), sliver),
        parts.end());
    for (std::size_t k = begin; k < parts.size(); ++k) {
      CellPart& part = parts[k];
      part.x /= part.n, part.y /= part.n, part.q /= part.n;
      part.n *= kStep_px * kStep_px;
    }
  }
  return parts;
}

/// Sees parts as points of inverse depth that are freed of the known pattern.
class PartPoints {
 public:
  PartPoints(const std::vector<CellPart>& parts, const DepthNoise& noise,
             const Eigen::VectorXd& known, const Eigen::VectorXd& spread, BendLaw law)
      : parts_(parts), noise_(noise), known_(known), spread_(spread), law_(law) {}

  double InverseDepth(const CellPart& part) const {
    return part.q * (1 + known_[part.cell] * BendGrowth(law_, 1 / part.q));
  }
  /// Of the mean inverse depth, as a part of it, for a surface that is seen frontally.
  double Sigma(const CellPart& part) const {
    const double z = 1 / part.q;
    const double pixel = noise_.Sigma(z) / z;
    return std::hypot(pixel * std::sqrt(std::min(1.0, noise_.correlated_px / part.n)), kUneven);
  }
  void Add(const CellPart& part, PlaneSums& sums) const {
    const double q = InverseDepth(part), sigma = Sigma(part) * q;
    sums.Add(part.x, part.y, q, 1 / (sigma * sigma));
  }
  /// How far the plane is from the part, as a part of the inverse depth.
  double Off(const CellPart& part, const InverseDepthPlane& plane) const {
    return plane.InverseDepth(part.x, part.y) / InverseDepth(part) - 1;
  }
  /// How far a part of a flat surface is expected off its plane, in the same unit.
  double Spread(const CellPart& part) const {
    return std::hypot(Sigma(part), spread_[part.cell] * BendGrowth(law_, 1 / part.q));
  }
  /// Whether the parts of a group keep to a plane as far as a bend goes.
  bool Keeps(const SurfaceGroup& group, const InverseDepthPlane& plane) const {
    double squares = 0.0, bound = 0.0;
    for (const int k : group.parts) {
      const CellPart& part = parts_[static_cast<std::size_t>(k)];
      const double off = Off(part, plane), spread = kMaxOff_spreads * Spread(part);
      squares += off * off;
      bound += spread * spread;
    }
    return squares < bound;
  }

 private:
  const std::vector<CellPart>& parts_;
  const DepthNoise& noise_;
  const Eigen::VectorXd &known_, &spread_;
  BendLaw law_;
};

/// A group for each label that has a plane.
std::map<int, SurfaceGroup> GroupsOfSegments(const std::vector<CellPart>& parts,
                                             const PartPoints& points) {
  std::map<int, SurfaceGroup> groups;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    SurfaceGroup& group = groups[parts[k].label];
    group.parts.push_back(static_cast<int>(k));
    points.Add(parts[k], group.sums);
  }
  std::erase_if(groups, [](const auto& entry) { return !Fit(entry.second.sums); });
  return groups;
}

/// The pairs of segments that share cells; the more they share, the earlier.
std::vector<Contact> Contacts(const std::vector<CellPart>& parts,
                              const std::map<int, SurfaceGroup>& groups,
                              const PartPoints& points) {
  std::map<int, InverseDepthPlane> planes;
  for (const auto& [label, group] : groups) planes[label] = Fit(group.sums)->plane;
  std::map<std::pair<int, int>, Contact> found;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size() && parts[j].cell == parts[i].cell; ++j) {
      const bool in_order = parts[i].label < parts[j].label;
      const CellPart& a = in_order ? parts[i] : parts[j];
      const CellPart& b = in_order ? parts[j] : parts[i];
      if (planes.count(a.label) == 0 || planes.count(b.label) == 0) continue;
      const InverseDepthPlane& plane_a = planes[a.label];
      const InverseDepthPlane& plane_b = planes[b.label];
      Contact& contact = found[{a.label, b.label}];
      contact.first = a.label, contact.second = b.label;
      contact.cells += 1;
      contact.step += 0.5 * (points.Off(b, plane_a) - points.Off(a, plane_a) +
                             points.Off(b, plane_b) - points.Off(a, plane_b));
    }
  }
  std::vector<Contact> contacts;
  contacts.reserve(found.size());
  for (const auto& [labels, contact] : found) contacts.push_back(contact);
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& a, const Contact& b) { return a.cells > b.cells; });
  return contacts;
}

/// Joins segments that touch without a step and share a plane.
void JoinGroups(const std::vector<Contact>& contacts, const PartPoints& points,
                std::map<int, SurfaceGroup>& groups) {
  std::map<int, int> joined;  // label to the label of its group
  for (const auto& [label, group] : groups) joined[label] = label;
  for (const Contact& contact : contacts) {
    if (contact.cells < kMinSharedCells) continue;
    if (!(std::abs(contact.step) < kMaxStep * contact.cells)) continue;
    const int a = joined[contact.first], b = joined[contact.second];
    if (a == b) continue;
    SurfaceGroup &whole = groups[a], &part = groups[b];
    PlaneSums sums = whole.sums;
    sums += part.sums;
    const std::optional<PlaneFit> fit = Fit(sums);
    if (!fit || !points.Keeps(whole, fit->plane) || !points.Keeps(part, fit->plane)) {
      continue;
    }
    whole.sums = sums;
    whole.parts.insert(whole.parts.end(), part.parts.begin(), part.parts.end());
    groups.erase(b);
    for (auto& [label, group] : joined) group = group == b ? a : group;
  }
}

/// The parts of a surface that share a cell, as one.
std::vector<CellPart> UniteParts(const std::vector<CellPart>& parts,
                                 const SurfaceGroup& group) {
  std::map<int, CellPart> united;
  for (const int k : group.parts) {
    const CellPart& part = parts[static_cast<std::size_t>(k)];
    CellPart& cell = united[part.cell];
    const double n = cell.n + part.n;
    cell.cell = part.cell;
    cell.x += (part.x - cell.x) * part.n / n;
    cell.y += (part.y - cell.y) * part.n / n;
    cell.q += (part.q - cell.q) * part.n / n;
    cell.n = n;
  }
  std::vector<CellPart> list;
  list.reserve(united.size());
  for (const auto& [cell, part] : united) list.push_back(part);
  return list;
}

double PixelsOfCell(const WarpCells& cells) {
  return static_cast<double>(cells.width) * cells.height / cells.count();
}

/// The cells that the surface fills and that lie on its plane, without single other things.
/// Nothing when they are too few.
std::optional<SurfaceView> ViewOf(std::vector<CellPart> parts, const PartPoints& points,
                                  const WarpCells& cells, const DepthNoise& noise) {
  constexpr int kRounds = 3;  // others move the plane a little, so that it is fitted again
  std::erase_if(parts, [&](const CellPart& part) {
    return part.n < kMinCellShare * PixelsOfCell(cells);
  });
  InverseDepthPlane plane;
  for (int round = 0; round < kRounds; ++round) {
    if (static_cast<double>(parts.size()) < kMinImageShare * cells.count()) return std::nullopt;
    PlaneSums sums;
    for (const CellPart& part : parts) points.Add(part, sums);
    const std::optional<PlaneFit> fit = Fit(sums);
    if (!fit) return std::nullopt;
    plane = fit->plane;
    std::erase_if(parts, [&](const CellPart& part) {
      return !(std::abs(points.Off(part, plane)) < kMaxCellOff_spreads * points.Spread(part));
    });
  }
  SurfaceView view;
  view.plane = plane;
  for (const CellPart& part : parts) {
    const double grazing = noise.GrazingFactor(1 / part.q, plane.Cosine(part.x, part.y));
    view.cells.push_back({part.cell, part.x, part.y, part.q, grazing * points.Sigma(part)});
  }
  return view;
}

}  // namespace

std::vector<SurfaceView> ViewSurfaces(const cv::Mat1f& depth_m, const cv::Mat1b& labels,
                                      const cv::Mat2d& rays, const WarpCells& cells,
                                      const DepthNoise& noise, const Eigen::VectorXd& known,
                                      const Eigen::VectorXd& spread, BendLaw law) {
  const std::vector<CellPart> parts = PartsOfCells(depth_m, labels, rays, cells);
  const PartPoints points(parts, noise, known, spread, law);
  std::map<int, SurfaceGroup> groups = GroupsOfSegments(parts, points);
  JoinGroups(Contacts(parts, groups, points), points, groups);
  std::vector<SurfaceView> views;
  for (const auto& [label, group] : groups) {
    if (auto view = ViewOf(UniteParts(parts, group), points, cells, noise)) {
      views.push_back(std::move(*view));
    }
  }
  return views;
}

}  // namespace slam
