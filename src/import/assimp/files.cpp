#include "import/assimp/files.h"

#include "base/error.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace imgeo {

namespace {

class MemoryStream : public Assimp::IOStream {
public:
  explicit MemoryStream(ByteSpan bytes) : bytes_(bytes) {}
  explicit MemoryStream(Bytes bytes) : own_(std::move(bytes)), bytes_(own_) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    const std::size_t whole = size == 0 ? 0 : std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0)
      std::memcpy(to, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    const std::size_t to = origin == aiOrigin_END ? from - offset : from + offset;
    if (to > bytes_.size())
      return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

private:
  Bytes own_;
  ByteSpan bytes_;
  std::size_t at_ = 0;
};

/// Paths that Assimp makes begin with the source's folder, or with "./".
std::string withoutFolder(std::string path, const std::string& source) {
  std::ranges::replace(path, '\\', '/');
  const std::size_t slash = source.rfind('/');
  if (slash != source.npos && path.starts_with(source.substr(0, slash + 1)))
    path = path.substr(slash + 1);
  while (path.starts_with("./"))
    path = path.substr(2);
  return path;
}

} // namespace

bool SourceFiles::isSource(const std::string& path) const {
  return path == withoutFolder(name_, name_) || path == name_;
}

bool SourceFiles::Exists(const char* path) const {
  const std::string file = withoutFolder(path, name_);
  if (isSource(file))
    return true;
  try {
    references_.fetch(file);
    return true;
  } catch (const Error&) {
    return false;
  }
}

Assimp::IOStream* SourceFiles::Open(const char* path, const char* mode) {
  if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos)
    return nullptr;
  const std::string file = withoutFolder(path, name_);
  if (isSource(file))
    return new MemoryStream(bytes_);
  try {
    return new MemoryStream(references_.fetch(file));
  } catch (const Error& error) {
    refused_.insert(error.what());
    return nullptr;
  }
}

} // namespace imgeo
