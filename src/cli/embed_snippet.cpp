#include "cli/embed_snippet.h"

#include "serve/request_path.h"
#include "transcode/site/site_files.h"

#include <fmt/format.h>

namespace imgeo::cli {

std::string embedSnippet(const std::filesystem::path& directory) {
  std::error_code ignored;
  std::filesystem::path site = std::filesystem::weakly_canonical(std::filesystem::absolute(directory), ignored);
  if (!site.has_filename()) // "statue/" has an empty one
    site = site.parent_path();
  // Without the first slash the path is relative to the page.
  const std::string folder = formatRequestPath({{site.filename().string()}, true}).substr(1);
  return fmt::format("<script type=\"module\" src=\"{0}{1}/{2}\"></script>\n<imgeo-viewer src=\"{0}\"></imgeo-viewer>",
                     folder, runtimeFolder, runtimeModuleName);
}

} // namespace imgeo::cli
