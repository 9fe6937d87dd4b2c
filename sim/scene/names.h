#pragma once

#include <string>
#include <vector>

namespace sim {

/// First key of a scene file.
inline constexpr const char* kSceneFormat = "pas-scene/1";

/// Names of the enumerations in files, in the order of the enumerators.
inline const std::vector<std::string> kRoleNames{"structure", "regular", "unstructured",
                                                 "other"};
inline const std::vector<std::string> kPrintNames{"plain", "wood", "cloth",  "text",
                                                  "cover", "keys", "screen", "speckle"};
inline const std::vector<std::string> kShapeNames{
    "box", "toy", "cylinder", "mug", "bottle", "bowl", "bush", "mesh", "person", "hand"};
inline const std::vector<std::string> kLightNames{"lamp", "area"};
inline const std::vector<std::string> kFaceNames{"-x", "+x", "-y", "+y", "-z", "+z"};
inline const std::vector<std::string> kPresetNames{"slow", "office", "fast", "xyz",     "rpy",
                                                   "360",  "orbit",  "loop", "lookaway"};
inline const std::vector<std::string> kSensorNames{"ideal", "kinect1", "kinect1-clean", "azure",
                                                   "d435"};

}  // namespace sim
