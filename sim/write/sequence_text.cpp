#include "sim/write/sequence_text.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "io/image/encode_png.h"
#include "io/number_text.h"
#include "sim/truth/truth_json.h"

namespace sim {
namespace {

/// Under the stamp of its frame, which jitter may have moved away from when it was.
std::string PoseLine(const Shot& shot) {
  Eigen::Quaterniond q(shot.T_wc.R);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d& t = shot.T_wc.t;
  return fmt::format("{} {} {} {} {} {} {} {}\n", TimeText(shot.colour_stamp_s), t.x(), t.y(),
                     t.z(), q.x(), q.y(), q.z(), q.w());
}

/// A share p of depth as 32768 + 1e6 p, 16 bits.
cv::Mat1w DepthWarpImage(const cv::Mat1f& p) {
  cv::Mat1w image;
  p.convertTo(image, CV_16U, 1e6, 32768);
  return image;
}

}  // namespace

std::string TimeText(double timestamp_s) { return fmt::format("{:.6f}", timestamp_s); }

double PrintedTime(double timestamp_s) {
  return io::ParseNumber(TimeText(timestamp_s)).value_or(std::nan(""));
}

std::map<std::string, std::string> FixedFiles(const Scene& scene,
                                              const std::vector<ScenePlane>& planes,
                                              const RigOptions& rig,
                                              const std::vector<Shot>& shots) {
  std::string rgb = "# colour images\n# timestamp filename\n";
  std::string depth = "# depth images\n# timestamp filename\n";
  std::string truth = "# camera to world\n# timestamp tx ty tz qx qy qz qw\n";
  std::string pairs;
  for (const Shot& shot : shots) {
    const std::string t = TimeText(shot.colour_stamp_s), d = TimeText(shot.depth_stamp_s);
    rgb += fmt::format("{0} rgb/{0}.png\n", t);
    depth += fmt::format("{0} depth/{0}.png\n", d);
    pairs += fmt::format("{0} rgb/{0}.png {1} depth/{1}.png\n", t, d);
    truth += PoseLine(shot);
  }
  std::map<std::string, std::string> files{{"associations.txt", pairs},
                                           {"camera.yaml", CameraYaml(rig.CameraAsTold())},
                                           {"depth.txt", depth},
                                           {"groundtruth.txt", truth},
                                           {"gt/scene.json", SceneTruthJson(scene, planes)},
                                           {"rgb.txt", rgb}};
  if (rig.sensor.calibration.intrinsics != 0) files["gt/camera.yaml"] = CameraYaml(rig.camera);
  const cv::Mat1f warp = DevicePattern(rig.sensor.depth, rig.camera, rig.seed);
  if (!warp.empty()) files["gt/depth_warp.png"] = io::EncodePng(DepthWarpImage(warp));
  return files;
}

}  // namespace sim
