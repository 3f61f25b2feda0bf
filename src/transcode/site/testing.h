#pragma once
// Functions for tests of sites: write inputs and list directories.

#include "base/file.h"
#include "base/testing.h"
#include "export/export.h"
#include "imgeo/convert.h"
#include "imgeo/site.h"
#include "imgeo/verify.h"
#include "transcode/export/export_site.h"
#include "transcode/site/site_document.h"
#include "transcode/site/staged_site.h"

#include <filesystem>
#include <map>
#include <string>

namespace imgeo::testing {

/// Writes a mesh as a PLY file.
inline void writeMesh(const std::filesystem::path& file, const Mesh& mesh) {
  Scene scene;
  scene.meshes.push_back(mesh);
  addRoot(scene.graph, {"", Shape{}, {}, ""});
  writeFile(file, exportScene(scene, MeshFormat::ply));
}

/// The names in a directory, hidden ones included.
inline std::vector<std::string> namesIn(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

/// Every file below a directory and what it holds.
inline std::map<std::string, Bytes> contentsOf(const std::filesystem::path& directory) {
  std::map<std::string, Bytes> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
    if (entry.is_regular_file())
      contents[std::filesystem::relative(entry.path(), directory)] = readFile(entry.path());
  return contents;
}

} // namespace imgeo::testing
