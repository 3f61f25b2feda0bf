#pragma once
// The prototypes that a document and the files of its EXTERNPROTOs declare, and which of them an instance names.

#include "import/x3d/extern_prototypes.h"
#include "import/x3d/prototype_report.h"

#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace imgeo::x3d {

/// Whether an element is a ProtoDeclare or an ExternProtoDeclare.
bool isDeclaration(pugi::xml_node node);

/// The first node of a prototype's body, the only one that is rendered. A null node where the body has none.
pugi::xml_node firstNodeOf(pugi::xml_node declaration);

/// Whether a node of a body besides the first stays: it sends events but is not drawn.
bool isOfEvents(pugi::xml_node node);

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

class PrototypeScopes {
public:
  /// Prototypes that cannot be read, and nodes of bodies that are left out, are added to `report`. Both must outlive
  /// this.
  PrototypeScopes(ExternPrototypes& externals, PrototypeReport& report) : externals_(externals), report_(report) {}

  /// Adds the scope of a document; it stays valid as long as this.
  Prototype* addScope();

  /// Declares a prototype, with those of its body, and moves its declaration to `removed`, from where it is copied.
  void declare(pugi::xml_node declaration, Prototype& scope, pugi::xml_node removed);

  /// The prototype of an instance within `scope`, for which a file may be read; null where there is none. Throws
  /// Error{limit} beyond the maximum number of files.
  Prototype* prototypeOf(pugi::xml_node instance, Prototype& scope);

private:
  Prototype* readExternal(pugi::xml_node declaration, pugi::xml_node instance);
  Prototype* prototypeIn(ExternPrototypes::File& file, const std::string& name);

  ExternPrototypes& externals_;
  PrototypeReport& report_;
  std::vector<std::unique_ptr<Prototype>> prototypes_; ///< all, and the scopes of documents
  std::map<ExternPrototypes::File*, Prototype*> scopes_;
  std::size_t order_ = 0;
};

} // namespace imgeo::x3d
