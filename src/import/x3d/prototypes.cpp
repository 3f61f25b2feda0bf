#include "import/x3d/prototypes.h"

#include "base/error.h"
#include "import/vrml/names.h"
#include "import/x3d/element_edits.h"
#include "import/x3d/prototype_routes.h"
#include "import/x3d/prototype_scopes.h"

#include <fmt/format.h>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxExpandedElements = 250'000;
constexpr std::size_t maxNesting = 200;

class PrototypeExpander {
public:
  PrototypeExpander(Elements& elements, const std::string& name, ExternPrototypes& externals)
      : elements_(elements), name_(name), scopes_(externals, report_), routes_(name) {}

  PrototypeReport run() {
    noteNames(elements_.root(), 0, true);
    declarations_ = elements_.document.append_child("declarations");
    expandIn(elements_.root(), *scopes_.addScope(), 0);
    routes_.replaceIn(elements_, maxExpandedElements - expandedElements_);
    elements_.document.remove_child(declarations_);
    return std::move(report_);
  }

private:
  [[noreturn]] void failTooDeep() const {
    throw Error(ErrorKind::limit, name_, "elements and prototypes are nested too deeply");
  }

  /// Collects DEF names. `isInScene` is false inside prototype bodies, whose names are not in the scene yet.
  void noteNames(pugi::xml_node element, std::size_t depth, bool isInScene) {
    if (depth > maxNesting)
      failTooDeep();
    if (const pugi::xml_attribute def = element.attribute("DEF"); def && isInScene)
      names_.insert(def.value());
    for (const pugi::xml_node& child : elementsOf(element))
      noteNames(child, depth + 1, isInScene && !isElement(element, "ProtoDeclare"));
  }

  /// `scope`: the prototype whose body contains `parent`, or the document's.
  void expandIn(pugi::xml_node parent, Prototype& scope, std::size_t depth) {
    if (depth > maxNesting)
      failTooDeep();
    for (const pugi::xml_node& child : elementsOf(parent))
      if (isDeclaration(child))
        scopes_.declare(child, scope, declarations_);
      else if (isElement(child, "ProtoInstance"))
        expand(child, scope, depth);
      else
        expandIn(child, scope, depth + 1);
  }

  void expand(pugi::xml_node instance, Prototype& scope, std::size_t depth) {
    expandIn(instance, scope, depth + 1); // its field values may contain instances too
    Prototype* const prototype = scopes_.prototypeOf(instance, scope);
    if (!prototype)
      return;
    const pugi::xml_node first = firstNodeOf(prototype->declaration);
    if (prototype->isExpanding || !first) {
      report_.failures.push_back(fmt::format("The instances of the prototype {} are left out: it {}",
                                             instance.attribute("name").value(),
                                             first ? "contains itself" : "has no node"));
      return;
    }
    pugi::xml_node copy = instance.parent().insert_copy_before(first, instance);
    ++report_.instances;
    report_.prototypes += expanded_.insert(prototype).second;
    std::map<std::string, std::string> names;
    const std::size_t offset = elements_.offsets.of(instance);
    std::vector<pugi::xml_node> copies{copy};
    for (const pugi::xml_node& other : elementsOf(prototype->declaration.child("ProtoBody")))
      if (other != first && isOfEvents(other)) // at the end of the scene, where any of them may stand
        copies.push_back(elements_.root().child("Scene").append_copy(other));
    for (const pugi::xml_node& each : copies)
      rename(each, names, offset);
    for (const pugi::xml_node& each : copies)
      renameRoutes(each, names);
    connections_.clear();
    for (const pugi::xml_node& each : copies)
      connect(each, instance, prototype->declaration.child("ProtoInterface"), offset);
    for (const char* field : {"DEF", "containerField"})
      if (const pugi::xml_attribute given = instance.attribute(field)) {
        if (field == std::string_view("DEF"))
          renameEnds(copies, copy.attribute("DEF").value(), given.value());
        setField(copy, field, given.value());
      }
    noteConnections(instance.attribute("DEF").value());
    instance.parent().remove_child(instance);
    prototype->isExpanding = true;
    if (isElement(copy, "ProtoInstance"))
      expand(copy, *prototype, depth + 1);
    else
      expandIn(copy, *prototype, depth + 1);
    prototype->isExpanding = false;
  }

  /// Gives the DEF names of a copied body suffixes where the scene already has them.
  void rename(pugi::xml_node element, std::map<std::string, std::string>& names, std::size_t offset) {
    if (++expandedElements_ > maxExpandedElements)
      throw Error(ErrorKind::limit, name_,
                  fmt::format("prototypes expand to more than {} elements", maxExpandedElements));
    elements_.offsets.add(element, offset);
    if (pugi::xml_attribute def = element.attribute("DEF")) {
      std::string uniqueName = def.value();
      for (std::size_t& number = numbers_[uniqueName]; !names_.insert(uniqueName).second;)
        uniqueName = fmt::format("{}-{}", def.value(), ++number + 1);
      names[def.value()] = uniqueName;
      def.set_value(uniqueName.c_str());
    }
    if (pugi::xml_attribute use = element.attribute("USE"))
      if (const auto found = names.find(use.value()); found != names.end())
        use.set_value(found->second.c_str());
    for (const pugi::xml_node& child : elementsOf(element))
      rename(child, names, offset);
  }

  /// Gives the ends of routes in a copied body the new names of their nodes.
  static void renameRoutes(pugi::xml_node element, const std::map<std::string, std::string>& names) {
    if (isElement(element, "ROUTE"))
      for (const char* end : {"fromNode", "toNode"})
        if (const auto found = names.find(element.attribute(end).value()); found != names.end())
          element.attribute(end).set_value(found->second.c_str());
    for (const pugi::xml_node& child : elementsOf(element))
      renameRoutes(child, names);
  }

  /// The body's first node gets the DEF of its instance: routes of the body follow.
  static void renameEnds(const std::vector<pugi::xml_node>& copies, const std::string& from, const std::string& to) {
    if (!from.empty())
      for (const pugi::xml_node& copy : copies)
        renameRoutes(copy, {{from, to}});
  }

  /// Notes which fields of nodes the fields of an instance with a DEF stand for, for routes to the instance.
  void noteConnections(const std::string& instance) {
    for (auto& [element, nodeField, protoField] : connections_) {
      if (instance.empty())
        break;
      if (!element.attribute("DEF")) {
        std::string name = fmt::format("{}-{}", instance, protoField);
        for (std::size_t number = 2; !names_.insert(name).second; ++number)
          name = fmt::format("{}-{}-{}", instance, protoField, number);
        element.append_attribute("DEF").set_value(name.c_str());
      }
      routes_.add({instance, protoField}, {element.attribute("DEF").value(), nodeField});
    }
    connections_.clear();
  }

  /// Sets the fields that nodes of the body connect to fields of the prototype.
  void connect(pugi::xml_node element, pugi::xml_node instance, pugi::xml_node interface, std::size_t offset) {
    for (const pugi::xml_node& child : elementsOf(element))
      if (!isElement(child, "IS"))
        connect(child, instance, interface, offset);
    const pugi::xml_node is = element.child("IS");
    for (const pugi::xml_node& connection : is.children("connect")) {
      const char* protoField = connection.attribute("protoField").value();
      pugi::xml_node value = instance.find_child_by_attribute("fieldValue", "name", protoField);
      if (!value)
        value = interface.find_child_by_attribute("field", "name", protoField);
      fill(element, connection.attribute("nodeField").value(), value, offset);
      connections_.push_back({element, connection.attribute("nodeField").value(), protoField});
    }
    if (is)
      element.remove_child(is);
  }

  void fill(pugi::xml_node element, const char* field, pugi::xml_node value, std::size_t offset) {
    pugi::xml_node target = element;
    if (isElement(element, "ProtoInstance")) { // the value is passed on to a nested instance
      target = element.append_child("fieldValue");
      target.append_attribute("name") = field;
      field = "value";
    }
    if (const pugi::xml_attribute given = value.attribute("value"))
      setField(target, field, given.value());
    for (const pugi::xml_node& node : elementsOf(value)) {
      if (++expandedElements_ > maxExpandedElements)
        throw Error(ErrorKind::limit, name_,
                    fmt::format("prototypes expand to more than {} elements", maxExpandedElements));
      pugi::xml_node copy = target.append_copy(node);
      elements_.offsets.add(copy, offset);
      const bool needsContainerField = target == element && field != defaultContainerField(copy.name());
      if (needsContainerField && !copy.attribute("containerField"))
        copy.append_attribute("containerField") = field;
    }
  }

  Elements& elements_;
  const std::string& name_;
  PrototypeReport report_;
  PrototypeScopes scopes_;
  PrototypeRoutes routes_;
  std::set<Prototype*> expanded_;
  pugi::xml_node declarations_;
  std::set<std::string> names_;                ///< the DEF names in the scene
  std::map<std::string, std::size_t> numbers_; ///< the last number that was tried as a suffix, by DEF name
  std::size_t expandedElements_ = 0;
  struct Connection {
    pugi::xml_node element;
    std::string nodeField, protoField;
  };
  std::vector<Connection> connections_; ///< of the instance that is being expanded
};

} // namespace

PrototypeReport expandPrototypes(Elements& elements, const std::string& name, ExternPrototypes& externals) {
  return PrototypeExpander(elements, name, externals).run();
}

} // namespace imgeo::x3d
