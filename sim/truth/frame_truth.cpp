#include "sim/truth/frame_truth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>

#include "sim/scene/geometry.h"

namespace sim {
namespace {

struct Extent {
  int pixels = 0;
  int u0 = 1 << 30, v0 = 1 << 30, u1 = -1, v1 = -1;
  /// Pixels `first` to `last` of row v, that one too.
  void Include(int first, int last, int v) {
    pixels += last - first + 1;
    u0 = std::min(u0, first);
    v0 = std::min(v0, v);
    u1 = std::max(u1, last);
    v1 = std::max(v1, v);
  }
};

std::map<int, Extent> Extents(const cv::Mat1w& ids) {
  std::vector<Extent> by_id;
  for (int v = 0; v < ids.rows; ++v) {
    const ushort* row = ids[v];
    for (int first = 0, next = 0; first < ids.cols; first = next) {
      const std::size_t id = row[first];
      while (next < ids.cols && row[next] == id) ++next;
      if (id >= by_id.size()) by_id.resize(id + 1);
      by_id[id].Include(first, next - 1, v);
    }
  }
  std::map<int, Extent> seen;
  for (std::size_t id = 1; id < by_id.size(); ++id) {
    if (by_id[id].pixels > 0) seen.emplace(static_cast<int>(id), by_id[id]);
  }
  return seen;
}

/// The group that an object is detected with; 0 = none.
int GroupOf(const Object& object) {
  return object.role == Role::kStructure ? 0 : object.detection_group;
}

/// Pixels whose centre may lie in the box, cut at the image.
cv::Rect PixelsOf(const PixelBox& box, const Camera& camera) {
  const auto inside = [](double x, int size) {
    return static_cast<int>(std::clamp(x, -1.0, static_cast<double>(size)));
  };
  const int u0 = inside(std::floor(box.x0), camera.width);
  const int v0 = inside(std::floor(box.y0), camera.height);
  const int u1 = inside(std::ceil(box.x1), camera.width);
  const int v1 = inside(std::ceil(box.y1), camera.height);
  return cv::Rect(u0, v0, u1 - u0 + 1, v1 - v0 + 1) &
         cv::Rect(0, 0, camera.width, camera.height);
}

}  // namespace

TruthMaker::TruthMaker(const FrameRenderer& renderer)
    : renderer_(renderer),
      planes_(renderer.standing().planes),
      // What moves has no corners, and never bears one.
      ends_(renderer.standing().triangles) {
  for (std::size_t i = 0; i < renderer.scene().objects.size(); ++i) {
    triangles_.push_back(renderer.TrianglesOf(i));
  }
  std::map<std::array<double, 3>, std::size_t> numbers;
  const std::vector<std::vector<MeshCorner>> on_mesh = MeshCorners(renderer.standing());
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    corners_.emplace_back();
    for (std::size_t k = 0; k < on_mesh[i].size(); ++k) {
      const Eigen::Vector3d& x = planes_[i].vertices_w[k];
      const auto [at, fresh] = numbers.emplace(std::array{x.x(), x.y(), x.z()}, numbers.size());
      corners_.back().push_back(at->second);
      if (fresh) mesh_corners_.push_back(on_mesh[i][k]);
    }
  }
}

VertexInFrame TruthMaker::DescribeCorner(const Eigen::Vector3d& x_w, const MeshCorner& on_mesh,
                                         const Pose& T_wc, double time_s) const {
  const Camera& camera = renderer_.camera();
  VertexInFrame vertex;
  vertex.x_w = x_w;
  const Eigen::Vector3d x_c = Inverse(T_wc) * x_w;
  vertex.projects = x_c.z() > kSilhouetteNear_m;
  vertex.pixel = vertex.projects ? camera.Project(x_c) : Eigen::Vector2d::Zero();
  const auto within = [](double x, int size) { return x >= -0.5 && x <= size - 0.5; };
  if (!vertex.projects || !within(vertex.pixel.x(), camera.width) ||
      !within(vertex.pixel.y(), camera.height)) {
    return vertex;
  }
  vertex.state = renderer_.Sees(T_wc, on_mesh.x_w, time_s, on_mesh.planes)
                     ? VertexState::kVisible
                     : VertexState::kOccluded;
  vertex.surface_ends = vertex.state == VertexState::kVisible && ends_.At(T_wc, on_mesh.x_w);
  return vertex;
}

FrameTruth TruthMaker::Describe(const Rendering& rendering, const Pose& T_wc,
                                double time_s) const {
  FrameTruth truth;
  DescribeObjects(rendering, T_wc, time_s, truth);
  DescribePlanes(rendering, T_wc, time_s, truth);
  return truth;
}

void TruthMaker::DescribeObjects(const Rendering& rendering, const Pose& T_wc, double time_s,
                                 FrameTruth& truth) const {
  const std::map<int, Extent> seen = Extents(rendering.object_id);
  const std::vector<Object>& objects = renderer_.scene().objects;
  std::map<int, cv::Mat1b> covered;  // by group, of those that are seen
  for (const Object& object : objects) {
    if (GroupOf(object) == 0 || !seen.contains(object.id)) continue;
    covered.try_emplace(GroupOf(object), rendering.object_id.size(), uchar{0});
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto found = seen.find(objects[i].id);
    const auto group = covered.find(GroupOf(objects[i]));
    if (found == seen.end() && group == covered.end()) continue;
    // What moved is seen as if it stood and the camera had moved round it.
    const std::optional<PixelBox> whole = ProjectedBox(
        triangles_[i], Inverse(renderer_.Moved(i, time_s)) * T_wc, renderer_.camera());
    const auto unoccluded_pixels = [&](const PixelBox& box) {
      return renderer_.UnoccludedPixels(i, T_wc, PixelsOf(box, renderer_.camera()),
                                        rendering.object_id, time_s,
                                        group == covered.end() ? nullptr : &group->second);
    };
    if (found == seen.end()) {  // hidden, a part of its group all the same
      if (whole) unoccluded_pixels(*whole);
      continue;
    }
    const Extent& extent = found->second;
    ObjectInFrame object;
    object.id = objects[i].id;
    object.pixels = extent.pixels;
    object.visible_box = {static_cast<double>(extent.u0), static_cast<double>(extent.v0),
                          static_cast<double>(extent.u1), static_cast<double>(extent.v1)};
    object.amodal_box = whole.value_or(object.visible_box);
    object.unoccluded_pixels = unoccluded_pixels(object.amodal_box);
    if (!objects[i].way.empty()) object.T_wo = ObjectPoseAt(objects[i], time_s);
    object.visible_fraction =
        static_cast<double>(object.pixels) / std::max(object.unoccluded_pixels, object.pixels);
    truth.objects.push_back(object);
  }
  for (const auto& [group, pixels] : covered) {
    truth.unoccluded_pixels_of_group[group] = cv::countNonZero(pixels);
  }
  std::sort(truth.objects.begin(), truth.objects.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
}

void TruthMaker::DescribePlanes(const Rendering& rendering, const Pose& T_wc, double time_s,
                                FrameTruth& truth) const {
  // Faces that meet share their corners: each is described once.
  std::vector<std::optional<VertexInFrame>> corners(mesh_corners_.size());
  for (const auto& [id, extent] : Extents(rendering.plane_id)) {
    const auto i = static_cast<std::size_t>(id) - 1;
    const ScenePlane& plane = planes_.at(i);
    truth.planes.push_back(
        {id, extent.pixels, ProjectedFace(plane, T_wc, renderer_.camera()), {}});
    for (std::size_t k = 0; k < plane.vertices_w.size(); ++k) {
      const std::size_t number = corners_[i][k];
      std::optional<VertexInFrame>& corner = corners[number];
      if (!corner) {
        corner = DescribeCorner(plane.vertices_w[k], mesh_corners_[number], T_wc, time_s);
      }
      truth.planes.back().vertices.push_back(*corner);
      truth.planes.back().vertices.back().x_w = plane.vertices_w[k];  // to the sign of zero
    }
  }
}

}  // namespace sim
