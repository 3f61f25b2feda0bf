#pragma once
// Names of the files and folders of a site.

namespace imgeo {

/// Marks a directory as an imgeo site; site_manifest.h has its content.
inline constexpr const char* manifestName = "imgeo.json";

inline constexpr const char* pageName = "index.html";
inline constexpr const char* sceneName = "scene.x3d";
inline constexpr const char* stylesheetName = "imgeo.css";
inline constexpr const char* geometryFolder = "geometry";
inline constexpr const char* textureFolder = "textures";
inline constexpr const char* runtimeFolder = "runtime";

/// The only file of runtimeFolder whose name does not change with its content: other people's pages name it.
inline constexpr const char* runtimeModuleName = "imgeo.js";

} // namespace imgeo
