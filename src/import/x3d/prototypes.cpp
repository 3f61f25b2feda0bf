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

constexpr std::size_t maxWritten = 250'000; // elements
constexpr std::size_t maxNesting = 200;

bool isElement(pugi::xml_node node, std::string_view name) {
  return node.type() == pugi::node_element && node.name() == name;
}

bool isDeclaration(pugi::xml_node node) {
  return isElement(node, "ProtoDeclare") || isElement(node, "ExternProtoDeclare");
}

/// The node of a prototype that is seen.
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

/// A declaration with those in its body. A body names what was declared before it
/// alone, so that nothing can stand in itself.
struct Prototype {
  pugi::xml_node declaration;
  const Prototype* around = nullptr; ///< whose body the declaration stands in
  std::size_t order = std::numeric_limits<std::size_t>::max();
  std::map<std::string, std::unique_ptr<Prototype>> inner;
};

class Writer {
public:
  Writer(Elements& elements, const std::string& name) : elements_(elements), name_(name) {}

  PrototypeReport write() {
    noteNames(elements_.root(), 0, true);
    declarations_ = elements_.document.append_child("declarations");
    writeOutIn(elements_.root(), whole_, 0);
    elements_.document.remove_child(declarations_);
    return std::move(report_);
  }

private:
  [[noreturn]] void failOfDepth() const {
    throw Error(ErrorKind::limit, name_, "elements and prototypes are nested too deeply");
  }

  /// `counts`: not in the body of a prototype, of which there is none of its names yet.
  void noteNames(pugi::xml_node element, std::size_t depth, bool counts) {
    if (depth > maxNesting)
      failOfDepth();
    if (const pugi::xml_attribute def = element.attribute("DEF"); def && counts)
      names_.insert(def.value());
    for (const pugi::xml_node& child : elementsIn(element))
      noteNames(child, depth + 1, counts && !isElement(element, "ProtoDeclare"));
  }

  /// `around`: in whose body `parent` was written.
  void writeOutIn(pugi::xml_node parent, Prototype& around, std::size_t depth) {
    if (depth > maxNesting)
      failOfDepth();
    for (const pugi::xml_node& child : elementsIn(parent))
      if (isElement(child, "ProtoDeclare"))
        declare(child, around);
      else if (isElement(child, "ProtoInstance"))
        writeOut(child, around, depth);
      else
        writeOutIn(child, around, depth + 1);
  }

  void declare(pugi::xml_node declaration, Prototype& around) {
    const pugi::xml_node first = firstNodeOf(declaration);
    if (!first)
      return;
    auto prototype = std::make_unique<Prototype>();
    prototype->declaration = declaration;
    prototype->around = &around;
    for (const pugi::xml_node& other : elementsIn(declaration.child("ProtoBody")))
      if (isElement(other, "ProtoDeclare"))
        declare(other, *prototype);
      else if (other != first)
        ++report_.leftOut[other.name()];
    prototype->order = ++order_;
    declarations_.append_move(declaration); // out of the scene, where copies are still made of it
    ++report_.prototypes;
    around.inner[declaration.attribute("name").value()] = std::move(prototype);
  }

  Prototype* prototypeOf(pugi::xml_node instance, const Prototype& around) const {
    const char* name = instance.attribute("name").value();
    for (const Prototype* scope = &around; scope; scope = scope->around)
      if (const auto found = scope->inner.find(name);
          found != scope->inner.end() && found->second->order < around.order)
        return found->second.get();
    return nullptr;
  }

  void writeOut(pugi::xml_node instance, Prototype& around, std::size_t depth) {
    writeOutIn(instance, around, depth + 1); // what it is given may be instances, too
    Prototype* const prototype = prototypeOf(instance, around);
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
      writeOut(copy, *prototype, depth + 1);
    else
      writeOutIn(copy, *prototype, depth + 1);
  }

  static void set(pugi::xml_node element, const char* attribute, const char* value) {
    if (!element.attribute(attribute))
      element.append_attribute(attribute);
    element.attribute(attribute).set_value(value);
  }

  /// Names of a body are its own: each copy of it needs others.
  void rename(pugi::xml_node element, std::map<std::string, std::string>& names, std::size_t offset) {
    if (++written_ > maxWritten)
      throw Error(ErrorKind::limit, name_, fmt::format("prototypes stand for more than {} elements", maxWritten));
    elements_.offsets[element.internal_object()] = offset;
    if (pugi::xml_attribute def = element.attribute("DEF")) {
      std::string own = def.value();
      for (std::size_t& number = numbers_[own]; !names_.insert(own).second;)
        own = fmt::format("{}-{}", def.value(), ++number + 1);
      names[def.value()] = own;
      def.set_value(own.c_str());
    }
    if (pugi::xml_attribute use = element.attribute("USE"))
      if (const auto found = names.find(use.value()); found != names.end())
        use.set_value(found->second.c_str());
    for (const pugi::xml_node& child : elementsIn(element))
      rename(child, names, offset);
  }

  /// Fills in the fields that a node of the body takes from the prototype's.
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
    if (isElement(element, "ProtoInstance")) { // a prototype hands on what it was given
      target = element.append_child("fieldValue");
      target.append_attribute("name") = field;
      field = "value";
    }
    if (const pugi::xml_attribute given = value.attribute("value"))
      set(target, field, given.value());
    for (const pugi::xml_node& node : elementsIn(value)) {
      if (++written_ > maxWritten)
        throw Error(ErrorKind::limit, name_, fmt::format("prototypes stand for more than {} elements", maxWritten));
      pugi::xml_node copy = target.append_copy(node);
      elements_.offsets[copy.internal_object()] = elements_.offsetOf(node);
      const bool isSaid = target == element && field != defaultContainerField(copy.name());
      if (isSaid && !copy.attribute("containerField"))
        copy.append_attribute("containerField") = field;
    }
  }

  Elements& elements_;
  const std::string& name_;
  Prototype whole_; ///< the document, as if it were a body
  std::size_t order_ = 0;
  PrototypeReport report_;
  pugi::xml_node declarations_;
  std::set<std::string> names_;
  std::map<std::string, std::size_t> numbers_;
  std::size_t written_ = 0;
};

} // namespace

PrototypeReport writeOutPrototypes(Elements& elements, const std::string& name) {
  return Writer(elements, name).write();
}

} // namespace imgeo::x3d
