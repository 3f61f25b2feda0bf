#pragma once
// The fields of an element, as X3D types; safe for untrusted text. Every fault
// is an Error that names the document and the line, or a warning that does.

#include "base/error.h"
#include "scene/transform.h"

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// The text that a parsed <X3D> element came from: for the places in Errors.
struct DocumentText {
  std::string_view text;
  const std::string& name;
  std::size_t begin = 0; ///< of the element
};

/// What is wrong with elements that an author may have written, which are shown all the
/// same: one sentence each, with the line.
using DocumentWarnings = std::vector<std::string>;

[[noreturn]] void fail(const DocumentText& source, const pugi::xml_node& node, ErrorKind kind,
                       const std::string& message);

/// One element whose attributes are read by name, without regard to case. An
/// absent or empty field gives the fallback; with `warnings` one that is malformed does,
/// too, as in browsers, and is named there instead of thrown.
class FieldReader {
public:
  FieldReader(const DocumentText& source, pugi::xml_node node, DocumentWarnings* warnings = nullptr)
      : source_(source), node_(node), warnings_(warnings) {}

  const pugi::xml_node& node() const { return node_; }
  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const {
    imgeo::fail(source_, node_, kind, message);
  }
  /// Warns, if that may be, or throws Error{malformed}.
  void warnOrFail(const std::string& message, const char* consequence) const;

  std::string text(const char* name) const; ///< "" where it is absent
  bool boolean(const char* name, bool fallback) const;
  double real(const char* name, double fallback) const;
  float real(const char* name, float fallback) const;
  Vec2f vec2(const char* name, Vec2f fallback) const;
  Vec3f vec3(const char* name, Vec3f fallback) const;
  Vec3d vec3(const char* name, Vec3d fallback) const;
  Rotation rotation(const char* name, const Rotation& fallback) const;
  /// Finite numbers, any number of them.
  std::vector<double> reals(const char* name) const;
  /// Finite numbers, exactly `count` of them, or none where the field is absent.
  std::vector<double> reals(const char* name, std::size_t count) const;
  /// Non-negative whole numbers of at most 32 bits; any number of them.
  std::vector<std::uint32_t> integers(const char* name) const;
  std::uint32_t integer(const char* name, std::uint32_t fallback) const;
  /// An MFString: quoted strings, or one bare string.
  std::vector<std::string> strings(const char* name) const;
  /// bboxCenter and bboxSize; empty where the size is absent or negative.
  Box3d box() const;

private:
  template <typename T> std::vector<T> parse(const char* name) const;
  template <typename T> std::vector<T> parse(const char* name, std::size_t count) const;
  void warnOrFailField(const std::string& message) const { warnOrFail(message, "it counts as absent"); }

  const DocumentText& source_;
  pugi::xml_node node_;
  DocumentWarnings* warnings_;
};

} // namespace imgeo
