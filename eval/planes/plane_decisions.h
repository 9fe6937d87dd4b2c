#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/planes/association.h"
#include "eval/planes/frame_evidence.h"

namespace eval {

/// A surface larger than this share of the image is one whose landmark a frame should find.
inline constexpr double kLargeSurfaceShare = 0.05;
/// In the first second a run is still making its first landmarks.
inline constexpr double kFirstLandmarks_s = 1.0;

/// The cue of a surface that no frame plane shows mostly.
inline constexpr const char* kNoFramePlane = "no frame plane";

/// What a run says of a frame plane to which it gave no answer, as two were too close.
inline constexpr const char* kByAmbiguous = "ambiguous";

/// Why a surface got no decision, by what the run says of its largest frame plane: what settled it,
/// or why the plane is not trusted; may be empty.
/// @param plane  null when there is none
std::string WhyUndecided(const RunFramePlane* plane);

/// A frame plane that was put on a map plane, and what to know of it beside the record.
struct PlaneDecision {
  AssociationRecord record;
  double stamp_s = 0.0;
  std::string cue;             ///< what settled it, as the run says; may be empty
  Eigen::Vector3d centroid_g;  ///< of the patch, by the true pose, metres
};

/// A true plane that counts in a frame, and what of it was decided there.
struct SeenSurface {
  int frame = 0;
  double stamp_s = 0.0;
  int truth = 0;
  int pixels = 0;  ///< of the surface
  bool is_large = false;
  /// Its largest frame plane was put on a map plane.
  bool decided = false;
  std::string cue;  ///< why not, as the run says; "no frame plane" when nothing shows it mostly
};

/// A frame plane of a scored surface that was put on no map plane, as ambiguous.
struct AmbiguousPlane {
  int frame = 0;
  double stamp_s = 0.0;
  int truth = 0;            ///< that it shows, told as for decisions
  int pixels = 0;           ///< of the frame plane
  bool is_largest = false;  ///< of the frame planes that show this surface
};

/// What a run decided about planes, frame by frame.
struct DecisionHistory {
  std::vector<PlaneDecision> decisions;   ///< by rising frame
  std::vector<SeenSurface> surfaces;      ///< by rising frame
  std::vector<AmbiguousPlane> ambiguous;  ///< by rising frame
  bool says_by = false;                   ///< the run says of some frame plane what settled it
  std::optional<double> first_s;          ///< time of the first frame

  void Add(const FrameEvidence& e);
};

std::vector<AssociationRecord> RecordsOf(const std::vector<PlaneDecision>& decisions);

/// The first map plane that a surface made, and when.
struct FirstLandmark {
  int map_plane = 0;
  int frame = 0;
};
/// By true plane; 0 made those of noise.
/// @param decisions  by rising frame
std::map<int, FirstLandmark> FirstLandmarks(const std::vector<PlaneDecision>& decisions);

/// Of large surfaces that have a landmark since an earlier frame, those without a decision.
struct UndecidedSurfaces {
  int large = 0;  ///< surfaces in frames, after the first second, that have a landmark
  std::vector<SeenSurface> undecided;
};
UndecidedSurfaces FindUndecided(const DecisionHistory& history);

/// Ambiguous frame planes of surfaces, large or small, that have a landmark since an earlier frame.
std::vector<AmbiguousPlane> FindAmbiguous(const DecisionHistory& history);

}  // namespace eval
