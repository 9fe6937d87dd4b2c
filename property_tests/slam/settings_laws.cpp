#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>

#include "io/interval.h"
#include "slam/base/degrees.h"
#include "slam/run/config_file.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

double BoundOf(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  if (text == "inf") return std::numeric_limits<double>::max();
  double bound = 0;
  std::from_chars(text.data(), text.data() + text.size(), bound);
  return bound;
}

/// Any number of the domain, with all its bits: anywhere in it, or of any order of magnitude
/// where it has no end.
double AnyIn(const io::Interval& domain) {
  const std::string_view text = domain.text();
  const std::size_t comma = text.find(',');
  const double min = BoundOf(text.substr(1, comma - 1));
  const double max = BoundOf(text.substr(comma + 1, text.size() - comma - 2));
  const double share = static_cast<double>(*rc::gen::inRange<std::int64_t>(1, 1LL << 53)) /
                       static_cast<double>(1LL << 53);
  const double number = max < 1e300 ? min + share * (max - min)
                                    : min + std::ldexp(share, *rc::gen::inRange(-40, 40));
  return domain.Contains(number) ? number : min + 0.5 * (std::min(max, min + 2) - min);
}

/// Letters that a file has to quote; the key keeps the lists of classes apart.
std::string AnyText(const std::string& key) {
  const std::string letters = " \"#:,[]{}'\\\t\n-aZ\xc3\xa9";
  return *rc::gen::container<std::string>(
             rc::gen::elementOf(letters.substr(0, letters.size() - 2))) +
         key;
}

/// Sets every field to a value of its domain, as a file could.
class AnyValues : public FieldVisitor {
 public:
  void Section(const char*, const char*, const std::function<void()>& body) override { body(); }
  void Number(const char*, double& value, const char* domain, const char*) override {
    value = AnyIn(io::Interval(domain));
  }
  void Integer(const char*, int& value, const char* domain, const char*) override {
    const io::Interval interval(domain);
    value = static_cast<int>(std::min(std::floor(AnyIn(interval)), 2e9));
    if (!interval.Contains(value)) ++value;
  }
  void Flag(const char*, bool& value, const char*) override {
    value = *rc::gen::arbitrary<bool>();
  }
  void Choice(const char*, int& value, const std::vector<std::string>& names,
              const char*) override {
    value = *rc::gen::inRange(0, static_cast<int>(names.size()));
  }
  void Text(const char* key, std::string& value, const char*) override { value = AnyText(key); }
  void Texts(const char* key, std::vector<std::string>& value, const char*) override {
    value.clear();
    const int count = *rc::gen::inRange(1, 5);
    for (int i = 0; i < count; ++i) {
      value.push_back(AnyText(key));
    }
  }
};

/// The bits of every field, radians of an angle; in words, so that a failure can be read.
class AllBits : public FieldVisitor {
 public:
  std::vector<std::string> fields;

  void Section(const char*, const char*, const std::function<void()>& body) override { body(); }
  void Number(const char* key, double& value, const char*, const char*) override {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    fields.push_back(std::string(key) + " " + std::to_string(bits));
  }
  void Degrees(const char* key, double& value_rad, const char*, const char*) override {
    Number(key, value_rad, "", "");
  }
  void Integer(const char* key, int& value, const char*, const char*) override {
    fields.push_back(std::string(key) + " " + std::to_string(value));
  }
  void Flag(const char* key, bool& value, const char*) override {
    fields.push_back(std::string(key) + (value ? " true" : " false"));
  }
  void Choice(const char* key, int& value, const std::vector<std::string>&,
              const char*) override {
    fields.push_back(std::string(key) + " " + std::to_string(value));
  }
  void Text(const char* key, std::string& value, const char*) override {
    fields.push_back(std::string(key) + " " + value);
  }
  void Texts(const char* key, std::vector<std::string>& value, const char*) override {
    for (const std::string& text : value) fields.push_back(std::string(key) + " " + text);
  }
};

std::vector<std::string> BitsOf(Config config) {
  AllBits visitor;
  VisitFields(config, visitor);
  return visitor.fields;
}

/// What `pas config > FILE` and `--config FILE` do, over the defaults of another sensor.
Config PrintedAndRead(const Config& config) {
  const test_support::TemporaryFolder folder;
  const std::filesystem::path file = folder / "settings.yaml";
  std::ofstream(file) << ConfigAsYaml(config);
  const Config read = ReadConfig(file, ConfigFor(DepthSensor::kAzure));
  std::filesystem::remove(file);
  return read;
}

template <typename Number>
void PutInOrder(Number& min, Number& max) {
  if (max < min) std::swap(min, max);
}

Config AnyConfig() {
  Config c;
  AnyValues visitor;
  VisitFields(c, visitor);
  // What the reader demands of two fields together.
  PutInOrder(c.point_features.min_fast_threshold, c.point_features.fast_threshold);
  PutInOrder(c.point_features.depth.min_depth_m, c.point_features.depth.max_depth_m);
  c.point_features.depth.max_depth_m += 1;
  PutInOrder(c.plane_processing.vertices.min_fill, c.plane_processing.vertices.max_fill);
  PutInOrder(c.association.max_chi2, c.association.new_chi2);
  return c;
}

TEST(Settings, DefaultsOfEverySensorArePrintedSoThatTheyReadBackBitForBit) {
  for (const DepthSensor sensor :
       {DepthSensor::kKinect1, DepthSensor::kAzure, DepthSensor::kD435}) {
    const Config config = ConfigFor(sensor);
    EXPECT_EQ(BitsOf(PrintedAndRead(config)), BitsOf(config));
  }
}

RC_GTEST_PROP(Settings, AreWhatTheyWereOncePrintedAndRead, ()) {
  const Config config = AnyConfig();
  RC_ASSERT(BitsOf(PrintedAndRead(config)) == BitsOf(config));
}

RC_GTEST_PROP(Settings, AngleOfAFileIsPrintedSoThatItReadsBackToTheSameRadians, ()) {
  const double radians = RadiansOf(AnyIn(io::Interval("(0, 360]")));
  RC_ASSERT(RadiansOf(DegreesOf(radians)) == radians);
}

}  // namespace
}  // namespace slam
