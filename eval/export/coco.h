#pragma once

#include <filesystem>
#include <vector>

#include "eval/export/exportable.h"

namespace eval {

/// Writes sequences as one COCO instance data set:
///   annotations/instances.json   info, licenses, images, annotations, categories
///   images/SEQUENCE/T.png        the colour images as they are; SEQUENCE counts from 000000
/// An annotation is what is visible of an object (objects of one detection_group are one): its
/// pixels as compressed run lengths, their number, and the box [x, y, width, height] of whole
/// pixels. Ids count from 1. Categories keep COCO's ids; classes that COCO does not have get
/// ids from 101 on, by name. Structure is left out unless asked for.
/// Source: cocodataset.org/#format-data, and the run lengths of its API.
/// @throws InputError, see ReadExportable, ReadCheckedObjectIds, io::OutputFolder
ExportSummary ExportCoco(const std::vector<std::filesystem::path>& sequences,
                         const std::filesystem::path& output, const ExportOptions& options);

}  // namespace eval
