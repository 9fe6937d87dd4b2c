#pragma once

#include <filesystem>
#include <vector>

#include "eval/export/exportable.h"

namespace eval {

/// Writes sequences as one data set in BOP's scene-wise format:
///   camera.json, dataset_info.md, models/obj_ID.ply, models/models_info.json, and a scene per
///   sequence: train/SCENE/{rgb,depth}/IM.png, {mask,mask_visib}/IM_GT.png, scene_camera.json,
///   scene_gt.json, scene_gt_info.json
/// Millimetres; depth images as they are, with depth_scale = 1000 / depth_factor. Annotated are
/// the visible objects whose shape the truth tells: boxes. Masks are exact: the visible part is
/// the id image's, the silhouette is the pixels whose rays meet the box; no tolerance of depth.
/// px_count_all counts the silhouette beyond the image border too; boxes of pixels are [x, y,
/// last x - x, last y - y], both as bop_toolkit's calc_gt_info.py has them.
/// Source: bop_toolkit, docs/bop_datasets_format.md.
/// @throws InputError, see ReadExportable, ReadCheckedObjectIds, FramePoses, io::OutputFolder;
///   for a camera with distortion, which the format cannot say
ExportSummary ExportBop(const std::vector<std::filesystem::path>& sequences,
                        const std::filesystem::path& output, const ExportOptions& options);

}  // namespace eval
