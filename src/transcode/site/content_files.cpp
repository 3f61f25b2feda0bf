#include "transcode/site/content_files.h"

#include "base/file.h"

namespace imgeo {

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
