#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace slam {

/// What a topic of a bag holds.
struct BagTopic {
  enum class Kind { kImage, kCameraInfo, kNumber, kTransform, kCompressedImage };
  std::string name;
  Kind kind = Kind::kImage;
  int messages = 0;  ///< at least 1
};

/// sensor_msgs/Image.
struct BagImage {
  std::string frame;  ///< coordinate frame, "camera_color_optical_frame"
  int width = 0, height = 0;
  std::size_t step = 0;  ///< bytes from row to row
  std::string encoding;  ///< "rgb8"
  bool big_endian = false;
  std::vector<std::uint8_t> data;
};

/// sensor_msgs/CameraInfo.
struct BagCameraInfo {
  int width = 0, height = 0;
  std::string lens;            ///< distortion model, "plumb_bob"
  std::vector<double> d;       ///< its coefficients
  std::array<double, 9> k{};   ///< intrinsics of the image as recorded, row by row
  std::array<double, 12> p{};  ///< projection of the rectified image, row by row
};

/// geometry_msgs/Transform.
struct BagTransform {
  std::array<double, 3> t{};       ///< metres
  std::array<double, 4> q_xyzw{};  ///< quaternion
};

/// A bag of ROS 1, read message by message through an index. This is the one place that knows
/// ROS; it may be asked from several threads. Every function throws InputError, with file and
/// topic, for a message that cannot be read.
class BagFile {
 public:
  /// @throws InputError for what is no bag, is cut off, was not closed, or is encrypted, and
  ///   when the program was built without the library.
  explicit BagFile(const std::filesystem::path& file);
  ~BagFile();

  const std::filesystem::path& file() const { return file_; }
  /// Topics of the kinds above, by name.
  const std::vector<BagTopic>& topics() const { return topics_; }
  /// The topic of that name and kind; null when there is none.
  const BagTopic* Find(const std::string& name, BagTopic::Kind kind) const;

  /// Message i of a topic of that kind, in the order of recording.
  BagImage Image(const std::string& topic, int i) const;
  /// The stamps of all images of these topics, seconds: of their headers, or when they were
  /// recorded where no header has one. Reads the bag once from begin to end.
  std::map<std::string, std::vector<double>> ImageStamps(
      const std::vector<std::string>& topics) const;
  /// The first message of a topic of that kind.
  BagCameraInfo CameraInfo(const std::string& topic) const;
  double Number(const std::string& topic) const;
  BagTransform Transform(const std::string& topic) const;

 private:
  struct Messages;
  std::filesystem::path file_;
  std::vector<BagTopic> topics_;
  std::unique_ptr<Messages> messages_;
};

}  // namespace slam
