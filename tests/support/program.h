#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/file_contents.h"
#include "tests/support/temporary_folder.h"

/// Runs the project's own program and other executables as processes.
namespace program {

namespace fs = std::filesystem;
using Environment = std::map<std::string, std::string>;

inline fs::path Pas() { return fs::path(PAS_BINARY_DIR) / "pas"; }

using test_support::Contents;
using test_support::ReadText;
using test_support::TemporaryFolder;

struct Outcome {
  int exit_code = -1;  ///< -1 when a signal ended it
  int signal = 0;
  std::string errors;  ///< what it wrote to its error output
  double peak_mb = 0;  ///< the most memory it had at a time, 2^20 bytes
};

/// A process that has been started.
class Process {
 public:
  /// `changes` are set over this process's own environment.
  Process(const std::vector<std::string>& command, const Environment& changes,
          const fs::path& errors)
      : errors_(errors) {
    std::vector<std::string> settings;
    for (char** at = environ; *at != nullptr; ++at) {
      const std::string setting = *at;
      if (changes.count(setting.substr(0, setting.find('='))) == 0) settings.push_back(setting);
    }
    for (const auto& [name, value] : changes) settings.push_back(name + "=" + value);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors_.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    // Whatever this process ignores, as those in the background of a shell do.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawn(&id_, command[0].c_str(), &files, &attributes,
                                  Pointers(command).data(), Pointers(settings).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw std::runtime_error(command[0] + " cannot be started");
  }
  void Kill() const { Send(SIGKILL); }
  void Send(int signal) const { kill(id_, signal); }
  Outcome Wait() const {
    int status = 0;
    rusage usage{};
    wait4(id_, &status, 0, &usage);
    Outcome outcome;
    outcome.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.errors = ReadText(errors_);
    return outcome;
  }

 private:
  static std::vector<char*> Pointers(const std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
    pointers.push_back(nullptr);
    return pointers;
  }
  fs::path errors_;
  pid_t id_ = 0;
};

}  // namespace program
