#pragma once
// The JSON of a GLB file that is not kept in memory: most of it describes accessors and buffer views, of which one
// primitive needs a few.

#include "import/chunks/json_elements.h"
#include "import/gltf/document.h"

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// Knows where each accessor and buffer view is in the text. Parsed documents have the accessors and views that are
/// needed, and null for all others, so that indices stay valid. Safe to use from several threads.
class GlbText {
public:
  /// `json` must outlive this. Throws Error{malformed, limit} naming `name`.
  GlbText(std::string_view json, const std::string& name);

  /// The document, with the accessors and views that others than primitives name: instances, animations and images.
  gltf::Json document() const;
  /// An object with "accessors", "bufferViews" and "buffers" alone, of which the first two have none.
  gltf::Json withoutAccessors() const;
  /// Those of a document that are not null although withoutAccessors() has none.
  struct Added {
    std::vector<std::size_t> accessors, views;
  };
  /// Adds those that a primitive names to a document.
  Added addAccessorsOf(const gltf::Json& primitive, gltf::Json& document) const;
  /// Removes them, and what has been appended to these arrays.
  void removeAccessors(const Added& added, gltf::Json& document) const;
  /// The texts of the primitives of each mesh.
  std::vector<std::vector<std::string_view>> primitives() const;

private:
  /// An array whose elements are parsed one by one.
  struct Array {
    std::string_view text; ///< empty where there is none
    JsonElements elements;
  };

  void addAccessor(const gltf::Json& index, gltf::Json& document, Added& added) const;
  void addView(const gltf::Json& index, gltf::Json& document, Added& added) const;

  /// An object of some members, with as many null as the arrays have elements.
  gltf::Json objectOf(const std::vector<JsonMember>& members) const;

  std::vector<JsonMember> others_; ///< members that are neither accessors nor views, nor what stands in for these
  Array accessors_, views_;
};

/// A document of a GLB file with the accessors and views of one primitive at a time.
class PrimitiveDocument {
public:
  /// Everything must outlive this.
  PrimitiveDocument(const GlbText& text, ByteSpan binary, const References& references, const std::string& name,
                    std::uint64_t sourceBytes);
  PrimitiveDocument(const PrimitiveDocument&) = delete;
  PrimitiveDocument& operator=(const PrimitiveDocument&) = delete;

  gltf::Document& document() { return document_; }
  gltf::Json& json() { return json_; }
  /// Has the accessors of a primitive from now on, and no others.
  void enter(const gltf::Json& primitive);
  /// Adds a buffer, until another primitive is entered.
  void addBuffer(Bytes bytes);

private:
  const GlbText& text_;
  gltf::Json json_;
  std::size_t bufferCount_;
  gltf::Document document_;
  GlbText::Added added_;
};

} // namespace imgeo
