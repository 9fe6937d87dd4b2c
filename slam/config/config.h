#pragma once

#include "slam/associate/association_config.h"
#include "slam/associate/plane_constraints.h"
#include "slam/extract/box_tracks.h"
#include "slam/extract/class_table.h"
#include "slam/extract/plane_segments.h"
#include "slam/extract/point_features.h"
#include "slam/extract/yolox_output.h"
#include "slam/localise/point_tracking.h"
#include "slam/loop/close_loop.h"
#include "slam/mapping/local_mapping.h"
#include "slam/mapping/plane_map_config.h"
#include "slam/planes/process_planes.h"

namespace slam {

/// Every stage's settings in one. Defaults stand in the stages' own headers and nowhere else.
/// As text: config_file.h.
struct Config {
  // (B) extraction
  PointFeatureConfig point_features;
  ClassTable classes = CocoClassTable();
  YoloxConfig yolox;
  BoxTracksConfig box_tracks;
  PlaneExtractionConfig plane_extraction;

  // (C) plane processing
  PlaneProcessingConfig plane_processing;

  // (D) association
  AssociationConfig association;

  // (E) optimisation and tracking by points
  PointTrackingConfig tracking;
  PlaneConstraintConfig plane_constraints;

  // (F) the map
  bool async_mapping = false;  ///< on a thread beside tracking, instead of between frames
  LocalMappingConfig mapping;
  PlaneMapConfig plane_map;
  LoopClosingConfig loop_closing;
};

/// The pyramid and the virtual baseline are facts of the point features that later stages keep
/// a copy of; makes all copies those of `point_features`.
void ShareFacts(Config& config);

}  // namespace slam
