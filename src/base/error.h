#pragma once
// The exception type of the project. Bad input, files and networks throw `Error`; a violated precondition is an
// `assert`. An Error that nobody handles ends in `cli/main.cpp`, as one sentence and an exit code, or in an HTTP
// request handler, as a closed connection. Readers handle an Error of an optional file themselves (a texture, a
// material library, an Inline): they leave the file out and add a warning. `verify` turns an Error of the site it reads
// into a difference.

#include "imgeo/error.h"

namespace imgeo {

/// The process exit code that stands for an error: 1 usage, 2 io,
/// 3 bad input (truncated, malformed, unsupported, limit). 0 is success and
/// 4 an internal fault, which is no Error.
int exitCode(ErrorKind kind) noexcept;

} // namespace imgeo
