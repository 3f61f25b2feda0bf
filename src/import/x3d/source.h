#pragma once
// The elements of an X3D file, with its DEFs: what geometry nodes are read from.

#include "base/error.h"
#include "import/x3d/elements.h"
#include "import/x3d/mf_values.h"

#include <map>
#include <string>

namespace imgeo::x3d {

class Source {
public:
  /// The elements of `text`, which with `name` outlives the source. Throws Error{limit}.
  Source(Elements elements, std::string_view text, const std::string& name);

  /// <X3D>.
  pugi::xml_node root() const { return elements_.root(); }
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

  Elements elements_;
  std::string_view text_;
  const std::string& name_;
  std::map<std::string_view, pugi::xml_node> defs_; ///< the first of each name
};

} // namespace imgeo::x3d
