#pragma once

#include <vector>

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Box of a map plane in the recorded image at T_cw, clipped to the picture: of its corners
/// when four are known, else of its hull; where part of it lies behind the camera, of the cloud
/// points in the picture. Empty when nothing of it is in the picture.
Box ProjectedBox(const MapPlane& map_plane, const Pose& T_cw, const Camera& camera);

/// A map plane that belongs to a detected object.
struct BoxPlaneMatch {
  int map_plane = kNone;  ///< id
  int detection = 0;      ///< index into Frame::detections
  double iou = 0.0;       ///< of the projected box and the detection box
};

/// Associates map planes that have a class with detections of that class by the IoU of the
/// boxes at frame.T_cw; a map plane takes at most one detection, the best; several planes (top
/// and sides of a box) may share a detection. Pairs with an IoU of at most `min_iou` are left
/// out. In the order of the map. Cost: O(map planes x detections).
std::vector<BoxPlaneMatch> AssociateBoxes(const Frame& frame, const Map& map,
                                          const Camera& camera, double min_iou);

}  // namespace slam
