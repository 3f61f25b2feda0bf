#pragma once
// Regular files below the served directory, opened for sending.

#include "base/bytes.h"
#include "serve/request_path.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

namespace imgeo {

/// Owns a file descriptor, so that the bytes stay readable while a newer site replaces the file.
class OpenFile {
public:
  OpenFile(int descriptor, std::uint64_t size, std::int64_t modifiedNanoseconds, std::string version);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// Time of the last change to the bytes, in nanoseconds since 1970.
  std::int64_t modifiedNanoseconds() const { return modifiedNanoseconds_; }
  /// Inode, size and modification time in nanoseconds, so that it changes when the bytes change. Consists of letters,
  /// digits and dashes.
  const std::string& version() const { return version_; }
  /// Reads out.size() bytes from `offset`, or fewer at the file's end. Returns their number. Throws Error{io}. Safe to
  /// call from several threads.
  std::size_t readAt(std::uint64_t offset, std::span<std::uint8_t> out) const;

private:
  int descriptor_;
  std::uint64_t size_;
  std::int64_t modifiedNanoseconds_;
  std::string version_;
};

enum class Absence {
  notFound,  ///< no such file, not readable, not a regular file, or outside the root
  directory, ///< a directory, requested without a trailing slash
};

/// Opens the file of a path below `root`, a canonical path; for a directory, its index.html. Names that start with a
/// dot and symbolic links that leave the root are not found.
std::variant<std::shared_ptr<const OpenFile>, Absence> openBelow(const std::filesystem::path& root,
                                                                 const RequestPath& path);

} // namespace imgeo
