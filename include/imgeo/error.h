#pragma once
/// @file
/// The exception type of imgeo.

#include <cstdint>
#include <exception>
#include <string>

namespace imgeo {

/// What is wrong.
enum class ErrorKind {
  io,          ///< a file could not be read, written or exchanged
  truncated,   ///< the bytes end before the data do
  malformed,   ///< the bytes contradict their format
  unsupported, ///< well-formed, but imgeo cannot read or write it
  limit,       ///< larger than a stated limit
  usage,       ///< options contradict each other or cannot be honoured
};

/// Thrown for bad input, files and options. A violated precondition is an `assert` instead.
class Error : public std::exception {
public:
  /// `location` says where the fault is: "bunny.ply:12" (line), "bunny.ply, byte 1042", a URL or an option; it may be
  /// empty. `message` is one sentence without a full stop.
  Error(ErrorKind kind, std::string location, std::string message);

  /// What is wrong.
  ErrorKind kind() const noexcept { return kind_; }
  /// File and line or byte, URL or option; may be empty.
  const std::string& location() const noexcept { return location_; }
  /// One sentence without a full stop.
  const std::string& message() const noexcept { return message_; }
  /// "location: message", or the message alone.
  const char* what() const noexcept override { return what_.c_str(); }

private:
  ErrorKind kind_;
  std::string location_, message_, what_;
};

} // namespace imgeo
