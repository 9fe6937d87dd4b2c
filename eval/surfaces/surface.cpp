#include "eval/surfaces/surface.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "io/input_error.h"
#include "io/number_text.h"
#include "io/yaml_value.h"

namespace eval {
namespace {

constexpr const char* kFormat = "pas-surfaces/1";
constexpr double kUnit = 1e-3;        // as four written decimals may be off
constexpr double kMaxCorner_m = 200;  // from an edge on: a corridor; more is a slip of the pen
constexpr int kMaxSurfaceId = 65000;  // labels of pixels have 16 bits

const io::Interval kAnyNumber("(-inf, inf)"), kNotNegative("[0, inf)"), kPositive("(0, inf)");

Eigen::Vector3d ReadDirection(const io::YamlValue& value) {
  const Eigen::Vector3d direction = value.Numbers(3, io::Interval(-1 - kUnit, 1 + kUnit));
  if (!(std::abs(direction.norm() - 1) <= kUnit)) {
    value.Fail("expected a direction of length 1; divide it by its length");
  }
  return direction.normalized();
}

Polygon2 ReadPolygon(const io::YamlValue& value) {
  Polygon2 polygon;
  for (const io::YamlValue& corner : value.List()) {
    polygon.push_back(corner.Numbers(2, io::Interval(-kMaxCorner_m, kMaxCorner_m), "metres"));
  }
  if (polygon.size() < 3) value.Fail("expected at least 3 corners [u, v]");
  return polygon;
}

std::vector<Polygon2> ReadPolygons(const io::YamlValue& value) {
  std::vector<Polygon2> polygons;
  for (const io::YamlValue& polygon : value.List()) polygons.push_back(ReadPolygon(polygon));
  return polygons;
}

Surface ReadSurface(const io::YamlValue& value) {
  const io::YamlMap map(value, {"id", "same_as", "area_m2", "flatness_mm", "origin", "normal",
                                "axis_u", "outlines", "holes"});
  Surface surface;
  surface.id = map.At("id").Whole(io::Interval(1, kMaxSurfaceId));
  if (map.Has("same_as"))
    surface.same_as = map.At("same_as").Whole(io::Interval(1, kMaxSurfaceId));
  if (map.Has("area_m2")) map.At("area_m2").Number(kNotNegative, "square metres");
  if (map.Has("flatness_mm")) {
    surface.flatness_m = 1e-3 * map.At("flatness_mm").Number(kNotNegative, "mm");
  }
  const Eigen::Vector3d origin_g = map.At("origin").Numbers(3, kAnyNumber, "metres");
  const Eigen::Vector3d n_g = ReadDirection(map.At("normal"));
  const Eigen::Vector3d u_g = ReadDirection(map.At("axis_u"));
  if (!(std::abs(n_g.dot(u_g)) <= kUnit)) {
    map.At("axis_u").Fail("expected a direction at right angles to normal");
  }
  const Eigen::Vector3d axis_u = (u_g - n_g.dot(u_g) * n_g).normalized();
  surface.pi_g = {n_g, -n_g.dot(origin_g)};
  surface.chart_g = {origin_g, axis_u, n_g.cross(axis_u)};
  surface.outlines = ReadPolygons(map.At("outlines"));
  if (surface.outlines.empty()) map.At("outlines").Fail("expected at least one outline");
  if (map.Has("holes")) surface.holes = ReadPolygons(map.At("holes"));
  return surface;
}

/// Ids are used once, and `same_as` leads to a surface that is counted by itself.
void CheckIds(const std::vector<Surface>& surfaces, const std::vector<io::YamlValue>& values) {
  std::set<int> ids, parts;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!ids.insert(surfaces[i].id).second) {
      values[i].Fail(
          fmt::format("id {} is used a second time; give each its own", surfaces[i].id));
    }
    if (surfaces[i].same_as != 0) parts.insert(surfaces[i].id);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const int whole = surfaces[i].same_as;
    if (whole == 0 || (ids.count(whole) != 0 && parts.count(whole) == 0)) continue;
    values[i].Fail(fmt::format(
        "same_as {} is {}; name a surface that has no same_as itself", whole,
        ids.count(whole) == 0 ? "no surface of the file" : "a part of another itself"));
  }
}

/// In YAML's double quotes.
std::string Quoted(const std::string& plain) {
  std::string quoted = "\"";
  for (const char c : plain) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string NumberOf(double value, int decimals) {
  // Rounded first, so that the shortest text has no more than these decimals.
  const double unit = std::pow(10.0, decimals);
  const double rounded = std::round(value * unit) / unit;
  return io::NumberText(rounded == 0 ? 0.0 : rounded);
}

std::string ListOf(const Eigen::VectorXd& values, int decimals) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : ", ") + NumberOf(value, decimals);
  return "[" + text + "]";
}

void AddPolygons(const char* key, const std::vector<Polygon2>& polygons, std::string& text) {
  constexpr int kMillimetres = 3, kCornersALine = 8;
  if (polygons.empty()) return;
  text += fmt::format("    {}:\n", key);
  for (const Polygon2& polygon : polygons) {
    text += "      - [";
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (i > 0) text += i % kCornersALine == 0 ? ",\n         " : ", ";
      text += ListOf(polygon[i], kMillimetres);
    }
    text += "]\n";
  }
}

}  // namespace

double AreaOf(const Surface& surface) {
  double area_m2 = 0.0;
  for (const Polygon2& outline : surface.outlines) area_m2 += Area(outline);
  for (const Polygon2& hole : surface.holes) area_m2 -= Area(hole);
  return area_m2;
}

SurfaceFile ReadSurfaces(const std::filesystem::path& path) {
  const io::YamlMap map(io::ReadYaml(path, "make it with `pas surfaces SEQ -o FILE`"),
                        {"format", "sequence", "min_area_m2", "noise_per_m", "surfaces"});
  map.At("format").OneOf({kFormat});
  SurfaceFile file;
  if (map.Has("sequence")) file.sequence = map.At("sequence").Text();
  file.min_area_m2 = map.At("min_area_m2").Number(kPositive, "square metres");
  file.noise_per_m = map.At("noise_per_m").Number(kNotNegative, "1/m");
  const std::vector<io::YamlValue> values = map.At("surfaces").List();
  for (const io::YamlValue& value : values) file.surfaces.push_back(ReadSurface(value));
  CheckIds(file.surfaces, values);
  return file;
}

std::string SurfacesText(const SurfaceFile& file) {
  constexpr int kDirection = 6, kMillimetres = 4, kNoise = 6, kArea = 3, kFlatness = 1;
  std::string text = fmt::format("format: {}\n", kFormat);
  if (!file.sequence.empty()) text += "sequence: " + Quoted(file.sequence) + "\n";
  text += "min_area_m2: " + NumberOf(file.min_area_m2, kArea) + "\n";
  text += "noise_per_m: " + NumberOf(file.noise_per_m, kNoise) + "\n";
  text += file.surfaces.empty() ? "surfaces: []\n" : "surfaces:\n";
  for (const Surface& surface : file.surfaces) {
    text += fmt::format("  - id: {}\n", surface.id);
    if (surface.same_as != 0) text += fmt::format("    same_as: {}\n", surface.same_as);
    text += "    area_m2: " + NumberOf(AreaOf(surface), kArea) + "\n";
    text += "    flatness_mm: " + NumberOf(1e3 * surface.flatness_m, kFlatness) + "\n";
    text += "    origin: " + ListOf(surface.chart_g.origin, kMillimetres) + "\n";
    text += "    normal: " + ListOf(surface.pi_g.n, kDirection) + "\n";
    text += "    axis_u: " + ListOf(surface.chart_g.axis_u, kDirection) + "\n";
    AddPolygons("outlines", surface.outlines, text);
    AddPolygons("holes", surface.holes, text);
  }
  return text;
}

}  // namespace eval
