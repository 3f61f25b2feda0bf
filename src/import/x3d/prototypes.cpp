#include "import/x3d/prototypes.h"

#include "base/error.h"
#include "import/vrml/names.h"

#include <fmt/format.h>
#include <limits>
#include <memory>
#include <set>
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

std::vector<pugi::xml_node> elementsIn(pugi::xml_node parent) {
  std::vector<pugi::xml_node> elements;
  for (const pugi::xml_node& child : parent.children())
    if (child.type() == pugi::node_element)
      elements.push_back(child);
  return elements;
}

/// A declaration and the declarations in its body. A body may use only prototypes that were declared before it, so that
/// no prototype can contain itself.
struct Prototype {
  pugi::xml_node declaration;
  const Prototype* enclosing = nullptr; ///< the prototype whose body contains the declaration
  std::size_t order =
      std::numeric_limits<std::size_t>::max(); ///< its number in the order of declarations; max for the document
  std::map<std::string, std::unique_ptr<Prototype>> inner;
};

class PrototypeExpander {
public:
  PrototypeExpander(Elements& elements, const std::string& name) : elements_(elements), name_(name) {}

  PrototypeReport run() {
    noteNames(elements_.root(), 0, true);
    declarations_ = elements_.document.append_child("declarations");
    expandIn(elements_.root(), document_, 0);
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
    for (const pugi::xml_node& child : elementsIn(element))
      noteNames(child, depth + 1, isInScene && !isElement(element, "ProtoDeclare"));
  }

  /// `enclosing`: the prototype whose body contains `parent`.
  void expandIn(pugi::xml_node parent, Prototype& enclosing, std::size_t depth) {
    if (depth > maxNesting)
      failTooDeep();
    for (const pugi::xml_node& child : elementsIn(parent))
      if (isElement(child, "ProtoDeclare"))
        declare(child, enclosing);
      else if (isElement(child, "ProtoInstance"))
        expand(child, enclosing, depth);
      else
        expandIn(child, enclosing, depth + 1);
  }

  void declare(pugi::xml_node declaration, Prototype& enclosing) {
    const pugi::xml_node first = firstNodeOf(declaration);
    if (!first)
      return;
    auto prototype = std::make_unique<Prototype>();
    prototype->declaration = declaration;
    prototype->enclosing = &enclosing;
    for (const pugi::xml_node& other : elementsIn(declaration.child("ProtoBody")))
      if (isElement(other, "ProtoDeclare"))
        declare(other, *prototype);
      else if (other != first)
        ++report_.leftOut[other.name()];
    prototype->order = ++order_;
    declarations_.append_move(declaration); // removed from the scene but kept for copying
    ++report_.prototypes;
    enclosing.inner[declaration.attribute("name").value()] = std::move(prototype);
  }

  Prototype* prototypeOf(pugi::xml_node instance, const Prototype& enclosing) const {
    const char* name = instance.attribute("name").value();
    for (const Prototype* scope = &enclosing; scope; scope = scope->enclosing)
      if (const auto found = scope->inner.find(name);
          found != scope->inner.end() && found->second->order < enclosing.order)
        return found->second.get();
    return nullptr;
  }

  void expand(pugi::xml_node instance, Prototype& enclosing, std::size_t depth) {
    expandIn(instance, enclosing, depth + 1); // its field values may contain instances too
    Prototype* const prototype = prototypeOf(instance, enclosing);
    if (!prototype)
      return;
    pugi::xml_node copy = instance.parent().insert_copy_before(firstNodeOf(prototype->declaration), instance);
    ++report_.instances;
    std::map<std::string, std::string> names;
    rename(copy, names, elements_.offsetOf(instance));
    connect(copy, instance, prototype->declaration.child("ProtoInterface"));
    for (const char* field : {"DEF", "containerField"})
      if (const pugi::xml_attribute given = instance.attribute(field))
        set(copy, field, given.value());
    instance.parent().remove_child(instance);
    if (isElement(copy, "ProtoInstance"))
      expand(copy, *prototype, depth + 1);
    else
      expandIn(copy, *prototype, depth + 1);
  }

  static void set(pugi::xml_node element, const char* attribute, const char* value) {
    if (!element.attribute(attribute))
      element.append_attribute(attribute);
    element.attribute(attribute).set_value(value);
  }

  /// Makes the DEF names of a copied body unique, since each copy needs its own.
  void rename(pugi::xml_node element, std::map<std::string, std::string>& names, std::size_t offset) {
    if (++expandedElements_ > maxExpandedElements)
      throw Error(ErrorKind::limit, name_,
                  fmt::format("prototypes expand to more than {} elements", maxExpandedElements));
    elements_.offsets[element.internal_object()] = offset;
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
    for (const pugi::xml_node& child : elementsIn(element))
      rename(child, names, offset);
  }

  /// Sets the fields that nodes of the body connect to fields of the prototype.
  void connect(pugi::xml_node element, pugi::xml_node instance, pugi::xml_node interface) {
    for (const pugi::xml_node& child : elementsIn(element))
      if (!isElement(child, "IS"))
        connect(child, instance, interface);
    const pugi::xml_node is = element.child("IS");
    for (const pugi::xml_node& connection : is.children("connect")) {
      const char* protoField = connection.attribute("protoField").value();
      pugi::xml_node value = instance.find_child_by_attribute("fieldValue", "name", protoField);
      if (!value)
        value = interface.find_child_by_attribute("field", "name", protoField);
      fill(element, connection.attribute("nodeField").value(), value);
    }
    if (is)
      element.remove_child(is);
  }

  void fill(pugi::xml_node element, const char* field, pugi::xml_node value) {
    pugi::xml_node target = element;
    if (isElement(element, "ProtoInstance")) { // the value is passed on to a nested instance
      target = element.append_child("fieldValue");
      target.append_attribute("name") = field;
      field = "value";
    }
    if (const pugi::xml_attribute given = value.attribute("value"))
      set(target, field, given.value());
    for (const pugi::xml_node& node : elementsIn(value)) {
      if (++expandedElements_ > maxExpandedElements)
        throw Error(ErrorKind::limit, name_,
                    fmt::format("prototypes expand to more than {} elements", maxExpandedElements));
      pugi::xml_node copy = target.append_copy(node);
      elements_.offsets[copy.internal_object()] = elements_.offsetOf(node);
      const bool needsContainerField = target == element && field != defaultContainerField(copy.name());
      if (needsContainerField && !copy.attribute("containerField"))
        copy.append_attribute("containerField") = field;
    }
  }

  Elements& elements_;
  const std::string& name_;
  Prototype document_; ///< the document, treated like a body
  std::size_t order_ = 0;
  PrototypeReport report_;
  pugi::xml_node declarations_;
  std::set<std::string> names_;                ///< the DEF names in the scene
  std::map<std::string, std::size_t> numbers_; ///< the last number that was tried as a suffix, by DEF name
  std::size_t expandedElements_ = 0;
};

} // namespace

PrototypeReport expandPrototypes(Elements& elements, const std::string& name) {
  return PrototypeExpander(elements, name).run();
}

} // namespace imgeo::x3d
