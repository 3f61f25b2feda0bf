#pragma once
// Reads parts of a file. The system reads no more of it from disk than these parts, in contrast to a mapped file
// (file_view.h), of which it reads the surroundings of each page: 128 KB by default, up to megabytes on some disks.

#include "base/bytes.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace imgeo {

class RandomAccessFile {
public:
  /// Throws Error{io} naming the path and the system's reason.
  explicit RandomAccessFile(std::filesystem::path path);
  ~RandomAccessFile();
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;

  /// In bytes, when the file was opened.
  std::uint64_t size() const { return size_; }

  /// Fills `bytes` with what the file has from byte `offset` on. Throws Error{io}, also where the file ends before.
  void read(std::uint64_t offset, std::span<std::uint8_t> bytes) const;

private:
  std::filesystem::path path_;
  int file_;
  std::uint64_t size_ = 0;
};

} // namespace imgeo
