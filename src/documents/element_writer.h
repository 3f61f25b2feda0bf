#pragma once
// Elements as text that HTML and XML read alike and people can read.

#include "base/vec.h"
#include "scene/mf_string.h"

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

struct Attribute {
  std::string name, value; ///< the value as it is meant, not escaped
};

using Attributes = std::vector<Attribute>;

/// An element's name and attributes. Groups stand on a line each where all of
/// them together are too long for one.
struct Element {
  std::string name;
  std::vector<Attributes> groups;
};

/// Collects the text of nested elements, two spaces a level. An element with nothing
/// but one short line in it stands in that line.
class ElementWriter {
public:
  explicit ElementWriter(std::size_t level) : level_(level) {}

  void open(const Element& element);
  void close(const Element& element);
  void leaf(const Element& element); ///< opened and closed: HTML knows no self-closing elements here
  void leaf(const Element& element, std::string_view content); ///< with text in it

  /// Hyphens that would end it sooner are parted.
  void comment(std::string_view content);

  const std::string& text() const { return text_; }

private:
  /// Where the line of a start tag begins, and where it ends.
  struct Tag {
    std::size_t begin, end;
  };

  void startTag(const Element& element);

  std::size_t level_;
  std::string text_;
  std::vector<Tag> opened_;
};

/// The shortest decimal text that reads back as the same number.
std::string number(double value);
std::string number(float value);
template <typename T> std::string numbers(Vec2<T> v) {
  return number(v.x) + " " + number(v.y);
}
template <typename T> std::string numbers(Vec3<T> v) {
  return number(v.x) + " " + number(v.y) + " " + number(v.z);
}

std::string numbers(const std::vector<double>& values);

/// Appends the attribute where its value is not what an absent one means.
template <typename T>
void addUnless(Attributes& attributes, const char* name, const T& value, const T& absent, std::string text) {
  if (!(value == absent))
    attributes.push_back({name, std::move(text)});
}

} // namespace imgeo
