#pragma once
// Expands prototype instances into the nodes of the prototypes' bodies.

#include "import/x3d/elements.h"
#include "import/x3d/extern_prototypes.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

struct PrototypeReport {
  std::size_t instances = 0, prototypes = 0; ///< that were expanded
  /// Nodes of prototype bodies besides the first, which are dropped unless they only send events; counts by element
  /// name.
  std::map<std::string, std::size_t> leftOut;
  /// A sentence for each prototype that could not be read or contains itself. Its instances stay ProtoInstances.
  std::vector<std::string> failures;
};

/// Replaces each instance by a copy of the first node of its prototype's body, the only node that is rendered (ISO/IEC
/// 19775-1, 4.4.4.3), with the field values of the instance, and removes the declarations. Copies of the body's further
/// nodes that only send events, and of its routes, go to the end of the scene; routes to a field of an instance become
/// routes to the fields that it stands for. `externals` reads the files of external prototypes. Safe for untrusted
/// documents: throws Error{limit} naming `name` where nested prototypes expand to too many elements.
PrototypeReport expandPrototypes(Elements& elements, const std::string& name, ExternPrototypes& externals);

} // namespace imgeo::x3d
