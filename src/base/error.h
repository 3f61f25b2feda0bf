#pragma once
// The exception type of the project. Bad input, files and networks throw `Error`; a violated precondition is an
// `assert`. An Error that nobody handles ends in `cli/main.cpp`, as one sentence and an exit code, or in an HTTP
// request handler, as a closed connection. Readers handle an Error of an optional file themselves (a texture, a
// material library, an Inline): they leave the file out and add a warning. `verify` turns an Error of the site it reads
// into a difference.

#include <cstdint>
#include <exception>
#include <string>

namespace imgeo {

enum class ErrorKind {
  io,          ///< a file could not be read, written or exchanged
  truncated,   ///< the bytes end before the data do
  malformed,   ///< the bytes contradict their format
  unsupported, ///< well-formed, but nothing we can read or write
  limit,       ///< larger than a stated limit
  usage,       ///< the command line asks for something impossible
};

class Error : public std::exception {
public:
  /// `location` is where a person should look: "bunny.ply:12" (line) or
  /// "bunny.ply, byte 1042" or a URL; empty where there is none.
  /// `message` is one sentence without a full stop's worth of jargon.
  Error(ErrorKind kind, std::string location, std::string message);

  ErrorKind kind() const noexcept { return kind_; }
  const std::string& location() const noexcept { return location_; }
  const std::string& message() const noexcept { return message_; }
  /// "location: message", or the message alone.
  const char* what() const noexcept override { return what_.c_str(); }

private:
  ErrorKind kind_;
  std::string location_, message_, what_;
};

/// The process exit code that stands for an error: 1 usage, 2 io,
/// 3 bad input (truncated, malformed, unsupported, limit). 0 is success and
/// 4 an internal fault, which is no Error.
int exitCode(ErrorKind kind) noexcept;

} // namespace imgeo
