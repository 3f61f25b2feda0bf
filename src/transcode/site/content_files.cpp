#include "transcode/site/content_files.h"

#include "base/file.h"

namespace imgeo {

void FolderName::add(const std::string& name, ByteSpan bytes) {
  text_ += name + " " + contentName(bytes) + "\n";
}

std::string FolderName::get() const {
  return contentName(asBytes(text_));
}

std::string ContentFiles::writeFolder(std::span<const FolderFile> folderFiles) {
  FolderName name;
  for (const FolderFile& file : folderFiles)
    name.add(file.name, file.bytes);
  const std::string url = folder_ + "/" + name.get();
  {
    const std::lock_guard lock(mutex_);
    if (!urls_.insert(url).second)
      return url;
  }
  for (const FolderFile& file : folderFiles) {
    const std::filesystem::path path = site_ / url / file.name;
    std::filesystem::create_directories(path.parent_path());
    writeFile(path, file.bytes);
  }
  return url;
}

std::string ContentFiles::write(ByteSpan bytes, const std::string& extension) {
  std::string url = folder_ + "/" + contentName(bytes) + extension;
  {
    const std::lock_guard lock(mutex_);
    if (urls_.empty())
      std::filesystem::create_directories(site_ / folder_);
    if (!urls_.insert(url).second)
      return url;
  }
  writeFile(site_ / url, bytes);
  return url;
}

} // namespace imgeo
