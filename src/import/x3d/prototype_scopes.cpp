#include "import/x3d/prototype_scopes.h"

#include "base/error.h"
#include "import/x3d/element_edits.h"
#include "import/x3d/node_table.h"
#include "scene/mf_string.h"

#include <fmt/format.h>
#include <utility>

namespace imgeo::x3d {

bool isDeclaration(pugi::xml_node node) {
  return isElement(node, "ProtoDeclare") || isElement(node, "ExternProtoDeclare");
}

pugi::xml_node firstNodeOf(pugi::xml_node declaration) {
  for (const pugi::xml_node& node : declaration.child("ProtoBody").children())
    if (node.type() == pugi::node_element && !isDeclaration(node))
      return node;
  return {};
}

bool isOfEvents(pugi::xml_node node) {
  const NodeRow* row = nodeRow(node.name());
  return row && row->treatment == NodeTreatment::drawn &&
         (row->component == "Time" || row->component == "Interpolation" || row->component == "EventUtilities" ||
          row->name == "ROUTE");
}

Prototype* PrototypeScopes::addScope() {
  return prototypes_.emplace_back(std::make_unique<Prototype>()).get();
}

void PrototypeScopes::declare(pugi::xml_node declaration, Prototype& scope, pugi::xml_node removed) {
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

Prototype* PrototypeScopes::prototypeOf(pugi::xml_node instance, Prototype& scope) {
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
Prototype* PrototypeScopes::readExternal(pugi::xml_node declaration, pugi::xml_node instance) {
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
Prototype* PrototypeScopes::prototypeIn(ExternPrototypes::File& file, const std::string& name) {
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

} // namespace imgeo::x3d
