#include "import/x3d/prototypes.h"

#include "base/error.h"
#include "import/vrml/names.h"
#include "import/x3d/element_edits.h"
#include "import/x3d/node_table.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <compare>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxExpandedElements = 250'000;
constexpr std::size_t maxNesting = 200;

bool isElement(pugi::xml_node node, std::string_view name) {
  return node.type() == pugi::node_element && node.name() == name;
}

bool isDeclaration(pugi::xml_node node) {
  return isElement(node, "ProtoDeclare") || isElement(node, "ExternProtoDeclare");
}

/// The first node of a prototype's body, the only one that is rendered.
pugi::xml_node firstNodeOf(pugi::xml_node declaration) {
  for (const pugi::xml_node& node : declaration.child("ProtoBody").children())
    if (node.type() == pugi::node_element && !isDeclaration(node))
      return node;
  return {};
}

/// Whether a node of a body besides the first stays: it sends events but is not drawn.
bool isOfEvents(pugi::xml_node node) {
  const NodeRow* row = nodeRow(node.name());
  return row && row->treatment == NodeTreatment::drawn &&
         (row->component == "Time" || row->component == "Interpolation" || row->component == "EventUtilities" ||
          row->name == "ROUTE");
}

/// The end of a route.
struct RouteEnd {
  std::string node, field;
  friend auto operator<=>(const RouteEnd&, const RouteEnd&) = default;
};

/// A declaration and the prototypes that its body declares; or the scope of a document.
struct Prototype {
  /// The prototype that a name stands for. A body may use only names that were declared before it, so that no prototype
  /// of one file can contain itself.
  struct Entry {
    Prototype* prototype = nullptr; ///< null for an external one that has not been read
    pugi::xml_node externDeclaration;
    std::size_t order = 0; ///< its number in the order of declarations
  };

  pugi::xml_node declaration;
  Prototype* enclosing = nullptr;                              ///< the scope that contains the declaration
  std::size_t order = std::numeric_limits<std::size_t>::max(); ///< as in Entry; max for a document
  std::map<std::string, Entry> inner;
  bool isExpanding = false; ///< an instance of it is being expanded
};

class PrototypeExpander {
public:
  PrototypeExpander(Elements& elements, const std::string& name, ExternPrototypes& externals)
      : elements_(elements), name_(name), externals_(externals) {}

  PrototypeReport run() {
    noteNames(elements_.root(), 0, true);
    declarations_ = elements_.document.append_child("declarations");
    expandIn(elements_.root(), *addScope(), 0);
    connectRoutes(elements_.root());
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

  Prototype* addScope() { return prototypes_.emplace_back(std::make_unique<Prototype>()).get(); }

  /// `scope`: the prototype whose body contains `parent`, or the document's.
  void expandIn(pugi::xml_node parent, Prototype& scope, std::size_t depth) {
    if (depth > maxNesting)
      failTooDeep();
    for (const pugi::xml_node& child : elementsOf(parent))
      if (isDeclaration(child))
        declare(child, scope, declarations_);
      else if (isElement(child, "ProtoInstance"))
        expand(child, scope, depth);
      else
        expandIn(child, scope, depth + 1);
  }

  /// Declares a prototype and moves its declaration to `removed`, from where it is copied.
  void declare(pugi::xml_node declaration, Prototype& scope, pugi::xml_node removed) {
    const std::string name = declaration.attribute("name").value();
    if (isElement(declaration, "ExternProtoDeclare")) {
      scope.inner[name] = {nullptr, declaration, ++order_};
      removed.append_move(declaration);
      return;
    }
    Prototype* const prototype = addScope();
    prototype->declaration = declaration;
    prototype->enclosing = &scope;
    const pugi::xml_node first = firstNodeOf(declaration);
    for (const pugi::xml_node& other : elementsOf(declaration.child("ProtoBody")))
      if (isDeclaration(other))
        declare(other, *prototype, removed);
      else if (other != first && !isOfEvents(other))
        ++report_.leftOut[other.name()];
    prototype->order = ++order_;
    removed.append_move(declaration);
    scope.inner[name] = {prototype, {}, prototype->order};
  }

  /// The prototype of an instance within `scope`; null where there is none.
  Prototype* prototypeOf(pugi::xml_node instance, Prototype& scope) {
    const char* name = instance.attribute("name").value();
    for (Prototype* at = &scope; at; at = at->enclosing)
      if (const auto found = at->inner.find(name); found != at->inner.end() && found->second.order < scope.order) {
        Prototype::Entry& entry = found->second;
        if (!entry.prototype && entry.externDeclaration)
          entry.prototype = readExternal(std::exchange(entry.externDeclaration, {}), instance);
        return entry.prototype;
      }
    return nullptr;
  }

  /// Reads the first file of an EXTERNPROTO that can be read; null where none can.
  Prototype* readExternal(pugi::xml_node declaration, pugi::xml_node instance) {
    std::string cause = "it has no url";
    for (const std::string& url : parseStrings(declaration.attribute("url").value()))
      try {
        const ExternPrototypes::Named named = externals_.find(url);
        if (Prototype* found = prototypeIn(*named.file, named.prototype))
          return found;
        cause = fmt::format("{} has no prototype {}", url, named.prototype);
      } catch (const Error& error) {
        if (error.kind() == ErrorKind::limit)
          throw;
        cause = error.what();
      }
    report_.failures.push_back(fmt::format("The instances of the external prototype {} are left out: {}",
                                           instance.attribute("name").value(), cause));
    return nullptr;
  }

  /// A prototype of a file by its name, or its first; null where there is none.
  Prototype* prototypeIn(ExternPrototypes::File& file, const std::string& name) {
    Prototype*& scope = scopes_[&file];
    if (!scope) {
      scope = addScope();
      pugi::xml_node removed = file.elements.document.append_child("declarations");
      for (const pugi::xml_node& child : elementsOf(file.elements.root().child("Scene")))
        if (isDeclaration(child))
          declare(child, *scope, removed);
    }
    Prototype::Entry* first = nullptr;
    for (auto& [each, entry] : scope->inner)
      if (each == name || (name.empty() && (!first || entry.order < first->order)))
        first = &entry;
    return first ? first->prototype : nullptr;
  }

  void expand(pugi::xml_node instance, Prototype& scope, std::size_t depth) {
    expandIn(instance, scope, depth + 1); // its field values may contain instances too
    Prototype* const prototype = prototypeOf(instance, scope);
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
      const RouteEnd end{element.attribute("DEF").value(), nodeField};
      if (const RouteEnd from{instance, protoField}; from != end)
        ends_[from].push_back(end);
    }
    connections_.clear();
  }

  /// The fields of nodes that a field of an instance stands for; the field itself where it is no instance's.
  std::vector<RouteEnd> endsOf(const RouteEnd& end, std::size_t depth = 0) {
    if (++routeEnds_ > maxExpandedElements)
      throw Error(ErrorKind::limit, name_, "routes connect too many fields of prototypes");
    std::vector<RouteEnd> all;
    if (const auto found = ends_.find(end); found != ends_.end() && depth < maxNesting) {
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

  /// Replaces routes from and to fields of instances by routes of the fields that these stand for.
  void connectRoutes(pugi::xml_node element) {
    for (pugi::xml_node& child : elementsOf(element)) {
      if (!isElement(child, "ROUTE")) {
        connectRoutes(child);
        continue;
      }
      const auto at = [&](const char* node, const char* field) {
        return endsOf({child.attribute(node).value(), child.attribute(field).value()});
      };
      const std::vector<RouteEnd> sources = at("fromNode", "fromField"), targets = at("toNode", "toField");
      for (std::size_t i = 0; i < sources.size(); ++i)
        for (std::size_t j = 0; j < targets.size(); ++j) {
          const bool isLast = i + 1 == sources.size() && j + 1 == targets.size();
          if (!isLast && ++expandedElements_ > maxExpandedElements)
            throw Error(ErrorKind::limit, name_, "routes connect too many fields of prototypes");
          pugi::xml_node route = isLast ? child : element.insert_copy_before(child, child);
          if (!isLast)
            elements_.offsets.add(route, elements_.offsets.of(child));
          setField(route, "fromNode", sources[i].node);
          setField(route, "fromField", sources[i].field);
          setField(route, "toNode", targets[j].node);
          setField(route, "toField", targets[j].field);
        }
    }
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
  ExternPrototypes& externals_;
  std::vector<std::unique_ptr<Prototype>> prototypes_; ///< all, and the scopes of documents
  std::map<ExternPrototypes::File*, Prototype*> scopes_;
  std::set<Prototype*> expanded_;
  std::size_t order_ = 0;
  PrototypeReport report_;
  pugi::xml_node declarations_;
  std::set<std::string> names_;                ///< the DEF names in the scene
  std::map<std::string, std::size_t> numbers_; ///< the last number that was tried as a suffix, by DEF name
  std::size_t expandedElements_ = 0, routeEnds_ = 0;
  struct Connection {
    pugi::xml_node element;
    std::string nodeField, protoField;
  };
  std::vector<Connection> connections_;            ///< of the instance that is being expanded
  std::map<RouteEnd, std::vector<RouteEnd>> ends_; ///< by a field of an instance
};

} // namespace

PrototypeReport expandPrototypes(Elements& elements, const std::string& name, ExternPrototypes& externals) {
  return PrototypeExpander(elements, name, externals).run();
}

} // namespace imgeo::x3d
