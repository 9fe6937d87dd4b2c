// Any bytes either are a scene, which then can be and reads back as itself, or are refused with
// the one typed error that tells where. Whatever else happens is a bug, and ends the run.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "io/input_error.h"
#include "sim/scene/check.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "sim/shapes/planes.h"
#include "sim/shapes/steps.h"

namespace {

void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz_scene: %s\n", what);
  std::abort();
}

void CheckRefusal(const std::string& message) {
  Require(message.starts_with("fuzz.yaml"), "an error does not say in which file");
  Require(message.size() > 20 && message.size() < 4000, "an error says too little or too much");
}

void CheckPlanes(const sim::Scene& scene) {
  for (const sim::ScenePlane& plane : sim::ScenePlanes(scene)) {
    Require(std::abs(plane.n_w.norm() - 1) < 1e-6, "a normal is not of unit length");
    Require(std::isfinite(plane.d) && plane.area_m2 > 0, "a plane is not finite");
  }
}

#ifdef PAS_FUZZ_PLANTED
/// The planted bug: a table for things of less than 3 m, which the format does not promise.
void CountBySize(const sim::Scene& scene) {
  int of_size[3] = {};
  for (const sim::Object& object : scene.objects) {
    for (const double size_m : object.size) ++of_size[static_cast<int>(size_m)];
  }
  Require(of_size[0] >= 0, "never");
}
#else
void CountBySize(const sim::Scene&) {}
#endif

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  sim::Scene scene;
  try {
    scene = sim::ParseScene(text, "fuzz.yaml");
  } catch (const io::InputError& error) {
    CheckRefusal(error.what());
    return 0;
  }
  Require(!sim::FindFault(scene).has_value(), "a scene that cannot be was read");
  const std::string canonical = sim::SceneText(scene);
  Require(sim::SceneText(sim::ParseScene(canonical, "canonical")) == canonical,
          "a scene does not read back as itself");
  CheckPlanes(scene);
  sim::TopSteps(scene, sim::ScenePlanes(scene));
  CountBySize(scene);
  return 0;
}
