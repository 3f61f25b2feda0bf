#include "import/gltf/gltf1.h"

#include "import/assimp/assimp.h"
#include "import/gltf/value.h"
#include "import/references.h"
#include "import/warnings.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

using gltf::Json;
using gltf::Value;

constexpr std::uint32_t glbMagic = 0x46546c67;
constexpr const char* binaryExtension = "KHR_binary_glTF";

/// The bytes of a buffer view of the file's own buffer.
ByteSpan bytesOf(const Value& view, ByteSpan body) {
  const std::uint64_t begin = view["byteOffset"].whole(0), length = view["byteLength"].whole(0);
  if (begin > body.size() || length > body.size() - begin)
    view.fail(ErrorKind::malformed, "reaches beyond the file's buffer");
  return body.subspan(begin, length);
}

/// All images, and all shaders, may have as many bytes as the buffer, or this many: their buffer views may overlap.
constexpr std::size_t maxInlinedBytes = std::size_t{1} << 28;

/// Gives the images or shaders that name a buffer view by KHR_binary_glTF a data: URL instead.
void inlineBufferViews(Json& json, const char* member, ByteSpan body, const std::string& name) {
  std::size_t bytesLeft = std::max(body.size(), maxInlinedBytes);
  const Json source = json; // a Value refers to JSON that does not change
  const Value root(source, name, ", "), views = root["bufferViews"];
  if (!source.contains(member) || !source[member].is_object())
    return;
  for (const auto& [key, object] : source[member].items()) {
    const Value binary = root[member][key.c_str()]["extensions"][binaryExtension];
    if (binary.isAbsent())
      continue;
    const std::string view = binary["bufferView"].text();
    if (!views.has(view.c_str()))
      binary.fail(ErrorKind::malformed, "names no buffer view");
    const ByteSpan bytes = bytesOf(views[view.c_str()], body);
    if (bytes.size() > bytesLeft)
      binary.fail(ErrorKind::limit, fmt::format("the {} repeat the file's buffer too often", member));
    bytesLeft -= bytes.size();
    json[member][key]["uri"] = dataUrlOf(bytes, binary["mimeType"].text("text/plain"));
  }
}

} // namespace

namespace {

/// The number of animations in a document of glTF 1.0; 0 for malformed ones.
std::size_t animationsIn(std::string_view json) {
  const Json document = Json::parse(json, nullptr, false);
  const auto found = document.is_object() ? document.find("animations") : document.end();
  return found != document.end() && found->is_object() ? found->size() : 0;
}

} // namespace

bool isGlb(ByteSpan bytes) {
  return bytes.size() >= 12 && loadLittle<std::uint32_t>(bytes.data()) == glbMagic;
}

bool resemblesGltf(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '{' && text.find("\"asset\"") != text.npos;
}

bool isGltf1(ByteSpan bytes) {
  if (isGlb(bytes))
    return loadLittle<std::uint32_t>(bytes.data() + 4) == 1;
  const std::string_view text = asText(bytes), key = "\"accessors\"";
  const auto notSpaceFrom = [&](std::size_t at) { return text.find_first_not_of(" \t\r\n", at); };
  const std::size_t found = resemblesGltf(text) ? text.find(key) : text.npos,
                    colon = found == text.npos ? found : notSpaceFrom(found + key.size()),
                    value = colon == text.npos ? colon : notSpaceFrom(colon + 1);
  return value != text.npos && text[colon] == ':' && text[value] == '{';
}

std::string jsonOfGlb1(ByteSpan bytes, const std::string& name) {
  // magic, version, length of the file, length of the JSON, its format (0); then the JSON and the buffer.
  constexpr std::size_t headerBytes = 20;
  if (bytes.size() < headerBytes)
    throw Error(ErrorKind::truncated, name, "a GLB file is at least 20 bytes long");
  const std::uint32_t fileLength = loadLittle<std::uint32_t>(bytes.data() + 8),
                      length = loadLittle<std::uint32_t>(bytes.data() + 12);
  if (fileLength > bytes.size())
    throw Error(ErrorKind::truncated, name,
                fmt::format("has {} bytes, but its header says {}", bytes.size(), fileLength));
  if (length > bytes.size() - headerBytes)
    throw Error(ErrorKind::truncated, name, "the JSON is longer than what is left of the file");
  Json json = gltf::parseJson(asText(bytes.subspan(headerBytes, length)), name);
  const ByteSpan body = bytes.subspan(headerBytes + length);
  inlineBufferViews(json, "images", body, name);
  inlineBufferViews(json, "shaders", body, name);
  if (const auto buffers = json.find("buffers"); buffers != json.end() && buffers->is_object())
    if (const auto own = buffers->find("binary_glTF"); own != buffers->end() && own->is_object())
      (*own)["uri"] = dataUrlOf(body, "application/octet-stream");
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Imported readGltf1(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  const std::string ofGlb = isGlb(bytes) ? jsonOfGlb1(bytes, name) : std::string();
  const ByteSpan json = isGlb(bytes) ? asBytes(ofGlb) : bytes;
  Imported imported = readByAssimp(json, name, options, ".gltf");
  // Assimp 5.2 reads none of glTF 1.0, and does not say so.
  const bool hasSensor = std::ranges::any_of(
      imported.scene.graph.nodes, [](const Node& node) { return std::holds_alternative<TimeSensor>(node.content); });
  if (const std::size_t animations = animationsIn(asText(json)); animations > 0 && !hasSensor)
    imported.warnings.push_back(fmt::format("{} not carried over: those of glTF 1.0 are not read.",
                                            counted(animations, "animation is", "animations are")));
  return imported;
}

} // namespace imgeo
