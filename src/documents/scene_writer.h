#pragma once
// The <X3D> element: one text for both documents. A subclass writes shapes in the
// dialect of another runtime.

#include "documents/documents.h"
#include "documents/element_writer.h"
#include "documents/xml_text.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// A page runs what stands in it, a file does not (page_markup.h).
enum class DocumentKind : std::uint8_t { page, file };

class SceneWriter {
public:
  /// `document` outlives the writer; `level` is the element's indent. With an Inline's
  /// node, the document that it shows is written instead.
  SceneWriter(const SceneDocument& document, std::size_t level, DocumentKind medium,
              std::optional<std::size_t> inlineNode = {});
  virtual ~SceneWriter() = default;
  SceneWriter(const SceneWriter&) = delete;
  SceneWriter& operator=(const SceneWriter&) = delete;

  /// The element with all its children, ending in a newline. To be called once.
  std::string write();

protected:
  /// Writes what stands for a Shape node; `names` is its DEF, if it has one.
  virtual void writeShape(const Node& node, const Attributes& names);
  /// A page's attribute for the `style` of a FontStyle. `style` itself is HTML's there, and a
  /// strict content policy refuses it.
  virtual Attribute fontStyleAttribute(const std::string& style) const;
  void writeExtras(const Node& node);
  /// Extras and children: of an X3D source's Shape, what it has besides its geometry.
  void writeChildren(const Node& node);
  /// The further fields of a node's element, as far as they may stand in this medium.
  Attributes furtherFields(const Node& node) const;
  Attributes allowedFields(const std::vector<FieldText>& all) const;

  /// Names that elements have, given when they are first written.
  class Names {
  public:
    Names(std::size_t count) : names_(count), written_(count) {}
    std::string& operator[](std::size_t index) { return names_[index]; }
    /// Its DEF the first time, its USE from then on; nothing where it has no name.
    Attributes defOrUse(std::size_t index);

  private:
    std::vector<std::string> names_;
    std::vector<bool> written_;
  };

  const SceneDocument& document_;
  ElementWriter writer_;
  DefNames table_;
  Names nodeNames_, appearanceNames_, textureNames_;

private:
  void giveNames();
  void writeHeader();
  void writeComment(const GenericNode& comment);
  Element elementOf(const Node& node, const Attributes& names) const;
  Element otherElement(const GenericNode& other, const Node& node, const Attributes& names) const;
  bool hasOther(std::string_view element) const;
  void writeHead();
  void writeNode(std::size_t index);
  void writeAppearanceOf(const Shape& shape);
  void writeGeometryOf(const Shape& shape);

  const std::vector<std::size_t>& roots_;
  const DocumentHead& head_;
  const DocumentKind medium_;
  Names geometryNames_; ///< two for each: solid and not
};

/// Whether attributes are a USE, so that an element stands elsewhere.
bool isUse(const Attributes& names);

} // namespace imgeo
