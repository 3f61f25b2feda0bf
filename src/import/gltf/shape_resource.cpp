#include "import/gltf/shape_resource.h"

#include "import/gltf/gltf1.h"
#include "import/gltf/primitive.h"
#include "import/import.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace imgeo::gltf {

namespace {

constexpr std::uint32_t defaultIndexType = 5123; ///< unsigned short

/// Names of attributes that glTF 2.0 would read in another way: colours as linear, v of texture coordinates downwards.
constexpr const char *storedColor = "_COLOR", *storedTexCoord = "_TEXCOORD";

struct Container {
  std::string_view json;
  ByteSpan body;
};

/// The header's JSON and the bytes after it. Both layouts begin with a magic number and a version.
Container containerOf(ByteSpan bytes, const std::string& name) {
  const bool isGltf = isGlb(bytes);
  const std::size_t fixedBytes = isGltf ? 20 : 12;
  if (bytes.size() < fixedBytes)
    throw Error(ErrorKind::truncated, name, fmt::format("a container has a header of at least {} bytes", fixedBytes));
  const auto word = [&](std::size_t index) { return loadLittle<std::uint32_t>(bytes.data() + 4 * index); };
  if (isGltf && word(1) != 1)
    throw Error(ErrorKind::unsupported, name, fmt::format("is glTF {}, which an Inline can name", word(1)));
  if (isGltf && word(2) > bytes.size())
    throw Error(ErrorKind::truncated, name, fmt::format("has {} bytes, but its header says {}", bytes.size(), word(2)));
  // glTF: magic, version, length of the file, length of the JSON, its format (0). Before: magic, version, length of the
  // JSON.
  const std::uint32_t jsonBytes = word(isGltf ? 3 : 2);
  if (jsonBytes == 0 || jsonBytes > bytes.size() - fixedBytes)
    throw Error(jsonBytes == 0 ? ErrorKind::malformed : ErrorKind::truncated, name,
                fmt::format("has a header of {} bytes, where {} follow", jsonBytes, bytes.size() - fixedBytes));
  if (isGltf && word(4) != 0)
    throw Error(ErrorKind::unsupported, name, "has a header that is no JSON");
  const ByteSpan body = bytes.subspan(fixedBytes + jsonBytes);
  return {asText(bytes.subspan(fixedBytes, jsonBytes)), body};
}

/// A range of bytes of the buffer.
struct Range {
  std::uint64_t offset = 0, length = 0;
};

/// Writes a container as glTF 2.0, whose readers then do the rest: names become indices, and each accessor gets a view
/// of its own, where glTF 2.0 has the stride.
class Upgrade {
public:
  Upgrade(const Value& root, ByteSpan body)
      : root_(root), hasViewsOfItsOwn_(root["accessors"].has("attributeViews")), buffer_(body.begin(), body.end()),
        bodyBytes_(body.size()), joinableBytes_(body.size()) {
    result_ = {{"asset", {{"version", "2.0"}}},
               {"buffers", {Json::object()}},
               {"bufferViews", Json::array()},
               {"accessors", Json::array()},
               {"meshes", Json::array()}};
  }

  void addMesh(const std::string& key) {
    const Value mesh = member(root_["meshes"], key);
    Json primitives = Json::array();
    if (hasViewsOfItsOwn_)
      primitives.push_back(primitiveOf(mesh));
    for (std::size_t i = 0; !hasViewsOfItsOwn_ && i < mesh["primitives"].size(); ++i)
      primitives.push_back(primitiveOf(mesh["primitives"][i]));
    result_["meshes"].push_back({{"name", key}, {"primitives", std::move(primitives)}});
  }

  /// The bytes of a view.
  ByteSpan bytesOf(const std::string& view) {
    const Range range = rangeOf(view);
    return ByteSpan(buffer_).subspan(range.offset, range.length);
  }

  const Json& json() const { return result_; }
  const Bytes& buffer() const { return buffer_; }
  /// The material of a primitive, by mesh and primitive; "" for none.
  static std::string materialOf(const Value& primitive) { return primitive["extras"].text(); }

private:
  static Value member(const Value& object, const std::string& key) {
    if (!object.has(key.c_str()))
      object.fail(ErrorKind::malformed, fmt::format("has no \"{}\"", key));
    return object[key.c_str()];
  }

  Json primitiveOf(const Value& from) {
    const Value names = from["attributes"];
    if (!names.json().is_object())
      names.fail(ErrorKind::malformed, "is missing");
    Json attributes = Json::object();
    for (const auto& [name, unused] : names.json().items())
      if (const char* known = attributeNamed(name))
        attributes[known] = accessor(attributeViews(), names[name.c_str()].text(), known);
    Json primitive{{"attributes", std::move(attributes)}};
    // "primitive" is the name in SRC and in drafts of glTF 1.0.
    primitive["mode"] = from.has("mode") ? from["mode"].whole() : from["primitive"].whole(4);
    if (const std::string indices = from["indices"].text(); !indices.empty())
      primitive["indices"] =
          accessor(hasViewsOfItsOwn_ ? root_["accessors"]["indexViews"] : attributeViews(), indices, "");
    primitive["extras"] = from["material"].text();
    return primitive;
  }

  static const char* attributeNamed(std::string_view name) {
    static constexpr std::pair<std::string_view, const char*> known[] = {
        {"POSITION", "POSITION"}, {"NORMAL", "NORMAL"},     {"TEXCOORD_0", storedTexCoord},
        {"COLOR", storedColor},   {"COLOR_0", storedColor}, {"position", "POSITION"},
        {"normal", "NORMAL"},     {"color", storedColor},   {"texcoord", storedTexCoord},
    };
    const auto* found = std::ranges::find(known, name, &std::pair<std::string_view, const char*>::first);
    return found == std::end(known) ? nullptr : found->second;
  }

  Value attributeViews() const { return hasViewsOfItsOwn_ ? root_["accessors"]["attributeViews"] : root_["accessors"]; }

  /// The index of an accessor in the result, for an attribute or, without a name, for indices.
  std::size_t accessor(const Value& accessors, const std::string& key, const std::string& attribute) {
    const auto [found, isNew] = accessors_.try_emplace(attribute + '/' + key, result_["accessors"].size());
    if (!isNew)
      return found->second;
    const Value from = member(accessors, key);
    requirePlain(from);
    const Range range = rangeOf(from["bufferView"].text());
    const std::uint64_t offset = from["byteOffset"].whole(0), stride = from["byteStride"].whole(0);
    if (offset > range.length)
      from["byteOffset"].fail(ErrorKind::truncated, fmt::format("is behind the {} bytes of its view", range.length));
    Json view{{"buffer", 0}, {"byteOffset", range.offset + offset}, {"byteLength", range.length - offset}};
    if (stride > 0)
      view["byteStride"] = stride;
    result_["bufferViews"].push_back(std::move(view));
    Json to{{"bufferView", result_["bufferViews"].size() - 1},
            {"componentType", from["componentType"].whole(attribute.empty() ? defaultIndexType : 0)},
            {"count", from["count"].whole()},
            {"type", attribute.empty() ? "SCALAR" : from["type"].text()}};
    to["normalized"] = attribute == storedColor; // X3DOM would draw a byte of 255 as 255 times white
    result_["accessors"].push_back(std::move(to));
    return found->second;
  }

  /// Refuses numbers that are stored in another way than X3DOM draws them.
  static void requirePlain(const Value& accessor) {
    for (const char* extension : {"WEB3D_quantized_attributes", "EXT_quantized_attributes"})
      if (accessor["extensions"].has(extension))
        accessor.fail(ErrorKind::unsupported, fmt::format("has {}, which X3DOM does not draw", extension));
    const auto isOnly = [&](const char* field, double value) {
      const Value numbers = accessor[field];
      for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i].real(value) != value)
          numbers.fail(ErrorKind::unsupported, "changes the numbers, which X3DOM does not draw");
    };
    isOnly("decodeOffset", 0);
    isOnly("decodeScale", 1);
  }

  Range rangeOf(const std::string& key) {
    if (const auto found = ranges_.find(key); found != ranges_.end())
      return found->second;
    const Value view = member(root_["bufferViews"], key);
    return ranges_[key] = hasViewsOfItsOwn_ ? rangeOfChunks(view) : checkedRange(view);
  }

  Range checkedRange(const Value& value) const {
    const Range range{value["byteOffset"].whole(0), value["byteLength"].whole()};
    if (range.offset > bodyBytes_ || range.length > bodyBytes_ - range.offset)
      value.fail(ErrorKind::truncated, fmt::format("needs {} bytes from byte {} on, where the container has {}",
                                                   range.length, range.offset, bodyBytes_));
    return range;
  }

  /// The range of one chunk, or of several, which are joined behind the container's own bytes.
  Range rangeOfChunks(const Value& view) {
    const Value chunks = view["chunks"];
    const auto chunk = [&](std::size_t i) { return checkedRange(member(root_["bufferChunks"], chunks[i].text())); };
    if (chunks.size() == 1)
      return chunk(0);
    Range joined{buffer_.size(), 0};
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      const Range range = chunk(i);
      if (range.length > joinableBytes_)
        view.fail(ErrorKind::limit, "joins more bytes than the container has");
      joinableBytes_ -= range.length;
      joined.length += range.length;
      buffer_.resize(buffer_.size() + range.length);
      std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(range.offset), range.length,
                  buffer_.end() - static_cast<std::ptrdiff_t>(range.length));
    }
    return joined;
  }

  const Value& root_;
  bool hasViewsOfItsOwn_; ///< the layout before glTF
  Bytes buffer_;
  std::uint64_t bodyBytes_, joinableBytes_;
  Json result_;
  std::map<std::string, Range> ranges_;          ///< by view
  std::map<std::string, std::size_t> accessors_; ///< by attribute and name
};

/// The names of the meshes to read, each once.
std::vector<std::string> meshesToRead(const Value& root, const std::string& mesh) {
  const Value meshes = root["meshes"], nodes = root["nodes"];
  std::vector<std::string> names;
  if (!mesh.empty()) {
    if (!meshes.has(mesh.c_str()))
      meshes.fail(ErrorKind::malformed, fmt::format("has no mesh \"{}\"", mesh));
    return {mesh};
  }
  const std::string scene = root["scene"].text();
  if (scene.empty() || !root["scenes"].has(scene.c_str())) {
    for (const auto& [name, unused] : meshes.json().items())
      names.push_back(name);
    return names;
  }
  std::set<std::string> seenNodes, seenMeshes;
  std::vector<Value> lists{root["scenes"][scene.c_str()]["nodes"]};
  while (!lists.empty()) {
    const Value list = lists.back();
    lists.pop_back();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string key = list[i].text();
      if (!seenNodes.insert(key).second || !nodes.has(key.c_str()))
        continue;
      const Value node = nodes[key.c_str()], ofNode = node["meshes"];
      for (std::size_t n = 0; n < ofNode.size(); ++n)
        if (std::string name = ofNode[n].text(); seenMeshes.insert(name).second)
          names.push_back(std::move(name));
      lists.push_back(node["children"]);
    }
  }
  return names;
}

/// Takes a named attribute out of a mesh; empty where it has none.
std::optional<NamedAttribute> taken(Mesh& mesh, const char* storedName) {
  const auto found = std::ranges::find(mesh.namedAttributes, storedName + 1, &NamedAttribute::name);
  if (found == mesh.namedAttributes.end())
    return {};
  NamedAttribute attribute = std::move(*found);
  mesh.namedAttributes.erase(found);
  return attribute;
}

/// Makes the stored colours and texture coordinates those of the mesh.
void readStored(Mesh& mesh, bool isUpsideDown, const Value& location) {
  if (const auto colors = taken(mesh, storedColor)) {
    if (colors->components != 3 && colors->components != 4)
      location.fail(ErrorKind::malformed, "has colors of the wrong number of components");
    for (std::size_t i = 0; i < colors->values.size(); i += colors->components) {
      const float* value = &colors->values[i];
      const float alpha = colors->components == 4 ? channelOf(value[3]) : 1;
      mesh.colors.emplace_back(channelOf(value[0]), channelOf(value[1]), channelOf(value[2]), alpha);
    }
    mesh.colorComponents = colors->components;
  }
  if (const auto texCoords = taken(mesh, storedTexCoord)) {
    if (texCoords->components != 2)
      location.fail(ErrorKind::malformed, "has texture coordinates of the wrong number of components");
    for (std::size_t i = 0; i < texCoords->values.size(); i += 2)
      mesh.texCoords.push_back(
          {texCoords->values[i], isUpsideDown ? 1 - texCoords->values[i + 1] : texCoords->values[i + 1]});
  }
}

void append(Mesh& mesh, const Mesh& more, const Value& location) {
  const std::size_t before = mesh.wedgeCount(), positions = mesh.positions.size();
  if (std::max(before + more.wedgeCount(), mesh.corners.size() + more.corners.size()) >
      std::numeric_limits<std::uint32_t>::max())
    location.fail(ErrorKind::limit, "has more vertices than 32 bits count");
  append(mesh, before, more, more.wedgeCount());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const std::uint32_t position : more.wedgePositions)
    mesh.wedgePositions.push_back(static_cast<std::uint32_t>(positions + position));
  for (const std::uint32_t corner : more.corners)
    mesh.corners.push_back(static_cast<std::uint32_t>(before + corner));
}

/// KHR_materials_common, or values of the same names in a material with a program of its own.
class Materials {
public:
  Materials(const Value& root, Upgrade& upgrade) : root_(root), upgrade_(upgrade) {}

  ResourceMaterial read(const std::string& key) {
    const Value material = root_["materials"][key.c_str()], common = material["extensions"]["KHR_materials_common"];
    const Value values = common.isAbsent() ? material["values"] : common["values"];
    ResourceMaterial result;
    result.name = key;
    // X3DOM draws CONSTANT in the emission alone, and LAMBERT without highlights.
    const std::string technique = common["technique"].text();
    result.material.diffuseColor = {0, 0, 0};
    if (technique != "CONSTANT")
      setColor(values["diffuse"], result.material.diffuseColor, TextureRole::color, result);
    if (technique != "CONSTANT" && technique != "LAMBERT")
      setColor(values["specular"], result.material.specularColor, TextureRole::specular, result);
    setColor(values["emission"], result.material.emissiveColor, TextureRole::emissive, result);
    if (values["shininess"].json().is_number()) // an exponent
      result.material.shininess = static_cast<float>(std::clamp(values["shininess"].real(0) / 128, 0.0, 1.0));
    // The extension calls 1 opaque, X3DOM 0.
    if (values["transparency"].json().is_number())
      result.material.transparency = static_cast<float>(std::clamp(values["transparency"].real(0), 0.0, 1.0));
    result.isSolid = !common["doubleSided"].boolean(false);
    return result;
  }

private:
  void setColor(const Value& value, Vec3f& color, TextureRole role, ResourceMaterial& material) {
    if (value.isAbsent())
      return;
    if (value.json().is_string()) {
      color = {1, 1, 1};
      if (std::optional<Bytes> image = imageOf(value.text()))
        material.images[role] = std::move(*image);
      return;
    }
    if (value.size() < 3)
      value.fail(ErrorKind::malformed, "has fewer than 3 numbers");
    const auto channel = [&](std::size_t i) { return static_cast<float>(std::clamp(value[i].real(0), 0.0, 1.0)); };
    color = {channel(0), channel(1), channel(2)};
  }

  /// The file of the image of a texture, if it is in the container.
  std::optional<Bytes> imageOf(const std::string& texture) {
    const std::string key = root_["textures"][texture.c_str()]["source"].text();
    const Value binary = root_["images"][key.c_str()]["extensions"]["KHR_binary_glTF"];
    if (binary.isAbsent())
      return {};
    const ByteSpan bytes = upgrade_.bytesOf(binary["bufferView"].text());
    return Bytes(bytes.begin(), bytes.end());
  }

  const Value& root_;
  Upgrade& upgrade_;
};

} // namespace

ShapeResource readShapeResource(ByteSpan bytes, const std::string& name, const std::string& mesh, bool withMaterials) {
  const Container container = containerOf(bytes, name);
  const Json json = parseJson(container.json, name);
  const Value root(json, name, ", ");
  Upgrade upgrade(root, container.body);
  for (const std::string& key : meshesToRead(root, mesh))
    upgrade.addMesh(key);

  const References references(ImportOptions{}, name); // everything is in the container
  Document document(upgrade.json(), upgrade.buffer(), references, name, bytes.size());
  const AttributeChoice stored{.all = false, .names = {storedColor + 1, storedTexCoord + 1}};
  PrimitiveReader primitives(document, stored, true);
  ShapeResource resource;
  std::map<std::string, std::size_t> materials;
  std::map<std::pair<std::string, Topology>, std::size_t> shapes; ///< by material and kind of element
  const Value meshes = document.array("meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t n = 0; n < meshes[i]["primitives"].size(); ++n) {
      const Value primitive = meshes[i]["primitives"][n];
      const Value location(primitive.json(), fmt::format("{}, mesh \"{}\"", name, meshes[i]["name"].text()));
      Mesh part;
      try {
        part = primitives.read(primitive, {}, 0);
      } catch (const Error& error) { // located in the JSON that the file does not have
        throw Error(error.kind(), location.location(), error.message());
      }
      readStored(part, withMaterials, location);
      const std::string material = withMaterials ? Upgrade::materialOf(primitive) : "";
      const auto [shape, isNew] = shapes.try_emplace({material, part.topology}, resource.shapes.size());
      if (isNew) {
        resource.shapes.push_back({});
        resource.shapes.back().mesh.topology = part.topology;
        resource.shapes.back().mesh.name = meshes[i]["name"].text();
      }
      append(resource.shapes[shape->second].mesh, part, location);
      if (!isNew || material.empty() || !root["materials"].has(material.c_str()))
        continue;
      const auto [found, isNewMaterial] = materials.try_emplace(material, resource.materials.size());
      if (isNewMaterial)
        resource.materials.push_back(Materials(root, upgrade).read(material));
      resource.shapes[shape->second].material = found->second;
    }
  return resource;
}

} // namespace imgeo::gltf
