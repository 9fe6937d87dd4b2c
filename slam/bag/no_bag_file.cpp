// In the place of bag_file.cpp where the library is not there.
#include "io/input_error.h"
#include "slam/bag/bag_file.h"

namespace slam {

struct BagFile::Messages {};

BagFile::BagFile(const std::filesystem::path& file) : file_(file) {
  throw io::InputError(file.string(),
                       "is a ROS bag, and this program was built without reading them; install "
                       "librosbag-storage-dev and libsensor-msgs-dev (`ci/setup --with-bags`) "
                       "and build it again with `ci/build`");
}

BagFile::~BagFile() = default;

const BagTopic* BagFile::Find(const std::string&, BagTopic::Kind) const { return nullptr; }
BagImage BagFile::Image(const std::string&, int) const { return {}; }
std::map<std::string, std::vector<double>> BagFile::ImageStamps(
    const std::vector<std::string>&) const {
  return {};
}
BagCameraInfo BagFile::CameraInfo(const std::string&) const { return {}; }
double BagFile::Number(const std::string&) const { return 0; }
BagTransform BagFile::Transform(const std::string&) const { return {}; }

}  // namespace slam
