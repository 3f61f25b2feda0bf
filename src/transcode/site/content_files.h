#pragma once
// The files of a site that are named by their content: geometry and textures.

#include "base/bytes.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <string>

namespace imgeo {

/// A file of a folder that is named by its content.
struct FolderFile {
  std::string name; ///< relative to the folder
  ByteSpan bytes;
};

/// Names a folder by the names and contents of its files, one after the other.
class FolderName {
public:
  void add(const std::string& name, ByteSpan bytes);
  /// The same for a file whose contentName() is known.
  void add(const std::string& name, const std::string& contentName);
  std::string get() const;

private:
  std::string text_;
};

/// The files of one folder of a site under construction. Equal contents share one file. Safe to call from any thread.
class ContentFiles {
public:
  /// `site` is the site's root. The first file makes the folder.
  ContentFiles(std::filesystem::path site, std::string folder) : site_(std::move(site)), folder_(std::move(folder)) {}

  /// Writes a file named by its content and returns its url, relative to the site.
  std::string write(ByteSpan bytes, const std::string& extension);

  /// Writes files with names of their own into a folder that is named by the names and contents of all, and returns
  /// its url. Names may have folders: "0/7.png".
  std::string writeFolder(std::span<const FolderFile> folderFiles);

  /// The same for files that memory need not hold at once: `visit` calls its argument for each of the files that `name`
  /// has been told, unless the folder has been written before.
  std::string writeFolder(const FolderName& name,
                          const std::function<void(const std::function<void(const FolderFile&)>& write)>& visit);

private:
  std::filesystem::path site_;
  std::string folder_;
  std::mutex mutex_;
  std::set<std::string> urls_;
};

} // namespace imgeo
