#pragma once
// A glTF document with its binary data: buffers, buffer views, accessors.

#include "base/bytes.h"
#include "import/gltf/value.h"
#include "import/references.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo::gltf {

/// A glTF accessor. Its elements are checked to lie in their buffer view.
class Accessor {
public:
  Accessor() = default;
  Accessor(Accessor&&) = default; // a copy would point into the original
  Accessor& operator=(Accessor&&) = default;

  std::size_t count() const { return count_; }
  std::uint32_t components() const { return components_; }

  /// A component; normalised integers are scaled to 0..1 or -1..1. May be infinite or NaN.
  double real(std::size_t element, std::uint32_t component) const;
  /// A component of an unsigned integer type, not scaled.
  std::uint32_t whole(std::size_t element, std::uint32_t component) const;
  /// The bytes of an element, as they are stored.
  ByteSpan bytesOf(std::size_t element) const;
  bool isUnsigned() const { return componentType_ != 5120 && componentType_ != 5122 && componentType_ != 5126; }

private:
  friend class Document;
  const std::uint8_t* at(std::size_t element, std::uint32_t component) const;

  Bytes own_; ///< the elements of sparse accessors and of those without a buffer view
  const std::uint8_t* begin_ = nullptr;
  std::size_t stride_ = 0, count_ = 0;
  std::uint32_t components_ = 1, componentType_ = 5126, componentSize_ = 4;
  bool normalized_ = false;
};

class Document {
public:
  /// `binary` is the binary chunk of a GLB, or empty; `sourceBytes` is the size of the file. `json`, `binary` and
  /// `references` must outlive the document.
  Document(const Json& json, ByteSpan binary, const References& references, const std::string& name,
           std::uint64_t sourceBytes);

  const Value& root() const { return root_; }
  /// A top-level array, such as "meshes"; a null value where it is absent.
  Value array(const char* name) const { return root_[name]; }

  /// Gives a buffer without a URL its bytes.
  void setBuffer(std::size_t index, Bytes bytes) { buffers_[index] = std::move(bytes); }

  /// The bytes of a buffer view, decompressed where it uses EXT_meshopt_compression.
  ByteSpan view(std::size_t index);

  /// Throws Error for an accessor that does not lie in its view, and Error{limit} where all data read so far exceeds
  /// the budget, a multiple of the source's bytes.
  Accessor accessor(std::size_t index);

  /// Subtracts `bytes` from the budget; throws Error{limit} at `location` where it is exhausted.
  void spend(const Value& location, std::uint64_t bytes);

  const References& references() const { return references_; }

private:
  ByteSpan buffer(std::size_t index);
  Bytes unpacked(const Value& compression);
  ByteSpan checkedSubspan(const Value& value, ByteSpan bytes, std::uint64_t offset, std::uint64_t length) const;
  void applySparse(const Value& value, Accessor& accessor);

  Value root_;
  ByteSpan binary_;
  const References& references_;
  std::uint64_t budget_;
  std::map<std::size_t, Bytes> buffers_, unpackedViews_;
};

} // namespace imgeo::gltf
