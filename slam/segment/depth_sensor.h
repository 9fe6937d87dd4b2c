#pragma once

#include <string>
#include <vector>

#include "slam/segment/extraction_config.h"

namespace slam {

/// Settings of plane extraction for a sensor: its noise, and what follows from it.
///
/// - kKinect1: the defaults. Nguyen, Izadi, Lovell, "Modeling Kinect sensor noise", 3DIMPVT
/// 2012.
/// - kAzure: time of flight. Noise of 0.5 mm + 1 mm/m (z - 0.5 m) on light surfaces, more on
///   others, as fitted by Toelgyessy et al., "Evaluation of the Azure Kinect", Sensors 21(2),
///   2021, and a systematic error, within the data sheet's 11 mm + 0.1 % of distance, taken as
///   a wave of 2 mm over fractions of a metre. It does not average out over a surface.
/// - kD435: active stereo. The error is one of disparity: sigma(z) = z^2 0.08 px / (430 px x
///   50.15 mm), subpixel error and formula of Intel's "Tuning D435 and D415 cameras for best
///   performance". Matching windows of 7 x 7 pixels share most of it.
PlaneExtractionConfig ExtractionFor(DepthSensor sensor);

/// Names as in files and on the command line, in the order of the enumeration.
const std::vector<std::string>& DepthSensorNames();

}  // namespace slam
