// A real network on a real recording: both are reference data that the repository does not hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "slam/detect/yolox_detector.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "tests/support/shared_data.h"

namespace slam {
namespace {

/// What a person sees in a frame: boxes read off the picture by eye, to some 5 px.
struct SeenByEye {
  int frame;
  std::string class_name;
  Box box_px;
};

TEST(YoloxOnARecording, FindsWhatAPersonSees) {
  const std::filesystem::path data = test_support::SharedFolder() / "data",
                              recording = data / "real_kitchen_first300",
                              model = data / "models/yolox_nano.onnx";
  SKIP_WITHOUT(recording);
  SKIP_WITHOUT(model);
  const std::vector<SeenByEye> things = {
      {0, "cup", {{363, 164}, {402, 203}}},     {0, "chair", {{175, 126}, {306, 345}}},
      {0, "chair", {{425, 150}, {548, 230}}},   {0, "dining table", {{222, 158}, {639, 470}}},
      {200, "cup", {{332, 385}, {392, 442}}},   {200, "chair", {{48, 320}, {240, 479}}},
      {200, "chair", {{393, 322}, {552, 395}}}, {279, "cup", {{109, 268}, {155, 315}}},
      {279, "tv", {{430, 0}, {617, 72}}},       {279, "chair", {{197, 225}, {340, 277}}},
      {279, "chair", {{525, 233}, {639, 291}}}, {279, "dining table", {{0, 265}, {639, 479}}},
  };
  constexpr double kMinIou =
      0.6;  // YOLOX-nano cuts legs off chairs; found by eye 0.64 and more
  const Camera camera = ChooseCamera("", recording).camera;
  SequenceReader reader(recording, camera);
  YoloxDetector detector(model, camera, CocoClassTable(), {});
  int frame = -1;
  std::vector<Detection> found;
  for (const SeenByEye& thing : things) {
    if (thing.frame != frame) {
      frame = thing.frame;
      found = detector.Detect(0, reader.Read(frame).bgr);
    }
    const auto hit = std::find_if(found.begin(), found.end(), [&](const Detection& d) {
      return d.class_name == thing.class_name && d.box_px.Contains(thing.box_px.center()) &&
             Iou(d.box_px, thing.box_px) > kMinIou;
    });
    EXPECT_NE(hit, found.end()) << thing.class_name << " of frame " << frame;
    if (hit != found.end()) found.erase(hit);
  }
}

}  // namespace
}  // namespace slam
