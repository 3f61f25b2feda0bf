#include "import/x3d/routes.h"

#include "documents/node_fields.h"
#include "import/x3d/event_fields.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace imgeo::x3d {

namespace {

/// The DEFs that the routes and exports of a document name, and the names of nodes that it imports.
struct NameCollector : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node& node) override {
    const std::string_view element = node.name();
    if (element == "ROUTE")
      for (const char* end : {"fromNode", "toNode"})
        connected.insert(node.attribute(end).value());
    if (element == "EXPORT")
      connected.insert(node.attribute("localDEF").value());
    if (element == "IMPORT")
      imported.insert(node.attribute(node.attribute("AS") ? "AS" : "importedDEF").value());
    return true;
  }
  std::set<std::string, std::less<>> connected, imported;
};

/// Adds the elements with these DEFs, and all around them, to a set.
void addConnected(const Source& source, const std::set<std::string, std::less<>>& names,
                  std::set<pugi::xml_node_struct*>& connected) {
  for (const std::string& name : names)
    for (pugi::xml_node node = source.defined(name); node && connected.insert(node.internal_object()).second;)
      node = node.parent();
}

std::vector<float> floatsOf(const std::vector<double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

} // namespace

Routes::Routes(const Source& source, Faults& faults) : source_(source), faults_(faults) {
  NameCollector names;
  source.root().traverse(names);
  addConnected(source, names.connected, connected_);
  imported_ = std::move(names.imported);
}

bool Routes::isImported(pugi::xml_node route) const {
  return std::ranges::any_of(std::array{"fromNode", "toNode"}, [&](const char* end) {
    const std::string_view name = route.attribute(end).value();
    return imported_.contains(name) && !source_.defined(name);
  });
}

bool Routes::connects(pugi::xml_node element) const {
  return connected_.contains(element.internal_object());
}

std::optional<Interpolator> Routes::interpolator(InterpolatorKind kind, pugi::xml_node element) {
  std::optional<Interpolator> interpolator = faults_.attempt("Left out", [&]() -> std::optional<Interpolator> {
    Interpolator read{kind, floatsOf(source_.reals(element, "key")), floatsOf(source_.reals(element, "keyValue"))};
    if (const std::string fault = faultOf(read); !fault.empty())
      source_.fail(element, ErrorKind::malformed, fault);
    return read;
  });
  if (!interpolator)
    malformed_.insert(element.internal_object());
  return interpolator;
}

TimeSensor Routes::timeSensor(pugi::xml_node element, std::vector<FieldText>& fields) {
  struct Read {
    Routes& routes;
    pugi::xml_node element;
    std::vector<FieldText>& fields;

    void operator()(const char* name, bool& member, Written = {}) {
      member = routes.source_.boolean(element, name, member);
    }
    void operator()(const char* name, double& member, Written = {}) {
      const bool isRead = routes.faults_.attempt("A field is left out", [&] {
        const double value = routes.source_.real(element, name, member);
        if (name == std::string_view("cycleInterval") && !(value > 0))
          routes.source_.fail(element, ErrorKind::malformed, "cycleInterval is not above 0");
        member = value;
        return true;
      });
      if (!isRead)
        std::erase_if(fields, [&](const FieldText& field) { return field.name == name; });
    }
    void line() {}
  };
  TimeSensor sensor;
  visitFields(sensor, Read{*this, element, fields});
  return sensor;
}

Route Routes::checked(pugi::xml_node element, pugi::xml_node from, pugi::xml_node to,
                      const std::map<std::string, std::size_t>& nodes) const {
  const auto fail = [&](const std::string& message) { source_.fail(element, ErrorKind::malformed, message); };
  struct End {
    std::size_t node;
    std::string name, field;
    EventField event;
  };
  const auto endOf = [&](const char* nodeName, const char* fieldName, pugi::xml_node node) {
    End end{0, element.attribute(nodeName).value(), element.attribute(fieldName).value(), {}};
    if (!node)
      fail(fmt::format("no node has the DEF \"{}\"", end.name));
    const auto found = nodes.find(end.name);
    if (found == nodes.end())
      fail(fmt::format("the {} \"{}\" has become a part of a mesh, or is not in the scene", node.name(), end.name));
    end.node = found->second;
    const std::optional<EventField> event = eventField(node.name(), end.field);
    if (!event || end.field.empty())
      fail(fmt::format("a {} has no field \"{}\" for routes", node.name(), end.field));
    end.event = *event;
    return end;
  };
  End source = endOf("fromNode", "fromField", from), target = endOf("toNode", "toField", to);
  if (source.event.access == FieldAccess::inputOnly)
    fail(fmt::format("{} of \"{}\" only takes events", source.field, source.name));
  if (target.event.access == FieldAccess::outputOnly)
    fail(fmt::format("{} of \"{}\" only sends events", target.field, target.name));
  if (!source.event.type.empty() && !target.event.type.empty() && source.event.type != target.event.type)
    fail(fmt::format("{} of \"{}\" is of type {}, {} of \"{}\" of type {}", source.field, source.name,
                     source.event.type, target.field, target.name, target.event.type));
  return {source.node, std::move(source.field), target.node, std::move(target.field)};
}

} // namespace imgeo::x3d
