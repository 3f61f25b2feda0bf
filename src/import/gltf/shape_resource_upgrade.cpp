#include "import/gltf/shape_resource_upgrade.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <utility>

namespace imgeo::gltf {

namespace {

constexpr std::uint32_t defaultIndexType = 5123; ///< unsigned short

Value member(const Value& object, const std::string& key) {
  if (!object.has(key.c_str()))
    object.fail(ErrorKind::malformed, fmt::format("has no \"{}\"", key));
  return object[key.c_str()];
}

const char* attributeNamed(std::string_view name) {
  static constexpr std::pair<std::string_view, const char*> known[] = {
      {"POSITION", "POSITION"}, {"NORMAL", "NORMAL"},     {"TEXCOORD_0", storedTexCoord},
      {"COLOR", storedColor},   {"COLOR_0", storedColor}, {"position", "POSITION"},
      {"normal", "NORMAL"},     {"color", storedColor},   {"texcoord", storedTexCoord},
  };
  const auto* found = std::ranges::find(known, name, &std::pair<std::string_view, const char*>::first);
  return found == std::end(known) ? nullptr : found->second;
}

/// Refuses numbers that are stored in another way than X3DOM draws them.
void requirePlain(const Value& accessor) {
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

} // namespace

ShapeResourceUpgrade::ShapeResourceUpgrade(const Value& root, ByteSpan body)
    : root_(root), hasViewsOfItsOwn_(root["accessors"].has("attributeViews")), buffer_(body.begin(), body.end()),
      bodyBytes_(body.size()), joinableBytes_(body.size()) {
  result_ = {{"asset", {{"version", "2.0"}}},
             {"buffers", {Json::object()}},
             {"bufferViews", Json::array()},
             {"accessors", Json::array()},
             {"meshes", Json::array()}};
}

void ShapeResourceUpgrade::addMesh(const std::string& key) {
  const Value mesh = member(root_["meshes"], key);
  Json primitives = Json::array();
  if (hasViewsOfItsOwn_)
    primitives.push_back(primitiveOf(mesh));
  for (std::size_t i = 0; !hasViewsOfItsOwn_ && i < mesh["primitives"].size(); ++i)
    primitives.push_back(primitiveOf(mesh["primitives"][i]));
  result_["meshes"].push_back({{"name", key}, {"primitives", std::move(primitives)}});
}

ByteSpan ShapeResourceUpgrade::bytesOf(const std::string& view) {
  const Range range = rangeOf(view);
  return ByteSpan(buffer_).subspan(range.offset, range.length);
}

std::string ShapeResourceUpgrade::materialOf(const Value& primitive) {
  return primitive["extras"].text();
}

Json ShapeResourceUpgrade::primitiveOf(const Value& from) {
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

Value ShapeResourceUpgrade::attributeViews() const {
  return hasViewsOfItsOwn_ ? root_["accessors"]["attributeViews"] : root_["accessors"];
}

/// The index of an accessor in the result, for an attribute or, without a name, for indices.
std::size_t ShapeResourceUpgrade::accessor(const Value& accessors, const std::string& key,
                                           const std::string& attribute) {
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

ShapeResourceUpgrade::Range ShapeResourceUpgrade::rangeOf(const std::string& key) {
  if (const auto found = ranges_.find(key); found != ranges_.end())
    return found->second;
  const Value view = member(root_["bufferViews"], key);
  return ranges_[key] = hasViewsOfItsOwn_ ? rangeOfChunks(view) : checkedRange(view);
}

ShapeResourceUpgrade::Range ShapeResourceUpgrade::checkedRange(const Value& value) const {
  const Range range{value["byteOffset"].whole(0), value["byteLength"].whole()};
  if (range.offset > bodyBytes_ || range.length > bodyBytes_ - range.offset)
    value.fail(ErrorKind::truncated, fmt::format("needs {} bytes from byte {} on, where the container has {}",
                                                 range.length, range.offset, bodyBytes_));
  return range;
}

/// The range of one chunk, or of several, which are joined behind the container's own bytes.
ShapeResourceUpgrade::Range ShapeResourceUpgrade::rangeOfChunks(const Value& view) {
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

} // namespace imgeo::gltf
