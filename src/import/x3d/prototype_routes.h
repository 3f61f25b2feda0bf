#pragma once
// Replaces routes from and to fields of prototype instances by routes of the fields that these stand for.

#include "import/x3d/elements.h"

#include <compare>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// The end of a route.
struct RouteEnd {
  std::string node, field;
  friend auto operator<=>(const RouteEnd&, const RouteEnd&) = default;
};

class PrototypeRoutes {
public:
  /// `name`: of the document, for errors. It must outlive this.
  explicit PrototypeRoutes(const std::string& name) : name_(name) {}

  /// Notes that a field of an instance stands for a field of a node.
  void add(const RouteEnd& instanceField, const RouteEnd& nodeField);

  /// Replaces the routes of a document whose instances are expanded. Throws Error{limit} where that adds more than
  /// `maxAdded` routes, or where too many fields are connected.
  void replaceIn(Elements& elements, std::size_t maxAdded);

private:
  std::vector<RouteEnd> endsOf(const RouteEnd& end, std::size_t depth = 0);
  void replaceWithin(pugi::xml_node element, ElementOffsets& offsets);

  const std::string& name_;
  std::map<RouteEnd, std::vector<RouteEnd>> ends_; ///< by a field of an instance
  std::size_t routeEnds_ = 0, added_ = 0, maxAdded_ = 0;
};

} // namespace imgeo::x3d
