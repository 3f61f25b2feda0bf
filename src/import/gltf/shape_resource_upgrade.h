#pragma once
// Writes the JSON of a Shape Resource Container as that of glTF 2.0, whose readers then do the rest.

#include "base/bytes.h"
#include "import/gltf/value.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace imgeo::gltf {

/// Names of attributes that glTF 2.0 would read in another way: colours as linear, v of texture coordinates downwards.
inline constexpr const char *storedColor = "_COLOR", *storedTexCoord = "_TEXCOORD";

/// Names become indices, and each accessor gets a view of its own, where glTF 2.0 has the stride. All functions throw
/// Error{truncated, malformed, unsupported, limit} for what the container must not have.
class ShapeResourceUpgrade {
public:
  /// `root`: the container's JSON, which must outlive this; `body`: the bytes behind it.
  ShapeResourceUpgrade(const Value& root, ByteSpan body);

  /// Adds the mesh of this name.
  void addMesh(const std::string& key);

  /// The bytes of a view.
  ByteSpan bytesOf(const std::string& view);

  /// The document with the meshes that have been added.
  const Json& json() const { return result_; }
  /// The bytes of its only buffer.
  const Bytes& buffer() const { return buffer_; }
  /// The name of the container's material of a primitive of `json()`; "" for none.
  static std::string materialOf(const Value& primitive);

private:
  /// A range of bytes of the buffer.
  struct Range {
    std::uint64_t offset = 0, length = 0;
  };

  Json primitiveOf(const Value& from);
  Value attributeViews() const;
  std::size_t accessor(const Value& accessors, const std::string& key, const std::string& attribute);
  Range rangeOf(const std::string& key);
  Range checkedRange(const Value& value) const;
  Range rangeOfChunks(const Value& view);

  const Value& root_;
  bool hasViewsOfItsOwn_; ///< the layout before glTF
  Bytes buffer_;
  std::uint64_t bodyBytes_, joinableBytes_;
  Json result_;
  std::map<std::string, Range> ranges_;          ///< by view
  std::map<std::string, std::size_t> accessors_; ///< by attribute and name
};

} // namespace imgeo::gltf
