#include "transcode/site/site_files.h"

#include "base/file.h"

#include <algorithm>
#include <array>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

bool isNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

/// Whether a file is one of levels: "geometry/NAME/levels-1.png", "geometry/NAME/0/7.png".
bool isLevelFile(const fs::path& file) {
  if (file.extension() != ".png")
    return false;
  const fs::path folder = file.parent_path();
  const auto isLevelFolder = [](const fs::path& path) {
    return path.parent_path() == geometryFolder && isContentNamed(path.filename().native());
  };
  const std::string stem = file.stem();
  if (isLevelFolder(folder))
    return file.filename() == levelIndexName || (stem.starts_with("levels-") && isNumber(stem.substr(7)));
  return isLevelFolder(folder.parent_path()) && isNumber(folder.filename()) && isNumber(stem);
}

} // namespace

bool isPrecompressed(const fs::path& file) {
  return file.extension() == ".br" || file.extension() == ".gz";
}

bool isSiteFile(const fs::path& file) {
  if (isPrecompressed(file)) {
    const fs::path original = fs::path(file).replace_extension();
    return !isPrecompressed(original) && isSiteFile(original);
  }
  const fs::path folder = file.parent_path();
  if (isLevelFile(file))
    return true;
  if (isContentNamed(file.filename().native()))
    return folder == geometryFolder || folder == textureFolder || folder == runtimeFolder ||
           (folder.empty() && file.extension() == ".x3d"); // a document that an Inline refers to
  if (folder == runtimeFolder)
    return file.filename() == runtimeModuleName;
  constexpr std::array names{manifestName, pageName, sceneName, stylesheetName, iconName, pictureName};
  return std::ranges::find(names, file) != names.end();
}

std::vector<fs::path> filesIn(const fs::path& directory) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (auto entry = fs::recursive_directory_iterator(directory, ignored); entry != fs::recursive_directory_iterator();
       entry.increment(ignored))
    if (!entry->is_directory(ignored))
      files.push_back(entry->path().lexically_relative(directory));
    else if (entry->path().filename().native().starts_with(stagingPrefix))
      entry.disable_recursion_pending();
  std::ranges::sort(files);
  return files;
}

std::optional<fs::path> foreignFileIn(const fs::path& site) {
  const std::vector<fs::path> files = filesIn(site);
  const auto foreign = std::ranges::find_if_not(files, isSiteFile);
  return foreign == files.end() ? std::nullopt : std::optional(*foreign);
}

} // namespace imgeo
