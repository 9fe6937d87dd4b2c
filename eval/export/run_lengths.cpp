#include "eval/export/run_lengths.h"

namespace eval {

std::vector<std::uint32_t> RunLengths(const cv::Mat1b& mask) {
  std::vector<std::uint32_t> runs;
  bool on = false;
  std::uint32_t length = 0;
  for (int u = 0; u < mask.cols; ++u) {
    for (int v = 0; v < mask.rows; ++v) {
      if ((mask(v, u) != 0) != on) {
        runs.push_back(length);
        length = 0;
        on = !on;
      }
      ++length;
    }
  }
  runs.push_back(length);
  return runs;
}

std::string CompressRunLengths(const std::vector<std::uint32_t>& runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::int64_t left = runs[i];
    if (i > 2) left -= runs[i - 2];
    for (bool more = true; more;) {
      const std::int64_t group = left & 31;
      left >>= 5;  // keeps the sign
      more = left != ((group & 16) != 0 ? -1 : 0);
      text += static_cast<char>(48 + group + (more ? 32 : 0));
    }
  }
  return text;
}

}  // namespace eval
