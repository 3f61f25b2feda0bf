#include "import/chunks/glb_text.h"

#include <cmath>
#include <optional>
#include <utility>

namespace imgeo {

using namespace gltf;

namespace {

constexpr const char *accessorsName = "accessors", *viewsName = "bufferViews", *buffersName = "buffers";

/// An index as Value::index() takes it.
std::optional<std::size_t> indexOf(const Json& value, std::size_t size) {
  const double number = value.is_number() ? value.get<double>() : -1;
  if (!(number >= 0 && number < static_cast<double>(size) && number == std::floor(number)))
    return {};
  return static_cast<std::size_t>(number);
}

/// A member of an object, or null.
const Json& memberOf(const Json& value, const char* name) {
  static const Json absent;
  const auto found = value.is_object() ? value.find(name) : value.end();
  return value.is_object() && found != value.end() ? *found : absent;
}

void truncate(Json& array, std::size_t size) {
  if (array.is_array() && array.size() > size)
    array.get_ref<Json::array_t&>().resize(size);
}

} // namespace

GlbText::GlbText(std::string_view json, const std::string& name) {
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  checkJson(json, name);
  if (json.starts_with(byteOrderMark))
    json.remove_prefix(byteOrderMark.size());
  for (JsonMember& member : membersOf(json)) {
    Array* array = member.name == accessorsName ? &accessors_ : member.name == viewsName ? &views_ : nullptr;
    if (array) { // of members of one name the last counts
      *array = {};
      std::erase_if(others_, [&](const JsonMember& other) { return other.name == member.name; });
    }
    if (array && member.value.starts_with('['))
      *array = {member.value, JsonElements(member.value)};
    else
      others_.push_back(std::move(member));
  }
}

Json GlbText::objectOf(const std::vector<JsonMember>& members) const {
  Json object = Json::object();
  for (const auto& [array, name] : {std::pair(&accessors_, accessorsName), std::pair(&views_, viewsName)})
    if (!array->text.empty())
      object[name] = Json::array_t(array->elements.size());
  for (const JsonMember& member : members)
    object[member.name] = Json::parse(member.value);
  return object;
}

Json GlbText::withoutAccessors() const {
  std::vector<JsonMember> members;
  for (const JsonMember& member : others_)
    if (member.name == buffersName || member.name == accessorsName || member.name == viewsName)
      members.push_back(member);
  return objectOf(members);
}

Json GlbText::document() const {
  Json document = objectOf(others_);
  Added added;
  for (const Json& image : memberOf(document, "images"))
    addView(memberOf(image, "bufferView"), document, added);
  for (const Json& animation : memberOf(document, "animations"))
    for (const Json& sampler : memberOf(animation, "samplers"))
      for (const char* end : {"input", "output"})
        addAccessor(memberOf(sampler, end), document, added);
  for (const Json& node : memberOf(document, "nodes")) {
    const Json& instancing = memberOf(memberOf(node, "extensions"), "EXT_mesh_gpu_instancing");
    for (const Json& attribute : memberOf(instancing, "attributes"))
      addAccessor(attribute, document, added);
  }
  return document;
}

GlbText::Added GlbText::addAccessorsOf(const Json& primitive, Json& document) const {
  Added added;
  for (const Json& attribute : memberOf(primitive, "attributes"))
    addAccessor(attribute, document, added);
  addAccessor(memberOf(primitive, "indices"), document, added);
  return added;
}

void GlbText::removeAccessors(const Added& added, Json& document) const {
  for (const std::size_t accessor : added.accessors)
    document[accessorsName][accessor] = nullptr;
  for (const std::size_t view : added.views)
    document[viewsName][view] = nullptr;
  truncate(document[accessorsName], accessors_.elements.size());
  truncate(document[viewsName], views_.elements.size());
}

void GlbText::addAccessor(const Json& value, Json& document, Added& added) const {
  const std::optional<std::size_t> index = indexOf(value, accessors_.elements.size());
  if (!index)
    return;
  Json& accessor = document[accessorsName][*index];
  if (!accessor.is_null())
    return;
  accessor = Json::parse(accessors_.elements[*index]);
  added.accessors.push_back(*index);
  addView(memberOf(accessor, "bufferView"), document, added);
}

void GlbText::addView(const Json& value, Json& document, Added& added) const {
  const std::optional<std::size_t> index = indexOf(value, views_.elements.size());
  if (!index || !document[viewsName][*index].is_null())
    return;
  document[viewsName][*index] = Json::parse(views_.elements[*index]);
  added.views.push_back(*index);
}

std::vector<std::vector<std::string_view>> GlbText::primitives() const {
  std::vector<std::vector<std::string_view>> primitives;
  for (const JsonMember& member : others_) {
    if (member.name != "meshes")
      continue;
    primitives.clear(); // of members of one name the last counts
    for (const std::string_view mesh : elementsOf(member.value)) {
      primitives.emplace_back();
      for (const JsonMember& ofMesh : membersOf(mesh))
        if (ofMesh.name == "primitives")
          primitives.back() = elementsOf(ofMesh.value);
    }
  }
  return primitives;
}

PrimitiveDocument::PrimitiveDocument(const GlbText& text, ByteSpan binary, const References& references,
                                     const std::string& name, std::uint64_t sourceBytes)
    : text_(text), json_(text.withoutAccessors()), bufferCount_(memberOf(json_, buffersName).size()),
      document_(json_, binary, references, name, sourceBytes) {}

void PrimitiveDocument::enter(const Json& primitive) {
  text_.removeAccessors(added_, json_);
  truncate(json_[buffersName], bufferCount_);
  added_ = text_.addAccessorsOf(primitive, json_);
}

void PrimitiveDocument::addBuffer(Bytes bytes) {
  document_.setBuffer(json_[buffersName].size(), std::move(bytes));
  json_[buffersName].push_back(Json::object());
}

} // namespace imgeo
