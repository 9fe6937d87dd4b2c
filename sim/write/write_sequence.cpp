#include "sim/write/write_sequence.h"

#include <fmt/format.h>

#include <optional>

#include "io/atomic_file.h"
#include "io/folder_lock.h"
#include "io/image/encode_png.h"
#include "io/json_field.h"
#include "io/read_file.h"
#include "io/sha256.h"
#include "sim/motion/preset.h"
#include "sim/scene/write_scene.h"
#include "sim/truth/truth_json.h"
#include "sim/write/parallel_frames.h"
#include "sim/write/sequence_text.h"

namespace sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Holds one record a finished frame until the sequence is complete.
constexpr const char* kRecordFolder = ".frames";

const char* Name(DetectorKind detector) {
  switch (detector) {
    case DetectorKind::kPerfect:
      return "perfect";
    case DetectorKind::kNoisy:
      return "noisy";
    case DetectorKind::kPoor:
      return "poor";
    case DetectorKind::kNone:
      break;
  }
  return "none";
}

Json CameraJson(const Camera& camera) {
  Json json{{"width", camera.width}, {"height", camera.height}, {"fx", camera.fx},
            {"fy", camera.fy},       {"cx", camera.cx},         {"cy", camera.cy}};
  const Lens& lens = camera.lens;
  if (!lens.IsNone()) json["distortion"] = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  json["fps"] = camera.fps;
  return json;
}

/// The manifest as it is before the first frame.
Json Plan(const Scene& scene, const SequenceOptions& options, std::size_t frames,
          const std::map<std::string, std::string>& fixed) {
  Json plan;
  plan["format"] = "pas-sequence/1";
  plan["generator"] = "pas sim";
  plan["version"] = options.version;
  plan["scene"] = scene.name;
  plan["scene_hash"] = SceneHash(scene);
  plan["seed"] = options.rig.seed;
  plan["camera"] = CameraJson(options.rig.CameraAsTold());
  if (!options.motion.empty()) plan["motion"] = options.motion;
  plan["sensor"] = options.rig.sensor.name;
  if (options.rig.sensor.name != options.rig.sensor.base) {
    plan["sensor_base"] = options.rig.sensor.base;
  }
  if (!options.rig.sensor.changed.empty()) {
    plan["sensor_parameters"] = options.rig.sensor.changed;
  }
  const Exposure& exposure = options.rig.sensor.exposure;
  if (!exposure.IsPlain()) {
    plan["exposure"] = {{"shutter_s", exposure.shutter_s},
                        {"shutter_samples", exposure.shutter_samples},
                        {"rolling_s", exposure.rolling_s},
                        {"drift_stops", exposure.drift_stops}};
  }
  const TimingDefects& timing = options.rig.sensor.timing;
  if (!timing.IsNone()) {
    plan["timing"] = {{"drop_ratio", timing.drop_ratio},
                      {"repeat_ratio", timing.repeat_ratio},
                      {"depth_offset_s", timing.depth_offset_s},
                      {"stamp_jitter_s", timing.stamp_jitter_s}};
  }
  const CalibrationError& calibration = options.rig.sensor.calibration;
  if (calibration.registration_px != 0 || calibration.intrinsics != 0) {
    plan["calibration_error"] = {{"registration_px", calibration.registration_px},
                                 {"intrinsics", calibration.intrinsics}};
  }
  plan["detector"] = Name(options.rig.detector);
  plan["frame_count"] = frames;
  plan["complete"] = false;
  plan["sha256"] = Json::object();
  for (const auto& [path, text] : fixed) plan["sha256"][path] = io::Sha256Hex(text);
  return plan;
}

/// Writes frames one by one; a frame counts once its record is written, after its images.
class FrameStore {
 public:
  FrameStore(fs::path folder, const Simulator& simulator, const Recording& recording)
      : folder_(std::move(folder)), simulator_(simulator), recording_(recording) {
    fs::create_directories(folder_ / kRecordFolder);
  }

  void Make(int frame) const {
    const Shot& shot = recording_.shots[static_cast<std::size_t>(frame)];
    const SimulatedFrame made = Record(simulator_, recording_, frame);
    const double t = PrintedTime(shot.colour_stamp_s);
    Json record;
    record["truth"] = FrameTruthJson(t, made.truth);
    record["detections"] = DetectionsJson(t, made.detections);
    const std::string name = TimeText(shot.colour_stamp_s) + ".png";
    const std::string depth_name = TimeText(shot.depth_stamp_s) + ".png";
    const std::initializer_list<std::pair<std::string, const cv::Mat*>> images{
        {"rgb/" + name, &made.colour},
        {"depth/" + depth_name, &made.depth},
        {"gt/plane_id/" + name, &made.plane_id},
        {"gt/object_id/" + name, &made.object_id}};
    for (const auto& [file, image] : images) {
      const std::string bytes = io::EncodePng(*image);
      io::WriteFile(folder_ / file, bytes);
      record["sha256"][file] = io::Sha256Hex(bytes);
    }
    io::WriteFile(RecordPath(frame), record.dump());
  }

  /// True when the frame's record and the images it names are there, bit for bit.
  bool Made(int frame) const {
    if (!fs::exists(RecordPath(frame))) return false;
    const Json record = Json::parse(io::ReadFile(RecordPath(frame)), nullptr, false);
    for (const char* key : {"truth", "detections", "sha256"}) {
      if (!record.contains(key)) return false;
    }
    for (const auto& [file, sum] : record.at("sha256").items()) {
      if (!fs::exists(folder_ / file) || io::Sha256OfFile(folder_ / file) != sum) return false;
    }
    return true;
  }

  std::vector<int> Missing() const {
    std::vector<int> missing;
    for (int frame = 0; frame < recording_.frames(); ++frame) {
      if (!Made(frame)) missing.push_back(frame);
    }
    return missing;
  }

  /// Gathers the records into the two line files and the manifest, which says complete.
  /// Holds one record at a time.
  void Finish(Json manifest) const {
    std::map<std::string, std::string> sums;
    for (const auto& [file, sum] : manifest["sha256"].items()) sums[file] = sum;
    io::AtomicFile truth(folder_ / "gt/frames.jsonl");
    std::optional<io::AtomicFile> detections;
    if (simulator_.options().detector != DetectorKind::kNone) {
      detections.emplace(folder_ / "detections.jsonl");
    }
    for (int frame = 0; frame < recording_.frames(); ++frame) {
      const nlohmann::json json = io::ReadJson(RecordPath(frame));
      const io::JsonField record(json, RecordPath(frame).string());
      truth.Add(record["truth"].Text() + "\n");
      if (detections) detections->Add(record["detections"].Text() + "\n");
      for (const auto& [file, sum] : json.at("sha256").items()) sums[file] = sum;
    }
    truth.Finish();
    sums["gt/frames.jsonl"] = io::Sha256OfFile(folder_ / "gt/frames.jsonl");
    if (detections) {
      detections->Finish();
      sums["detections.jsonl"] = io::Sha256OfFile(folder_ / "detections.jsonl");
    }
    manifest["sha256"] = sums;
    manifest["complete"] = true;
    fs::remove_all(folder_ / kRecordFolder);
    WriteManifest(folder_, manifest);
  }

 private:
  fs::path RecordPath(int frame) const {
    return folder_ / kRecordFolder / fmt::format("{:06}.json", frame);
  }

  fs::path folder_;
  const Simulator& simulator_;
  const Recording& recording_;
};

}  // namespace

Json PlannedManifest(const Scene& scene, const Recording& recording,
                     const SequenceOptions& options,
                     const std::map<std::string, std::string>& fixed) {
  SequenceOptions told = options;
  if (recording.scenes_own) {
    const MotionPreset preset = PresetOf(scene.motion);
    told.motion = {{"preset", scene.motion.preset},
                   {"speed_m_s", fmt::format("{}", preset.speed_m_s)},
                   {"turn_deg_s", fmt::format("{}", preset.turn_deg_s)}};
  }
  return Plan(scene, told, recording.shots.size(), fixed);
}

int WriteSequence(const Scene& scene, const Recording& recording,
                  const SequenceOptions& options, const fs::path& folder) {
  const Simulator simulator(scene, options.rig);
  const auto fixed = FixedFiles(scene, simulator.planes(), options.rig, recording.shots);
  const Json plan = PlannedManifest(scene, recording, options, fixed);
  const io::FolderLock lock(folder);
  if (PrepareFolder(folder, plan, options.existing)) return 0;

  for (const auto& [path, text] : fixed) io::WriteFile(folder / path, text);
  const FrameStore store(folder, simulator, recording);
  const std::vector<int> missing = store.Missing();
  ForEachFrame(
      missing, options.threads, [&](int frame) { store.Make(frame); }, options.progress);
  store.Finish(plan);
  return static_cast<int>(missing.size());
}

int WriteSequence(const Scene& scene, const std::vector<TimedPose>& trajectory,
                  const SequenceOptions& options, const fs::path& folder) {
  return WriteSequence(scene, PlanRecording(trajectory, options.path, options.rig), options,
                       folder);
}

int WriteSequence(const Scene& scene, const SequenceOptions& options, const fs::path& folder) {
  return WriteSequence(scene, PlanRecording(scene, options.rig, options.frames), options,
                       folder);
}

}  // namespace sim
