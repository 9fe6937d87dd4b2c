#pragma once

#include "sim/sensor/depth/depth_sensor.h"

// The Kinect's model by rows of `count` pixels. Same bits on every processor.
namespace sim {

/// Incidence of each pixel, radians.
void KinectAngles(const float* cosine, int count, double* theta);

/// By how many pixels each looks beside itself.
/// @param jitter_u, jitter_v  standard normal
/// @param scale               of sigma_L
void KinectJitter(const double* theta, const float* jitter_u, const float* jitter_v,
                  double scale, int count, int* du, int* dv);

/// z as it comes out with the limits, noise and rounding; 0 = no measurement.
/// @param z     metres; 0: nothing to measure
/// @param draw  standard normal
void KinectMeasured(const double* z, const double* theta, const float* draw,
                    const KinectModel& model, int count, double* measured);

/// To whole file units; 0 where there is no depth or it does not fit.
void DepthUnits(const double* depth_m, double depth_factor, int count, ushort* units);

}  // namespace sim
