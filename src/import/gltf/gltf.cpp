// glTF 2.0 and GLB (Khronos Group, "glTF 2.0 Specification", 2021).

#include "import/gltf/gltf.h"

#include "import/gltf/extensions.h"
#include "import/gltf/gltf1.h"
#include "import/gltf/nodes.h"
#include "import/gltf/read_document.h"
#include "import/source_name.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace imgeo {

namespace {

using namespace gltf;

constexpr std::uint32_t jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942;

void checkVersion(const Value& root) {
  const Value asset = root["asset"];
  // Some glTF 1.0 files have a number as their version.
  const Value stated = asset["version"];
  const std::string version =
      !stated.isAbsent() && stated.json().is_number() ? fmt::format("{:.1f}", stated.real(0)) : stated.text();
  if (!version.starts_with("2."))
    asset.fail(ErrorKind::unsupported,
               version.empty() ? "states no version" : "is glTF " + version + "; imgeo reads glTF 2");
}

/// Throws Error{unsupported} for the first required extension that the table refuses or does not have.
void checkRequiredExtensions(const Value& required) {
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string name = required[i].text();
    const ExtensionRow* row = extensionRow(name);
    if (!row)
      required[i].fail(ErrorKind::unsupported, fmt::format("is {}, which imgeo does not know", name));
    if (row->treatment == ExtensionTreatment::refused)
      required[i].fail(ErrorKind::unsupported, fmt::format("is {}: {}", name, row->note));
  }
}

/// A sentence for each extension of `names` that changes the picture and is not drawn.
void addExtensionWarnings(const std::set<std::string>& names, std::vector<std::string>& warnings) {
  std::vector<std::string> unknown;
  for (const std::string& name : names) {
    const ExtensionRow* row = extensionRow(name);
    if (!row)
      unknown.push_back(name);
    else if (row->treatment == ExtensionTreatment::approximated || row->treatment == ExtensionTreatment::refused)
      warnings.push_back(fmt::format("{}: {}.", name, row->note));
  }
  if (!unknown.empty())
    warnings.push_back(fmt::format("Extensions that imgeo does not know are left out: {}.", fmt::join(unknown, ", ")));
}

/// The names in extensionsUsed, and of the extensions of materials, which some files do not list.
std::set<std::string> usedExtensions(const Value& root) {
  std::set<std::string> names;
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    for (std::size_t i = 0; i < root[list].size(); ++i)
      names.insert(root[list][i].text());
  const Value materials = root["materials"];
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (const Json& extensions = materials[i]["extensions"].json(); extensions.is_object())
      for (const auto& [name, unused] : extensions.items())
        names.insert(name);
  return names;
}

void addInfo(const Value& asset, SceneGraph& graph) {
  for (const char* field : {"copyright", "generator"})
    if (const std::string text = asset[field].text(); !text.empty())
      graph.info.push_back(fmt::format("{}: {}", field, text));
}

void addWarnings(const Value& root, const PrimitiveOmissions& primitives, const MaterialOmissions& materials,
                 const NodeReader& nodes, const AnimationOmissions& animations, std::vector<std::string>& warnings) {
  const auto add = [&](std::size_t count, const char* singular, const char* plural, const char* why = "") {
    if (count > 0)
      warnings.push_back(fmt::format("{} not carried over{}.", counted(count, singular, plural), why));
  };
  add(animations.otherPaths, "animated property is", "animated properties are",
      ": only transforms of nodes and weights of morph targets are animated");
  add(primitives.surplusVertices, "vertex or index is", "vertices or indices are",
      ": a whole triangle or line needs more");
  if (primitives.scaledWeights > 0)
    warnings.push_back(fmt::format("The weights of joints of {} do not sum to one: they are scaled.",
                                   counted(primitives.scaledWeights, "vertex", "vertices")));
  add(nodes.otherScenes, "further scene is", "further scenes are");
  if (!primitives.attributes.empty())
    warnings.push_back(
        fmt::format("Attributes of vertices that are not carried over: {}.", fmt::join(primitives.attributes, ", ")));
  addExtensionWarnings(usedExtensions(root), warnings);
  add(materials.skewedTransforms, "texture transform is", "texture transforms are",
      ": X3D's cannot scale before it rotates");
  std::ranges::copy(materials.images, std::back_inserter(warnings));
  std::ranges::copy(nodes.damage.warnings, std::back_inserter(warnings));
  std::ranges::copy(primitives.damage, std::back_inserter(warnings));
  std::ranges::copy(animations.damage, std::back_inserter(warnings));
  warnOfNormals(warnings, primitives.unusableNormals);
}

} // namespace

bool isGltf(ByteSpan bytes) {
  return !isGltf1(bytes) && (isGlb(bytes) || resemblesGltf(asText(bytes)));
}

GlbChunks gltf::chunksOf(ByteSpan bytes, const std::string& name) {
  if (!isGlb(bytes))
    return {asText(bytes), {}};
  if (bytes.size() < 20)
    throw Error(ErrorKind::truncated, name, "a GLB file is at least 20 bytes long");
  const std::uint32_t version = loadLittle<std::uint32_t>(bytes.data() + 4);
  if (version != 2)
    throw Error(ErrorKind::unsupported, name, fmt::format("is glTF {}; imgeo reads glTF 2", version));
  GlbChunks chunks;
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

void gltf::checkSupported(const Value& root) {
  checkVersion(root);
  checkRequiredExtensions(root["extensionsRequired"]);
}

Imported gltf::readDocument(Document& document, const char* format, const ImportOptions& options) {
  PrimitiveReader primitives(document, options.attributes, options.strict);
  return readDocument(document, format, options, primitives);
}

Imported gltf::readDocument(Document& document, const char* format, const ImportOptions& options,
                            PrimitiveReader& primitives) {
  checkSupported(document.root());
  Imported imported;
  imported.format = format;
  MaterialReader materials(document, imported.scene.graph, options.strict);
  NodeReader nodes(document, imported.scene, primitives, materials, options.strict);
  nodes.readScene();
  // A file of which nothing is left fails with the cause: a missing .bin, an index out of range.
  if (nodes.damage.first && !nodes.hasShapes())
    throw Error(*nodes.damage.first);
  AnimationReader animations(document, imported.scene.graph, options.strict);
  animations.read(nodes.animatedNodes());
  imported.attributes.assign(primitives.furtherAttributes.begin(), primitives.furtherAttributes.end());
  addInfo(document.root()["asset"], imported.scene.graph);
  addWarnings(document.root(), primitives.omissions, materials.omissions, nodes, animations.omissions,
              imported.warnings);
  return imported;
}

Imported readGltf(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const GlbChunks chunks = chunksOf(bytes, name);
  const Json json = parseJson(chunks.json, name);
  const References references(options, name);
  Document document(json, chunks.binary, references, name, bytes.size());
  return readDocument(document, isGlb(bytes) ? "GLB" : "glTF", options);
}

} // namespace imgeo
