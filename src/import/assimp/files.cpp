#include "import/assimp/files.h"

#include "base/error.h"

#include <algorithm>
#include <cstring>
#include <memory>

namespace imgeo {

namespace {

struct OpenFile : aiFile {
  Bytes own;
  ByteSpan bytes; ///< `own`, or the source's bytes
  std::size_t at = 0;

  explicit OpenFile(ByteSpan all) : aiFile{}, bytes(all) {
    ReadProc = [](aiFile* file, char* to, std::size_t size, std::size_t count) {
      return of(file).read(to, size, count);
    };
    WriteProc = [](aiFile*, const char*, std::size_t, std::size_t) -> std::size_t { return 0; };
    TellProc = [](aiFile* file) { return of(file).at; };
    FileSizeProc = [](aiFile* file) { return of(file).bytes.size(); };
    SeekProc = [](aiFile* file, std::size_t offset, aiOrigin origin) { return of(file).seek(offset, origin); };
    FlushProc = [](aiFile*) {};
  }
  explicit OpenFile(Bytes all) : OpenFile(ByteSpan{}) {
    own = std::move(all);
    bytes = own;
  }

  static OpenFile& of(aiFile* file) { return *static_cast<OpenFile*>(file); }

  std::size_t read(char* to, std::size_t size, std::size_t count) {
    const std::size_t whole = size == 0 ? 0 : std::min(count, (bytes.size() - at) / size);
    if (whole > 0)
      std::memcpy(to, bytes.data() + at, whole * size);
    at += whole * size;
    return whole;
  }
  aiReturn seek(std::size_t offset, aiOrigin origin) {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at : bytes.size();
    const std::size_t to = origin == aiOrigin_END ? from - offset : from + offset;
    if (to > bytes.size())
      return aiReturn_FAILURE;
    at = to;
    return aiReturn_SUCCESS;
  }
};

/// Removes the source's folder or "./", with which paths from Assimp begin.
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

SourceFiles::SourceFiles(ByteSpan bytes, const std::string& name, const References& references)
    : bytes_(bytes), name_(name), references_(references) {
  io_.OpenProc = [](aiFileIO* io, const char* path, const char* mode) {
    return reinterpret_cast<SourceFiles*>(io->UserData)->open(path, mode);
  };
  io_.CloseProc = [](aiFileIO*, aiFile* file) { delete static_cast<OpenFile*>(file); };
  io_.UserData = reinterpret_cast<aiUserData>(this);
}

/// Opens a file; null where it cannot be read. Assimp also calls this to test whether files exist.
aiFile* SourceFiles::open(const std::string& path, const std::string& mode) {
  if (mode.find_first_of("wa+") != mode.npos)
    return nullptr;
  const std::string file = withoutFolder(path, name_);
  if (file == withoutFolder(name_, name_) || file == name_)
    return std::make_unique<OpenFile>(bytes_).release();
  const std::string fileName = file.substr(file.rfind('/') + 1);
  try {
    auto opened = std::make_unique<OpenFile>(references_.fetch(file));
    refused_.erase(fileName);
    return opened.release();
  } catch (const Error& error) {
    if (!file.starts_with('/')) // Assimp derives such paths from others
      refused_.try_emplace(fileName, error.what());
    return nullptr;
  }
}

std::vector<std::string> SourceFiles::refused() const {
  std::vector<std::string> sentences;
  for (const auto& [file, sentence] : refused_)
    sentences.push_back(sentence);
  return sentences;
}

} // namespace imgeo
