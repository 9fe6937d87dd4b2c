#pragma once

#include "eval/formats/json_record.h"
#include "eval/formats/sequence/scene_truth.h"

namespace eval {

/// Tells what of a true face cannot be: corners off its plane, a shape that is no rectangle (of
/// a mesh: an outline that turns right), another area than its corners enclose, a normal into
/// its object, corners outside the object's box.
/// @param plane   with 3 corners or more
/// @param object  its owner; null when it is unknown
void TellFaceFlaws(const JsonRecord& record, const TruthPlane& plane,
                   const TruthObject* object);

}  // namespace eval
