#include "sim/trace/render_world.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "io/input_error.h"

namespace sim {
namespace {

void CheckIds(const Scene& scene, const SceneMesh& mesh) {
  const auto fits = [](int id) { return id >= 0 && id <= kMaxId; };
  for (const Object& object : scene.objects) {
    if (!fits(object.id) || object.id == 0) {
      throw std::invalid_argument("object id " + std::to_string(object.id) +
                                  ": expected 1 to 65535, as id images have 16 bits");
    }
  }
  for (const Triangle& triangle : mesh.triangles) {
    if (!fits(triangle.plane))
      throw io::InputError(scene.name,
                           "has more than 65535 planes, which id images of 16 bits cannot "
                           "hold; simplify its meshes");
  }
}

}  // namespace

RenderWorld::RenderWorld(const Scene& scene_in, const Camera& camera_in, InstructionSet set_in,
                         double reflections_in)
    : scene(scene_in),
      camera(camera_in),
      set(set_in),
      image_rays(camera),
      mesh(BuildMesh(scene)),
      rays(mesh.triangles, set),
      edges(mesh.triangles),
      caster(mesh.triangles),
      surfaces(mesh, camera),
      to_sun_w(-scene.sun.direction_w.normalized()),
      reflections(reflections_in) {
  CheckIds(scene, mesh);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    alone_.push_back(std::make_unique<LoneObject>());
  }
}

std::vector<Triangle> RenderWorld::TrianglesOf(std::size_t object_index) const {
  std::vector<Triangle> own;
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(own),
               [id = scene.objects.at(object_index).id](const Triangle& triangle) {
                 return triangle.object == id;
               });
  return own;
}

const RayScene& RenderWorld::Alone(std::size_t object_index) const {
  LoneObject& lone = *alone_.at(object_index);
  std::call_once(lone.once, [&] {
    lone.rays = std::make_unique<const RayScene>(TrianglesOf(object_index), set);
  });
  return *lone.rays;
}

}  // namespace sim
