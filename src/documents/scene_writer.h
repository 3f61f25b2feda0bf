#pragma once
// Writes the <X3D> element of pages and X3D files. A subclass writes shapes for X3DOM (x3dom_writer.cpp).

#include "documents/document_names.h"
#include "documents/documents.h"
#include "documents/element_writer.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// Pages are sanitised (page_sanitizer.h), X3D files are not.
enum class DocumentKind : std::uint8_t { page, file };

class SceneWriter {
public:
  /// `document` must outlive the writer; `level` is the element's indentation level. With `inlineNode`, the document of
  /// that Inline node is written instead.
  SceneWriter(const SceneDocument& document, std::size_t level, DocumentKind kind,
              std::optional<std::size_t> inlineNode = {});
  virtual ~SceneWriter() = default;
  SceneWriter(const SceneWriter&) = delete;
  SceneWriter& operator=(const SceneWriter&) = delete;

  /// Returns the element with all its children, ending in a newline. To be called once.
  std::string write();

protected:
  /// Writes the element or elements of a Shape node; `names` is its DEF, if any.
  virtual void writeShape(const Node& node, const Attributes& names);
  /// A page's attribute for the `style` of a FontStyle. In a page `style` itself is HTML's attribute, which a strict
  /// content security policy refuses.
  virtual Attribute fontStyleAttribute(const std::string& style) const;
  void writeExtras(const Node& node);
  /// Writes extras and child nodes. The children of a Shape are those that an X3D source has besides the geometry.
  void writeChildren(const Node& node);
  /// Node::fields, without those that are not allowed in this kind of document.
  Attributes furtherFields(const Node& node) const;
  /// The given fields without those that are not allowed in this kind of document.
  Attributes allowedFields(const std::vector<FieldText>& candidates) const;

  const SceneDocument& document_;
  ElementWriter writer_;
  DocumentNames names_;

private:
  void writeFileHead();
  void writeComment(const GenericNode& comment);
  Element elementOf(const Node& node, const Attributes& names) const;
  Element genericElement(const GenericNode& generic, const Node& node, const Attributes& names) const;
  bool hasGenericNode(std::string_view element) const;
  /// Writes WorldInfo, NavigationInfo and Background, unless the source has them.
  void writeSceneSettings();
  void writeNode(std::size_t index);
  void writeAppearanceOf(const Shape& shape);
  void writeGeometryOf(const Node& node);
  void writeSharedGeometries();
  void writeRoutes();
  std::optional<Attributes> boxInGeometry(const GeometryDescription& geometry) const;

  const std::vector<std::size_t>& roots_;
  const DocumentHead& head_;
  const DocumentKind kind_;
};

} // namespace imgeo
