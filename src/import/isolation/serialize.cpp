#include "import/isolation/serialize.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace imgeo {

namespace {

// The members of each type that is not trivially copyable, in the order in which both directions visit them.
void members(auto& archive, auto& v, const NamedAttribute*) {
  archive(v.name, v.components, v.values);
}
void members(auto& archive, auto& v, const Mesh*) {
  archive(v.name, v.topology, v.positions, v.wedgePositions, v.corners, v.creaseDegrees);
  visitAttributes(v, [&](const auto&, auto& values) { archive(values); });
  archive(v.texCoordMappings, v.colorComponents, v.namedAttributes);
}
void members(auto& archive, auto& v, const Viewpoint*) {
  archive(v.description, v.position, v.orientation, v.fieldOfView, v.centerOfRotation);
}
void members(auto& archive, auto& v, const OrthoViewpoint*) {
  archive(v.description, v.position, v.orientation, v.min, v.max, v.centerOfRotation);
}
void members(auto& archive, auto& v, const Interpolator*) {
  archive(v.kind, v.keys, v.values);
}
void members(auto& archive, auto& v, const Humanoid*) {
  archive(v.joints, v.inverseBindings);
}
void members(auto& archive, auto& v, const Displacer*) {
  archive(v.name, v.weight);
}
void members(auto& archive, auto& v, const Route*) {
  archive(v.fromNode, v.fromField, v.toNode, v.toField);
}
void members(auto& archive, auto& v, const Node*) {
  archive(v.name, v.content, v.children, v.extras, v.fields);
}
void members(auto& archive, auto& v, const FieldText*) {
  archive(v.name, v.value);
}
void members(auto& archive, auto& v, const FieldImage*) {
  archive(v.field, v.image);
}
void members(auto& archive, auto& v, const GenericNode*) {
  archive(v.element, v.text, v.images, v.document);
}
void members(auto& archive, auto& v, const Texture*) {
  archive(v.name, v.image, v.boundaryS, v.boundaryT, v.magnification, v.minification, v.betweenMipMaps, v.mipMaps);
}
void members(auto& archive, auto& v, const ImageFile*) {
  archive(v.url, v.bytes, v.preview);
}
void members(auto& archive, auto& v, const PhysicalMaterial*) {
  archive(v.baseColor, v.emissiveColor, v.metallic, v.roughness, v.transparency, v.normalScale, v.occlusionStrength,
          v.extensions);
}
void members(auto& archive, auto& v, const TextureUse*) {
  archive(v.role, v.texture, v.transform, v.mapping);
}
void members(auto& archive, auto& v, const Appearance*) {
  archive(v.name, v.material, v.textures, v.alphaMode, v.alphaCutoff);
}
void members(auto& archive, auto& v, const DocumentHead*) {
  archive(v.fields, v.header);
}
void members(auto& archive, auto& v, const InlinedDocument*) {
  archive(v.url, v.head);
}
void members(auto& archive, auto& v, const SceneGraph*) {
  archive(v.title, v.info, v.nodes, v.roots, v.routes, v.head, v.inlined, v.appearances, v.textures, v.images,
          v.background, v.headlight, v.isComplete);
}
void members(auto& archive, auto& v, const Imported*) {
  archive(v.scene.graph, v.scene.meshes, v.attributes, v.format, v.warnings, v.up, v.metres);
}

class Serializer {
public:
  template <typename... T> void operator()(const T&... values) { (add(values), ...); }

  Bytes bytes;

private:
  void addBytes(const void* from, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(from);
    bytes.insert(bytes.end(), begin, begin + size);
  }
  template <typename T> void add(const T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      addBytes(&value, sizeof(T));
    else
      members(*this, value, &value);
  }
  void add(const std::string& text) {
    add(text.size());
    addBytes(text.data(), text.size());
  }
  template <typename T> void add(const std::vector<T>& list) {
    add(list.size());
    if constexpr (std::is_trivially_copyable_v<T>)
      addBytes(list.data(), list.size() * sizeof(T));
    else
      for (const T& element : list)
        add(element);
  }
  template <typename... T> void add(const std::variant<T...>& any) {
    add(any.index());
    std::visit([this](const auto& value) { this->add(value); }, any);
  }
};

class Deserializer {
public:
  explicit Deserializer(ByteSpan bytes) : bytes_(bytes) {}
  template <typename... T> void operator()(T&... values) { (take(values), ...); }

private:
  void takeBytes(void* to, std::size_t size) {
    requireLeft(size);
    if (size > 0)
      std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  void requireLeft(std::size_t size) const {
    if (size > bytes_.size())
      throw std::out_of_range("the other process has sent less than it announced");
  }
  std::size_t takeCount(std::size_t elementSize) {
    std::size_t count = 0;
    takeBytes(&count, sizeof count);
    requireLeft(count);
    requireLeft(count * elementSize);
    return count;
  }
  template <typename T> void take(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      takeBytes(&value, sizeof(T));
    else
      members(*this, value, &value);
  }
  void take(std::string& text) {
    text.resize(takeCount(1));
    takeBytes(text.data(), text.size());
  }
  template <typename T> void take(std::vector<T>& list) {
    constexpr bool isPlain = std::is_trivially_copyable_v<T>;
    list.resize(takeCount(isPlain ? sizeof(T) : 1));
    if constexpr (isPlain)
      takeBytes(list.data(), list.size() * sizeof(T));
    else
      for (T& element : list)
        take(element);
  }
  template <typename... T> void take(std::variant<T...>& any) {
    std::size_t index = 0;
    take(index);
    setAlternative(any, index, std::index_sequence_for<T...>());
    std::visit([this](auto& value) { this->take(value); }, any);
  }
  template <typename Variant, std::size_t... I>
  static void setAlternative(Variant& any, std::size_t index, std::index_sequence<I...>) {
    ((I == index ? static_cast<void>(any.template emplace<I>()) : static_cast<void>(0)), ...);
  }

  ByteSpan bytes_;
};

} // namespace

Bytes serialized(const Imported& imported) {
  Serializer serializer;
  serializer(imported);
  return std::move(serializer.bytes);
}

Imported deserialized(ByteSpan bytes) {
  Imported imported;
  Deserializer deserializer(bytes);
  deserializer(imported);
  return imported;
}

} // namespace imgeo
