#pragma once
// A regular file that stays open while it is being sent.

#include "base/bytes.h"
#include "serve/request_path.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

namespace imgeo {

/// Owns a descriptor: the file's bytes stay readable although its site is
/// exchanged for a newer one meanwhile.
class OpenFile {
public:
  OpenFile(int descriptor, std::uint64_t size, std::string version);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::uint64_t size() const { return size_; }
  /// Another string whenever the bytes may be others: from inode, size and the
  /// time of the last change in nanoseconds. Letters, digits and dashes.
  const std::string& version() const { return version_; }
  /// Reads up to out.size() bytes from `offset`; fewer only at the file's end.
  /// Throws Error{io}. Safe to call from several threads.
  std::size_t readAt(std::uint64_t offset, std::span<std::uint8_t> out) const;

private:
  int descriptor_;
  std::uint64_t size_;
  std::string version_;
};

enum class Absence {
  notFound,  ///< no such file, not readable, no regular file, or outside the root
  directory, ///< a directory, whose path wants a slash behind it
};

/// Opens the file of a path below `root`, a canonical path; the index.html of a
/// directory. Names that start with a dot and links that leave the root are not found.
std::variant<std::shared_ptr<const OpenFile>, Absence> openBelow(const std::filesystem::path& root,
                                                                 const RequestPath& path);

} // namespace imgeo
