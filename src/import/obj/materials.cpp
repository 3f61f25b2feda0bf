#include "import/obj/materials.h"

#include "base/error.h"
#include "import/text/line_ends.h"
#include "import/text/text_scanner.h"
#include "import/warnings.h"
#include "scene/color.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <optional>

namespace imgeo {

namespace {

/// Statements that are skipped without a warning.
const std::set<std::string_view> ignoredStatements{"Ka", "illum", "Tf", "Ni", "sharpness"};

float saturate(float value) {
  return value > 0 ? std::min(value, 1.0f) : 0.0f;
}

Vec3f readColor(TextScanner& scanner) {
  scanner.skipBlanks();
  const float red = scanner.float32("a colour");
  scanner.skipBlanks();
  if (scanner.atLineEnd())
    return {saturate(red), saturate(red), saturate(red)};
  const float green = scanner.float32("a colour");
  scanner.skipBlanks();
  return {saturate(red), saturate(green), saturate(scanner.float32("a colour"))};
}

float readNumber(TextScanner& scanner) {
  scanner.skipBlanks();
  return scanner.float32("a number");
}

Vec3f linearOf(Vec3f color) {
  const auto linear = [](float value) { return static_cast<float>(linearOfSrgb(value)); };
  return {linear(color.x), linear(color.y), linear(color.z)};
}

} // namespace

void ObjMaterials::readLibrary(const std::string& files) {
  std::vector<std::string> missing;
  const auto isRead = [&](const std::string& file) {
    try {
      readFile(file);
      return true;
    } catch (const Error& error) {
      missing.push_back(fmt::format("Materials are left out: {}.", error.what()));
      return false;
    }
  };
  if (isRead(files)) // one file, whose name may contain blanks
    return;
  std::size_t readFiles = 0;
  for (std::size_t at = 0; at < files.size();) {
    const std::size_t end = std::min(files.find(' ', at), files.size());
    if (end > at && end - at < files.size())
      readFiles += isRead(files.substr(at, end - at));
    at = end + 1;
  }
  // Where none of several can be read, the blanks are those of one name.
  if (readFiles > 0)
    missing.erase(missing.begin());
  else
    missing.resize(1);
  std::ranges::copy(missing, std::back_inserter(missingLibraries_));
}

void ObjMaterials::readFile(const std::string& file) {
  std::string url = file;
  std::ranges::replace(url, '\\', '/');
  Bytes bytes = references_.fetch(url);
  if (std::optional<Bytes> text = withLineFeeds(bytes))
    bytes = *std::move(text);
  const std::string folder = url.substr(0, url.rfind('/') + 1); // npos + 1 is 0
  Definition* definition = nullptr;
  for (TextScanner scanner(bytes, file); !scanner.atEnd(); scanner.skipLine()) {
    scanner.skipBlanks();
    TextScanner line = scanner;
    if (line.word() == "newmtl") {
      line.skipBlanks();
      definition = &definitions_[std::string(line.restOfLine())];
    } else if (definition && !line.atLineEnd()) {
      readStatement(scanner, *definition, folder);
    }
  }
}

void ObjMaterials::readStatement(TextScanner& scanner, Definition& definition, const std::string& folder) {
  static const std::map<std::string_view, TextureRole> maps{
      {"map_Kd", TextureRole::color},     {"map_Ks", TextureRole::specular}, {"map_Ke", TextureRole::emissive},
      {"map_Ns", TextureRole::shininess}, {"norm", TextureRole::normal},     {"map_Ka", TextureRole::ambient}};
  const std::string keyword(scanner.word());
  Material& material = definition.material;
  if (keyword.empty() || keyword.front() == '#')
    return;
  if (keyword == "Kd")
    material.diffuseColor = readColor(scanner);
  else if (keyword == "Ks")
    material.specularColor = readColor(scanner);
  else if (keyword == "Ke")
    material.emissiveColor = readColor(scanner);
  else if (keyword == "Ns")
    material.shininess = saturate(readNumber(scanner) / 128);
  else if (keyword == "d")
    material.transparency = 1 - saturate(readNumber(scanner));
  else if (keyword == "Tr")
    material.transparency = saturate(readNumber(scanner));
  else if (keyword == "Pm")
    definition.metallic = saturate(readNumber(scanner));
  else if (keyword == "Pr")
    definition.roughness = saturate(readNumber(scanner));
  else if (const auto map = maps.find(keyword); map != maps.end()) {
    definition.maps.push_back(readMap(scanner, map->second));
    definition.maps.back().folder = folder;
  } else if (!ignoredStatements.contains(keyword)) {
    skippedKeywords_.insert(asPrintable(keyword));
  }
}

/// "-s u v w -o u v w -clamp on file name.png": options, then the rest of the line.
ObjMaterials::TextureMap ObjMaterials::readMap(TextScanner& scanner, TextureRole role) {
  TextureMap map;
  map.role = role;
  const auto readPair = [&](Vec2f& pair) {
    float* numbers[] = {&pair.x, &pair.y};
    float depth = 0;
    for (int i = 0; i < 3; ++i) {
      scanner.skipBlanks();
      TextScanner ahead = scanner;
      const std::string_view word = ahead.word();
      if (word.empty() || word.find_first_not_of("+-.0123456789eE") != word.npos)
        return;
      (i < 2 ? *numbers[i] : depth) = scanner.float32("a number");
    }
  };
  for (scanner.skipBlanks();; scanner.skipBlanks()) {
    TextScanner ahead = scanner;
    const std::string_view option = ahead.word();
    if (!option.starts_with('-'))
      break;
    scanner.word();
    if (option == "-s") {
      readPair(map.transform.scale);
    } else if (option == "-o") {
      readPair(map.transform.translation);
    } else if (option == "-mm") {
      Vec2f unused;
      readPair(unused);
    } else { // one word
      scanner.skipBlanks();
      const std::string_view value = scanner.word();
      map.clamps |= option == "-clamp" && value == "on";
    }
  }
  // MTL scales, then translates: u' = s u + o. X3D translates first.
  if (map.transform.scale.x != 0 && map.transform.scale.y != 0)
    map.transform.translation = {map.transform.translation.x / map.transform.scale.x,
                                 map.transform.translation.y / map.transform.scale.y};
  map.file = std::string(scanner.restOfLine());
  return map;
}

/// Names of images are relative to the library or, as some exporters write them, to the OBJ file.
std::string ObjMaterials::urlOf(const TextureMap& map) const {
  std::string url = map.file;
  std::ranges::replace(url, '\\', '/');
  if (map.folder.empty() || url.starts_with('/'))
    return url;
  try {
    std::error_code ignored;
    if (std::filesystem::exists(references_.fileOf(map.folder + url), ignored))
      return map.folder + url;
  } catch (const Error&) { // beside the library it is out of reach; beside the OBJ file it may not be
    return url;
  }
  return url;
}

std::optional<std::size_t> ObjMaterials::image(const TextureMap& map) {
  const std::string url = urlOf(map);
  return images_.index(url, url, [&] { return ImageFile{url, references_.fetch(url)}; });
}

Appearance ObjMaterials::appearanceOf(const std::string& name, const Definition& definition) {
  Appearance appearance;
  appearance.name = name;
  appearance.material = definition.material;
  if (definition.metallic || definition.roughness) {
    PhysicalMaterial physical;
    physical.baseColor = linearOf(definition.material.diffuseColor);
    physical.emissiveColor = linearOf(definition.material.emissiveColor);
    physical.transparency = definition.material.transparency;
    physical.metallic = definition.metallic.value_or(0);
    physical.roughness = definition.roughness.value_or(0.5f);
    appearance.material = physical;
  }
  for (const TextureMap& map : definition.maps) {
    const auto hasRole = [&](const TextureUse& use) { return use.role == map.role; };
    const std::optional<std::size_t> image = this->image(map);
    if (!image || std::ranges::any_of(appearance.textures, hasRole))
      continue;
    Texture texture;
    texture.image = *image;
    texture.boundaryS = texture.boundaryT = map.clamps ? Boundary::clamp : Boundary::repeat;
    graph_.textures.push_back(texture);
    appearance.textures.push_back({map.role, graph_.textures.size() - 1, map.transform});
  }
  return appearance;
}

std::optional<std::size_t> ObjMaterials::appearance(const std::string& name) {
  const auto [found, isNew] = appearances_.try_emplace(name);
  if (!isNew)
    return found->second;
  const auto definition = definitions_.find(name);
  if (definition == definitions_.end()) {
    undefined_.insert(name);
    return {};
  }
  graph_.appearances.push_back(appearanceOf(name, definition->second));
  return found->second = graph_.appearances.size() - 1;
}

std::vector<std::string> ObjMaterials::omissions() const {
  std::vector<std::string> omissions = missingLibraries_;
  std::ranges::copy(images_.omissions, std::back_inserter(omissions));
  if (!undefined_.empty())
    omissions.push_back(fmt::format("{} named but not defined: {}.",
                                    counted(undefined_.size(), "material is", "materials are"),
                                    fmt::join(undefined_, ", ")));
  return omissions;
}

void ObjMaterials::addWarnings(std::vector<std::string>& warnings) const {
  if (!skippedKeywords_.empty())
    warnings.push_back(
        fmt::format("Statements of MTL files that imgeo does not read: {}.", fmt::join(skippedKeywords_, ", ")));
}

} // namespace imgeo
