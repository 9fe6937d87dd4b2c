#pragma once

#include <array>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "eval/formats/json_record.h"

namespace eval {

using Box = std::array<double, 4>;  ///< x0, y0, x1, y1 in pixels

/// Reads a box, x0 < x1, y0 < y1 (equal ones, a single row or column, only when `may_be_thin`),
/// inside an image of `size` unless that is empty; that it is another one is a flaw.
std::optional<Box> ReadBox(const JsonRecord& record, const std::string& key, cv::Size size,
                           bool may_be_thin);

}  // namespace eval
