#include "app/console/failure.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <opencv2/core.hpp>
#include <system_error>

#include "io/input_error.h"

namespace app {
namespace {

constexpr const char* kOutput = "standard output";
constexpr const char* kReport = "; please report it with the command that was run";

}  // namespace

std::string Words(const std::exception& error) {
  if (dynamic_cast<const io::InputError*>(&error) != nullptr) return error.what();
  const auto* of_opencv = dynamic_cast<const cv::Exception*>(&error);
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
      (of_opencv != nullptr && of_opencv->code == cv::Error::StsNoMem)) {
    return "out of memory; close other programs, or ask for smaller images or fewer frames";
  }
  if (const auto* files = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    return files->path1().string() + ": " + files->code().message() +
           "; mend the path or its permissions";
  }
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    const std::string where = std::ferror(stdout) != 0 ? kOutput : "the system";
    return where + ": " + system->code().message() + "; free what is lacking and try again";
  }
  // Of OpenCV's text, which names its own source files, only what went wrong.
  const std::string text = of_opencv != nullptr ? of_opencv->err : error.what();
  return "internal error: " + text + kReport;
}

void KeepStandardStreams() {
  // The lowest free one is taken first. Opened the wrong way round: using it is still an error.
  if (::fcntl(STDIN_FILENO, F_GETFD) < 0) ::open("/dev/null", O_WRONLY);
  if (::fcntl(STDOUT_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  if (::fcntl(STDERR_FILENO, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
}

void FinishOutput() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw io::InputError(kOutput,
                       "cannot be written; the disk may be full, send it to another place");
}

}  // namespace app
