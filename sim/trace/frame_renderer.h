#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"
#include "sim/scene/scene.h"
#include "sim/shapes/mesh.h"
#include "sim/trace/image_rays.h"
#include "sim/trace/ray_scene.h"

namespace sim {

/// One view of the scene, all height x width, before any sensor.
struct Rendering {
  cv::Mat3f radiance;   ///< linear RGB, about [0, 1]; edges averaged over four rays
  cv::Mat1d depth_m;    ///< exact planar z of the pixel centre's ray; 0 where nothing is hit
  cv::Mat1w plane_id;   ///< ScenePlane::id at the pixel centre; 0 = none
  cv::Mat1w object_id;  ///< Object::id at the pixel centre; 0 = none
  cv::Mat1b
      projector_lit;  ///< 255 where the depth sensor's projector reaches; empty unless asked
  // What a depth sensor's light meets; empty when RenderOptions::sensed is not set.
  cv::Mat1f incidence_cos;  ///< |cos| between the ray and the surface normal; 0 where no hit
  cv::Mat1f infrared;       ///< InfraredOf the face at the pixel centre; 0 where no hit
  cv::Mat1f gloss;          ///< GlossOf that face; 0 where no hit
  /// Where gloss > 0: cos of the angle between the surface normal and the direction half way
  /// between camera and projector; 1 is a mirror that throws the projector's light at the camera.
  cv::Mat1f mirror_cos;
};

struct RenderOptions {
  double time_s = 0;                  ///< where what moves is
  bool colour = true;                 ///< fill radiance
  bool sensed = true;                 ///< fill incidence_cos, infrared, gloss and mirror_cos
  double projector_offset_m = 0.0;    ///< along camera +x; 0 leaves projector_lit empty
  cv::Range rows = cv::Range::all();  ///< only these are rendered; the rest is left alone
  /// Decide what a pixel beside an edge shows in double instead of by the ray tracer, whose
  /// single precision takes the other side within about 1e-4 px. Then depth and ids are the
  /// same bits on every processor.
  bool exact_edges = true;
};

struct RenderedScene;

/// Renders views of one scene. Const and thread-safe; a view depends on its pose and time
/// alone.
///
/// What moves is rendered as if it stood and the camera moved round it, so that its depth is as
/// exact as that of what stands, and put together by depth. Shadows fall from each on the
/// others.
class FrameRenderer {
 public:
  /// @throws std::invalid_argument when ids of objects do not fit in 16 bits, InputError when
  ///   those of planes do not.
  /// @param reflections  times what glossy faces mirror of lamps, sun and room in colour
  FrameRenderer(const Scene& scene, const Camera& camera,
                InstructionSet set = InstructionSet::kPinned, double reflections = 0);
  ~FrameRenderer();
  FrameRenderer(FrameRenderer&&) noexcept;

  /// One primary ray through each pixel centre (integer coordinates). Its depth is recomputed
  /// in double from the plane it hits, so within a plane 1/z is affine in the pixel.
  Rendering Render(const Pose& T_wc, const RenderOptions& options = {}) const;
  /// The same into the images of an earlier view, whose memory is used again.
  void Render(const Pose& T_wc, const RenderOptions& options, Rendering& out) const;

  /// Seconds of processor time that the ray tracer alone takes for the rays of this view: one
  /// through each pixel, those to the sun and to the projector. Of what stands; what moves is
  /// left out.
  double BareTraversal_s(const Pose& T_wc, const RenderOptions& options) const;

  /// Pixels whose centre ray meets the object when nothing else is there, inside the image:
  /// what the object would show unoccluded. A box is looked at in double, by its outline; of
  /// other shapes visible pixels count without a ray.
  /// @param object_index  index into scene.objects
  /// @param where         pixels to look at; must hold the whole silhouette in the image
  /// @param object_id     of the same view
  /// @param covered       of the image's size; if given, those pixels become 255 in it
  int UnoccludedPixels(std::size_t object_index, const Pose& T_wc, const cv::Rect& where,
                       const cv::Mat1w& object_id, double time_s = 0,
                       cv::Mat1b* covered = nullptr) const;

  /// From the place where an object stands in the mesh of the scene to where it is at a moment.
  Pose Moved(std::size_t object_index, double time_s) const;

  /// Whether nothing lies between the camera's centre and the point, up to 0.1 mm before it.
  /// Decided in double.
  /// @param own_planes  ids of planes that hold the point: their triangles, uneven within what
  ///   is rendered as flat, do not hide it
  bool Sees(const Pose& T_wc, const Eigen::Vector3d& x_w, double time_s = 0,
            std::span<const int> own_planes = {}) const;

  /// Triangles of an object; of what moves, where it is at the first point of its way.
  std::vector<Triangle> TrianglesOf(std::size_t object_index) const;

  const Camera& camera() const;
  const ImageRays& image_rays() const;
  const Scene& scene() const;
  /// Triangles and planes of what stands.
  const SceneMesh& standing() const;

 private:
  std::unique_ptr<const RenderedScene> world_;
};

}  // namespace sim
