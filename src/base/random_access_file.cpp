#include "base/random_access_file.h"

#include "base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace imgeo {

RandomAccessFile::RandomAccessFile(std::filesystem::path path)
    : path_(std::move(path)), file_(open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0)
    throw Error(ErrorKind::io, path_.string(), fmt::format("cannot open: {}", std::strerror(errno)));
  struct stat status {};
  fstat(file_, &status); // does not fail for an open file
  size_ = static_cast<std::uint64_t>(status.st_size);
  posix_fadvise(file_, 0, 0, POSIX_FADV_RANDOM);
}

RandomAccessFile::~RandomAccessFile() {
  close(file_);
}

void RandomAccessFile::read(std::uint64_t offset, std::span<std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = pread(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0)
      throw Error(ErrorKind::io, path_.string(),
                  count < 0 ? fmt::format("cannot read: {}", std::strerror(errno)) : "has become shorter");
    offset += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

} // namespace imgeo
