#pragma once
// Names of the files and folders of a site.

#include <filesystem>
#include <optional>
#include <vector>

namespace imgeo {

/// Marks a directory as an imgeo site; site_manifest.h has its content.
inline constexpr const char* manifestName = "imgeo.json";

inline constexpr const char* pageName = "index.html";
inline constexpr const char* sceneName = "scene.x3d";
inline constexpr const char* stylesheetName = "imgeo.css";
inline constexpr const char* iconName = "icon.png";
inline constexpr const char* pictureName = "picture.png"; ///< what previews of links show
inline constexpr const char* geometryFolder = "geometry";
inline constexpr const char* levelIndexName = "levels.png"; ///< in a folder of its own in geometryFolder
inline constexpr const char* textureFolder = "textures";
inline constexpr const char* runtimeFolder = "runtime";

/// The only file of runtimeFolder whose name does not change with its content: other people's pages name it.
inline constexpr const char* runtimeModuleName = "imgeo.js";

/// Begins the name of an unfinished site that is built inside the site that it will replace.
inline constexpr const char* stagingPrefix = ".imgeo-";

/// Whether a file holds the content of the one beside it, whose name lacks the extension ".br" or ".gz", in a content
/// coding.
bool isPrecompressed(const std::filesystem::path& file);

/// Whether convert writes files of this name; `file` is relative to the site's root.
bool isSiteFile(const std::filesystem::path& file);

/// All files of a directory, relative to it and sorted, without unfinished sites in it.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& directory);

/// The first file of a site that convert has not written.
std::optional<std::filesystem::path> foreignFileIn(const std::filesystem::path& site);

} // namespace imgeo
