#pragma once
// The nodes of a VRML 1.0 file, before properties and transforms are applied (G. Bell, A. Parisi, M. Pesce: "The
// Virtual Reality Modeling Language, Version 1.0 Specification", 1995).

#include "base/vec.h"
#include "import/vrml/tokens.h"
#include "import/vrml1/report.h"

#include <deque>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::vrml1 {

/// A field with its values: numbers, or strings and words.
struct Field {
  std::string_view name;
  std::vector<double> numbers; ///< finite in single precision
  std::vector<std::string> words;
};

struct Node {
  std::string type; ///< of an extension node: the known type that its isA names, if any
  std::string name; ///< its DEF; "" without
  x3d::Token where; ///< the type in the text
  std::vector<Field> fields;
  std::vector<const Node*> children; ///< a node that a USE names stands in several lists
  bool draws = false;                ///< whether it or a descendant is a shape, a light, a camera or a WWWInline
  bool lightsSiblings = false;       ///< whether it is a light, or has one that shines on its siblings

  const Field* field(std::string_view fieldName) const;
  bool is(std::string_view otherType) const { return type == otherType; }

  // Values of fields; the fallback for absent fields and for those with too few numbers.
  double real(std::string_view fieldName, double fallback) const;
  Vec3d vector(std::string_view fieldName, Vec3d fallback) const;
  /// All numbers of a field; empty where it is absent.
  const std::vector<double>& numbers(std::string_view fieldName) const;
  /// The first string or word of a field.
  std::string word(std::string_view fieldName, std::string_view fallback) const;
  bool boolean(std::string_view fieldName, bool fallback) const;
};

struct Tree {
  std::deque<Node> nodes; ///< addresses of nodes stay valid; the last is the root, a Separator around the file
  const Node& root() const { return nodes.back(); }
};

/// Parses a file behind its header. Safe for untrusted text. A USE without a DEF, unknown nodes and unknown fields are
/// left out and reported. Throws Error{malformed, truncated, limit} naming line and column.
Tree parseTree(x3d::VrmlTokens& tokens, Report& report);

} // namespace imgeo::vrml1
