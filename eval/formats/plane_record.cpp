#include "eval/formats/plane_record.h"

#include <fmt/format.h>

#include <cmath>

namespace eval {
namespace {

// Corners and hull points are averages and measurements: a sensor at 3 m is off by 15 mm (one
// sigma). What is beyond is in another frame or belongs to another plane.
constexpr double kOffRunPlane_m = 0.10;

const io::Interval kOffsets(fmt::format("[{0:g}, {1:g}]", -kMaxCoordinate_m, kMaxCoordinate_m));

}  // namespace

std::optional<Plane> ReadPlane(const JsonRecord& record, double unit_tolerance) {
  const auto n = record.Vector3("normal");
  const auto d = record.Number("d", kOffsets);
  if (!n || !d) return std::nullopt;
  if (!(std::abs(n->norm() - 1) <= unit_tolerance)) {
    record.TellAt("normal",
                  fmt::format("has length {:.8g}; expected 1, a unit normal", n->norm()),
                  "normalise the normal and divide d by the same length");
    return std::nullopt;
  }
  return Plane{n->normalized(), *d};
}

std::vector<Eigen::Vector3d> ReadPointsOnPlane(const JsonRecord& record, const std::string& key,
                                               const std::optional<Plane>& pi) {
  if (!record.Has(key)) {
    record.TellAt(
        key, "is missing; expected a list of points",
        fmt::format("write the {} of each plane, an empty list where it has none", key),
        Severity::kWarning);
    return {};
  }
  std::vector<Eigen::Vector3d> points = record.Points(key);
  for (std::size_t i = 0; pi && i < points.size(); ++i) {
    const double off_m = SignedDistance(*pi, points[i]);
    if (std::abs(off_m) <= kOffRunPlane_m) continue;
    record.TellAt(fmt::format("{}/{}", key, i),
                  fmt::format("is {:.3f} m off its plane n . x + d = 0", off_m),
                  "write points and plane in one frame, n . x + d = 0", Severity::kWarning);
  }
  return points;
}

}  // namespace eval
