#pragma once

#include <map>
#include <optional>
#include <string>

#include "io/atomic_file.h"
#include "sim/write/write_sequence.h"
#include "slam/run/run_sequence.h"

namespace app {

/// A frame's truth as a sequence holds it.
struct TruthRecord {
  std::string line;                 ///< of gt/frames.jsonl
  std::string plane_id, object_id;  ///< bytes of the two PNG files
};
TruthRecord EncodeTruth(double timestamp_s, const sim::SimulatedFrame& frame);

/// Writes the sequence of a live recording without its images: lists, camera, poses,
/// detections, all of gt/, and a manifest that says `images: false`. `pas eval` scores a run
/// with it. It holds the frames that were added, so that a run that was interrupted has the
/// truth of what it ran on. Memory: two checksums a frame.
class TruthFolder : public slam::LiveTruth {
 public:
  /// @param planes  all of the scene
  /// @param recording  must outlive this object
  TruthFolder(sim::Scene scene, std::vector<sim::ScenePlane> planes,
              const sim::Recording& recording, sim::SequenceOptions options);

  void Begin(const std::filesystem::path& folder) override;
  /// The next frame. @param detections  line of detections.jsonl
  /// @throws InputError when it cannot be written
  void Add(const TruthRecord& record, const std::string& detections);
  void Finish() override;

 private:
  void Write(const std::string& file, const std::string& bytes);

  sim::Scene scene_;
  std::vector<sim::ScenePlane> planes_;
  const sim::Recording& recording_;
  sim::SequenceOptions options_;

  std::filesystem::path folder_;
  std::optional<io::AtomicFile> frames_, detections_;
  std::map<std::string, std::string> sums_;  ///< sha256 by file
  int count_ = 0;                            ///< frames that were added
};

}  // namespace app
