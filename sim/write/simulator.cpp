#include "sim/write/simulator.h"

namespace sim {

Simulator::Simulator(const Scene& scene, const RigOptions& options)
    : options_(options),
      renderer_(scene, options.camera),
      truth_(renderer_),
      detector_(scene, options.camera, options.detector, options.seed) {}

SimulatedFrame Simulator::Simulate(int frame, const Pose& T_wc) const {
  const bool noisy = options_.sensor == SensorKind::kKinect1;
  const KinectModel kinect;
  RenderOptions view;
  if (noisy) view.projector_offset_m = kinect.projector_offset_m;
  const Rendering rendering = renderer_.Render(T_wc, view);

  const PixelNoise noise(options_.seed, static_cast<std::uint64_t>(frame));
  SimulatedFrame result;
  result.colour =
      MeasureColour(rendering.radiance, noisy ? ColourModel{} : CleanColour(), noise);
  result.depth = EncodeDepth(noisy ? MeasureDepth(rendering, kinect, noise) : rendering.depth_m,
                             options_.camera.depth_factor);
  result.plane_id = rendering.plane_id;
  result.object_id = rendering.object_id;
  result.truth = truth_.Describe(rendering, T_wc);
  result.detections = detector_.Detect(frame, result.truth);
  return result;
}

}  // namespace sim
