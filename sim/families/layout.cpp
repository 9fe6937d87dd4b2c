#include "sim/families/layout.h"

#include <algorithm>
#include <cmath>

#include "sim/base/angle.h"

namespace sim {
namespace {

Eigen::Vector2d Across(const Eigen::Vector2d& axis) { return {-axis.y(), axis.x()}; }

}  // namespace

bool Layout::OnTable(const Rectangle& r) const {
  const Eigen::Vector2d reach = r.x_axis.cwiseAbs() * r.half.x() +
                                Across(r.x_axis).cwiseAbs() * r.half.y() +
                                Eigen::Vector2d::Constant(margin_m_);
  return ((r.center - reach).array() >= low_.array()).all() &&
         ((r.center + reach).array() <= high_.array()).all();
}

bool Layout::Free(const Rectangle& r) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const Rectangle& other) {
    double apart = 0;  // the widest gap along an edge direction of either
    for (const Rectangle* owner : {&r, &other}) {
      for (const Eigen::Vector2d& axis : {owner->x_axis, Across(owner->x_axis)}) {
        double reach = 0;
        for (const Rectangle* one : {&r, &other}) {
          reach += std::abs(one->x_axis.dot(axis)) * one->half.x() +
                   std::abs(Across(one->x_axis).dot(axis)) * one->half.y();
        }
        apart = std::max(apart, std::abs((other.center - r.center).dot(axis)) - reach);
      }
    }
    return apart < margin_m_;
  });
}

std::optional<Place> Layout::Find(const Eigen::Vector2d& footprint, const Zone& zone, int tries,
                                  Random& random) {
  for (int i = 0; i < tries; ++i) {
    Place place;
    place.x = DrawLength(random, zone.low.x(), zone.high.x());
    place.y = DrawLength(random, zone.low.y(), zone.high.y());
    place.yaw_deg = Rounded(std::round(random.Between(-1, 1) * zone.max_yaw_deg * 10) / 10);
    const SinCos yaw = SinCosDeg(place.yaw_deg);
    const Rectangle rectangle{{place.x, place.y}, footprint / 2, {yaw.cos, yaw.sin}};
    if (!OnTable(rectangle) || !Free(rectangle)) continue;
    taken_.push_back(rectangle);
    return place;
  }
  return std::nullopt;
}

}  // namespace sim
