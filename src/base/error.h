#pragma once
// The exception type of the project (imgeo/error.h). Bad input, files and networks throw `Error`; a violated
// precondition is an `assert`. An unhandled Error ends in `cli/main.cpp`, as one sentence and an exit code, or in
// `serve/session.cpp`, where it closes the connection. Readers handle an Error of an optional file themselves (a
// texture, a material library, an Inline): they leave the file out and add a warning. `verify` turns an Error of the
// site that it reads into a difference.

#include "imgeo/error.h"

namespace imgeo {

/// The process exit code for an Error: 1 usage, 2 io, 3 bad input (truncated, malformed, unsupported, limit). 0 is
/// success; 4 is an internal fault, which is not an Error.
int exitCode(ErrorKind kind) noexcept;

} // namespace imgeo
