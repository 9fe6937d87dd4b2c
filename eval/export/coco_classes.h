#pragma once

#include <string>

namespace eval {

/// A category of COCO's instances (2014 and 2017).
struct CocoClass {
  int id = 0;  ///< from 1 to 90, with gaps
  const char* name = "";
  const char* supercategory = "";
};

/// The class of that name, null when COCO has none.
const CocoClass* FindCocoClass(const std::string& name);

/// Categories that COCO does not have get ids from here on, so that they never mean another.
inline constexpr int kFirstOwnCategory = 101;

}  // namespace eval
