#include "app/live/truth_folder.h"

#include <filesystem>
#include <utility>

#include "io/image/encode_png.h"
#include "io/sha256.h"
#include "sim/truth/truth_json.h"
#include "sim/write/sequence_text.h"

namespace app {

TruthRecord EncodeTruth(double timestamp_s, const sim::SimulatedFrame& frame) {
  return {sim::FrameTruthJson(timestamp_s, frame.truth), io::EncodePng(frame.plane_id),
          io::EncodePng(frame.object_id)};
}

TruthFolder::TruthFolder(sim::Scene scene, std::vector<sim::ScenePlane> planes,
                         const sim::Recording& recording, sim::SequenceOptions options)
    : scene_(std::move(scene)),
      planes_(std::move(planes)),
      recording_(recording),
      options_(std::move(options)) {}

void TruthFolder::Begin(const std::filesystem::path& folder) {
  folder_ = folder;
  for (const char* name : {"gt/plane_id", "gt/object_id"}) {
    std::error_code error;
    std::filesystem::create_directories(folder_ / name, error);
    if (error) io::FailToWrite(folder_ / name, error);
  }
  frames_.emplace(folder_ / "gt/frames.jsonl");
  if (options_.rig.detector != sim::DetectorKind::kNone) {
    detections_.emplace(folder_ / "detections.jsonl");
  }
}

void TruthFolder::Add(const TruthRecord& record, const std::string& detections) {
  const sim::Shot& shot = recording_.shots[static_cast<std::size_t>(count_++)];
  const std::string name = sim::TimeText(shot.colour_stamp_s) + ".png";
  Write("gt/plane_id/" + name, record.plane_id);
  Write("gt/object_id/" + name, record.object_id);
  frames_->Add(record.line + "\n");
  if (detections_) detections_->Add(detections + "\n");
}

void TruthFolder::Finish() {
  frames_->Finish();
  sums_["gt/frames.jsonl"] = io::Sha256OfFile(folder_ / "gt/frames.jsonl");
  if (detections_) {
    detections_->Finish();
    sums_["detections.jsonl"] = io::Sha256OfFile(folder_ / "detections.jsonl");
  }
  // The lists name the frames that were run.
  sim::Recording run;
  run.shots.assign(recording_.shots.begin(), recording_.shots.begin() + count_);
  run.scenes_own = recording_.scenes_own;
  const auto fixed = sim::FixedFiles(scene_, planes_, options_.rig, run.shots);
  for (const auto& [file, text] : fixed) Write(file, text);
  nlohmann::ordered_json manifest = sim::PlannedManifest(scene_, run, options_, fixed);
  manifest["images"] = false;
  manifest["sha256"] = sums_;
  manifest["complete"] = true;
  sim::WriteManifest(folder_, manifest);
}

void TruthFolder::Write(const std::string& file, const std::string& bytes) {
  io::WriteFile(folder_ / file, bytes);
  sums_[file] = io::Sha256Hex(bytes);
}

}  // namespace app
