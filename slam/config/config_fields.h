#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "slam/config/config.h"

namespace slam {

/// Visits every field of a Config: what reads a file, writes one or lists the fields implements
/// it. A new field of a stage is one line in bind_*.cpp.
///
/// `key` is the field's name in the file, `domain` an interval (yaml_map.h) in the file's
/// units.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  /// Fields visited by `body` stand below `key`.
  virtual void Section(const char* key, const char* help,
                       const std::function<void()>& body) = 0;
  virtual void Number(const char* key, double& value, const char* domain, const char* help) = 0;
  virtual void Integer(const char* key, int& value, const char* domain, const char* help) = 0;
  virtual void Flag(const char* key, bool& value, const char* help) = 0;
  virtual void Texts(const char* key, std::vector<std::string>& value, const char* help) = 0;

  /// A single-precision field.
  void Number(const char* key, float& value, const char* domain, const char* help) {
    double x = static_cast<double>(value);
    Number(key, x, domain, help);
    value = static_cast<float>(x);
  }
  /// An angle: radians in the struct, degrees in the file; `key` ends in _deg.
  void Degrees(const char* key, double& value_rad, const char* domain, const char* help) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double before = value_rad / kDegree;
    double value_deg = before;
    Number(key, value_deg, domain, help);
    if (value_deg != before)
      value_rad = value_deg * kDegree;  // untouched is bit for bit the same
  }
};

/// All fields, in the order of the data flow.
void VisitConfig(Config& config, FieldVisitor& visitor);

// The parts, by file.
void VisitPlanes(Config& config, FieldVisitor& visitor);
void VisitPoints(Config& config, FieldVisitor& visitor);

}  // namespace slam
