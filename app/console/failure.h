#pragma once

#include <exception>
#include <string>

namespace app {

/// What a user is told of an exception: bad input as it is, want of memory or a file system that
/// refuses in plain words, anything else as the program's own fault.
std::string Words(const std::exception& error);

/// Makes sure that descriptors 0 to 2 are in use, so that no file that is opened later takes the
/// place of one that the caller has closed.
void KeepStandardStreams();

/// Writes out what was printed. @throws InputError when it did not arrive (a full disk)
void FinishOutput();

}  // namespace app
