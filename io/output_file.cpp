#include "io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/number_text.h"
#include "io/path_type.h"

namespace io {
namespace {

namespace fs = std::filesystem;

/// The descriptor of this process that a path names: /dev/stdout, /dev/fd/3 ...
std::optional<int> DescriptorOf(const fs::path& path) {
  if (path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  const fs::path folder = path.parent_path();
  if (folder != "/dev/fd" && folder != "/proc/self/fd") return std::nullopt;
  const auto number = ParseNumber(path.filename().string());
  if (!number || *number < 0 || *number > 1e6) return std::nullopt;
  return static_cast<int>(*number);
}

bool IsStream(const fs::path& path, fs::file_type type) {
  return type == fs::file_type::character || type == fs::file_type::fifo || DescriptorOf(path);
}

/// Whether `path` is `folder` or lies in it, links resolved.
bool LiesIn(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path inner = fs::weakly_canonical(path, error);
  if (error) return false;
  fs::path outer = fs::weakly_canonical(folder, error);
  if (error) return false;
  if (outer.filename().empty()) outer = outer.parent_path();  // it ended with a slash
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first ==
         outer.end();
}

}  // namespace

OutputFile::OutputFile(fs::path path, OutputRules rules)
    : path_(std::move(path)), rules_(std::move(rules)) {
  if (path_.filename().empty()) {
    throw InputError("output file `" + path_.string() + "`", "expected the name of a file");
  }
  const fs::file_type type = TypeAt(path_);
  if (IsStream(path_, type)) {
    OpenStream(type);
  } else {
    RequirePlace();
  }
}

OutputFile::~OutputFile() {
  if (stream_ >= 0) ::close(stream_);
}

void OutputFile::OpenStream(fs::file_type type) {
  const std::optional<int> descriptor = DescriptorOf(path_);
  // A pipe that nobody reads would wait for ever.
  stream_ = descriptor ? ::fcntl(*descriptor, F_DUPFD_CLOEXEC, 0)
                       : ::open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (stream_ < 0 && errno == ENXIO && type == fs::file_type::fifo) {
    throw InputError(path_.string(), "is a pipe that nobody reads; start its reader first");
  }
  if (stream_ < 0) FailToWrite(path_, {errno, std::generic_category()});
  if (!descriptor) ::fcntl(stream_, F_SETFL, O_WRONLY);
}

void OutputFile::RefuseInput() const {
  for (const fs::path& input : rules_.inputs) {
    std::error_code ignored;
    const bool folder = fs::is_directory(input, ignored);
    const bool own = folder && path_.filename() == rules_.own_name &&
                     fs::equivalent(fs::absolute(path_).parent_path(), input, ignored);
    if (own || !(folder ? LiesIn(path_, input) : fs::equivalent(path_, input, ignored))) {
      continue;
    }
    throw InputError(path_.string(),
                     (folder ? "is in " + input.string() + ", which is read by this command"
                             : std::string("is read by this command")) +
                         ", so even --force does not replace it; choose another name");
  }
}

void OutputFile::RefuseWhatIsThere() const {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path_, error).type();
  if (type == fs::file_type::regular) {
    RefuseInput();
    if (!rules_.force) {
      throw InputError(path_.string(), "exists already; choose another name or add --force");
    }
  } else if (type != fs::file_type::not_found) {
    throw InputError(path_.string(), std::string("is ") + NameOf(type) +
                                         ", which is never replaced; name a file itself");
  }
}

void OutputFile::RequirePlace() const {
  RefuseWhatIsThere();
  const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
  if (TypeAt(folder) != fs::file_type::directory) {
    throw InputError(path_.string(), "cannot be written: there is no folder " +
                                         folder.string() + "; make it or choose another place");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    FailToWrite(path_, {errno, std::generic_category()});
  }
  std::error_code error;
  const fs::path unfinished = path_.string() + kUnfinishedSuffix;
  if (!rules_.force && fs::exists(fs::symlink_status(unfinished, error))) {
    throw InputError(unfinished.string(), "is in the way; remove it or add --force");
  }
}

void OutputFile::WriteTogether(const std::vector<Content>& contents) {
  std::vector<std::unique_ptr<AtomicFile>> files;  // each is locked until all are in place
  for (const auto& [output, bytes] : contents) {
    if (output->stream_ >= 0) continue;
    output->RequirePlace();  // something may have appeared meanwhile
    files.push_back(std::make_unique<AtomicFile>(output->path_));
    output->RefuseWhatIsThere();  // nobody else can put a file there now
    files.back()->Add(bytes);
  }
  for (const auto& file : files) file->Finish();
  std::fflush(stdout);  // what was printed before comes before
  for (const auto& [output, bytes] : contents) {
    if (output->stream_ >= 0) WriteAll(output->stream_, bytes, output->path_);
  }
}

void RefuseSameFile(const std::vector<fs::path>& outputs) {
  std::set<fs::path> places;
  for (const fs::path& output : outputs) {
    if (output.empty() || IsStream(output, TypeAt(output))) continue;
    std::error_code error;
    const fs::path place = fs::weakly_canonical(fs::absolute(output), error);
    if (error || places.insert(place).second) continue;
    throw InputError(output.string(),
                     "would hold two outputs of this command; choose another name for one");
  }
}

void RefuseInputsInside(const fs::path& folder, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs) {
    if (input.empty() || !LiesIn(input, folder)) continue;
    throw InputError(folder.string(), "cannot be replaced: " + input.string() +
                                          " is in it, which is read by this command; choose "
                                          "another folder");
  }
}

}  // namespace io
