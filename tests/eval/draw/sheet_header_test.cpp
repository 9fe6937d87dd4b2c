#include "eval/draw/sheet_header.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

TEST(SheetHeader, HasRoomForItsNoteWhateverElseItShows) {
  RunFrame frame;
  eval::Run run;
  run.frames = {frame};
  for (const bool with_legend : {true, false}) {
    SheetHeader header = HeaderOf({"run", "seq", "", ""}, run, 1000);
    EXPECT_EQ(header.note, kNoSegmentationNote);
    if (!with_legend) header.legend.clear();
    const double with_note = HeightOf(header);
    header.note.clear();
    EXPECT_GE(with_note - HeightOf(header), 16) << with_legend;
  }
}

}  // namespace
}  // namespace eval
