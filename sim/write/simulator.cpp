#include "sim/write/simulator.h"

#include "sim/write/carried_exposure.h"

namespace sim {

std::uint64_t RigOptions::device() const { return DeviceOf(sensor.depth, seed); }

Camera RigOptions::CameraAsTold() const {
  return ToldCamera(camera, sensor.calibration, device());
}

Simulator::Simulator(const Scene& scene, const RigOptions& options)
    : options_(options),
      depth_error_(RegistrationError(options.sensor.calibration, options.device())),
      renderer_(scene, options.camera, InstructionSet::kPinned,
                options.sensor.colour.reflections),
      truth_(renderer_),
      detector_(scene, options.camera, options.detector, options.seed) {}

SimulatedFrame Simulator::Simulate(int frame, const Pose& T_wc) const {
  Shot shot;
  shot.T_wc = T_wc;
  return Simulate(frame, shot, [&](double) { return T_wc; });
}

SimulatedFrame Simulator::Simulate(int frame, const Shot& shot,
                                   const PoseAround& around) const {
  const Sensor& sensor = options_.sensor;
  const double delay_s = shot.DepthDelay_s();
  // Depth that is taken from where colour is, when it is, needs no view of its own.
  const bool one_view = delay_s == 0 && sensor.calibration.registration_px == 0;
  const bool moves = sensor.exposure.Moves();
  RenderOptions view;
  const bool carried = moves && CanCarry(renderer_);
  view.colour = !moves || carried;
  view.time_s = shot.time_s;
  view.sensed = one_view;
  if (one_view) view.projector_offset_m = SecondEyeOffset(sensor.depth);
  thread_local Rendering rendering;  // memory only
  renderer_.Render(shot.T_wc, view, rendering);
  if (carried) {
    CarryExposure(renderer_, sensor.exposure, around, shot.T_wc, rendering);
  } else if (moves) {
    rendering.radiance = ExposeMoving(renderer_, sensor.exposure, around, shot.time_s);
  }
  const double gain = ExposureGain(sensor.exposure, options_.seed, shot.time_s);
  if (gain != 1.0) rendering.radiance = rendering.radiance * gain;

  SimulatedFrame result;
  result.colour = MeasureColour(rendering.radiance, sensor.colour,
                                PixelNoise(options_.seed, static_cast<std::uint64_t>(frame)));
  if (one_view) {
    result.depth = Depth(frame, rendering);
  } else {
    thread_local Rendering later;  // memory only
    RenderForDepth(around(delay_s) * depth_error_, shot.time_s + delay_s, later);
    result.depth = Depth(frame, later);
  }
  result.plane_id = rendering.plane_id.clone();
  result.object_id = rendering.object_id.clone();
  result.truth = truth_.Describe(rendering, shot.T_wc, shot.time_s);
  result.detections = detector_.Detect(frame, result.truth);
  return result;
}

void Simulator::RenderForDepth(const Pose& T_wc, double time_s, Rendering& out) const {
  RenderOptions view;
  view.time_s = time_s;
  view.colour = false;
  view.projector_offset_m = SecondEyeOffset(options_.sensor.depth);
  renderer_.Render(T_wc, view, out);
}

cv::Mat1w Simulator::Depth(int frame, const Rendering& rendering) const {
  return EncodeDepth(MeasureDepth(rendering, options_.sensor.depth, options_.camera,
                                  options_.seed, static_cast<std::uint64_t>(frame)),
                     options_.camera.depth_factor);
}

}  // namespace sim
