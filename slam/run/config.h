#pragma once

#include "slam/associate/association_config.h"
#include "slam/calibrate/first_look_config.h"
#include "slam/calibrate/registration_config.h"
#include "slam/calibrate/rolling_config.h"
#include "slam/calibrate/warp_config.h"
#include "slam/detect/box_tracks.h"
#include "slam/detect/class_table.h"
#include "slam/detect/detections.h"
#include "slam/detect/yolox_output.h"
#include "slam/faces/process_planes.h"
#include "slam/features/point_features.h"
#include "slam/geometry/sensor_model.h"
#include "slam/mapping/local_mapping.h"
#include "slam/mapping/plane_map_config.h"
#include "slam/places/close_loop.h"
#include "slam/pose/plane_constraints.h"
#include "slam/segment/extraction_config.h"
#include "slam/structure/structure.h"
#include "slam/tracking/point_tracking.h"

namespace slam {

/// Every stage's settings in one. Default, key, domain and help of each field stand in the
/// stage's own header and nowhere else. As text: config_file.h.
struct Config {
  SensorModel sensor;

  DepthWarpConfig depth_warp;
  RegistrationConfig depth_registration;
  RollingConfig rolling_shutter;
  FirstLookConfig first_look;

  // (B) extraction
  PointFeatureConfig point_features;
  ClassTable classes = CocoClassTable();
  DetectionConfig detection;
  YoloxConfig yolox;
  BoxTracksConfig box_tracks;
  PlaneExtractionConfig plane_extraction;

  // (C) plane processing
  PlaneProcessingConfig plane_processing;

  // (D) association
  AssociationConfig association;

  // (E) optimisation and tracking by points
  PointSearchConfig point_search;
  PointTrackingConfig tracking;
  PlaneConstraintConfig plane_constraints;
  StructureConfig structure;

  // (F) the map
  bool async_mapping = false;  ///< on a thread beside tracking, instead of between frames
  LocalMappingConfig mapping;
  PlaneMapConfig plane_map;
  LoopClosingConfig loop_closing;
};

/// The defaults for a sensor.
Config ConfigFor(DepthSensor sensor);

/// All fields, a section a stage.
void VisitFields(Config& config, FieldVisitor& visitor);

}  // namespace slam
