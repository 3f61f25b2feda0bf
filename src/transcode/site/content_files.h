#pragma once
// The files of a site that are named by their content: geometry and textures.

#include "base/bytes.h"

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>

namespace imgeo {

/// The files of one folder of a site under construction. Equal contents share one file. Safe to call from any thread.
class ContentFiles {
public:
  /// `site` is the site's root. The first file makes the folder.
  ContentFiles(std::filesystem::path site, std::string folder) : site_(std::move(site)), folder_(std::move(folder)) {}

  /// Writes a file named by its content and returns its url, relative to the site.
  std::string write(ByteSpan bytes, const std::string& extension);

private:
  std::filesystem::path site_;
  std::string folder_;
  std::mutex mutex_;
  std::set<std::string> urls_;
};

} // namespace imgeo
