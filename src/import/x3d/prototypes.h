#pragma once
// Expands prototype instances into the nodes of the prototypes' bodies.

#include "import/x3d/elements.h"

#include <map>
#include <string>

namespace imgeo::x3d {

struct PrototypeReport {
  std::size_t instances = 0, prototypes = 0; ///< that were expanded
  /// Nodes of prototype bodies besides the first, which are dropped; counts by element name.
  std::map<std::string, std::size_t> leftOut;
};

/// Replaces each instance by a copy of the first node of its prototype's body, the only node that is rendered (ISO/IEC
/// 19775-1, 4.4.4.3), with the field values of the instance, and removes the declarations. Instances of external
/// prototypes stay. Safe for untrusted documents: throws Error{limit} naming `name` where nested prototypes expand to
/// too many elements.
PrototypeReport expandPrototypes(Elements& elements, const std::string& name);

} // namespace imgeo::x3d
