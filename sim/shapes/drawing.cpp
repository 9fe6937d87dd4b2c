#include "sim/shapes/drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "io/number_text.h"
#include "sim/scene/geometry.h"
#include "sim/shapes/steps.h"

namespace sim {
namespace {

constexpr double kPixelsPerMetre = 500, kMargin_m = 0.15, kBetween_m = 0.30;

std::string Number(double x) { return io::NumberText(std::round(x * 10) / 10 + 0.0); }

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return escaped;
}

/// Andrew's monotone chain.
std::vector<Eigen::Vector2d> Hull(std::vector<Eigen::Vector2d> points) {
  const auto less = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), less);
  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= start + 2) {
        const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = p - hull.back();
        if (a.x() * b.y() - a.y() * b.x() > 1e-12) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool IsDrawn(const Object& object) {
  return object.class_name != "floor" && object.class_name != "wall";
}

/// One of the two views: which axes of the world go right and up the page, and where.
struct Sheet {
  int right, up;
  Eigen::Vector2d low, high;  ///< corners of what is drawn, metres
  double top_px = 0;          ///< where the sheet is on the page
  Eigen::Vector2d operator()(const Eigen::Vector3d& x_w) const {
    return {(x_w[right] - low.x()) * kPixelsPerMetre,
            top_px + (high.y() - x_w[up]) * kPixelsPerMetre};
  }
  double Height_px() const { return (high.y() - low.y()) * kPixelsPerMetre; }
};

std::string Colour(const Object& object) {
  std::string colour = "rgb(";
  // All of what is no box has the material of the first face.
  const auto face =
      object.shape == ShapeKind::kBox ? static_cast<std::size_t>(Face::kPlusZ) : std::size_t{0};
  for (const double part : object.faces[face].colour) {
    const double display = std::sqrt(std::clamp(part, 0.0, 1.0));  // near enough to sRGB
    colour += std::to_string(static_cast<int>(std::lround(255 * display))) + ",";
  }
  colour.back() = ')';
  return colour;
}

std::string Outline(const Object& object, const Sheet& sheet) {
  std::vector<Eigen::Vector2d> points;
  const bool round = object.shape != ShapeKind::kBox && object.shape != ShapeKind::kMesh;
  if (!round || sheet.up == 2) {
    for (const Eigen::Vector3d& corner : Corners(object)) points.push_back(sheet(corner));
  } else {
    // Its lower and its upper rim: a standing one is as round as they are, a lying one as long.
    for (int i = 0; i < 48; ++i) {
      const double angle = 2 * M_PI * i / 48;
      for (const double end : {-0.5, 0.5}) {
        const Eigen::Vector3d rim(std::cos(angle) / 2, std::sin(angle) / 2, end);
        points.push_back(sheet(ObjectPose(object) * rim.cwiseProduct(object.size)));
      }
    }
  }
  std::string text = "  <polygon points=\"";
  for (const Eigen::Vector2d& p : Hull(points)) {
    text += Number(p.x()) + "," + Number(p.y()) + " ";
  }
  text.back() = '"';
  return text + " fill=\"" + Colour(object) +
         "\" fill-opacity=\"0.75\" stroke=\"black\"><title>" + Escaped(object.name) +
         "</title></polygon>\n";
}

std::string Label(const Eigen::Vector2d& at, const std::string& text) {
  return "  <text x=\"" + Number(at.x()) + "\" y=\"" + Number(at.y()) +
         "\" text-anchor=\"middle\">" + Escaped(text) + "</text>\n";
}

/// "book_2 +24.5 mm": the step to what is under the object's top, one after another for several.
std::map<int, std::string> StepLabels(const Scene& scene) {
  std::map<int, std::string> labels;
  for (const TopStep& step : TopSteps(scene, ScenePlanes(scene))) {
    for (const Object& object : scene.objects) {
      if (object.id != step.object) continue;
      std::string& label = labels[object.id];
      label += (label.empty() ? object.name : ",") + " +" +
               io::NumberText(std::round(step.step_mm * 10) / 10) + " mm";
    }
  }
  return labels;
}

std::string Draw(const Scene& scene, const Sheet& sheet,
                 const std::map<int, std::string>& labels) {
  std::vector<const Object*> order;
  for (const Object& object : scene.objects) {
    if (IsDrawn(object)) order.push_back(&object);
  }
  const auto depth = [&](const Object* object) {  // the nearest to the viewer comes last
    double nearest = sheet.up == 1 ? -1e9 : 1e9;
    for (const Eigen::Vector3d& corner : Corners(*object)) {
      nearest = sheet.up == 1 ? std::max(nearest, corner.z()) : std::min(nearest, corner.y());
    }
    return sheet.up == 1 ? nearest : -nearest;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const Object* a, const Object* b) { return depth(a) < depth(b); });
  std::string text;
  for (const Object* object : order) text += Outline(*object, sheet);
  for (const Object* object : order) {
    const auto label = labels.find(object->id);
    if (label == labels.end()) continue;
    Eigen::Vector3d at = object->center_w;
    if (sheet.up == 2) at.z() += object->size.z() / 2 + 0.01;
    text += Label(sheet(at), label->second);
  }
  return text;
}

std::string Way(const Scene& scene, const Sheet& sheet) {
  if (scene.motion.stations.empty()) return "";
  std::string text =
      "  <polygon fill=\"none\" stroke=\"blue\" stroke-dasharray=\"6\" points=\"";
  for (const Station& station : scene.motion.stations) {
    const Eigen::Vector2d p = sheet(station.camera_w);
    text += Number(p.x()) + "," + Number(p.y()) + " ";
  }
  text.back() = '"';
  return text + "><title>stations of the camera</title></polygon>\n";
}

}  // namespace

std::string SceneSvg(const Scene& given) {
  const auto labels = StepLabels(given);
  Scene scene = given;  // what moves, as it stands at the first point of its way
  for (Object& object : scene.objects) {
    if (!object.way.empty()) object = ObjectAt(object, object.way.front().time_s);
  }
  Eigen::AlignedBox3d extent;
  for (const Object& object : scene.objects) {
    if (!IsDrawn(object)) continue;
    for (const Eigen::Vector3d& corner : Corners(object)) extent.extend(corner);
  }
  for (const Station& station : scene.motion.stations) extent.extend(station.camera_w);
  if (extent.isEmpty()) extent.extend(Eigen::Vector3d::Zero());
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin_m);
  const Eigen::Vector3d low = extent.min() - margin, high = extent.max() + margin;
  Sheet plan{0, 1, low.head<2>(), high.head<2>()};
  plan.top_px = 30;
  Sheet elevation{0, 2, {low.x(), low.z()}, {high.x(), high.z()}};
  elevation.top_px = plan.top_px + plan.Height_px() + kBetween_m * kPixelsPerMetre;
  const double width = (high.x() - low.x()) * kPixelsPerMetre;
  const double height = elevation.top_px + elevation.Height_px() + 40;

  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                     Number(width) + " " + Number(height) +
                     "\" font-family=\"sans-serif\" font-size=\"11\">\n"
                     "  <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  text += Label({width / 2, 20}, scene.name + ": plan, steps over what lies below");
  text += Way(scene, plan) + Draw(scene, plan, labels);
  text += Label({width / 2, elevation.top_px - 10}, "elevation, seen from -y");
  text += Way(scene, elevation) + Draw(scene, elevation, labels);
  text += "  <line x1=\"20\" x2=\"" + Number(20 + 0.1 * kPixelsPerMetre) + "\" y1=\"" +
          Number(height - 20) + "\" y2=\"" + Number(height - 20) +
          "\" stroke=\"black\" stroke-width=\"3\"/>\n";
  text += Label({20 + 0.05 * kPixelsPerMetre, height - 6}, "100 mm");
  return text + "</svg>\n";
}

}  // namespace sim
