// Writes an output folder as the program does: a process of its own, so that it can be killed.
//   folder_writer FOLDER VALUE    three files that hold VALUE, over an older folder of its kind
#include <cstdio>
#include <exception>
#include <string>

#include "io/atomic_file.h"
#include "io/output_folder.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string value = argv[2];
  try {
    io::OutputFolder folder(argv[1], "marker.json", true);
    io::AtomicFile lines(folder.Path("lines.txt"));
    for (int i = 0; i < 4; ++i) lines.Add(std::string(200000, 'x') + value + "\n");
    folder.Write("deep/down.txt", value);
    lines.Finish();
    folder.Write("marker.json", value);
    folder.Commit();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
