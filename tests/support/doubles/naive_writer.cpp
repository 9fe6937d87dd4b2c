// How a sequence is not to be written: each file in place, and what exists counts as done.
//   naive_writer FROM TO    copies a sequence file by file, manifest.json last
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

bool WriteInPlace(const fs::path& path, const std::string& bytes) {
  constexpr std::size_t kChunk = 4096;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return false;
  bool good = true;
  for (std::size_t at = 0; good && at < bytes.size(); at += kChunk) {
    const std::size_t count = std::min(kChunk, bytes.size() - at);
    good = ::write(file, bytes.data() + at, count) == static_cast<ssize_t>(count);
  }
  return ::close(file) == 0 && good;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const fs::path from = argv[1], to = argv[2];
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), from));
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(a == "manifest.json", a) < std::pair(b == "manifest.json", b);
  });
  for (const fs::path& file : files) {
    if (fs::exists(to / file)) continue;
    std::ifstream stream(from / file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    fs::create_directories((to / file).parent_path());
    if (!WriteInPlace(to / file, bytes)) return 1;
  }
  return 0;
}
