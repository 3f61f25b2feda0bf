#include "serve/open_file.h"

#include "base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

bool isBelow(const fs::path& root, const fs::path& path) {
  return std::mismatch(root.begin(), root.end(), path.begin(), path.end()).first == root.end();
}

} // namespace

OpenFile::OpenFile(int descriptor, std::uint64_t size, std::int64_t modifiedNanoseconds, std::string version)
    : descriptor_(descriptor), size_(size), modifiedNanoseconds_(modifiedNanoseconds), version_(std::move(version)) {}

OpenFile::~OpenFile() {
  ::close(descriptor_);
}

std::size_t OpenFile::readAt(std::uint64_t offset, std::span<std::uint8_t> out) const {
  std::size_t used = 0;
  while (used < out.size()) {
    const ssize_t got = ::pread(descriptor_, out.data() + used, out.size() - used, static_cast<off_t>(offset + used));
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      throw Error(ErrorKind::io, "", fmt::format("cannot read: {}", std::strerror(errno)));
    if (got == 0)
      break;
    used += static_cast<std::size_t>(got);
  }
  return used;
}

std::variant<std::shared_ptr<const OpenFile>, Absence> openBelow(const fs::path& root, const RequestPath& path) {
  fs::path requested = root;
  for (const std::string& name : path.names) {
    if (name.starts_with('.'))
      return Absence::notFound;
    requested /= name;
  }
  if (path.isDirectory)
    requested /= "index.html";

  std::error_code failure;
  const fs::path real = fs::canonical(requested, failure);
  if (failure || !isBelow(root, real))
    return Absence::notFound;

  // O_NONBLOCK: opening a pipe that nobody writes to must not hang a thread.
  const int descriptor = ::open(real.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
  if (descriptor < 0)
    return Absence::notFound;
  struct stat status {};
  const bool isKnown = ::fstat(descriptor, &status) == 0;
  if (!isKnown || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return isKnown && S_ISDIR(status.st_mode) && !path.isDirectory ? Absence::directory : Absence::notFound;
  }
  return std::make_shared<const OpenFile>(descriptor, static_cast<std::uint64_t>(status.st_size),
                                          status.st_mtim.tv_sec * std::int64_t{1'000'000'000} + status.st_mtim.tv_nsec,
                                          fmt::format("{:x}-{:x}-{:x}{:08x}", status.st_ino, status.st_size,
                                                      status.st_mtim.tv_sec, status.st_mtim.tv_nsec));
}

} // namespace imgeo
