// Preloaded into a program under test (LD_PRELOAD): counts what it does to files and, at the
// operation that the environment names, kills it or lets the disk be full from then on.
//   PAS_INTERRUPT_FOLDER  only files whose path holds this text count
//   PAS_INTERRUPT_KILL    SIGKILL at this operation, from 1; a write is torn in the middle
//   PAS_INTERRUPT_ERROR   this errno for everything that would take space, from
//   PAS_INTERRUPT_FROM    this operation on
//   PAS_INTERRUPT_DELAY   microseconds that an operation is held up at most, at random
//   PAS_INTERRUPT_COUNT   file to write the number of operations to when the program ends
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<long> operations{0};
std::array<std::atomic<bool>, 4096> watched{};  // by file descriptor

long Setting(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::atol(text) : 0;
}

template <typename Function>
Function Real(const char* name, Function) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool Counts(const char* path) {
  static const char* const folder = std::getenv("PAS_INTERRUPT_FOLDER");
  return folder != nullptr && path != nullptr && std::strstr(path, folder) != nullptr;
}

/// Counts one operation, before it is done; does not come back when it is the last of this
/// process, or after it. `last_act` is done before the kill.
template <typename Act>
void Happen(Act last_act) {
  static const long last = Setting("PAS_INTERRUPT_KILL");
  static const long delay_us = Setting("PAS_INTERRUPT_DELAY");
  if (delay_us > 0) usleep(static_cast<useconds_t>(std::rand() % delay_us));
  const long operation = ++operations;
  if (last == 0 || operation < last) return;
  if (operation == last) {
    last_act();
    kill(getpid(), SIGKILL);
  }
  // The kill takes a moment to reach the other threads: they must do nothing meanwhile.
  for (;;) pause();
}
void Happen() {
  Happen([] {});
}

/// Whether the disk is full by now; sets errno.
bool Fails() {
  static const long error = Setting("PAS_INTERRUPT_ERROR");
  static const long from = Setting("PAS_INTERRUPT_FROM");
  if (error == 0 || operations < from) return false;
  errno = static_cast<int>(error);
  return true;
}

void Watch(int file, bool on) {
  if (file >= 0 && file < static_cast<int>(watched.size())) {
    watched[static_cast<std::size_t>(file)] = on;
  }
}
bool IsWatched(int file) {
  return file >= 0 && file < static_cast<int>(watched.size()) &&
         watched[static_cast<std::size_t>(file)];
}

template <typename Function>
int Open(Function real, const char* path, int flags, mode_t mode) {
  if ((flags & O_ACCMODE) == O_RDONLY || !Counts(path)) return real(path, flags, mode);
  Happen();
  if ((flags & O_CREAT) != 0 && Fails()) return -1;
  const int file = real(path, flags, mode);
  Watch(file, true);
  return file;
}

template <typename Function>
FILE* OpenStream(Function real, const char* path, const char* mode) {
  if (mode[0] == 'r' || !Counts(path)) return real(path, mode);
  Happen();
  if (Fails()) return nullptr;
  FILE* const stream = real(path, mode);
  if (stream != nullptr) Watch(fileno(stream), true);
  return stream;
}

mode_t ModeOf(int flags, va_list list) {
  return (flags & O_CREAT) != 0 ? va_arg(list, mode_t) : 0;
}

void Report() __attribute__((destructor));
void Report() {
  const char* path = std::getenv("PAS_INTERRUPT_COUNT");
  if (path == nullptr) return;
  if (FILE* file = Real("fopen", &fopen)(path, "w")) {
    std::fprintf(file, "%ld\n", operations.load());
    std::fclose(file);
  }
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = ModeOf(flags, list);
  va_end(list);
  return Open(Real("open", &open), path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = ModeOf(flags, list);
  va_end(list);
  return Open(Real("open64", &open64), path, flags, mode);
}
FILE* fopen(const char* path, const char* mode) {
  return OpenStream(Real("fopen", &fopen), path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  return OpenStream(Real("fopen64", &fopen64), path, mode);
}

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto real = Real("write", &write);
  if (!IsWatched(file)) return real(file, bytes, count);
  Happen([&] {
    if (count > 1) static_cast<void>(!real(file, bytes, count / 2));
  });
  if (Fails()) return -1;
  return real(file, bytes, count);
}
ssize_t writev(int file, const iovec* parts, int count) {
  if (IsWatched(file)) {
    Happen();
    if (Fails()) return -1;
  }
  return Real("writev", &writev)(file, parts, count);
}

int close(int file) {
  static const auto real = Real("close", &close);
  if (IsWatched(file)) {
    Watch(file, false);
    Happen();
  }
  return real(file);
}

int rename(const char* from, const char* to) {
  if (Counts(from)) Happen();
  return Real("rename", &rename)(from, to);
}
int unlink(const char* path) {
  if (Counts(path)) Happen();
  return Real("unlink", &unlink)(path);
}
int unlinkat(int folder, const char* path, int flags) {  // relative paths: all count
  Happen();
  return Real("unlinkat", &unlinkat)(folder, path, flags);
}
int remove(const char* path) {
  if (Counts(path)) Happen();
  return Real("remove", &remove)(path);
}
int mkdir(const char* path, mode_t mode) {
  if (Counts(path)) {
    Happen();
    if (Fails()) return -1;
  }
  return Real("mkdir", &mkdir)(path, mode);
}

}  // extern "C"
