#pragma once

#include <vector>

#include "slam/associate/association_config.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Written into PlaneMatch::by when a plane was left undecided although the map may hold it: no
/// landmark is made of such a plane.
inline constexpr const char* kByAmbiguous = "ambiguous";

/// Decides which map plane each frame plane shows, at frame.T_cw.
///
/// The integrated rule keeps a pair whose offset and slopes agree within everybody's
/// uncertainty (chi-square), whose footprints cover each other as seen now (or, between
/// surfaces without class, go on from one another), whose class the map plane's belief allows
/// and whose projected box meets the detection; it then assigns all planes at once, best first.
/// The planes that fit beyond doubt first correct the predicted pose, because an error of the
/// pose moves all of them alike: what is left are the millimetres between the planes. The rank
/// test refuses pairs that hardly overlap and whose points are distributed otherwise. Two
/// nearly equal answers give none.
///
/// Fills frame.plane_matches (parallel to frame.planes): `kMatched` with the id and the rule in
/// `by` ("overlap", "extension", "iou", "belief", each perhaps with "+ranksum"; "parameters"),
/// or `kNone` with "" (nothing fits) or kByAmbiguous. Planes that are far, badly fitted or on
/// an unstructured object stay `kNone`. The outcome depends on neither the order of frame and
/// map planes nor on where the world lies. Source: PAS-SLAM eq6 to eq12 and its class rule
/// (corrected as said in the headers of the parts). Cost: about 2 ms for 20 frame planes and 50
/// map planes of 1,000 cloud points.
void AssociatePlanes(Frame& frame, const Map& map, const Camera& camera,
                     const AssociationConfig& config);

/// The same question about map.plane_candidates, for the frame planes that frame.plane_matches
/// leaves without landmark and without doubt. The pose follows from the landmarks that were
/// matched, not from candidates.
/// @returns parallel to frame.planes; `map_plane` of a match is an index into the candidates.
std::vector<PlaneMatch> AssociateCandidates(const Frame& frame, const Map& map,
                                            const Camera& camera,
                                            const AssociationConfig& config);

}  // namespace slam
