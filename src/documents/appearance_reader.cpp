#include "documents/appearance_reader.h"

#include "documents/appearance_names.h"
#include "documents/node_fields_reader.h"
#include "markup/find_x3d.h"

#include <algorithm>

namespace imgeo {

namespace {

bool isNamed(const pugi::xml_node& node, std::string_view name) {
  return equalIgnoringCase(node.name(), name);
}

void readProperties(const FieldReader& fields, Texture& texture) {
  texture.boundaryS = valueNamed<Boundary>(boundaryNames, fields.text("boundaryModeS")).value_or(Boundary::repeat);
  texture.boundaryT = valueNamed<Boundary>(boundaryNames, fields.text("boundaryModeT")).value_or(Boundary::repeat);
  setMagnificationFilter(texture, fields.text("magnificationFilter"));
  setMinificationFilter(texture, fields.text("minificationFilter"));
}

/// An extension of the kind with this index in MaterialExtension.
template <std::size_t kind = 0> MaterialExtension readExtension(std::size_t index, const FieldReader& fields) {
  if constexpr (kind + 1 < std::variant_size_v<MaterialExtension>)
    if (index != kind)
      return readExtension<kind + 1>(index, fields);
  return readNode<std::variant_alternative_t<kind, MaterialExtension>>(fields);
}

/// The name of the set of texture coordinates in a mapping as appearance_element.cpp writes it: "TEXCOORD_1.normal" and
/// "normal" name a transform, too.
std::string withoutRole(const std::string& mapping, TextureRole role) {
  const std::string name = nameOf(role), suffix = "." + name;
  return mapping == name ? "" : mapping.ends_with(suffix) ? mapping.substr(0, mapping.size() - suffix.size()) : mapping;
}

} // namespace

template <typename T>
const T* AppearanceReader::definitionOf(const FieldReader& fields, const std::map<std::string, T>& defined) const {
  const std::string use = fields.text("USE");
  if (use.empty())
    return nullptr;
  const auto found = defined.find(use);
  if (found != defined.end())
    return &found->second;
  fields.warnOrFail(std::string("USE names no ") + fields.node().name() + " that stands before", "it has its defaults");
  return nullptr;
}

std::size_t AppearanceReader::readTexture(const FieldReader& fields) {
  if (const std::size_t* index = definitionOf(fields, textures_))
    return *index;
  Texture texture;
  texture.name = fields.text("DEF");
  std::vector<std::string> urls = fields.strings("url");
  const auto [image, isNew] = images_.try_emplace(urls, graph_.images.size());
  if (isNew && urls.empty())
    urls.emplace_back();
  if (isNew)
    graph_.images.push_back({urls[0], {}, fields.text("preview"), {urls.begin() + 1, urls.end()}});
  texture.image = image->second;
  if (!fields.boolean("repeatS", true))
    texture.boundaryS = Boundary::clamp;
  if (!fields.boolean("repeatT", true))
    texture.boundaryT = Boundary::clamp;
  for (const pugi::xml_node& child : fields.node().children())
    if (isNamed(child, "TextureProperties"))
      readProperties(fieldsOf(child), texture);
  graph_.textures.push_back(texture);
  if (!texture.name.empty())
    textures_[texture.name] = graph_.textures.size() - 1;
  return graph_.textures.size() - 1;
}

template <typename Node>
void AppearanceReader::readTextures(const FieldReader& fields, const Node& owner, DefinedMaterial& read) {
  for (const pugi::xml_node& child : fields.node().children()) {
    if (!isNamed(child, "ImageTexture"))
      continue;
    const FieldReader texture = fieldsOf(child);
    const std::string field = texture.text("containerField");
    for (std::size_t i = 0; i < textureRoleNames.size(); ++i) {
      const auto role = static_cast<TextureRole>(i);
      const std::string name = textureField(owner, role);
      const auto isRole = [role](const TextureUse& use) { return use.role == role; };
      if (name.empty() || !equalIgnoringCase(name, field) || std::ranges::any_of(read.textures, isRole))
        continue;
      read.textures.push_back({role, readTexture(texture), {}});
      read.mappings[nameOf(role)] = fields.text((name + "Mapping").c_str());
    }
  }
}

/// Reads the extensions among a PhysicalMaterial's children; of several of a kind, the first.
void AppearanceReader::readExtensions(const FieldReader& fields, DefinedMaterial& read) {
  std::array<std::optional<MaterialExtension>, materialExtensionNames.size()> byKind;
  for (const pugi::xml_node& child : fields.node().children())
    for (std::size_t kind = 0; kind < byKind.size(); ++kind)
      if (!byKind[kind] && isNamed(child, materialExtensionNames[kind])) {
        byKind[kind] = readExtension(kind, fieldsOf(child));
        readTextures(fieldsOf(child), *byKind[kind], read);
      }
  for (const std::optional<MaterialExtension>& extension : byKind)
    if (extension)
      std::get<PhysicalMaterial>(read.material).extensions.push_back(*extension);
}

AppearanceReader::DefinedMaterial AppearanceReader::readMaterial(const FieldReader& fields) {
  if (const DefinedMaterial* defined = definitionOf(fields, materials_))
    return *defined;
  DefinedMaterial read;
  if (isNamed(fields.node(), "Material"))
    read.material = readNode<Material>(fields);
  else if (isNamed(fields.node(), "PhysicalMaterial"))
    read.material = readNode<PhysicalMaterial>(fields);
  else
    read.material = readNode<UnlitMaterial>(fields);
  readTextures(fields, read.material, read);
  if (std::holds_alternative<PhysicalMaterial>(read.material))
    readExtensions(fields, read);
  if (const std::string def = fields.text("DEF"); !def.empty())
    materials_[def] = read;
  return read;
}

/// Adds transforms by the name of their mapping, which is "" for a transform without one.
void AppearanceReader::readTransforms(const FieldReader& fields,
                                      std::map<std::string, TextureTransform>& transforms) const {
  if (isNamed(fields.node(), "TextureTransform"))
    transforms[fields.text("mapping")] = readNode<TextureTransform>(fields);
  if (isNamed(fields.node(), "MultiTextureTransform"))
    for (const pugi::xml_node& child : fields.node().children())
      if (isNamed(child, "TextureTransform"))
        readTransforms(fieldsOf(child), transforms);
}

std::size_t AppearanceReader::read(const pugi::xml_node& node) {
  const FieldReader fields = fieldsOf(node);
  if (const std::size_t* index = definitionOf(fields, appearances_))
    return *index;
  Appearance appearance;
  appearance.name = fields.text("DEF");
  appearance.alphaMode = valueNamed<AlphaMode>(alphaModeNames, fields.text("alphaMode")).value_or(AlphaMode::automatic);
  appearance.alphaCutoff = fields.real("alphaCutoff", 0.5f);

  DefinedMaterial material;
  bool hasMaterial = false;
  std::map<std::string, TextureTransform> transforms;
  std::optional<std::size_t> colorTexture;
  for (const pugi::xml_node& child : node.children()) {
    const FieldReader childFields = fieldsOf(child);
    if (isNamed(child, "Material") || isNamed(child, "PhysicalMaterial") || isNamed(child, "UnlitMaterial"))
      material = readMaterial(childFields), hasMaterial = true;
    else if (isNamed(child, "ImageTexture"))
      colorTexture = readTexture(childFields);
    else
      readTransforms(childFields, transforms);
  }
  const auto isColor = [](const TextureUse& use) { return use.role == TextureRole::color; };
  if (colorTexture && std::ranges::none_of(material.textures, isColor))
    material.textures.insert(material.textures.begin(), {TextureRole::color, *colorTexture, {}});
  for (TextureUse& use : material.textures) {
    const std::string& mapping = material.mappings[nameOf(use.role)];
    const auto found = transforms.contains(mapping) ? transforms.find(mapping) : transforms.find("");
    if (found != transforms.end())
      use.transform = found->second;
    use.mapping = withoutRole(mapping, use.role);
  }
  appearance.material = material.material;
  appearance.textures = std::move(material.textures);
  graph_.appearances.push_back(std::move(appearance));
  const std::size_t index = graph_.appearances.size() - 1;
  if (!hasMaterial)
    withoutMaterial_.insert(index);
  if (const std::string& def = graph_.appearances[index].name; !def.empty())
    appearances_[def] = index;
  return index;
}

std::size_t AppearanceReader::unlit(std::optional<std::size_t> appearance, bool hasVertexColors) {
  const auto [found, isNew] = unlit_.try_emplace({appearance, hasVertexColors}, graph_.appearances.size());
  if (!isNew)
    return found->second;
  Appearance changed = appearance ? graph_.appearances[*appearance] : Appearance{};
  changed.name.clear();
  std::erase_if(changed.textures, [](const TextureUse& use) { return use.role != TextureRole::color; });
  UnlitMaterial material = std::visit(
      [](const auto& given) {
        return UnlitMaterial{given.emissiveColor, given.transparency};
      },
      changed.material);
  if (!changed.textures.empty() || hasVertexColors || !appearance || withoutMaterial_.contains(*appearance))
    material.emissiveColor = {1, 1, 1};
  changed.material = material;
  graph_.appearances.push_back(std::move(changed));
  return found->second;
}

} // namespace imgeo
