#include "import/ply/textures.h"
#include "import/mesh/add_shape.h"
#include "import/references.h"
#include "import/source_images.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>

namespace imgeo {

namespace {

/// A mesh of some triangles of another, with the positions and wedges that they use.
Mesh meshOfTriangles(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  constexpr std::uint32_t unseen = 0xffffffff;
  Mesh part;
  part.name = mesh.name;
  part.creaseDegrees = mesh.creaseDegrees;
  std::vector<std::uint32_t> wedges, positions, wedgeOf(mesh.wedgeCount(), unseen),
      positionOf(mesh.positions.size(), unseen);
  const auto indexOf = [](std::uint32_t old, std::vector<std::uint32_t>& indices, std::vector<std::uint32_t>& used) {
    if (indices[old] == unseen) {
      indices[old] = static_cast<std::uint32_t>(used.size());
      used.push_back(old);
    }
    return indices[old];
  };
  for (const std::uint32_t triangle : triangles)
    for (std::size_t corner = 3 * std::size_t{triangle}; corner < 3 * (std::size_t{triangle} + 1); ++corner)
      part.corners.push_back(indexOf(mesh.corners[corner], wedgeOf, wedges));
  for (const std::uint32_t wedge : wedges)
    part.wedgePositions.push_back(indexOf(mesh.wedgePositions[wedge], positionOf, positions));
  static_cast<VertexAttributes&>(part) = gather(mesh, wedges);
  part.positions = gather(mesh.positions, positions);
  return part;
}

/// PLY files may come from other systems.
std::string urlOf(std::string file) {
  std::ranges::replace(file, '\\', '/');
  return file;
}

/// The images of a file, each with an appearance.
class PlyAppearances {
public:
  PlyAppearances(SceneGraph& graph, const std::vector<std::string>& files, const ImportOptions& options,
                 const std::string& name)
      : graph_(graph), files_(files), references_(options, name), images_(graph) {}

  /// The index of an appearance; empty for no texture, for one that the file does not name, and for an image that
  /// cannot be read.
  std::optional<std::size_t> of(std::uint32_t texture) {
    if (texture >= files_.size())
      return {};
    const auto [found, isNew] = appearances_.try_emplace(files_[texture]);
    if (isNew)
      found->second = add(files_[texture]);
    return found->second;
  }

  const std::vector<std::string>& omissions() const { return images_.omissions; }

private:
  std::optional<std::size_t> add(const std::string& file) {
    const std::string url = urlOf(file);
    const std::optional<std::size_t> image = images_.index(file, url, [&] {
      return ImageFile{url, references_.fetch(url)};
    });
    if (!image)
      return {};
    Texture texture;
    texture.image = *image;
    graph_.textures.push_back(texture);
    Appearance appearance;
    appearance.material = Material{.diffuseColor = {1, 1, 1}}; // colours are those of the image
    appearance.textures.push_back({TextureRole::color, graph_.textures.size() - 1, {}});
    graph_.appearances.push_back(std::move(appearance));
    return graph_.appearances.size() - 1;
  }

  SceneGraph& graph_;
  const std::vector<std::string>& files_;
  References references_;
  SourceImages images_;
  std::map<std::string, std::optional<std::size_t>> appearances_;
};

} // namespace

bool isPlyTextureNumber(const PlyProperty& property) {
  return !property.isList() && property.name == "texnumber" && isInteger(property.type);
}

std::uint32_t plyTextureOf(double number) {
  return number >= 0 ? static_cast<std::uint32_t>(number) : noPlyTexture;
}

Mesh inOrderOfUse(const Mesh& mesh) {
  std::vector<std::uint32_t> all(mesh.elementCount());
  std::iota(all.begin(), all.end(), 0u);
  return meshOfTriangles(mesh, all);
}

bool isReadablePlyTexture(const std::string& file, const ImportOptions& options, const std::string& name) {
  SceneGraph graph;
  return PlyAppearances(graph, {file}, options, name).of(0).has_value();
}

std::vector<TexturedPart> dividedByTexture(Mesh mesh, std::span<const std::uint32_t> textures) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> trianglesOf; // noPlyTexture is the largest number
  for (std::size_t triangle = 0; triangle < textures.size(); ++triangle)
    trianglesOf[textures[triangle]].push_back(static_cast<std::uint32_t>(triangle));
  std::vector<TexturedPart> parts;
  if (trianglesOf.size() <= 1) {
    parts.push_back({textures.empty() ? noPlyTexture : textures[0], mesh.elementCount(), std::move(mesh)});
    return parts;
  }
  for (const auto& [texture, triangles] : trianglesOf)
    parts.push_back({texture, triangles.size(), meshOfTriangles(mesh, triangles)});
  return parts;
}

void addTexturedShapes(Imported& imported, std::vector<TexturedPart> parts, const std::vector<std::string>& files,
                       const ImportOptions& options, const std::string& name) {
  SceneGraph& graph = imported.scene.graph;
  PlyAppearances appearances(graph, files, options, name);
  std::uint64_t unnamed = 0;
  std::size_t withoutTexCoords = 0;
  bool hasDroppedColors = false;
  for (TexturedPart& part : parts) {
    unnamed += part.texture != noPlyTexture && part.texture >= files.size() ? part.triangles : 0;
    const bool hasTexCoords = !part.mesh.texCoords.empty();
    withoutTexCoords += part.texture < files.size() && !hasTexCoords;
    const std::optional<std::size_t> appearance = hasTexCoords ? appearances.of(part.texture) : std::nullopt;
    if (appearance && !part.mesh.colors.empty()) {
      hasDroppedColors = true;
      part.mesh.colors.clear();
    }
    addShape(imported.scene, std::move(part.mesh), appearance && parts.size() > 1 ? files[part.texture] : "",
             appearance);
  }
  addOmissions(imported.warnings, appearances.omissions(), options.strict, name);
  if (withoutTexCoords > 0)
    imported.warnings.push_back("The textures of the PLY file were left out: it has no texture coordinates.");
  if (unnamed > 0)
    imported.warnings.push_back(fmt::format("{} of a 'texnumber' for which the PLY file names no texture: without one.",
                                            counted(unnamed, "triangle is", "triangles are")));
  if (hasDroppedColors)
    imported.warnings.push_back("The vertex colours of the PLY file were left out: its textures have the colours.");
}

} // namespace imgeo
