#include "eval/formats/run/run_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "io/input_error.h"

namespace eval {
namespace {

// Poses exist only at times of frames, keyframes only at times of poses.
template <typename Records>
void TellOtherTimes(Folder& folder, const std::string& file, const Records& records,
                    const std::vector<double>& stamps_s, const std::string& of,
                    Severity severity) {
  for (const auto& record : records) {
    if (NearestStamp(stamps_s, record.stamp_s, kSameInstant_s)) continue;
    folder.Tell(file, record.line, fmt::format("{:.6f} is no time of {}", record.stamp_s, of),
                "write the time of the frame as the sequence gives it", severity);
  }
}

void TellOtherCount(Folder& folder, const std::string& file, std::size_t count,
                    const char* what, const std::optional<int>& told, const char* records) {
  if (!told || *told == static_cast<int>(count)) return;
  folder.Tell(file, 0, fmt::format("has {} {}, but run.json tells of {}", count, what, *told),
              fmt::format("write one line for each {}", records), Severity::kWarning);
}

/// Follows which map planes exist when a frame decides.
class DecisionCheck {
 public:
  DecisionCheck(Folder& folder, const Run& run) : folder_(folder), map_is_read_(run.has_map) {
    for (const RunMapPlane& plane : run.map) {
      ids_.insert(plane.id);
      if (plane.split_from) split_off_.insert(plane.id);
    }
  }

  void Frame(const RunFrame& frame) {
    for (std::size_t i = 0; i < frame.planes.size(); ++i) {
      line_ = frame.line;
      pointer_ = fmt::format("/planes/{}/", i);
      Decision(frame.planes[i]);
    }
    // Decisions of a frame are made at once, so what is new in it can be matched only later.
    made_.merge(made_now_);
    made_now_.clear();
  }

 private:
  void Tell(const std::string& key, std::string what, std::string mend,
            Severity severity = Severity::kFatal) {
    folder_.Tell(
        {"frame_planes.jsonl", line_, pointer_ + key, std::move(what), std::move(mend)},
        severity);
  }

  void Decision(const RunFramePlane& plane) {
    if (plane.map_plane && map_is_read_ && ids_.count(*plane.map_plane) == 0) {
      Tell("map_plane", fmt::format("is {}, which is no plane of map.json", *plane.map_plane),
           "keep merged planes in the map, with merged_into");
    } else if (plane.decision == "none" && plane.map_plane) {
      Tell("map_plane", fmt::format("is {}, but the decision is none", *plane.map_plane),
           "write null, or the decision that was made", Severity::kWarning);
    } else if (plane.decision == "none" || plane.decision.empty()) {
      return;
    } else if (!plane.map_plane) {
      Tell("map_plane", "is null, but the decision is " + plane.decision,
           "name the map plane that was " +
               std::string(plane.decision == "new" ? "made" : "matched"));
    } else {
      Follow(plane.decision, *plane.map_plane);
    }
  }

  void Follow(const std::string& decision, int id) {
    const bool known = made_.count(id) != 0;
    if (decision == "new") {
      if (!made_now_.insert(id).second || known) {
        Tell("decision", fmt::format("is new, but map plane {} has been made before", id),
             "write each decision as it was made at that frame", Severity::kWarning);
      }
    } else if (!known && split_off_.count(id) == 0 && unmade_.insert(id).second) {
      Tell("decision", fmt::format("is matched, but no earlier frame made map plane {}", id),
           "write the frame that makes a map plane as new", Severity::kWarning);
    }
  }

  Folder& folder_;
  bool map_is_read_;
  std::set<int> ids_;        ///< in map.json
  std::set<int> split_off_;  ///< of these, made by splitting another
  std::set<int> made_, made_now_;
  std::set<int> unmade_;  ///< told already
  int line_ = 0;          ///< where the decision stands
  std::string pointer_;
};

template <typename Records>
void RequireFramesOf(const Sequence& sequence, const std::filesystem::path& file,
                     const Records& records, const char* what) {
  const bool equal = sequence.synthetic;
  // Of a recording a record or two may stand alone; if all do, it is another recording.
  const auto has_frame = [&, stamps_s = StampsOf(sequence.frames)](const auto& record) {
    return FindFrame(stamps_s, record.stamp_s, equal).has_value();
  };
  const auto stray = std::find_if_not(records.begin(), records.end(), has_frame);
  if (stray == records.end()) return;
  if (!equal && std::any_of(records.begin(), records.end(), has_frame)) return;
  throw io::InputError(
      io::Where(file, stray->line),
      fmt::format("{} at {:.6f} s belongs to no frame of {}; score a run against the "
                  "sequence it was made from",
                  what, stray->stamp_s, sequence.folder.string()));
}

}  // namespace

void RequireRunOf(const Sequence& sequence, const Run& run) {
  RequireFramesOf(sequence, run.folder / "trajectory.txt", run.trajectory, "the pose");
  RequireFramesOf(sequence, run.folder / "frame_planes.jsonl", run.frames,
                  "the line of planes");
}

void TellRunDisagreements(Folder& folder, const Run& run) {
  if (folder.Has("trajectory.txt")) {
    TellOtherCount(folder, "trajectory.txt", run.trajectory.size(), "poses", run.info.tracked,
                   "tracked frame");
  }
  if (run.keyframes) {
    TellOtherTimes(folder, "keyframes.txt", *run.keyframes, StampsOf(run.trajectory),
                   "trajectory.txt", Severity::kFlaw);
  }
  if (run.covariances) {
    TellOtherTimes(folder, "trajectory_covariance.txt", *run.covariances,
                   StampsOf(run.trajectory), "trajectory.txt", Severity::kWarning);
    TellOtherTimes(folder, "trajectory.txt", run.trajectory, StampsOf(*run.covariances),
                   "trajectory_covariance.txt", Severity::kWarning);
  }
  if (!run.has_planes) return;
  TellOtherTimes(folder, "trajectory.txt", run.trajectory, StampsOf(run.frames),
                 "frame_planes.jsonl", Severity::kWarning);
  TellOtherCount(folder, "frame_planes.jsonl", run.frames.size(), "frames", run.info.frames,
                 "frame");
  DecisionCheck decisions(folder, run);
  for (const RunFrame& frame : run.frames) decisions.Frame(frame);
}

}  // namespace eval
