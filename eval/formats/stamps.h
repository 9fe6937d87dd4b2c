#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "eval/formats/folder.h"

namespace eval {

/// Two stamps closer than this are one frame: above the round-off of a six-digit stamp in a
/// double (2.4e-7 s at 1.3e9 s), far below any camera's frame time.
inline constexpr double kSameStamp_s = 1e-5;

/// Two stamps that are further apart than this are two instants: stamps are text with at least
/// four decimals, and half a unit of the last of them is lost on either side.
inline constexpr double kSameInstant_s = 1e-4;

/// Truth and estimate of one moment are at most this far apart where they have clocks of their own
/// (evo's default).
inline constexpr double kMaxStampDifference_s = 0.01;

/// Index of the entry of rising `stamps_s` that is the frame at `stamp_s`, if any.
std::optional<std::size_t> FindStamp(const std::vector<double>& stamps_s, double stamp_s);

/// Index of the entry of rising `stamps_s` that is nearest to t_s, if it is at most
/// max_difference_s away; the earlier one on ties.
std::optional<std::size_t> NearestStamp(const std::vector<double>& stamps_s, double t_s,
                                        double max_difference_s);

/// The record of a frame: the same stamp where stamps are ids of frames, as on synthetic data, else
/// the nearest within kMaxStampDifference_s. `stamps_s` rise.
std::optional<std::size_t> FindFrame(const std::vector<double>& stamps_s, double frame_s,
                                     bool synthetic);

/// The stamps of a list of records.
template <typename Records>
std::vector<double> StampsOf(const Records& records) {
  std::vector<double> stamps_s;
  stamps_s.reserve(records.size());
  for (const auto& record : records) stamps_s.push_back(record.stamp_s);
  return stamps_s;
}

/// Follows the time stamps of a file, which should be seconds and increase strictly.
class StampOrder {
 public:
  /// @param disorder    what a stamp that goes back does; readers sort
  /// @param repetition  what a stamp that comes again does: which of the two holds?
  StampOrder(Folder& folder, std::string file, Severity disorder = Severity::kWarning,
             Severity repetition = Severity::kFatal)
      : folder_(folder), file_(std::move(file)), disorder_(disorder), repetition_(repetition) {}
  /// @param line   0 when the file has no lines of its own
  /// @returns whether no record before has this stamp
  bool Next(double stamp_s, int line);
  /// Tells stamps that cannot be seconds or are negative, once for the file.
  void Finish();

 private:
  Folder& folder_;
  std::string file_;
  Severity disorder_, repetition_;
  std::vector<double> stamps_s_;
  std::set<double> seen_s_;
};

}  // namespace eval
