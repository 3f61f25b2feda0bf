#include "transcode/site/content_files.h"

#include "base/file.h"

#include <algorithm>

namespace imgeo {

void FolderName::add(const std::string& name, ByteSpan bytes) {
  add(name, contentName(bytes));
}

void FolderName::add(const std::string& name, const std::string& contentName) {
  text_ += name + " " + contentName + "\n";
}

std::string FolderName::get() const {
  return contentName(asBytes(text_));
}

std::string ContentFiles::writeFolder(std::span<const FolderFile> folderFiles) {
  FolderName name;
  for (const FolderFile& file : folderFiles)
    name.add(file.name, file.bytes);
  return writeFolder(name, [&](const auto& write) { std::ranges::for_each(folderFiles, write); });
}

std::string
ContentFiles::writeFolder(const FolderName& name,
                          const std::function<void(const std::function<void(const FolderFile&)>& write)>& visit) {
  const std::string url = folder_ + "/" + name.get();
  {
    const std::lock_guard lock(mutex_);
    if (!urls_.insert(url).second)
      return url;
  }
  visit([&](const FolderFile& file) {
    const std::filesystem::path path = site_ / url / file.name;
    std::filesystem::create_directories(path.parent_path());
    writeFile(path, file.bytes);
  });
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
