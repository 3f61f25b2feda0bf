#pragma once
// Typed access to the fields of an X3D element; safe for untrusted text. Every fault is an Error or a warning with the
// document's name and the line.

#include "base/error.h"
#include "documents/document_warnings.h"
#include "markup/x3d_element.h"
#include "scene/transform.h"

#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// The text from which elements were parsed, for the locations of Errors, and its DEFs.
struct DocumentText {
  std::string_view text;
  const std::string& name;
  const ElementOffsets& offsets;
  const ElementsByDef& defs;
};

[[noreturn]] void fail(const DocumentText& source, const pugi::xml_node& node, ErrorKind kind,
                       const std::string& message);

/// Reads attributes of an element by name, without regard to case. The value of an absent or empty field is the
/// fallback. A malformed field throws Error{malformed}; with `warnings` it adds a warning and its value is the
/// fallback, too, as in browsers.
class FieldReader {
public:
  FieldReader(const DocumentText& source, pugi::xml_node node, DocumentWarnings* warnings = nullptr)
      : source_(source), node_(node), warnings_(warnings) {}

  const pugi::xml_node& node() const { return node_; }
  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const {
    imgeo::fail(source_, node_, kind, message);
  }
  /// Adds a warning with its consequence or, without `warnings`, throws Error{malformed}.
  void warnOrFail(const std::string& message, const char* consequence) const;

  std::string text(const char* name) const; ///< "" where it is absent
  bool has(const char* name) const { return !text(name).empty(); }
  bool boolean(const char* name, bool fallback) const;
  double real(const char* name, double fallback) const;
  float real(const char* name, float fallback) const;
  Vec2f vec2(const char* name, Vec2f fallback) const;
  Vec3f vec3(const char* name, Vec3f fallback) const;
  Vec3d vec3(const char* name, Vec3d fallback) const;
  Rotation rotation(const char* name, const Rotation& fallback) const;
  /// Any number of finite numbers.
  std::vector<double> reals(const char* name) const;
  /// Exactly `count` finite numbers, or none if the field is absent.
  std::vector<double> reals(const char* name, std::size_t count) const;
  /// Any number of non-negative integers of at most 32 bits.
  std::vector<std::uint32_t> integers(const char* name) const;
  std::uint32_t integer(const char* name, std::uint32_t fallback) const;
  /// An MFString: quoted strings, or one unquoted string.
  std::vector<std::string> strings(const char* name) const;
  /// bboxCenter and bboxSize; empty where the size is absent or negative.
  Box3d box() const;

private:
  template <typename T> std::vector<T> parse(const char* name) const;
  template <typename T> std::vector<T> parse(const char* name, std::size_t count) const;
  void warnOrFailField(const std::string& message) const { warnOrFail(message, "it counts as absent"); }

  DocumentText source_; ///< a copy, so that callers may pass a temporary
  pugi::xml_node node_;
  DocumentWarnings* warnings_;
};

} // namespace imgeo
