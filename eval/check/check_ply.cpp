#include "eval/check/check_ply.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <set>
#include <sstream>

#include "io/number_text.h"
#include "io/read_file.h"

namespace eval {
namespace {

const std::string kPly = "map.ply";
constexpr const char* kRunAgain = "write the file again";

struct Property {
  std::string type, name;
};

struct Header {
  bool has_format = false, ascii = true;
  long vertices = -1;
  std::vector<Property> properties;  ///< what element vertex has
  std::size_t body = 0;              ///< byte at which it starts
  int lines = 0;
};

std::size_t SizeOf(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "double" || type == "float64") return 8;
  return type == "int" || type == "uint" || type == "int32" || type == "uint32" ||
                 type == "float" || type == "float32"
             ? 4
             : 0;
}

/// A whole number from 0 on; -1 for anything else.
long CountIn(const std::string& text) {
  constexpr double kMost = 1e15;
  const double number = io::ParseNumber(text).value_or(-1);
  return number >= 0 && number <= kMost && number == std::floor(number)
             ? static_cast<long>(number)
             : -1;
}

std::optional<Header> ReadHeader(Folder& folder, const std::string& bytes) {
  Header header;
  std::istringstream in(bytes);
  std::string text, element;
  bool ended = false;
  for (; !ended && std::getline(in, text); ++header.lines) {
    std::istringstream words(text);
    std::string first, second, third;
    words >> first >> second >> third;
    if (header.lines == 0 && first != "ply") break;
    if (first == "format") {
      header.has_format = true;
      header.ascii = second == "ascii";
      if (header.ascii || second == "binary_little_endian") continue;
      folder.Tell(kPly, header.lines + 1, "has the format " + second,
                  "use ascii or binary_little_endian");
      return std::nullopt;
    }
    if (first == "element") {
      element = second;
      if (second == "vertex") header.vertices = CountIn(third);
    } else if (first == "property" && element == "vertex") {
      header.properties.push_back({second, third});
    }
    ended = first == "end_header";
  }
  // The points begin behind the line's end.
  if (!ended || in.eof() || header.vertices < 0 || !header.has_format) {
    folder.Tell(kPly, 0, "has no complete PLY header (ply, format, element vertex, end_header)",
                kRunAgain);
    return std::nullopt;
  }
  header.body = static_cast<std::size_t>(in.tellg());
  return header;
}

bool CheckProperties(Folder& folder, const Header& header) {
  bool good = true;
  for (const char* name : {"x", "y", "z", "red", "green", "blue", "plane_id"}) {
    bool found = false;
    for (const Property& property : header.properties) {
      if (property.name != name) continue;
      found = SizeOf(property.type) > 0;
      if (std::strcmp(name, "plane_id") == 0) found = SizeOf(property.type) == 4;
    }
    if (found) continue;
    folder.Tell(kPly, 0, fmt::format("has no property `{}` of a known type", name),
                "write x y z red green blue and `property int plane_id`");
    good = false;
  }
  return good;
}

/// Values of a point, in the order of the properties; nothing at the end of the file.
class Points {
 public:
  Points(const std::string& bytes, const Header& header)
      : bytes_(bytes), header_(header), at_(header.body) {}

  std::optional<std::vector<double>> Next() {
    return header_.ascii ? NextLine() : NextRecord();
  }
  bool AtEnd() const {
    return bytes_.find_first_not_of(header_.ascii ? " \r\n\t" : "", at_) == std::string::npos;
  }

 private:
  std::optional<std::vector<double>> NextLine() {
    if (at_ >= bytes_.size()) return std::nullopt;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::istringstream words(bytes_.substr(at_, end - at_));
    at_ = std::min(end + 1, bytes_.size());
    std::vector<double> values;
    for (std::string word; words >> word;) {
      values.push_back(io::ParseNumber(word).value_or(std::nan("")));
    }
    if (values.size() != header_.properties.size()) return std::nullopt;
    return values;
  }

  template <typename T>
  double Take() {
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return static_cast<double>(value);
  }

  std::optional<std::vector<double>> NextRecord() {
    std::vector<double> values;
    for (const Property& property : header_.properties) {
      const std::size_t size = SizeOf(property.type);
      if (size == 0 || at_ + size > bytes_.size()) return std::nullopt;
      const bool real = property.type[0] == 'f' || property.type[0] == 'd';
      if (size == 8) values.push_back(Take<double>());
      if (size == 4) values.push_back(real ? Take<float>() : Take<std::int32_t>());
      if (size == 2) values.push_back(Take<std::int16_t>());
      if (size == 1) values.push_back(Take<std::uint8_t>());
    }
    return values;
  }

  const std::string& bytes_;
  const Header& header_;
  std::size_t at_;
};

void CheckPoints(Folder& folder, const Header& header, const std::string& bytes,
                 const Run& run) {
  Points points(bytes, header);
  std::set<long> known, unknown;
  for (const RunMapPlane& plane : run.map) known.insert(plane.id);
  long not_finite = 0;
  for (long i = 0; i < header.vertices; ++i) {
    const auto point = points.Next();
    if (!point) {
      folder.Tell(kPly, header.ascii ? header.lines + static_cast<int>(i) + 1 : 0,
                  fmt::format("ends or breaks at point {} of {}", i, header.vertices),
                  kRunAgain);
      return;
    }
    for (std::size_t k = 0; k < point->size(); ++k) {
      const double value = (*point)[k];
      if (!std::isfinite(value)) {
        ++not_finite;
      } else if (header.properties[k].name == "plane_id" && run.has_map &&
                 known.count(std::lround(value)) == 0) {
        unknown.insert(std::lround(value));
      }
    }
  }
  if (!points.AtEnd()) {
    folder.Tell(kPly, 0,
                fmt::format("goes on after the {} points of its header", header.vertices),
                kRunAgain);
  }
  if (not_finite > 0) {
    folder.Tell(kPly, 0, fmt::format("has {} values that are no finite numbers", not_finite),
                kRunAgain);
  }
  for (const long id : unknown) {
    folder.Tell(kPly, 0, fmt::format("has points of plane {}, which is not in map.json", id),
                "write the id that map.json gives the plane");
  }
}

}  // namespace

void CheckPly(Folder& folder, const Run& run) {
  if (!folder.Require(kPly, "run the SLAM system again")) return;
  std::string bytes;
  if (!folder.Try(kPly, [&] { bytes = io::ReadFile(folder.Open(kPly)); })) return;
  const auto header = ReadHeader(folder, bytes);
  if (header && CheckProperties(folder, *header)) CheckPoints(folder, *header, bytes, run);
}

}  // namespace eval
