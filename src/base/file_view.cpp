#include "base/file_view.h"

#include "base/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace imgeo {

namespace {

/// The content of a regular file; empty for other files, empty ones and those that cannot be mapped.
ByteSpan mapped(const std::filesystem::path& path) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault)) // opening a pipe twice would end its writer
    return {};
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return {};
  ByteSpan bytes;
  struct stat status {};
  if (fstat(file, &status) == 0 && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    if (void* const begin = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0); begin != MAP_FAILED)
      bytes = {static_cast<const std::uint8_t*>(begin), size};
  }
  close(file);
  return bytes;
}

} // namespace

FileView::FileView(const std::filesystem::path& path) : bytes_(mapped(path)) {
  if (bytes_.empty())
    bytes_ = read_ = readFile(path); // which also reports a file that cannot be read
}

FileView::~FileView() {
  if (read_.empty() && !bytes_.empty())
    munmap(const_cast<std::uint8_t*>(bytes_.data()), bytes_.size());
}

} // namespace imgeo
