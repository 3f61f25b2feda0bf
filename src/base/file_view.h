#pragma once
// The content of a whole file, without a copy where the system can map it into memory.

#include "base/bytes.h"

#include <filesystem>

namespace imgeo {

/// The content of a file during the object's lifetime. Pages of a mapped file are read when they are used, and the
/// system can drop them: a file may be larger than the memory. Reading what another process has cut off a mapped file
/// raises SIGBUS.
class FileView {
public:
  /// Maps a regular file; reads anything else whole. Throws Error{io} naming the path and the system's reason.
  explicit FileView(const std::filesystem::path& path);
  ~FileView();
  FileView(const FileView&) = delete;
  FileView& operator=(const FileView&) = delete;

  ByteSpan bytes() const { return bytes_; }

private:
  Bytes read_; ///< of a file that is not mapped
  ByteSpan bytes_;
};

} // namespace imgeo
