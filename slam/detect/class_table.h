#pragma once

#include <string>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/model/detection.h"

namespace slam {

/// Which detector classes are box-shaped and which are not. Names as the detector writes them
/// (COCO's, lower case).
struct ClassTable {
  std::vector<std::string> regular;
  std::vector<std::string> unstructured;
  std::vector<std::string> other;

  ClassKind KindOf(const std::string& class_name) const;
};

inline void VisitFields(ClassTable& c, FieldVisitor& v) {
  v.Texts("regular", c.regular, "box-shaped classes: their faces are rectangles");
  v.Texts("unstructured", c.unstructured,
          "classes without planes: what is found on them is noise");
  v.Texts("other", c.other, "known classes that are neither, as is a class in no list");
}

/// COCO's 80 classes, with its older spellings, and "box".
ClassTable CocoClassTable();

}  // namespace slam
