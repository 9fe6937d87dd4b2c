#include "eval/export/coco.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "eval/export/coco_classes.h"
#include "eval/export/run_lengths.h"
#include "io/output_folder.h"

namespace eval {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool Wanted(const TruthObject& object, const ExportOptions& options) {
  return options.structure || object.role != Role::kStructure;
}

/// Category id of each class that occurs.
std::map<std::string, int> Categories(const std::vector<Sequence>& sequences,
                                      const ExportOptions& options) {
  std::map<std::string, int> id_of;
  for (const Sequence& sequence : sequences) {
    for (const TruthObject& object : sequence.scene->objects) {
      if (Wanted(object, options)) id_of[object.object_class] = 0;
    }
  }
  int next = kFirstOwnCategory;
  for (auto& [name, id] : id_of) {
    const CocoClass* known = FindCocoClass(name);
    id = known != nullptr ? known->id : next++;
  }
  return id_of;
}

Json CategoryList(const std::map<std::string, int>& id_of) {
  std::map<int, Json> by_id;
  for (const auto& [name, id] : id_of) {
    const CocoClass* known = FindCocoClass(name);
    by_id[id] = {{"id", id},
                 {"name", name},
                 {"supercategory", known != nullptr ? known->supercategory : "tabletop"}};
  }
  Json list = Json::array();
  for (const auto& [id, category] : by_id) list.push_back(category);
  return list;
}

/// The instance that each object belongs to: the first object of its group.
std::map<int, int> Instances(const SceneTruth& scene, const ExportOptions& options) {
  std::map<int, int> instance_of, first_of_group;
  for (const TruthObject& object : scene.objects) {
    if (!Wanted(object, options)) continue;
    instance_of[object.id] =
        object.detection_group > 0
            ? first_of_group.try_emplace(object.detection_group, object.id).first->second
            : object.id;
  }
  return instance_of;
}

class CocoWriter {
 public:
  CocoWriter(const io::OutputFolder& folder, std::map<std::string, int> categories)
      : folder_(folder), categories_(std::move(categories)) {}

  void AddFrame(const Sequence& sequence, std::size_t number, const SequenceFrame& frame,
                const std::map<int, int>& instance_of) {
    const std::string name =
        fmt::format("{:06}/{}", number, fs::path(frame.rgb).filename().string());
    folder_.Write("images/" + name, ReadColourBytes(sequence, frame.rgb));
    const int image_id = static_cast<int>(images_.size()) + 1;
    images_.push_back({{"id", image_id},
                       {"width", sequence.camera->width},
                       {"height", sequence.camera->height},
                       {"file_name", name},
                       {"license", 1}});
    const cv::Mat1w ids = ReadCheckedObjectIds(sequence, frame.stamp_s);
    std::map<int, PixelSet> seen;
    for (int v = 0; v < ids.rows; ++v) {
      for (int u = 0; u < ids.cols; ++u) {
        const auto instance = instance_of.find(ids(v, u));
        if (instance != instance_of.end()) seen[instance->second].Add(u, v);
      }
    }
    for (const auto& [instance, pixels] : seen) {
      AddInstance(image_id, *sequence.scene->FindObject(instance), pixels, ids, instance_of);
    }
  }

  /// instances.json, and how much is in it.
  void Finish(const ExportOptions& options) const {
    Json root;
    root["info"] = {{"year", 2026},
                    {"version", "1.0"},
                    {"description", "Simulated tabletop scenes, exact masks"},
                    {"contributor", "pas " + options.version},
                    {"url", ""},
                    {"date_created", ""}};
    root["licenses"] = {{{"id", 1}, {"name", "none stated"}, {"url", ""}}};
    root["images"] = images_;
    root["annotations"] = annotations_;
    root["categories"] = CategoryList(categories_);
    folder_.Write("annotations/instances.json", root.dump() + "\n");
  }
  ExportSummary Summary() const {
    return {.images = static_cast<int>(images_.size()),
            .instances = static_cast<int>(annotations_.size()),
            .kinds = static_cast<int>(categories_.size())};
  }

 private:
  void AddInstance(int image_id, const TruthObject& object, const PixelSet& pixels,
                   const cv::Mat1w& ids, const std::map<int, int>& instance_of) {
    cv::Mat1b mask(ids.size(), uchar{0});
    for (int v = pixels.y0; v <= pixels.y1; ++v) {
      for (int u = pixels.x0; u <= pixels.x1; ++u) {
        const auto instance = instance_of.find(ids(v, u));
        if (instance != instance_of.end() && instance->second == object.id) mask(v, u) = 1;
      }
    }
    annotations_.push_back(
        {{"id", static_cast<int>(annotations_.size()) + 1},
         {"image_id", image_id},
         {"category_id", categories_.at(object.object_class)},
         {"segmentation",
          {{"size", {mask.rows, mask.cols}}, {"counts", CompressRunLengths(RunLengths(mask))}}},
         {"area", pixels.count},
         {"bbox", {pixels.x0, pixels.y0, pixels.x1 - pixels.x0 + 1, pixels.y1 - pixels.y0 + 1}},
         {"iscrowd", 0}});
  }

  const io::OutputFolder& folder_;
  std::map<std::string, int> categories_;
  Json images_ = Json::array(), annotations_ = Json::array();
};

}  // namespace

ExportSummary ExportCoco(const std::vector<fs::path>& folders, const fs::path& output,
                         const ExportOptions& options) {
  io::OutputFolder folder(output, kExportMarker, options.force);  // refused before the work
  std::vector<Sequence> sequences;
  std::size_t total = 0;
  for (const fs::path& sequence : folders) {
    sequences.push_back(ReadExportable(sequence, options));
    total += sequences.back().frames.size();
  }
  CocoWriter writer(folder, Categories(sequences, options));
  int done = 0;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    const std::map<int, int> instance_of = Instances(*sequences[i].scene, options);
    for (const SequenceFrame& frame : sequences[i].frames) {
      writer.AddFrame(sequences[i], i, frame, instance_of);
      if (options.progress) options.progress(++done, static_cast<int>(total));
    }
  }
  writer.Finish(options);
  CommitExport(folder, "coco");
  return writer.Summary();
}

}  // namespace eval
