#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sim/sensor/sensor.h"

namespace sim {

/// What single frames of a frontal wall that fills the view leave of it, after its best plane in
/// inverse depth; disparity steps of 1/8 pixel (z^2 / 351.3 m, whatever the sensor).
struct BentWall {
  double z_m = 0;
  double pixels = 0;  ///< rms of pixels
  double blocks = 0;  ///< rms of the means of 16 x 16 pixels: what is slow over the image
};

/// How a sensor bends what is flat, a mean over devices.
struct BendReport {
  std::vector<BentWall> walls;  ///< at 1.4, 1.8, 2.25 and 3 m
  double fixed_share = 0;       ///< correlation of block means of one device, long apart
  /// Autocorrelation of the device's pattern after 32, 56 and 110 pixels along x; after 32 and 112
  /// along y. 0 where nothing bends.
  double along_x_32 = 0, along_x_56 = 0, along_x_110 = 0, along_y_32 = 0, along_y_112 = 0;
};

/// A frontal wall that fills the view, without the renderer and without shadows.
Rendering BareWall(const Camera& camera, double z_m);

/// @param devices  seeds 1, 2 ... each draw one, unless the sensor names its own
BendReport MeasureBend(const Sensor& sensor, int devices = 12);

/// The report as a table for people, a line a distance, beside what recordings of a real first
/// Kinect have.
std::string BendTable(const BendReport& report);

/// Residuals of 351.3 m / z from its best plane over the image; NaN where there is no depth.
cv::Mat1d DisparityResiduals(const cv::Mat1d& z_m);

/// Means over 16 x 16 pixels, of blocks that have depth in half of them; else NaN.
cv::Mat1d BlockMeans(const cv::Mat1d& residuals);

/// Correlation of two images about 0, over pixels that both have.
double CorrelationOf(const cv::Mat1d& a, const cv::Mat1d& b);

/// Autocorrelation of an image at a shift, about 0.
double Autocorrelation(const cv::Mat1d& image, cv::Point shift);

}  // namespace sim
