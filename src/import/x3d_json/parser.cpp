#include "import/x3d_json/parser.h"

#include "base/error.h"
#include "import/text/text_scanner.h"
#include "import/vrml/elements.h"
#include "import/x3d/node_table.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

namespace imgeo::x3d {

namespace {

using JsonLibrary = nlohmann::json;

constexpr std::size_t maxJsonNesting = 200; ///< of nested elements

/// Gives characters to nlohmann's parser and stores how far it has read: its events have no positions.
class CountingIterator {
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char*& shared) : at_(at), shared_(&shared) {}

  const char& operator*() const { return *at_; }
  CountingIterator& operator++() {
    *shared_ = ++at_;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

private:
  const char* at_;
  const char** shared_; ///< the position after the last character that was read
};

enum class JsonFrameKind {
  file,       ///< the object of the whole file
  element,    ///< the object of an element: its keys are fields and statements
  nodes,      ///< an object of the form {"Shape": {…}}
  nodeList,   ///< an array of such objects
  statements, ///< an array of objects that are elements of the same name
  values,     ///< an array of the values of a field
  lines,      ///< an array of lines of text
  ignored,
};

/// An object or array that has begun and not ended.
struct JsonFrame {
  JsonFrameKind kind = JsonFrameKind::ignored;
  pugi::xml_node element;            ///< that contains what is read
  std::string name;                  ///< of the field that holds nodes, of the statements, or of the field of values
  std::vector<std::string> values{}; ///< texts of values
  bool hasStrings = false;           ///< among values
};

/// Receives the events of nlohmann's parser.
class JsonEvents : public JsonLibrary::json_sax_t {
public:
  JsonEvents(std::string_view text, const std::string& name) : text_(text), name_(name), at_(text.data()) {
    elements_.format = "X3D JSON";
  }

  CountingIterator begin() { return {text_.data(), at_}; }
  CountingIterator end() { return {text_.data() + text_.size(), at_}; }
  Elements take() { return std::move(elements_); }

  bool null() override { return true; } // NULL, the absence of a node
  bool boolean(bool value) override { return addValue(value ? "true" : "false", false); }
  bool number_integer(number_integer_t value) override { return addValue(std::to_string(value), false); }
  bool number_unsigned(number_unsigned_t value) override { return addValue(std::to_string(value), false); }
  bool number_float(number_float_t, const string_t& text) override { return addValue(text, false); }
  bool string(string_t& value) override { return addValue(value, true); }
  bool binary(binary_t&) override { return true; }

  bool key(string_t& name) override {
    key_ = name;
    keyOffset_ = offset() - std::min(offset(), name.size() + 1);
    return true;
  }

  bool start_object(std::size_t) override {
    push(frames_.empty() ? JsonFrame{JsonFrameKind::file, elements_.document, {}} : objectIn(frames_.back()));
    return true;
  }

  bool start_array(std::size_t) override {
    if (frames_.empty())
      fail(ErrorKind::malformed, "its JSON is no object");
    push(arrayIn(frames_.back()));
    return true;
  }

  bool end_object() override {
    pop();
    return true;
  }

  bool end_array() override {
    const JsonFrame frame = std::move(frames_.back());
    pop();
    if (frame.kind == JsonFrameKind::lines)
      addText(frame.element, frame.name, fmt::format("{}", fmt::join(frame.values, "\n")));
    if (frame.kind != JsonFrameKind::values)
      return true;
    if (!frames_.empty() &&
        frames_.back().kind == JsonFrameKind::values) { // a list within a list: their values in a row
      JsonFrame& outer = frames_.back();
      std::ranges::copy(frame.values, std::back_inserter(outer.values));
      outer.hasStrings |= frame.hasStrings;
    } else {
      setField(frame.element, frame.name,
               frame.hasStrings ? quoteStrings(frame.values) : fmt::format("{}", fmt::join(frame.values, " ")));
    }
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const JsonLibrary::exception& error) override {
    keyOffset_ = std::min(byte - std::min<std::size_t>(byte, 1), text_.size());
    // nlohmann's error 406: a number out of range.
    fail(ErrorKind::malformed,
         error.id == 406 ? "its JSON holds a number out of range" : "its JSON is not well-formed");
  }

private:
  std::size_t offset() const { return static_cast<std::size_t>(at_ - text_.data()); }

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const {
    throw Error(kind, locationOf(text_, name_, keyOffset_), message);
  }

  void push(JsonFrame frame) {
    elementDepth_ += frame.kind == JsonFrameKind::element;
    if (elementDepth_ > maxJsonNesting || frames_.size() > 4 * maxJsonNesting)
      fail(ErrorKind::limit, "its JSON is nested too deeply");
    frames_.push_back(std::move(frame));
  }

  void pop() {
    elementDepth_ -= frames_.back().kind == JsonFrameKind::element;
    frames_.pop_back();
  }

  /// The frame of an object that begins in `outer`; key_ is its key where `outer` is an object.
  JsonFrame objectIn(const JsonFrame& outer) {
    switch (outer.kind) {
    case JsonFrameKind::file:
      return key_ == "X3D" ? JsonFrame{JsonFrameKind::element, add(outer.element, key_, ""), {}} : JsonFrame{};
    case JsonFrameKind::element:
      if (key_.starts_with('-'))
        return {JsonFrameKind::nodes, outer.element, key_.substr(1)};
      if (key_.starts_with('@'))
        fail(ErrorKind::malformed, fmt::format("the field \"{}\" holds an object", asPrintable(key_)));
      return key_.starts_with('#') ? JsonFrame{} : JsonFrame{JsonFrameKind::element, add(outer.element, key_, ""), {}};
    case JsonFrameKind::nodes:
      return {JsonFrameKind::element, add(outer.element, key_, outer.name), {}};
    case JsonFrameKind::nodeList:
      return {JsonFrameKind::nodes, outer.element, outer.name};
    case JsonFrameKind::statements:
      return {JsonFrameKind::element, add(outer.element, outer.name, ""), {}};
    case JsonFrameKind::values:
    case JsonFrameKind::lines:
      fail(ErrorKind::malformed, fmt::format("the field \"{}\" holds an object", asPrintable(outer.name)));
    case JsonFrameKind::ignored:
      break;
    }
    return {};
  }

  /// The same for an array.
  JsonFrame arrayIn(const JsonFrame& outer) {
    switch (outer.kind) {
    case JsonFrameKind::element:
      if (key_.starts_with('-'))
        return {JsonFrameKind::nodeList, outer.element, key_.substr(1)};
      if (key_.starts_with('@'))
        return {JsonFrameKind::values, outer.element, key_.substr(1)};
      return {key_.starts_with('#') ? JsonFrameKind::lines : JsonFrameKind::statements, outer.element, key_};
    case JsonFrameKind::nodes:
      return {key_.starts_with('#') ? JsonFrameKind::lines : JsonFrameKind::statements, outer.element, key_};
    case JsonFrameKind::statements: // a field without its @ that has a list of values
    case JsonFrameKind::values:
      return {JsonFrameKind::values, outer.element, outer.name};
    case JsonFrameKind::nodeList:
      return {JsonFrameKind::nodeList, outer.element, outer.name};
    case JsonFrameKind::file:
    case JsonFrameKind::lines:
    case JsonFrameKind::ignored:
      break;
    }
    return {};
  }

  bool addValue(const std::string& value, bool isString) {
    if (frames_.empty())
      fail(ErrorKind::malformed, "its JSON is no object");
    JsonFrame& frame = frames_.back();
    if (frame.kind == JsonFrameKind::statements)
      frame.kind = JsonFrameKind::values; // a field without its @
    if (frame.kind == JsonFrameKind::values || frame.kind == JsonFrameKind::lines) {
      frame.values.push_back(value);
      frame.hasStrings |= isString;
    } else if (frame.kind == JsonFrameKind::nodes && key_.starts_with('#')) {
      addText(frame.element, key_, value);
    } else if (frame.kind == JsonFrameKind::element) {
      if (key_.starts_with('#'))
        addText(frame.element, key_, value);
      else if (frame.element != elements_.root() || key_.starts_with('@')) // "encoding", "JSON schema"
        setField(frame.element, key_.starts_with('@') ? key_.substr(1) : key_, value);
    }
    return true;
  }

  /// Comments stay; the text of a script or shader is that of its element.
  static void addText(pugi::xml_node element, std::string_view key, const std::string& text) {
    element.append_child(key == "#comment" ? pugi::node_comment : pugi::node_pcdata).set_value(text.c_str());
  }

  void setField(pugi::xml_node element, const std::string& field, const std::string& value) const {
    requireName(field);
    set(element, field, value);
  }

  /// Appends an element that begins at key_. `field` is the field of its parent that holds it; "" for the default.
  pugi::xml_node add(pugi::xml_node parent, const std::string& element, std::string_view field) {
    requireName(element);
    pugi::xml_node added = parent.append_child(element.c_str());
    elements_.offsets.add(added, keyOffset_);
    const NodeRow* parentRow = nodeRow(parent.name());
    const bool isOfStatement = field == "children" && parentRow && parentRow->component == "statement";
    if (!isOfStatement)
      setContainerField(added, field);
    return added;
  }

  /// Throws Error{malformed} for a name that XML does not allow for elements and attributes.
  void requireName(std::string_view name) const {
    const auto isLetter = [](unsigned char c) { return std::isalpha(c) || c == '_' || c >= 0x80; };
    const auto isInner = [&](unsigned char c) { return isLetter(c) || std::isdigit(c) || c == '-' || c == ':'; };
    if (name.empty() || !isLetter(static_cast<unsigned char>(name[0])) || !std::ranges::all_of(name, isInner))
      fail(ErrorKind::malformed, fmt::format("\"{}\" is no name of a node or field", asPrintable(name)));
  }

  std::string_view text_;
  const std::string& name_;
  const char* at_; ///< the position after the last character that was read
  Elements elements_;
  std::vector<JsonFrame> frames_;
  std::string key_;
  std::size_t keyOffset_ = 0; ///< where the last key begins
  std::size_t elementDepth_ = 0;
};

} // namespace

Elements parseX3dJson(std::string_view text, const std::string& name) {
  JsonEvents events(text, name);
  JsonLibrary::sax_parse(events.begin(), events.end(), &events);
  Elements elements = events.take();
  if (std::string_view(elements.root().name()) != "X3D")
    throw Error(ErrorKind::malformed, name, "is JSON, but has no object \"X3D\"");
  return elements;
}

} // namespace imgeo::x3d
