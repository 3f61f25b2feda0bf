#pragma once
// The HTML that embeds a converted site in another page.

#include <filesystem>
#include <string>

namespace imgeo::cli {

/// Two lines of HTML that display the site `directory` in a page of the folder that holds the directory: the runtime's
/// script and an <imgeo-viewer> (docs/embedding.md). The folder's name is percent-encoded.
std::string embedSnippet(const std::filesystem::path& directory);

} // namespace imgeo::cli
