#include "base/scratch_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace imgeo {

namespace {

[[noreturn]] void fail(const std::filesystem::path& folder, const std::string& what, int reason) {
  throw Error(ErrorKind::io, folder.string(), what + ": " + std::generic_category().message(reason));
}

/// Not every file system has files without names: those get one that is removed at once.
int openUnnamed(const std::filesystem::path& folder) {
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL))
    return file;
  std::string name = (folder / ".imgeo-XXXXXX").string();
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0)
    unlink(name.c_str());
  return named;
}

} // namespace

ScratchFile::ScratchFile(const std::filesystem::path& folder) : folder_(folder), file_(openUnnamed(folder)) {
  if (file_ < 0)
    fail(folder_, "no file can be made in it", errno);
}

ScratchFile::~ScratchFile() {
  unmap();
  close(file_);
}

void ScratchFile::unmap() {
  if (!bytes_.empty())
    munmap(bytes_.data(), bytes_.size());
  bytes_ = {};
}

std::span<std::uint8_t> ScratchFile::resize(std::size_t size) {
  const std::size_t before = bytes_.size();
  unmap();
  const auto end = static_cast<off_t>(size);
  if (size < before && ftruncate(file_, end) != 0)
    fail(folder_, "the file in it cannot be shortened", errno);
  // A hole in the file would end the process where the disk is full.
  if (const int reason = size > before ? posix_fallocate(file_, 0, end) : 0; reason != 0)
    fail(folder_, "has no room for " + std::to_string(size) + " bytes", reason);
  if (size == 0)
    return {};
  void* const begin = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (begin == MAP_FAILED)
    fail(folder_, "a file in it cannot be mapped into memory", errno);
  bytes_ = {static_cast<std::uint8_t*>(begin), size};
  return bytes_;
}

} // namespace imgeo
