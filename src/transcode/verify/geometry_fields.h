#pragma once
// Compares an element of a site's document, which convert has written as it was read, with the node of the input.

#include "markup/x3d_element.h"
#include "scene/scene.h"

#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <utility>

namespace imgeo {

/// A document of a site, as far as the comparison of an element needs it.
struct ComparedDocument {
  ElementsByDef defs;
  bool isPage = false; ///< pages have no attributes and elements on which browsers would act
};

/// Compares elements with nodes: their fields, those of their children, and so on. Values are equal where X3D reads the
/// same from both texts: numbers in single precision (integers, and the coordinates of a CoordinateDouble, exactly),
/// booleans, strings. A field that is absent has X3D's default. Names (DEF, id, class), metadata and comments are not
/// compared.
class GeometryFieldComparer {
public:
  /// Both must outlive the comparer.
  GeometryFieldComparer(const ComparedDocument& document, const SceneGraph& input)
      : document_(document), input_(input) {}

  /// What the element has and the input's node has not, as the end of a sentence: `has size "1 2 3", in the input
  /// "3 2 1"`. Nothing where they are equal.
  std::optional<std::string> differenceOf(pugi::xml_node element, std::size_t node);

private:
  std::optional<std::string> differenceOfFields(pugi::xml_node element, const Node& node) const;
  std::optional<std::string> differenceOfChildren(pugi::xml_node element, const Node& node);
  std::vector<pugi::xml_node> childrenOf(pugi::xml_node element) const;
  std::vector<std::size_t> childrenOf(const Node& node) const;

  const ComparedDocument& document_;
  const SceneGraph& input_;
  std::set<std::pair<pugi::xml_node_struct*, std::size_t>> equal_; ///< a Coordinate may belong to many geometries
};

} // namespace imgeo
