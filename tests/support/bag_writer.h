#pragma once

#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

/// Bags of ROS 1 for tests, written with ROS' own library. C++17, as its messages are.
namespace bags {

enum class Compression { kNone, kBz2, kLz4 };

class BagWriter {
 public:
  BagWriter(const std::string& file, Compression compression);
  ~BagWriter();  ///< closes the bag

  void Image(const std::string& topic, double stamp_s, const std::string& frame,
             const std::string& encoding, const cv::Mat& pixels);
  /// @param k, p  fx fy cx cy, of the images as taken and as rectified
  void CameraInfo(const std::string& topic, cv::Size size, const std::array<double, 4>& k,
                  const std::string& lens, const std::vector<double>& d,
                  const std::array<double, 4>& p = {});
  void Number(const std::string& topic, float number);
  /// @param q_xyzw  quaternion
  void Transform(const std::string& topic, const std::array<double, 3>& t,
                 const std::array<double, 4>& q_xyzw);

 private:
  struct Bag;
  std::unique_ptr<Bag> bag_;
};

}  // namespace bags
