#include "base/file.h"

#include "base/error.h"
#include "base/unfinished_files.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <sys/stat.h>
#include <xxhash.h>

namespace imgeo {

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

bool isHexDigit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

[[noreturn]] void failWithErrno(const std::filesystem::path& path, const char* action) {
  throw Error(ErrorKind::io, path.string(), fmt::format("cannot {}: {}", action, std::strerror(errno)));
}

} // namespace

Bytes readFile(const std::filesystem::path& path) {
  const bool isStdin = path == "-";
  File opened(isStdin ? nullptr : std::fopen(path.c_str(), "rb"));
  std::FILE* file = isStdin ? stdin : opened.get();
  if (!file)
    failWithErrno(path, "open");
  struct stat status {};
  if (fstat(fileno(file), &status) != 0)
    failWithErrno(path, "read");
  if (S_ISDIR(status.st_mode))
    throw Error(ErrorKind::io, path.string(), "is a directory, not a file");

  Bytes bytes(S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0);
  std::size_t used = 0;
  // A regular file takes one read call and a second that finds its end; for a pipe the buffer grows.
  for (;;) {
    if (used == bytes.size()) {
      std::uint8_t more[1];
      if (std::fread(more, 1, 1, file) == 0)
        break;
      bytes.resize(std::max<std::size_t>(bytes.size() * 2, std::size_t{1} << 16));
      bytes[used++] = more[0];
    }
    const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file);
    if (got == 0)
      break;
    used += got;
  }
  if (std::ferror(file))
    failWithErrno(path, "read");
  bytes.resize(used);
  return bytes;
}

void writeFile(const std::filesystem::path& path, ByteSpan bytes) {
  writeFileInPieces(path, [&](const AppendBytes& append) { append(bytes); });
}

void writeFileInPieces(const std::filesystem::path& path, const std::function<void(const AppendBytes& append)>& write) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file)
    failWithErrno(path, "write");
  struct stat status {};
  std::optional<UnfinishedFile> unfinished; // devices and pipes are not removed
  if (fstat(fileno(file.get()), &status) == 0 && S_ISREG(status.st_mode))
    unfinished.emplace(path);
  const auto append = [&](ByteSpan bytes) {
    if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
      failWithErrno(path, "write");
  };
  try {
    write(append);
    if (std::fclose(file.release()) != 0)
      failWithErrno(path, "write");
  } catch (...) {
    std::error_code ignored;
    if (unfinished)
      std::filesystem::remove(path, ignored);
    throw;
  }
}

std::string contentName(ByteSpan bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}", hash.high64);
}

bool isContentNamed(std::string_view fileName) {
  constexpr std::size_t digits = 16;
  const std::string_view stem = fileName.substr(0, fileName.rfind('.'));
  if (stem.size() < digits || !std::all_of(stem.end() - digits, stem.end(), isHexDigit))
    return false;
  return stem.size() == digits || !isHexDigit(stem[stem.size() - digits - 1]);
}

} // namespace imgeo
