#pragma once

#include "slam/geometry/camera.h"

namespace slam {

/// The view of a Kinect in 160 x 120 pixels.
inline Camera SmallCamera() {
  Camera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 131.25, camera.cx = 79.5, camera.cy = 59.5;
  return camera;
}

/// The view of a Kinect in 320 x 240 pixels.
inline Camera HalfCamera() {
  Camera camera;
  camera.width = 320, camera.height = 240;
  camera.fx = camera.fy = 262.5, camera.cx = 159.5, camera.cy = 119.5;
  return camera;
}

/// A camera with about the field of view of a Kinect.
inline Camera CameraOfSize(int width = 320, int height = 240) {
  Camera camera;
  camera.width = width, camera.height = height;
  camera.fx = camera.fy = 0.82 * width;
  camera.cx = 0.5 * (width - 1), camera.cy = 0.5 * (height - 1);
  return camera;
}

}  // namespace slam
