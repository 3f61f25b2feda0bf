#pragma once
// The elements of an X3D file, with its DEFs: what geometry nodes are read from.

#include "base/error.h"
#include "import/x3d/mf_values.h"

#include <map>
#include <pugixml.hpp>
#include <string>

namespace imgeo::x3d {

class Source {
public:
  /// `text` and `name` outlive the source. Throws Error{malformed, unsupported, limit}.
  Source(std::string_view text, const std::string& name);

  /// <X3D>.
  pugi::xml_node root() const { return root_; }
  /// The element that a USE names, or the element itself. A null node where there is none.
  pugi::xml_node resolved(pugi::xml_node element) const;

  [[noreturn]] void fail(pugi::xml_node element, ErrorKind kind, const std::string& message) const;

  // Fields of an element, by their X3D name. Throw Error{malformed} for what is no such value.
  std::vector<double> reals(pugi::xml_node element, const char* field) const; ///< finite ones
  std::vector<std::int32_t> integers(pugi::xml_node element, const char* field) const;
  double real(pugi::xml_node element, const char* field, double fallback) const;
  bool boolean(pugi::xml_node element, const char* field, bool fallback) const;

private:
  void addDefs(pugi::xml_node element, std::size_t depth);

  std::string_view text_;
  const std::string& name_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::map<std::string_view, pugi::xml_node> defs_; ///< the first of each name
};

} // namespace imgeo::x3d
