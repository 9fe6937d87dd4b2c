#include "tests/support/bag_writer.h"

#include <geometry_msgs/Transform.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float32.h>

#include <algorithm>
#include <cmath>

namespace bags {
namespace {

ros::Time TimeOf(double stamp_s) {
  const double whole_s = std::floor(stamp_s);
  return {static_cast<std::uint32_t>(whole_s),
          static_cast<std::uint32_t>(std::lround((stamp_s - whole_s) * 1e6)) * 1000};
}

}  // namespace

struct BagWriter::Bag {
  rosbag::Bag bag;
  ros::Time last = ros::TIME_MIN;
};

BagWriter::BagWriter(const std::string& file, Compression compression)
    : bag_(std::make_unique<Bag>()) {
  bag_->bag.open(file, rosbag::bagmode::Write);
  bag_->bag.setCompression(compression == Compression::kBz2 ? rosbag::compression::BZ2
                           : compression == Compression::kLz4
                               ? rosbag::compression::LZ4
                               : rosbag::compression::Uncompressed);
}

BagWriter::~BagWriter() { bag_->bag.close(); }

void BagWriter::Image(const std::string& topic, double stamp_s, const std::string& frame,
                      const std::string& encoding, const cv::Mat& pixels) {
  sensor_msgs::Image image;
  image.header.stamp = TimeOf(stamp_s);
  image.header.frame_id = frame;
  image.width = static_cast<std::uint32_t>(pixels.cols);
  image.height = static_cast<std::uint32_t>(pixels.rows);
  image.encoding = encoding;
  image.step = static_cast<std::uint32_t>(pixels.step);
  image.data.assign(pixels.datastart, pixels.dataend);
  // Images are recorded in the order of the calls, each some time after it was taken.
  const ros::Time arrival = image.header.stamp + ros::Duration(0.004);
  bag_->last = std::max(arrival, bag_->last + ros::Duration(0.0001));
  bag_->bag.write(topic, bag_->last, image);
}

void BagWriter::CameraInfo(const std::string& topic, cv::Size size,
                           const std::array<double, 4>& k, const std::string& lens,
                           const std::vector<double>& d, const std::array<double, 4>& p) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(size.width);
  info.height = static_cast<std::uint32_t>(size.height);
  info.K = {k[0], 0, k[2], 0, k[1], k[3], 0, 0, 1};
  info.P = {p[0], 0, p[2], 0, 0, p[1], p[3], 0, 0, 0, 1, 0};
  info.distortion_model = lens;
  info.D = d;
  bag_->bag.write(topic, bag_->last, info);
}

void BagWriter::Number(const std::string& topic, float number) {
  std_msgs::Float32 message;
  message.data = number;
  bag_->bag.write(topic, bag_->last, message);
}

void BagWriter::Transform(const std::string& topic, const std::array<double, 3>& t,
                          const std::array<double, 4>& q_xyzw) {
  geometry_msgs::Transform transform;
  transform.translation.x = t[0], transform.translation.y = t[1];
  transform.translation.z = t[2];
  transform.rotation.x = q_xyzw[0], transform.rotation.y = q_xyzw[1];
  transform.rotation.z = q_xyzw[2], transform.rotation.w = q_xyzw[3];
  bag_->bag.write(topic, bag_->last, transform);
}

}  // namespace bags
