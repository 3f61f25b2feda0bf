// glTF 2.0 and GLB (Khronos Group, "glTF 2.0 Specification", 2021).

#include "import/gltf/gltf.h"

#include "import/gltf/nodes.h"
#include "import/source_name.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo {

namespace {

using namespace gltf;

constexpr std::uint32_t glbMagic = 0x46546c67, jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942;

/// Extensions that a document may require, besides KHR_materials_*.
const std::set<std::string> supportedExtensions{
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",  "KHR_lights_punctual",
    "KHR_texture_transform",      "EXT_texture_webp",        "EXT_mesh_gpu_instancing"};

bool isGlb(ByteSpan bytes) {
  return bytes.size() >= 12 && loadLittle<std::uint32_t>(bytes.data()) == glbMagic;
}

/// The contents of a GLB file; `binary` is empty if there is none.
struct Chunks {
  std::string_view json;
  ByteSpan binary;
};

Chunks chunksOf(ByteSpan bytes, const std::string& name) {
  if (!isGlb(bytes))
    return {asText(bytes), {}};
  if (bytes.size() < 20)
    throw Error(ErrorKind::truncated, name, "a GLB file is at least 20 bytes long");
  const std::uint32_t version = loadLittle<std::uint32_t>(bytes.data() + 4);
  if (version != 2)
    throw Error(ErrorKind::unsupported, name, fmt::format("is glTF {}; imgeo reads glTF 2", version));
  Chunks chunks;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::uint64_t length = loadLittle<std::uint32_t>(bytes.data() + at);
    const std::uint32_t type = loadLittle<std::uint32_t>(bytes.data() + at + 4);
    if (length > bytes.size() - at - 8)
      throw Error(ErrorKind::truncated, byteLocation(name, at), "a chunk is longer than what is left of the file");
    const ByteSpan content = bytes.subspan(at + 8, length);
    if (type == jsonChunk && chunks.json.empty())
      chunks.json = asText(content);
    if (type == binaryChunk && chunks.binary.empty())
      chunks.binary = content;
    at += 8 + length;
  }
  return chunks;
}

void checkVersion(const Value& root) {
  const Value asset = root["asset"];
  // Some glTF 1.0 files have a number as their version.
  const Value stated = asset["version"];
  const std::string version =
      !stated.isAbsent() && stated.json().is_number() ? fmt::format("{:.1f}", stated.real(0)) : stated.text();
  if (!version.starts_with("2."))
    asset.fail(ErrorKind::unsupported,
               version.empty() ? "states no version" : "is glTF " + version + "; imgeo reads glTF 2");
  const Value required = root["extensionsRequired"];
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string extension = required[i].text();
    if (!supportedExtensions.contains(extension) && !extension.starts_with("KHR_materials_"))
      required[i].fail(ErrorKind::unsupported, "is " + extension + ", which imgeo does not read");
  }
}

void addInfo(const Value& asset, SceneGraph& graph) {
  for (const char* field : {"copyright", "generator"})
    if (const std::string text = asset[field].text(); !text.empty())
      graph.info.push_back(fmt::format("{}: {}", field, text));
}

void addWarnings(const Value& root, const PrimitiveOmissions& primitives, const MaterialOmissions& materials,
                 const NodeOmissions& nodes, std::vector<std::string>& warnings) {
  const auto add = [&](std::size_t count, const char* singular, const char* plural, const char* why = "") {
    if (count > 0)
      warnings.push_back(fmt::format("{} not carried over{}.", counted(count, singular, plural), why));
  };
  add(root["animations"].size(), "animation is", "animations are");
  add(nodes.skins, "skin is", "skins are", ": skinned meshes stay as they were modelled");
  add(primitives.morphTargets, "mesh has morph targets, which are", "meshes have morph targets, which are");
  add(nodes.otherScenes, "further scene is", "further scenes are");
  if (!primitives.attributes.empty())
    warnings.push_back(
        fmt::format("Attributes of vertices that are not carried over: {}.", fmt::join(primitives.attributes, ", ")));
  std::vector<std::string> extensions;
  for (const auto& [name, count] : materials.extensions)
    if (count > 0)
      extensions.push_back(fmt::format("{} ({})", name, counted(count, "material", "materials")));
  if (!extensions.empty())
    warnings.push_back(fmt::format("Extensions that are not carried over: {}.", fmt::join(extensions, ", ")));
  add(materials.furtherTexCoords, "texture is", "textures are", ": they use further texture coordinates");
  add(materials.skewedTransforms, "texture transform is", "texture transforms are",
      ": X3D's cannot scale before it rotates");
  std::ranges::copy(materials.images, std::back_inserter(warnings));
  std::ranges::copy(nodes.damage, std::back_inserter(warnings));
  warnOfNormals(warnings, primitives.unusableNormals);
}

} // namespace

bool isGltf(ByteSpan bytes) {
  if (isGlb(bytes))
    return true;
  const std::string_view text = asText(bytes);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '{' && text.find("\"asset\"") != text.npos;
}

Imported readGltf(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const Chunks chunks = chunksOf(bytes, name);
  const Json json = parseJson(chunks.json, name);
  const References references(options, name);
  Document document(json, chunks.binary, references, name, bytes.size());
  checkVersion(document.root());

  Imported imported;
  imported.format = isGlb(bytes) ? "GLB" : "glTF";
  PrimitiveReader primitives(document, options.attributes);
  MaterialReader materials(document, imported.scene.graph, options.strict);
  NodeReader nodes(document, imported.scene, primitives, materials, options.strict);
  nodes.readScene();
  imported.attributes.assign(primitives.furtherAttributes.begin(), primitives.furtherAttributes.end());
  addInfo(document.root()["asset"], imported.scene.graph);
  addWarnings(document.root(), primitives.omissions, materials.omissions, nodes.omissions, imported.warnings);
  return imported;
}

} // namespace imgeo
