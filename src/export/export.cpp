#include "export/export.h"

#include <algorithm>
#include <cassert>

namespace imgeo {

const char* nameOf(MeshFormat format) {
  constexpr const char* names[] = {"PLY", "OBJ", "GLB"};
  return names[static_cast<std::size_t>(format)];
}

std::optional<MeshFormat> meshFormatOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  if (extension == ".ply")
    return MeshFormat::ply;
  if (extension == ".obj")
    return MeshFormat::obj;
  if (extension == ".glb")
    return MeshFormat::glb;
  return {};
}

Bytes exportScene(const Scene& scene, MeshFormat format) {
  assert(!shapeNodes(scene.graph).empty());
  switch (format) {
  case MeshFormat::ply:
    return writePly(scene);
  case MeshFormat::obj:
    return writeObj(scene);
  case MeshFormat::glb:
    return writeGlb(scene);
  }
  return {};
}

} // namespace imgeo
