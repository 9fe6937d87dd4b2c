#include "slam/input/bag_images.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "io/input_error.h"
#include "slam/base/index.h"
#include "slam/input/bag_camera.h"
#include "slam/input/image_message.h"
#include "slam/input/pair_images.h"

namespace slam {
namespace {

/// From each reference camera of the device that the bag knows, by its name, to the camera of a
/// stream.
std::map<std::string, Pose> FromReferences(const BagFile& bag, const std::string& image_topic) {
  const std::string begin = OfStream(image_topic, "tf/");
  std::map<std::string, Pose> poses;
  for (const BagTopic& topic : bag.topics()) {
    if (topic.kind != BagTopic::Kind::kTransform || topic.name.rfind(begin, 0) != 0) continue;
    const BagTransform tf = bag.Transform(topic.name);
    const Eigen::Quaterniond q(tf.q_xyzw[3], tf.q_xyzw[0], tf.q_xyzw[1], tf.q_xyzw[2]);
    const Eigen::Vector3d t(tf.t[0], tf.t[1], tf.t[2]);
    if (!(std::abs(q.norm() - 1) < 1e-3) || !t.allFinite()) {
      throw io::InputError(bag.file().string() + " (" + topic.name + ")",
                           "is no rigid motion: the quaternion's length must be 1");
    }
    poses[topic.name.substr(begin.size())] = {q.normalized().toRotationMatrix(), t};
  }
  return poses;
}

/// From the depth camera to colour's, by a reference that both know; nothing without one.
std::optional<Pose> FromDepthToColour(const BagFile& bag, const BagTopics& topics) {
  const auto to_colour = FromReferences(bag, topics.colour);
  for (const auto& [reference, to_depth] : FromReferences(bag, topics.depth)) {
    const auto found = to_colour.find(reference);
    if (found != to_colour.end()) return found->second * Inverse(to_depth);
  }
  return std::nullopt;
}

bool SameView(const Camera& a, const Camera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && a.k1 == b.k1 && a.k2 == b.k2 && a.k3 == b.k3 &&
         a.p1 == b.p1 && a.p2 == b.p2;
}

/// How depth of RealSense's library comes to lie on colour; nothing when it does.
std::optional<DepthRegistration> RegistrationOf(const BagFile& bag, const BagTopics& topics,
                                                const Camera& colour) {
  const std::optional<Pose> T_cd = FromDepthToColour(bag, topics);
  if (!T_cd || topics.depth_info.empty()) {
    throw io::InputError(bag.file().string(),
                         "does not say how " + topics.depth + " lies to " + topics.colour +
                             " (info/camera_info and tf/N of both, with one N); record it anew "
                             "with realsense-viewer");
  }
  const Camera depth = CameraOfInfo(bag, topics.depth_info, topics.depth);
  constexpr double kMaxApart_m = 1e-6, kMaxTurn_rad = 1e-6;  // round-off of single precision
  if (SameView(depth, colour) && T_cd->t.norm() < kMaxApart_m &&
      LogSo3(T_cd->R).norm() < kMaxTurn_rad) {
    return std::nullopt;
  }
  return DepthRegistration(depth, colour, *T_cd);
}

/// Without the slash that older drivers begin it with.
std::string PlainFrame(const std::string& frame) {
  return frame.substr(frame.rfind('/', 0) == 0 ? 1 : 0);
}

/// Refuses depth that a driver of ROS has not laid on colour.
void RequireRegistered(const BagFile& bag, const BagTopics& topics, const BagImage& depth) {
  const std::string frame = bag.Image(topics.colour, 0).frame;
  if (SaysRegistered(topics.depth) || PlainFrame(depth.frame) == PlainFrame(frame)) return;
  throw io::InputError(
      bag.file().string(),
      "depth of " + topics.depth + " is measured in frame `" + depth.frame + "`, colour of " +
          topics.colour + " in `" + frame +
          "`: it is not laid on colour; record it so (align_depth:=true of realsense2_camera, "
          "depth_registration:=true of openni_launch)");
}

/// The images of a topic in the order of their stamps, each stamp once.
struct StampedTopic {
  std::vector<StampedImage> images;
  std::vector<int> messages;  ///< of each image
};
StampedTopic InOrder(const std::string& topic, const std::vector<double>& stamps_s,
                     std::vector<std::string>& warnings) {
  std::vector<int> order(stamps_s.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return stamps_s[Index(a)] < stamps_s[Index(b)]; });
  StampedTopic stamped;
  for (const int i : order) {
    const double t = stamps_s[Index(i)];
    if (!stamped.images.empty() && stamped.images.back().t == t) continue;
    const std::string source = topic + ", image " + std::to_string(i);
    stamped.images.push_back({t, topic, source});
    stamped.messages.push_back(i);
  }
  if (const std::size_t again = order.size() - stamped.images.size(); again > 0) {
    warnings.push_back("left out, for their stamps come again: " + std::to_string(again) +
                       " of " + std::to_string(order.size()) + " images of " + topic);
  }
  return stamped;
}

}  // namespace

BagImages::BagImages(const std::filesystem::path& file, const Camera& camera)
    : bag_(file),
      topics_(ChooseTopics(bag_)),
      camera_(camera),
      depth_factor_(DepthFactorOf(bag_, topics_)) {
  const BagImage depth = bag_.Image(topics_.depth, 0);
  if (IsOfRealSense(topics_.depth) && IsOfRealSense(topics_.colour)) {
    registration_ = RegistrationOf(bag_, topics_, camera_);
  } else {
    RequireRegistered(bag_, topics_, depth);
  }
  depth_size_ =
      registration_ ? registration_->depth_size() : cv::Size(camera_.width, camera_.height);
  PairByTime();
}

void BagImages::PairByTime() {
  index_.warnings = topics_.warnings;
  const auto stamps_s = bag_.ImageStamps({topics_.colour, topics_.depth});
  const StampedTopic colour =
      InOrder(topics_.colour, stamps_s.at(topics_.colour), index_.warnings);
  const StampedTopic depth =
      InOrder(topics_.depth, stamps_s.at(topics_.depth), index_.warnings);
  ImagePairs made = PairImages(colour.images, depth.images);
  if (made.pairs.empty()) {
    throw io::InputError(bag_.file().string(),
                         "no image of " + topics_.colour + " has one of " + topics_.depth +
                             " within 20 ms; both must be stamped by one clock");
  }
  for (const auto& [i, j] : made.pairs) {
    index_.entries.push_back({colour.images[i].t, depth.images[j].t, topics_.colour,
                              topics_.depth, colour.images[i].source, depth.images[j].source});
    messages_.emplace_back(colour.messages[i], depth.messages[j]);
  }
  index_.warnings.insert(index_.warnings.end(), made.warnings.begin(), made.warnings.end());
}

cv::Mat3b BagImages::Bgr(int i) const {
  const int message = messages_[Index(i)].first;
  return BgrOf(bag_.Image(topics_.colour, message), {camera_.width, camera_.height},
               bag_.file().string() + " (frame " + std::to_string(i) + ", " + topics_.colour +
                   ", image " + std::to_string(message) + ")");
}

cv::Mat1f BagImages::Depth(int i) const {
  const int message = messages_[Index(i)].second;
  cv::Mat1f depth_m = DepthOf(bag_.Image(topics_.depth, message), depth_size_, depth_factor_,
                              bag_.file().string() + " (frame " + std::to_string(i) + ", " +
                                  topics_.depth + ", image " + std::to_string(message) + ")");
  return registration_ ? registration_->Register(depth_m) : depth_m;
}

}  // namespace slam
