#include "import/x3d/prototype_routes.h"

#include "base/error.h"
#include "import/x3d/element_edits.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxConnectedFields = 250'000;
constexpr std::size_t maxConnectionDepth = 200;

} // namespace

void PrototypeRoutes::add(const RouteEnd& instanceField, const RouteEnd& nodeField) {
  if (instanceField != nodeField)
    ends_[instanceField].push_back(nodeField);
}

/// The fields of nodes that a field of an instance stands for; the field itself where it is no instance's.
std::vector<RouteEnd> PrototypeRoutes::endsOf(const RouteEnd& end, std::size_t depth) {
  if (++routeEnds_ > maxConnectedFields)
    throw Error(ErrorKind::limit, name_, "routes connect too many fields of prototypes");
  std::vector<RouteEnd> all;
  if (const auto found = ends_.find(end); found != ends_.end() && depth < maxConnectionDepth) {
    for (const RouteEnd& next : found->second)
      std::ranges::move(endsOf(next, depth + 1), std::back_inserter(all));
    return all;
  }
  // "set_x" and "x_changed" are names of the field x, too.
  const std::string_view field = end.field;
  std::string plain;
  if (field.starts_with("set_"))
    plain = field.substr(4);
  else if (field.ends_with("_changed"))
    plain = field.substr(0, field.size() - 8);
  if (!plain.empty() && ends_.contains({end.node, plain}))
    return endsOf({end.node, plain}, depth + 1);
  return {end};
}

void PrototypeRoutes::replaceIn(Elements& elements, std::size_t maxAdded) {
  maxAdded_ = maxAdded;
  replaceWithin(elements.root(), elements.offsets);
}

void PrototypeRoutes::replaceWithin(pugi::xml_node element, ElementOffsets& offsets) {
  for (pugi::xml_node& child : elementsOf(element)) {
    if (!isElement(child, "ROUTE")) {
      replaceWithin(child, offsets);
      continue;
    }
    const auto at = [&](const char* node, const char* field) {
      return endsOf({child.attribute(node).value(), child.attribute(field).value()});
    };
    const std::vector<RouteEnd> sources = at("fromNode", "fromField"), targets = at("toNode", "toField");
    for (std::size_t i = 0; i < sources.size(); ++i)
      for (std::size_t j = 0; j < targets.size(); ++j) {
        const bool isLast = i + 1 == sources.size() && j + 1 == targets.size();
        if (!isLast && ++added_ > maxAdded_)
          throw Error(ErrorKind::limit, name_, "routes connect too many fields of prototypes");
        pugi::xml_node route = isLast ? child : element.insert_copy_before(child, child);
        if (!isLast)
          offsets.add(route, offsets.of(child));
        setField(route, "fromNode", sources[i].node);
        setField(route, "fromField", sources[i].field);
        setField(route, "toNode", targets[j].node);
        setField(route, "toField", targets[j].field);
      }
  }
}

} // namespace imgeo::x3d
