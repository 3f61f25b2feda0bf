#pragma once
// The elements that a VRML file becomes, and the scopes of its DEF and prototype names: one for the document and one
// for the body of each prototype.

#include "import/vrml/tokens.h"
#include "import/x3d/elements.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

class VrmlElements {
public:
  /// `tokens` must outlive the elements; they give the location of errors.
  explicit VrmlElements(const VrmlTokens& tokens) : tokens_(tokens), scopes_(1) {}

  pugi::xml_node top() { return elements_.document; }
  void setFormat(const char* format) { elements_.format = format; }
  Elements take() { return std::move(elements_); }

  /// Appends an element whose text begins at `where`.
  pugi::xml_node add(pugi::xml_node parent, std::string_view element, const Token& where);
  /// Throws Error{malformed} for the name of a node or field that XML does not allow as the name of an element or
  /// attribute.
  void requireName(const Token& where, std::string_view name) const;

  struct Definition {
    std::string name; ///< the name in the result: with a number where an earlier DEF has the same name
    std::string element;
  };
  /// Records the DEF of a node, which hides earlier ones of the same name; returns its name in the result.
  std::string define(const std::string& name, const std::string& element);
  /// The latest DEF of a name; null where there is none.
  const Definition* definition(const std::string& name) const;
  /// The name in the result of the latest DEF of a name; the name itself where there is none.
  std::string currentName(const std::string& name) const;

  /// The declaration of a prototype; a null node for other words.
  pugi::xml_node prototype(std::string_view name) const;
  void declare(const std::string& name, pugi::xml_node declaration);

  /// Opens the scope of a prototype's body, which sees the enclosing prototypes but no enclosing DEF names.
  void openScope();
  void closeScope() { scopes_.pop_back(); }

private:
  struct Scope {
    std::map<std::string, Definition, std::less<>> definitions; ///< the latest by name
    std::map<std::string, std::size_t, std::less<>> definitionCounts;
    std::map<std::string, pugi::xml_node, std::less<>> prototypes;
  };

  const VrmlTokens& tokens_;
  Elements elements_;
  std::vector<Scope> scopes_;
};

/// Sets an attribute, replacing an earlier value.
void set(pugi::xml_node element, std::string_view attribute, std::string_view value);
/// Sets containerField where it differs from the default of the element.
void setContainerField(pugi::xml_node element, std::string_view field);
void addComments(pugi::xml_node parent, const std::vector<std::string_view>& comments);

} // namespace imgeo::x3d
