// Compiled as C++17: the headers of ROS' messages use what C++20 took out of std::allocator.
#include "slam/bag/bag_file.h"

#include <console_bridge/console.h>
#include <geometry_msgs/Transform.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Header.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "io/input_error.h"

namespace slam {

/// A message whose checksum does not count: RealSense's library writes the unit of depth behind
/// an image, which makes its messages others than ROS' own. What is behind is passed over.
template <typename Message>
struct BagMessage {
  Message message;
};

}  // namespace slam

namespace ros::message_traits {
template <typename Message>
struct MD5Sum<slam::BagMessage<Message>> {
  static const char* value() { return "*"; }
};
}  // namespace ros::message_traits

namespace ros::serialization {
template <typename Message>
struct Serializer<slam::BagMessage<Message>> {
  template <typename Stream>
  static void read(Stream& stream, slam::BagMessage<Message>& to) {
    deserialize(stream, to.message);
  }
};
}  // namespace ros::serialization

namespace slam {
namespace {

std::optional<BagTopic::Kind> KindOfType(const std::string& type) {
  if (type == "sensor_msgs/Image") return BagTopic::Kind::kImage;
  if (type == "sensor_msgs/CameraInfo") return BagTopic::Kind::kCameraInfo;
  if (type == "std_msgs/Float32") return BagTopic::Kind::kNumber;
  if (type == "geometry_msgs/Transform") return BagTopic::Kind::kTransform;
  if (type == "sensor_msgs/CompressedImage") return BagTopic::Kind::kCompressedImage;
  return std::nullopt;
}

template <typename Message>
Message Decoded(const rosbag::MessageInstance& record) {
  return std::move(record.instantiate<BagMessage<Message>>()->message);
}

/// As the decimal text of the time would be read; Time::toSec may be one unit off.
double Seconds(const ros::Time& time) {
  return static_cast<double>(time.sec + time.nsec / 1e9L);
}

/// Runs what calls the library, and says of its exceptions which file they are about.
template <typename Call>
auto Reading(const std::string& where, const Call& call) {
  try {
    return call();
  } catch (const rosbag::BagUnindexedException&) {
    throw io::InputError(where,
                         "the bag has no index: it was not closed, or is cut off; copy it "
                         "again, or mend it with `rosbag reindex`");
  } catch (const std::exception& error) {
    throw io::InputError(where, "cannot be read as a bag of ROS 1 (" +
                                    io::Quoted(error.what()) +
                                    "); copy it again, or record it anew");
  }
}

}  // namespace

struct BagFile::Messages {
  rosbag::Bag bag;
  std::map<std::string, std::vector<rosbag::MessageInstance>> of_topic;
  mutable std::mutex reading;  ///< the library has one file position and one open chunk

  const rosbag::MessageInstance& At(const std::string& topic, int i) const {
    return of_topic.at(topic).at(static_cast<std::size_t>(i));
  }
};

BagFile::BagFile(const std::filesystem::path& file)
    : file_(file), messages_(std::make_unique<Messages>()) {
  console_bridge::noOutputHandler();  // what is wrong is in the exceptions
  Reading(file_.string(), [&] {
    messages_->bag.open(file_.string(), rosbag::bagmode::Read);
    std::map<std::string, BagTopic> topics;
    rosbag::View view(messages_->bag, [](const rosbag::ConnectionInfo* connection) {
      return KindOfType(connection->datatype).has_value();
    });
    for (const rosbag::MessageInstance& record : view) {
      const std::string& name = record.getTopic();
      topics[name].kind = *KindOfType(record.getDataType());
      ++topics[name].messages;
      messages_->of_topic[name].push_back(record);
    }
    for (auto& [name, topic] : topics) {
      topic.name = name;
      topics_.push_back(topic);
    }
  });
}

BagFile::~BagFile() = default;

const BagTopic* BagFile::Find(const std::string& name, BagTopic::Kind kind) const {
  const auto found = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& topic) {
    return topic.name == name && topic.kind == kind;
  });
  return found == topics_.end() ? nullptr : &*found;
}

BagImage BagFile::Image(const std::string& topic, int i) const {
  return Reading(file_.string() + " (" + topic + ", image " + std::to_string(i) + ")", [&] {
    const std::lock_guard lock(messages_->reading);
    auto message = Decoded<sensor_msgs::Image>(messages_->At(topic, i));
    BagImage image;
    image.frame = message.header.frame_id;
    image.width = static_cast<int>(message.width);
    image.height = static_cast<int>(message.height);
    image.step = message.step;
    image.encoding = message.encoding;
    image.big_endian = message.is_bigendian != 0;
    image.data = std::move(message.data);
    return image;
  });
}

std::map<std::string, std::vector<double>> BagFile::ImageStamps(
    const std::vector<std::string>& topics) const {
  return Reading(file_.string(), [&] {
    const std::lock_guard lock(messages_->reading);
    std::map<std::string, std::vector<double>> taken_s, recorded_s;
    // In the order of recording, so that each chunk is unpacked once.
    rosbag::View view(messages_->bag, rosbag::TopicQuery(topics));
    for (const rosbag::MessageInstance& record : view) {
      const std_msgs::Header header = Decoded<std_msgs::Header>(record);  // an image's begin
      taken_s[record.getTopic()].push_back(Seconds(header.stamp));
      recorded_s[record.getTopic()].push_back(Seconds(record.getTime()));
    }
    for (auto& [topic, stamps_s] : taken_s) {
      const auto none = [](double t) { return t == 0; };
      if (std::all_of(stamps_s.begin(), stamps_s.end(), none)) stamps_s = recorded_s[topic];
    }
    return taken_s;
  });
}

BagCameraInfo BagFile::CameraInfo(const std::string& topic) const {
  return Reading(file_.string() + " (" + topic + ")", [&] {
    const std::lock_guard lock(messages_->reading);
    const auto message = Decoded<sensor_msgs::CameraInfo>(messages_->At(topic, 0));
    BagCameraInfo info;
    info.width = static_cast<int>(message.width);
    info.height = static_cast<int>(message.height);
    info.lens = message.distortion_model;
    info.d = message.D;
    std::copy(message.K.begin(), message.K.end(), info.k.begin());
    std::copy(message.P.begin(), message.P.end(), info.p.begin());
    return info;
  });
}

double BagFile::Number(const std::string& topic) const {
  return Reading(file_.string() + " (" + topic + ")", [&] {
    const std::lock_guard lock(messages_->reading);
    return Decoded<std_msgs::Float32>(messages_->At(topic, 0)).data;
  });
}

BagTransform BagFile::Transform(const std::string& topic) const {
  return Reading(file_.string() + " (" + topic + ")", [&] {
    const std::lock_guard lock(messages_->reading);
    const auto message = Decoded<geometry_msgs::Transform>(messages_->At(topic, 0));
    return BagTransform{
        {message.translation.x, message.translation.y, message.translation.z},
        {message.rotation.x, message.rotation.y, message.rotation.z, message.rotation.w}};
  });
}

}  // namespace slam
