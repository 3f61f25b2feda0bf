#pragma once
// The elements that a VRML file becomes, with the names that stand for them: a scope
// for the document, and one for the body of each prototype.

#include "import/vrml/tokens.h"
#include "import/x3d/elements.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

class VrmlElements {
public:
  /// `tokens` outlive the elements, and name the place of what is refused.
  explicit VrmlElements(const VrmlTokens& tokens) : tokens_(tokens), scopes_(1) {}

  pugi::xml_node top() { return elements_.document; }
  void setFormat(const char* format) { elements_.format = format; }
  Elements take() { return std::move(elements_); }

  /// Appends an element that begins at `where`.
  pugi::xml_node add(pugi::xml_node parent, std::string_view element, const Token& where);
  /// Names of nodes and fields become those of elements and attributes: throws
  /// Error{malformed} for one that XML does not have.
  void requireName(const Token& where, std::string_view name) const;

  struct Named {
    std::string name; ///< its own, or one with a number where that was given before
    std::string element;
  };
  /// Gives a node a name, which from there on stands for it alone; returns that it gets.
  std::string define(const std::string& name, const std::string& element);
  /// Nothing for a name that nobody has.
  const Named* named(const std::string& name) const;
  std::string currentName(const std::string& name) const;

  /// The declaration of a prototype; none for other words.
  pugi::xml_node prototype(std::string_view name) const;
  void declare(const std::string& name, pugi::xml_node declaration);

  /// A body sees the prototypes around it, and none of the names.
  void openScope();
  void closeScope() { scopes_.pop_back(); }

private:
  struct Scope {
    std::map<std::string, Named, std::less<>> names;
    std::map<std::string, std::size_t, std::less<>> timesGiven;
    std::map<std::string, pugi::xml_node, std::less<>> prototypes;
  };

  const VrmlTokens& tokens_;
  Elements elements_;
  std::vector<Scope> scopes_;
};

/// Gives an attribute its value; the latest counts.
void set(pugi::xml_node element, std::string_view attribute, std::string_view value);
/// Says which field a node stands in, where its kind does not.
void setContainerField(pugi::xml_node element, std::string_view field);
void addComments(pugi::xml_node parent, const std::vector<std::string_view>& comments);

} // namespace imgeo::x3d
