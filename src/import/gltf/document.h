#pragma once
// A glTF document with its binary data: buffers, views of them, accessors.

#include "base/bytes.h"
#include "import/gltf/value.h"
#include "import/references.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo::gltf {

/// Numbers in a buffer, checked to lie in it.
class Accessor {
public:
  Accessor() = default;
  Accessor(Accessor&&) = default; // a copy would point into the original
  Accessor& operator=(Accessor&&) = default;

  std::size_t count() const { return count_; }
  std::uint32_t components() const { return components_; }

  /// A component as the document means it: normalised integers are 0..1 or -1..1.
  /// May be infinite or no number.
  double real(std::size_t element, std::uint32_t component) const;
  /// A component of an unsigned integer type as it is.
  std::uint32_t whole(std::size_t element, std::uint32_t component) const;
  bool isUnsigned() const { return componentType_ != 5120 && componentType_ != 5122 && componentType_ != 5126; }

private:
  friend class Document;
  const std::uint8_t* at(std::size_t element, std::uint32_t component) const;

  Bytes own_; ///< where the numbers are not in a buffer as they stand
  const std::uint8_t* begin_ = nullptr;
  std::size_t stride_ = 0, count_ = 0;
  std::uint32_t components_ = 1, componentType_ = 5126, componentSize_ = 4;
  bool normalized_ = false;
};

class Document {
public:
  /// `json` and `binary`, a GLB's second chunk, outlive the document.
  Document(const Json& json, ByteSpan binary, const References& references, const std::string& name,
           std::uint64_t sourceBytes);

  const Value& root() const { return root_; }
  Value array(const char* name) const { return root_[name]; }

  /// The bytes of a buffer view, unpacked where EXT_meshopt_compression packed them.
  ByteSpan view(std::size_t index);

  /// Throws Error for one that does not lie in its view, and {limit} where this
  /// and what was read before is out of all proportion to the source's bytes.
  Accessor accessor(std::size_t index);

  /// Takes `count` from what may still be read; see accessor().
  void spend(const Value& location, std::uint64_t bytes);

  const References& references() const { return references_; }

private:
  const Bytes& buffer(std::size_t index);
  Bytes unpacked(const Value& compression);
  ByteSpan within(const Value& value, ByteSpan bytes, std::uint64_t offset, std::uint64_t length) const;
  void applySparse(const Value& value, Accessor& accessor);

  Value root_;
  ByteSpan binary_;
  const References& references_;
  std::uint64_t budget_;
  std::map<std::size_t, Bytes> buffers_, unpackedViews_;
};

} // namespace imgeo::gltf
