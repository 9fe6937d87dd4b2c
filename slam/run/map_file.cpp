#include "slam/run/map_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "slam/base/require.h"
#include "slam/run/frame_record.h"
#include "slam/run/text_number.h"

namespace slam {
namespace {

using Json = nlohmann::ordered_json;

Json VectorsJson(const std::vector<Eigen::Vector3d>& list) {
  Json json = Json::array();
  for (const Eigen::Vector3d& x : list) json.push_back(VectorJson(x));
  return json;
}

double Finite(double x) {
  Require(std::isfinite(x), "map.json: a number to write is not finite");
  return x;
}

/// Upper triangle, row by row.
Json CovarianceJson(const Eigen::Matrix4d& C) {
  Json json = Json::array();
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) json.push_back(Finite(C(i, j)));
  }
  return json;
}

Json PlaneJson(const MapPlane& plane) {
  Json json;
  json["id"] = plane.id;
  json["class"] = plane.class_name.empty() ? Json(nullptr) : Json(plane.class_name);
  json["normal"] = VectorJson(plane.pi_w.n);
  json["d"] = Finite(plane.pi_w.d);
  if (!plane.estimate.empty())
    json["covariance"] = CovarianceJson(plane.estimate.WorldCovariance());
  json["area"] = Finite(plane.area_m2);
  json["observations"] = plane.observations;
  json["first_seen"] = Finite(plane.first_seen_s);
  json["last_seen"] = Finite(plane.last_seen_s);
  json["merged_into"] = plane.merged_into != kNone ? Json(plane.merged_into) : Json(nullptr);
  if (plane.split_from != kNone) {
    json["split_from"] = plane.split_from;
    json["split_at"] = Finite(plane.split_at_s);
  }
  json["vertices"] = VectorsJson(plane.vertices_w);
  json["hull"] = VectorsJson(plane.hull_w);
  return json;
}

}  // namespace

std::string MapAsJson(const Map& map) {
  std::string text = "{\"planes\": [";
  const char* separator = "\n";
  for (const MapPlane& plane : map.planes) {
    if (plane.status == LandmarkStatus::kCandidate) continue;
    text += separator + PlaneJson(plane).dump(-1, ' ', false, Json::error_handler_t::replace);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

std::array<std::uint8_t, 3> PlaneColour(int id) {
  // Steps by the golden ratio round the colour circle, at two brightnesses.
  const double hue = std::fmod(0.1 + id * 0.6180339887498949, 1.0) * 6.0;
  const double value = id % 2 == 0 ? 1.0 : 0.75;
  constexpr double kSaturation = 0.75;
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue, 6.0);
    const double x = value - value * kSaturation * std::max(0.0, std::min({k, 4.0 - k, 1.0}));
    return static_cast<std::uint8_t>(std::lround(255.0 * x));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

std::string MapAsPly(const Map& map) {
  std::size_t count = 0;
  std::string body;
  for (const MapPlane& plane : map.planes) {
    if (plane.status != LandmarkStatus::kLandmark) continue;
    const auto colour = PlaneColour(plane.id);
    std::string tail;
    for (const int number : {int{colour[0]}, int{colour[1]}, int{colour[2]}, plane.id})
      tail.append(" ").append(std::to_string(number));
    for (const Eigen::Vector3d& p : plane.points_w) {
      body += FiniteNumberText(p.x()) + ' ' + FiniteNumberText(p.y()) + ' ' +
              FiniteNumberText(p.z()) + tail + '\n';
      ++count;
    }
  }
  return "ply\nformat ascii 1.0\ncomment map planes, world frame, metres\nelement vertex " +
         std::to_string(count) +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
         "property uchar green\nproperty uchar blue\nproperty int plane_id\nend_header\n" +
         body;
}

}  // namespace slam
