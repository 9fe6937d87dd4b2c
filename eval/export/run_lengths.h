#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace eval {

/// Run lengths of a mask as COCO counts them: down the columns, one column after the other,
/// beginning with pixels that are off (a first run of 0 when the first pixel is on). They sum
/// to the number of pixels.
std::vector<std::uint32_t> RunLengths(const cv::Mat1b& mask);

/// The text of COCO's compressed `counts`: from the fourth run on the difference to the run two
/// before is kept; each number in groups of 5 bits, lowest first, as character 48 + group + 32
/// when more follow; the last group's bit 4 is the sign.
std::string CompressRunLengths(const std::vector<std::uint32_t>& runs);

}  // namespace eval
