#pragma once

#include <utility>
#include <variant>

#include "slam/base/require.h"

namespace slam {

/// A value, or the reason why there is none: for answers that can rightly be missing (lines
/// nearly parallel, a gate that refuses, too few points). `Reason` is an enum per function.
template <typename T, typename Reason>
class [[nodiscard]] Result {
 public:
  Result(T value) : outcome_(std::in_place_index<0>, std::move(value)) {}         // NOLINT
  Result(Reason reason) : outcome_(std::in_place_index<1>, std::move(reason)) {}  // NOLINT

  bool has_value() const { return outcome_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// @throws std::invalid_argument if there is no value.
  const T& value() const {
    Require(has_value(), "Result::value: there is no value, ask error() for the reason");
    return std::get<0>(outcome_);
  }
  /// @throws std::invalid_argument if there is a value.
  const Reason& error() const {
    Require(!has_value(), "Result::error: there is a value");
    return std::get<1>(outcome_);
  }

 private:
  std::variant<T, Reason> outcome_;
};

}  // namespace slam
