#include "import/assimp/materials.h"

#include "base/error.h"
#include "import/assimp/library.h"
#include "import/mesh/texcoord_mapping.h"
#include "import/warnings.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo {

namespace {

struct Role {
  aiTextureType type;
  TextureRole role;
};

constexpr Role roleTable[] = {
    {aiTextureType_DIFFUSE, TextureRole::color},     {aiTextureType_EMISSIVE, TextureRole::emissive},
    {aiTextureType_NORMALS, TextureRole::normal},    {aiTextureType_AMBIENT, TextureRole::ambient},
    {aiTextureType_SPECULAR, TextureRole::specular}, {aiTextureType_SHININESS, TextureRole::shininess}};

Vec3f colorOf(const aiMaterial& material, const char* key, unsigned type, unsigned index, Vec3f fallback) {
  aiColor4D color;
  if (assimp().getMaterialColor(&material, key, type, index, &color) != aiReturn_SUCCESS)
    return fallback;
  const auto channel = [](float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

float numberOf(const aiMaterial& material, const char* key, unsigned type, unsigned index, float fallback) {
  ai_real number = fallback;
  const bool isPresent = assimp().getMaterialFloats(&material, key, type, index, &number, nullptr) == aiReturn_SUCCESS;
  return isPresent && std::isfinite(number) ? number : fallback;
}

Boundary boundaryOf(aiTextureMapMode mode) {
  return mode == aiTextureMapMode_Mirror                                    ? Boundary::mirroredRepeat
         : mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? Boundary::clamp
                                                                            : Boundary::repeat;
}

/// The index of an embedded texture, whose path is "*3"; empty for other paths.
std::optional<std::size_t> embeddedIndex(const std::string& path) {
  std::size_t index = 0;
  if (!path.starts_with('*'))
    return {};
  const auto [end, fault] = std::from_chars(path.data() + 1, path.data() + path.size(), index);
  return fault == std::errc{} && end == path.data() + path.size() ? std::optional(index) : std::nullopt;
}

/// Whether the writer of a COLLADA document counts transparency from 0, opaque, upwards, as several exporters do. By
/// the specification (COLLADA 1.4.1, "transparent") 1 is opaque, and so the materials that these exporters write as
/// opaque would be invisible: the document is read in their way where most of the materials that state a transparency
/// would be.
bool countsTransparencyFromOpaque(const aiScene& source, std::string_view extension) {
  if (extension != "dae")
    return false;
  std::size_t invisible = 0, others = 0;
  constexpr float unstated = -1;
  for (unsigned i = 0; i < source.mNumMaterials; ++i) {
    const float opacity = numberOf(*source.mMaterials[i], AI_MATKEY_OPACITY, unstated);
    invisible += opacity == 0;
    others += opacity > 0;
  }
  return invisible > others;
}

/// Whether a format's viewers multiply all light by the texture, emission included (fixed-function OpenGL and
/// Direct3D). An untextured emissiveColor would wash the texture out.
bool multipliesAllLight(std::string_view extension) {
  constexpr std::string_view extensions[] = {"3ds", "ac", "acc", "ase", "lwo", "lws", "ms3d", "x"};
  return std::ranges::find(extensions, extension) != std::end(extensions);
}

/// Uses the colour texture as the emissive texture too, where the appearance has no other.
void useColorTextureAsEmissive(Appearance& appearance) {
  const Material* material = std::get_if<Material>(&appearance.material);
  const auto color = std::ranges::find(appearance.textures, TextureRole::color, &TextureUse::role);
  const bool hasOwn =
      std::ranges::find(appearance.textures, TextureRole::emissive, &TextureUse::role) != appearance.textures.end();
  if (!material || material->emissiveColor == Vec3f{} || color == appearance.textures.end() || hasOwn)
    return;
  TextureUse glow = *color;
  glow.role = TextureRole::emissive;
  appearance.textures.push_back(glow);
}

} // namespace

AssimpMaterials::AssimpMaterials(const aiScene& source, SceneGraph& graph, const References& references,
                                 std::string_view extension)
    : source_(source), graph_(graph), references_(references), images_(graph),
      invertsTransparency_(countsTransparencyFromOpaque(source, extension)),
      colorTextureIsEmissive_(multipliesAllLight(extension)) {}

AnyMaterial AssimpMaterials::materialOf(const aiMaterial& material) const {
  Material phong;
  phong.diffuseColor = colorOf(material, AI_MATKEY_COLOR_DIFFUSE, phong.diffuseColor);
  phong.specularColor = colorOf(material, AI_MATKEY_COLOR_SPECULAR, phong.specularColor) *
                        std::clamp(numberOf(material, AI_MATKEY_SHININESS_STRENGTH, 1), 0.0f, 1.0f);
  phong.emissiveColor = colorOf(material, AI_MATKEY_COLOR_EMISSIVE, phong.emissiveColor);
  phong.shininess = std::clamp(numberOf(material, AI_MATKEY_SHININESS, 128 * phong.shininess) / 128, 0.0f, 1.0f);
  phong.transparency = transparencyOf(material);
  return phong;
}

float AssimpMaterials::transparencyOf(const aiMaterial& material) const {
  const float opacity = std::clamp(numberOf(material, AI_MATKEY_OPACITY, invertsTransparency_ ? 0 : 1), 0.0f, 1.0f);
  return invertsTransparency_ ? opacity : 1 - opacity;
}

/// The bytes of a texture's file. Absolute paths of the authoring machine do not exist here, so the file's name is
/// tried in the source's folder too.
Bytes AssimpMaterials::bytesOf(const std::string& path) const {
  if (const aiTexture* texture = source_.GetEmbeddedTexture(path.c_str())) {
    if (texture->mHeight != 0)
      throw Error(ErrorKind::unsupported, path, "is an image without a file format");
    const auto* begin = reinterpret_cast<const std::uint8_t*>(texture->pcData);
    return Bytes(begin, begin + texture->mWidth);
  }
  std::string url = path;
  std::ranges::replace(url, '\\', '/');
  const bool isWindowsPath = url.size() > 1 && url[1] == ':';
  if (!isWindowsPath) {
    try {
      return references_.fetch(url);
    } catch (const Error&) {
      if (url.find('/') == url.npos)
        throw;
    }
  }
  return references_.fetch(url.substr(url.rfind('/') + 1));
}

std::optional<std::size_t> AssimpMaterials::image(const std::string& path) {
  return images_.index(path, path, [&] { return ImageFile{embeddedIndex(path) ? "" : path, bytesOf(path)}; });
}

void AssimpMaterials::addTexture(const aiMaterial& material, aiTextureType type, TextureRole role,
                                 Appearance& appearance) {
  aiString path;
  aiTextureMapping mapping = aiTextureMapping_UV;
  unsigned texCoords = 0;
  aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  if (assimp().getMaterialTextureCount(&material, type) == 0 ||
      assimp().getMaterialTexture(&material, type, 0, &path, &mapping, &texCoords, nullptr, nullptr, modes, nullptr) !=
          aiReturn_SUCCESS)
    return;
  if (mapping != aiTextureMapping_UV) {
    ++others_["with computed texture coordinates"];
    return;
  }
  const std::optional<std::size_t> image = this->image(path.C_Str());
  if (!image)
    return;
  Texture texture;
  texture.image = *image;
  texture.boundaryS = boundaryOf(modes[0]);
  texture.boundaryT = boundaryOf(modes[1]);
  const auto found = std::ranges::find(graph_.textures, texture);
  const auto index = static_cast<std::size_t>(found - graph_.textures.begin());
  if (found == graph_.textures.end())
    graph_.textures.push_back(texture);
  appearance.textures.push_back({role, index, {}, mappingOf(texCoords)});
}

std::optional<std::size_t> AssimpMaterials::appearance(unsigned index) {
  const auto [found, isNew] = appearances_.try_emplace(index);
  if (!isNew || index >= source_.mNumMaterials)
    return found->second;
  const aiMaterial& material = *source_.mMaterials[index];
  Appearance appearance;
  aiString name;
  assimp().getMaterialString(&material, AI_MATKEY_NAME, &name);
  appearance.name = name.C_Str();
  if (appearance.name == AI_DEFAULT_MATERIAL_NAME)
    return {};
  appearance.material = materialOf(material);
  for (const Role& role : roleTable)
    addTexture(material, role.type, role.role, appearance);
  if (colorTextureIsEmissive_)
    useColorTextureAsEmissive(appearance);
  const auto isCarried = [](int type) {
    return std::ranges::any_of(roleTable, [type](const Role& role) { return role.type == type; });
  };
  for (int type = 1; type <= AI_TEXTURE_TYPE_MAX; ++type)
    if (!isCarried(type) && assimp().getMaterialTextureCount(&material, static_cast<aiTextureType>(type)) > 0)
      ++others_[assimp().textureTypeToString(static_cast<aiTextureType>(type))];
  // Some of Assimp's importers make a separate material for every mesh.
  const auto same = std::ranges::find(graph_.appearances, appearance);
  found->second = static_cast<std::size_t>(same - graph_.appearances.begin());
  if (same == graph_.appearances.end())
    graph_.appearances.push_back(std::move(appearance));
  return found->second;
}

bool AssimpMaterials::isSolid(unsigned index) const {
  int isTwoSided = 0;
  if (index < source_.mNumMaterials)
    assimp().getMaterialIntegers(source_.mMaterials[index], AI_MATKEY_TWOSIDED, &isTwoSided, nullptr);
  return isTwoSided == 0;
}

void AssimpMaterials::addWarnings(std::vector<std::string>& warnings) const {
  if (invertsTransparency_)
    warnings.push_back("Most materials with a transparency would be invisible by COLLADA's rule, so transparency 0 is "
                       "read as opaque.");
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : others_)
    kinds.push_back(fmt::format("{} ({})", kind, count));
  if (!kinds.empty())
    warnings.push_back(fmt::format("Textures that are not carried over: {}.", fmt::join(kinds, ", ")));
}

} // namespace imgeo
