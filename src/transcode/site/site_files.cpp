#include "transcode/site/site_files.h"

#include "base/file.h"

#include <algorithm>
#include <array>

namespace imgeo {

namespace fs = std::filesystem;

bool isPrecompressed(const fs::path& file) {
  return file.extension() == ".br" || file.extension() == ".gz";
}

bool isSiteFile(const fs::path& file) {
  if (isPrecompressed(file)) {
    const fs::path original = fs::path(file).replace_extension();
    return !isPrecompressed(original) && isSiteFile(original);
  }
  const fs::path folder = file.parent_path();
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
