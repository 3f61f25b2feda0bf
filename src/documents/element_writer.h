#pragma once
// Writing of elements as text that is the same for HTML and XML parsers, with indentation.

#include "base/vec.h"
#include "scene/mf_string.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

struct Attribute {
  std::string name, value; ///< `value` is not escaped yet
};

using Attributes = std::vector<Attribute>;

/// An element's name and attributes. If the start tag is too long for one line, each group of attributes is on a line
/// of its own.
struct Element {
  std::string name;
  std::vector<Attributes> groups;
};

/// How elements become lines. `readable`: indented by two spaces a level; an element whose content is one short line is
/// written on one line. `dense`: without indentation, and a Shape is one line with all its content. `denseXml`: dense,
/// with the short form of empty elements, which HTML does not have.
enum class TextLayout : std::uint8_t { readable, dense, denseXml };

/// Collects the text of nested elements.
class ElementWriter {
public:
  explicit ElementWriter(std::size_t level, TextLayout layout = TextLayout::readable)
      : level_(level), layout_(layout) {}

  void open(const Element& element);
  void close(const Element& element);
  /// Writes an empty element; but for denseXml with an end tag, since HTML has no self-closing custom elements.
  void leaf(const Element& element);
  /// Writes an element that contains text, which is escaped.
  void leaf(const Element& element, std::string_view content);

  /// Writes a comment; consecutive hyphens, which would end it, are separated by spaces.
  void comment(std::string_view content);

  TextLayout layout() const { return layout_; }
  const std::string& text() const { return text_; }

private:
  /// Byte range of a start tag in text_, with its indentation.
  struct Tag {
    std::size_t begin, end;
  };

  void startTag(const Element& element);
  bool isReadable() const { return layout_ == TextLayout::readable; }
  void indent();
  /// Ends the line, but for the lines inside a Shape of a dense layout.
  void endLine();

  std::size_t level_;
  TextLayout layout_;
  std::size_t openShapes_ = 0;
  std::string text_;
  std::vector<Tag> openTags_;
};

/// The shortest decimal text from which parsing gives the same number.
std::string number(double value);
std::string number(float value);
template <typename T> std::string numbers(Vec2<T> v) {
  return number(v.x) + " " + number(v.y);
}
template <typename T> std::string numbers(Vec3<T> v) {
  return number(v.x) + " " + number(v.y) + " " + number(v.z);
}

/// The numbers, separated by spaces.
std::string numbers(const std::vector<double>& values);

/// Appends the attribute `name` with the text of `value`, unless `value` is the default of an absent attribute.
template <typename T>
void addUnless(Attributes& attributes, const char* name, const T& value, const T& defaultValue, std::string text) {
  if (!(value == defaultValue))
    attributes.push_back({name, std::move(text)});
}

} // namespace imgeo
