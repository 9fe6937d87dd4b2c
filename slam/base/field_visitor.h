#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slam/base/degrees.h"

namespace slam {

/// Visits the fields of settings: what reads a file, writes one or lists the fields implements
/// it. Each struct of settings has a VisitFields below it, which is the table of its keys.
///
/// `key` is the field's name in the file, `domain` an interval (io/interval.h) in the file's
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
  /// One of `names`; the value is its position.
  virtual void Choice(const char* key, int& value, const std::vector<std::string>& names,
                      const char* help) = 0;
  /// Any text but an empty one.
  virtual void Text(const char* key, std::string& value, const char* help) = 0;
  virtual void Texts(const char* key, std::vector<std::string>& value, const char* help) = 0;

  /// The settings of a part stand below `key`.
  template <typename Part>
  void Section(const char* key, const char* help, Part& part) requires
      requires(Part& p, FieldVisitor& v) {
    VisitFields(p, v);
  }
  {
    Section(key, help, std::function<void()>([&] { VisitFields(part, *this); }));
  }

  /// An enumeration whose values count from 0 in the order of `names`.
  template <typename Enum>
  void Named(const char* key, Enum& value, const std::vector<std::string>& names,
             const char* help) {
    int position = static_cast<int>(value);
    Choice(key, position, names, help);
    value = static_cast<Enum>(position);
  }

  /// An angle: radians in the struct, degrees in the file; `key` ends in _deg. What is written
  /// reads back bit for bit (see DegreesOf).
  virtual void Degrees(const char* key, double& value_rad, const char* domain,
                       const char* help) {
    const double before = DegreesOf(value_rad);
    double value_deg = before;
    Number(key, value_deg, domain, help);
    if (value_deg != before) value_rad = RadiansOf(value_deg);
  }
};

}  // namespace slam
