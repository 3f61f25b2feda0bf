#include "import/chunks/source_content.h"

#include "import/archive/gzip.h"

namespace imgeo {

std::filesystem::path nearestFolder(const std::filesystem::path& path) {
  std::filesystem::path folder = std::filesystem::absolute(path.empty() ? "." : path);
  std::error_code ignored;
  while (!std::filesystem::is_directory(folder, ignored) && folder.has_relative_path())
    folder = folder.parent_path();
  return folder;
}

SourceContent::SourceContent(const std::filesystem::path& path, const std::filesystem::path& scratch)
    : name_(path.string()), file_(std::make_unique<FileView>(path)) {
  if (!isGzip(file_->bytes()))
    return;
  unpacked_ = std::make_unique<ScratchFile>(nearestFolder(scratch));
  gunzipInto([this](std::size_t size) { return unpacked_->resize(size); }, file_->bytes(), name_);
}

} // namespace imgeo
