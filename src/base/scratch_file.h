#pragma once
// Memory that is a file without a name: what the machine's memory does not hold is on the disk.

#include "base/bytes.h"

#include <filesystem>
#include <span>

namespace imgeo {

/// A file that no other process sees, mapped into memory. The system frees it with the object, however the process
/// ends.
class ScratchFile {
public:
  /// An empty file on the disk of `folder`, which exists. Throws Error{io} naming the folder and the system's reason.
  explicit ScratchFile(const std::filesystem::path& folder);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Gives the file this size; further bytes are zero. The disk has them afterwards: writing them does not fail.
  /// Returns all bytes, valid until the next call. Throws Error{io} where the disk has no room.
  std::span<std::uint8_t> resize(std::size_t size);
  ByteSpan bytes() const { return bytes_; }

private:
  void unmap();

  std::filesystem::path folder_;
  int file_ = -1;
  std::span<std::uint8_t> bytes_;
};

} // namespace imgeo
