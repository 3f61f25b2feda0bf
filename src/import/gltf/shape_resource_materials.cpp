#include "import/gltf/shape_resource_materials.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace imgeo::gltf {

namespace {

class ResourceMaterialReader {
public:
  ResourceMaterialReader(const Value& root, ShapeResourceUpgrade& upgrade) : root_(root), upgrade_(upgrade) {}

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
  ShapeResourceUpgrade& upgrade_;
};

} // namespace

ResourceMaterial readResourceMaterial(const Value& root, ShapeResourceUpgrade& upgrade, const std::string& key) {
  return ResourceMaterialReader(root, upgrade).read(key);
}

} // namespace imgeo::gltf
