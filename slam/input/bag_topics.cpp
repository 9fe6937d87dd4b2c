#include "slam/input/bag_topics.h"

#include <algorithm>
#include <cctype>
#include <tuple>

#include "io/input_error.h"

namespace slam {
namespace {

/// A topic of images, and what its first one is.
struct ImageTopic {
  std::string name, encoding;
  int messages = 0;
};

bool IsAmong(const std::string& text, std::initializer_list<const char*> some) {
  return std::find(some.begin(), some.end(), text) != some.end();
}

/// Whether one of `some` stands among the words of a topic, which are put between slashes
/// ("/camera/left_ir": "/camera/left/ir/"). "/ir/" is a word, "/infra" how one begins.
bool HasWords(const std::string& topic, std::initializer_list<const char*> some) {
  std::string words = '/' + topic + '/';
  for (char& c : words) {
    c = c == '_' || c == '-' ? '/'
                             : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return std::any_of(some.begin(), some.end(),
                     [&](const char* one) { return words.find(one) != std::string::npos; });
}

bool IsInfrared(const std::string& topic) {
  return HasWords(topic, {"/ir/", "/ir1/", "/ir2/", "/infra"});
}

bool IsColour(const ImageTopic& image) {
  return IsAmong(image.encoding, {"rgb8", "bgr8", "rgba8", "bgra8", "mono8", "8UC1", "8UC3"}) &&
         !IsInfrared(image.name);
}

bool IsDepth(const ImageTopic& image) {
  return IsAmong(image.encoding, {"32FC1", "16UC1", "mono16"}) && !IsInfrared(image.name);
}

std::size_t CommonBegin(const std::string& a, const std::string& b) {
  const auto end = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return static_cast<std::size_t>(end - a.begin());
}

/// "/camera/rgb/image_color (rgb8), /camera/ir/image (16UC1)".
std::string ListOf(const std::vector<ImageTopic>& images) {
  std::string list;
  for (const ImageTopic& image : images) {
    list += (list.empty() ? "" : ", ") + image.name + " (" + image.encoding + ")";
  }
  return list.empty() ? "none" : list;
}

/// The first by `rank` of those that are of the kind wanted.
template <typename Is, typename Rank>
std::string Choose(const BagFile& bag, const std::vector<ImageTopic>& images, const char* what,
                   const Is& is, const Rank& rank, std::vector<std::string>& warnings) {
  std::vector<ImageTopic> some;
  std::copy_if(images.begin(), images.end(), std::back_inserter(some), is);
  if (some.empty()) {
    const bool compressed = std::any_of(
        bag.topics().begin(), bag.topics().end(),
        [](const BagTopic& topic) { return topic.kind == BagTopic::Kind::kCompressedImage; });
    throw io::InputError(
        bag.file().string(),
        std::string("has no topic of ") + what + "; its images are: " + ListOf(images) +
            (compressed ? "; it holds compressed images too, which must be written anew with "
                          "image_transport's `republish compressed raw`"
                        : ""));
  }
  std::stable_sort(some.begin(), some.end(),
                   [&](const ImageTopic& a, const ImageTopic& b) { return rank(a) < rank(b); });
  std::string taken = some.front().name;
  some.erase(some.begin());
  if (!some.empty()) {
    warnings.push_back("the bag has several topics of " + std::string(what) + "; " + taken +
                       " is read, and not " + ListOf(some));
  }
  return taken;
}

std::string InfoBeside(const BagFile& bag, const std::string& image_topic) {
  const std::string info = IsOfRealSense(image_topic)
                               ? OfStream(image_topic, "info/camera_info")
                               : image_topic.substr(0, image_topic.rfind('/')) + "/camera_info";
  return bag.Find(info, BagTopic::Kind::kCameraInfo) != nullptr ? info : "";
}

}  // namespace

bool SaysRegistered(const std::string& topic) {
  return HasWords(topic, {"/registered/", "/aligned/", "/to/color/", "/to/rgb/"});
}

bool IsOfRealSense(const std::string& topic) {
  return topic.rfind("/device_", 0) == 0 && topic.ends_with("/image/data");
}

std::string OfStream(const std::string& image_topic, const std::string& end) {
  const std::string data = "image/data";
  return image_topic.substr(0, image_topic.size() - data.size()) + end;
}

BagTopics ChooseTopics(const BagFile& bag) {
  std::vector<ImageTopic> images;
  for (const BagTopic& topic : bag.topics()) {
    if (topic.kind != BagTopic::Kind::kImage) continue;
    images.push_back({topic.name, bag.Image(topic.name, 0).encoding, topic.messages});
  }
  BagTopics topics;
  topics.colour = Choose(
      bag, images, "colour (rgb8, bgr8, rgba8, bgra8, mono8)", IsColour,
      [](const ImageTopic& image) {
        return std::tuple(IsAmong(image.encoding, {"mono8", "8UC1"}), -image.messages);
      },
      topics.warnings);
  topics.depth = Choose(
      bag, images, "depth (32FC1, 16UC1, mono16)", IsDepth,
      [&](const ImageTopic& image) {
        return std::tuple(!SaysRegistered(image.name),
                          -static_cast<int>(CommonBegin(image.name, topics.colour)),
                          -image.messages);
      },
      topics.warnings);
  topics.colour_info = InfoBeside(bag, topics.colour);
  topics.depth_info = InfoBeside(bag, topics.depth);
  return topics;
}

}  // namespace slam
