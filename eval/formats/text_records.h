#pragma once

#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "io/text_table.h"

namespace eval {

/// Records of a text file, split at blanks, without blank lines and `#` comments. A file that
/// cannot be read is a fault and has no records.
std::vector<io::TextRecord> ReadTextRecords(Folder& folder, const std::string& file,
                                            Severity severity = Severity::kFatal);
/// The same, split at commas.
std::vector<io::TextRecord> ReadCommaRecords(Folder& folder, const std::string& file);

/// The record as messages quote it.
std::string TextOf(const io::TextRecord& record);

}  // namespace eval
