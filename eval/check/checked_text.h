#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/check/fault.h"

namespace eval {

/// A line that holds a record.
struct CheckedLine {
  int number = 0;  ///< from 1
  std::string text;
  std::vector<std::string> words;  ///< split at blanks
};

/// Records of a text file, without blank lines and `#` comments. A file that cannot be opened
/// is a fault and has no records.
std::vector<CheckedLine> RecordsToCheck(FolderCheck& check, const std::string& file);

/// Follows the time stamps of a file: seconds, strictly increasing.
class StampOrder {
 public:
  StampOrder(FolderCheck& check, std::string file);
  /// @param line   0 when the file has no lines of its own
  void Next(double stamp_s, int line);
  /// Reports stamps that cannot be seconds, once for the file.
  void Finish();

 private:
  FolderCheck& check_;
  std::string file_;
  std::vector<double> stamps_s_;
};

/// Index of the stamp nearest to t, if it is closer than max_difference_s; stamps_s is
/// ascending.
std::optional<std::size_t> NearestStamp(const std::vector<double>& stamps_s, double t_s,
                                        double max_difference_s);

/// Two stamps that are further apart than this are two instants: stamps are text with at least
/// four decimals, and half a unit of the last of them is lost on either side.
inline constexpr double kSameInstant_s = 1e-4;

}  // namespace eval
