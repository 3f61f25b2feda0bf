#pragma once
// Reads the routes, interpolators and TimeSensors of an X3D document.

#include "import/x3d/faults.h"
#include "import/x3d/source.h"
#include "scene/scene.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::x3d {

class Routes {
public:
  /// Everything must outlive this.
  Routes(const Source& source, Faults& faults);

  /// Whether a route or an EXPORT names the DEF of an element or of one within it: then the element must stay a node of
  /// the scene.
  bool connects(pugi::xml_node element) const;

  /// Reads an interpolator. Empty, with a warning, where it is malformed (faultOf), or an Error if strict.
  std::optional<Interpolator> interpolator(InterpolatorKind kind, pugi::xml_node element);

  /// Whether interpolator() has found an element malformed.
  bool isMalformed(pugi::xml_node element) const { return malformed_.contains(element.internal_object()); }

  /// The fields of a TimeSensor; malformed ones count as absent and are removed from `fields`, with a warning.
  TimeSensor timeSensor(pugi::xml_node element, std::vector<FieldText>& fields);

  /// Whether a ROUTE begins or ends at a node of an inlined document that an IMPORT names (ISO/IEC 19775-1, 4.4.6).
  /// Such a route is kept as it is.
  bool isImported(pugi::xml_node route) const;

  /// Notes a ROUTE.
  void note(pugi::xml_node route) { routes_.push_back(route); }

  /// The routes that have been noted, between nodes by their DEF. One warning for each that names no node or no field,
  /// or fields of different types. `isLeftOut`: whether an element is left out of the scene, with a warning of its own.
  template <typename IsLeftOut>
  std::vector<Route> read(const std::map<std::string, std::size_t>& nodes, const IsLeftOut& isLeftOut) {
    std::vector<Route> routes;
    for (const pugi::xml_node& element : routes_) {
      const auto end = [&](const char* name) { return source_.defined(element.attribute(name).value()); };
      const pugi::xml_node from = end("fromNode"), to = end("toNode");
      if ((from && isLeftOut(from)) || (to && isLeftOut(to)))
        continue;
      std::optional<Route> route =
          faults_.attempt("Left out", [&] { return std::optional(checked(element, from, to, nodes)); });
      if (route && std::ranges::find(routes, *route) == routes.end())
        routes.push_back(*std::move(route));
    }
    return routes;
  }

private:
  Route checked(pugi::xml_node element, pugi::xml_node from, pugi::xml_node to,
                const std::map<std::string, std::size_t>& nodes) const;

  const Source& source_;
  Faults& faults_;
  std::vector<pugi::xml_node> routes_;
  std::set<pugi::xml_node_struct*> connected_; ///< elements with a routed DEF, and those around them
  std::set<pugi::xml_node_struct*> malformed_;
  std::set<std::string, std::less<>> imported_; ///< names of nodes of inlined documents
};

} // namespace imgeo::x3d
