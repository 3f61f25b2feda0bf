#pragma once
// The elements of an X3D file with its DEFs, and typed access to fields.

#include "base/error.h"
#include "documents/field_reader.h"
#include "import/x3d/elements.h"
#include "import/x3d/field_values.h"

#include <set>
#include <string>

namespace imgeo::x3d {

class Source {
public:
  /// `elements` were parsed from `text`; `text` and `name` must outlive the source. Throws Error{limit} for deep
  /// nesting.
  Source(Elements elements, std::string_view text, const std::string& name);

  /// The element <X3D>.
  pugi::xml_node root() const { return elements_.root(); }
  /// The element that a USE names, or the element itself without USE. A null node where no DEF has the name.
  pugi::xml_node resolved(pugi::xml_node element) const;

  /// The first element that has this DEF; a null node where there is none.
  pugi::xml_node defined(std::string_view name) const;

  /// The skin whose shapes a Group holds; nullptr for other elements.
  const Skin* skinOf(pugi::xml_node group) const;
  /// The joints and weights of the points of a geometry; nullptr for one that no skin has.
  const std::vector<NamedAttribute>* pointAttributesOf(pugi::xml_node geometry) const;

  /// Whether a Shape shows this geometry with a texture (x3d/textured_geometries.h).
  bool isTextured(pugi::xml_node geometry) const { return textured_.contains(geometry.internal_object()); }

  /// For the readers of src/documents.
  DocumentText documentText() const { return {text_, name_, elements_.offsets, defs_}; }

  /// "hall.wrl:12:3": the file, line and column of an element.
  std::string locationOf(pugi::xml_node element) const;
  [[noreturn]] void fail(pugi::xml_node element, ErrorKind kind, const std::string& message) const;

  // Fields of an element, by their X3D name. Throw Error{malformed} for values of another type.
  std::vector<double> reals(pugi::xml_node element, const char* field) const; ///< finite
  std::vector<std::int32_t> integers(pugi::xml_node element, const char* field) const;
  double real(pugi::xml_node element, const char* field, double fallback) const;
  bool boolean(pugi::xml_node element, const char* field, bool fallback) const;

private:
  void addDefs(pugi::xml_node element, std::size_t depth);

  Elements elements_;
  std::string_view text_;
  const std::string& name_;
  ElementsByDef defs_;
  std::set<pugi::xml_node_struct*> textured_; ///< geometries
};

} // namespace imgeo::x3d
