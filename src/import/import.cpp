#include "import/import.h"

#include "base/error.h"
#include "base/file.h"
#include "import/formats.h"
#include "import/gzip.h"
#include "import/warnings.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

using Reader = Imported (*)(ByteSpan, const std::string&, const ImportOptions&);

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// "bunny.ply" for "models/bunny.ply.gz".
std::filesystem::path withoutGz(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(name).filename();
  return lowerCase(file.extension()) == ".gz" ? file.stem() : file;
}

Reader readerFor(ByteSpan bytes, const std::string& name) {
  if (looksLikePly(bytes))
    return readPly;
  if (looksLikeStl(bytes))
    return readStl;
  if (looksLikeGlb(bytes) || looksLikeGltf(bytes))
    return readGltf;
  if (looksLikeX3d(bytes))
    return readX3d;
  if (looksLikeVrml(bytes))
    return readVrml;
  const std::string extension = lowerCase(withoutGz(name).extension());
  static const std::map<std::string_view, Reader> readers{
      {".ply", readPly},    {".stl", readStl},  {".obj", readObj},   {".gltf", readGltf},
      {".glb", readGltf},   {".x3d", readX3d},  {".x3dz", readX3d},  {".x3dv", readVrml},
      {".x3dvz", readVrml}, {".wrl", readVrml}, {".vrml", readVrml}, {".wrz", readVrml}};
  const auto reader = readers.find(extension);
  if (reader == readers.end() && isReadByAssimp(name)) // also text in UTF-16, and some that looks like OBJ
    return readByAssimp;
  if (looksLikeObj(bytes))
    return readObj;
  if (asText(bytes).starts_with("\xff\xfe") || asText(bytes).starts_with("\xfe\xff"))
    throw Error(ErrorKind::unsupported, name, "is text in UTF-16; imgeo reads ASCII and UTF-8");
  if (reader != readers.end())
    return reader->second;
  throw Error(ErrorKind::unsupported, name,
              "is in no format that imgeo reads, which are X3D, VRML, glTF, PLY, OBJ, STL and those of Assimp "
              "(Collada, FBX, 3DS ...)");
}

/// Names of nodes become DEFs, which must differ: "wheel", "wheel-2", ...
void makeNamesUnique(SceneGraph& graph) {
  std::map<std::string, std::size_t> next; // name -> the number to try for its next holder
  for (const std::size_t index : nodesOfDocument(graph, graph.roots)) {
    std::string& name = graph.nodes[index].name;
    if (name.empty())
      continue;
    const std::string wanted = name;
    while (!next.try_emplace(name, 2).second)
      name = fmt::format("{}-{}", wanted, next[wanted]++);
  }
}

} // namespace

std::string stemOf(const std::string& name) {
  return withoutGz(name).stem();
}

std::string byteLocation(const std::string& name, std::size_t byte) {
  return fmt::format("{}, byte {}", name, byte);
}

void addShape(Scene& scene, Mesh mesh, std::string shapeName) {
  Shape shape;
  shape.mesh = scene.meshes.size();
  scene.meshes.push_back(std::move(mesh));
  addRoot(scene.graph, {std::move(shapeName), shape, {}, ""});
}

Imported importBytes(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  Bytes unpacked;
  if (isGzip(bytes)) {
    unpacked = gunzip(bytes, name);
    bytes = unpacked;
  }
  if (bytes.empty())
    throw Error(ErrorKind::truncated, name, "the file is empty");
  if (asText(bytes).starts_with("\xef\xbb\xbf"))
    bytes = bytes.subspan(3); // byte order mark

  Imported imported = readerFor(bytes, name)(bytes, name, options);
  const auto hasElements = [&](const ShapeInstance& placed) {
    return !imported.scene.meshes[shapeOf(imported.scene.graph, placed.node).mesh].corners.empty();
  };
  if (!imported.scene.graph.isComplete && std::ranges::none_of(shapeInstances(imported.scene.graph, name), hasElements))
    throw Error(ErrorKind::malformed, name,
                "the file has no triangles, lines or points" +
                    (imported.warnings.empty() ? "" : "; " + withoutFullStop(imported.warnings[0])));
  checkShapeInstanceLimit(imported.scene.graph, name);
  makeNamesUnique(imported.scene.graph);
  if (imported.scene.graph.title.empty())
    imported.scene.graph.title = stemOf(name);
  return imported;
}

Imported importFile(const std::filesystem::path& path, const ImportOptions& options) {
  ImportOptions beside = options;
  beside.folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code none;
  beside.inlinedBy.push_back(std::filesystem::weakly_canonical(path, none));
  return importBytes(readFile(path), path.string(), beside);
}

} // namespace imgeo
