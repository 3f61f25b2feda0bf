#pragma once
// The names that a scene gets of its files.

#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace imgeo {

/// "frames/cloth.ply" for "frames/cloth-0001.ply".
std::filesystem::path withoutNumber(const std::filesystem::path& frame);

/// Sets the scene's title: the stated one, else the source's own, else the file's name.
void nameScene(SceneGraph& graph, const std::string& statedTitle, const std::filesystem::path& input);

} // namespace imgeo
