#pragma once

#include <gtest/gtest.h>

#include "eval/draw/draw_run.h"
#include "eval/draw/frame_picture.h"
#include "tests/eval/check/small_run.h"

namespace eval {

/// The small world as a sequence on disk, and runs on it that make no mistake.
class DrawnWorld : public ::testing::Test {
 protected:
  DrawnWorld() { small_world::WriteSequence(seq(), world_); }
  std::filesystem::path seq() const { return folder_.path() / "seq"; }
  std::filesystem::path MakeRun(const std::string& name, const Eigen::Isometry3d& T_wg,
                                bool segmentation = true) {
    small_world::RunOptions options;
    options.T_wg = T_wg;
    options.segmentation = segmentation;
    options.sequence = seq().string();
    small_world::WriteRun(folder_.path() / name, world_, options);
    return folder_.path() / name;
  }
  static cv::Mat Named(const std::vector<Picture>& pictures, const std::string& name) {
    for (const Picture& picture : pictures) {
      if (picture.name == name) return picture.image;
    }
    return {};
  }
  FrameScene SceneOf(const ::eval::Run& run, std::size_t frame) {
    FrameScene scene;
    scene.rgb = small_world::Render(world_, world_.views[frame]).rgb;
    scene.labels = ReadSegmentation(run, run.frames[frame].stamp_s);
    scene.frame = &run.frames[frame];
    scene.T_wc = run.trajectory[frame].T_wc;
    scene.map = &run.map;
    scene.camera = ReadNamedCamera((seq() / "camera.yaml").string());
    return scene;
  }

  small_world::TemporaryFolder folder_;
  small_world::World world_ = small_world::MakeWorld(240, 180, 5);
};

}  // namespace eval
