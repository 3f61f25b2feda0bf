#pragma once
// Instances of prototypes -> the nodes that they stand for.

#include "import/x3d/elements.h"

#include <map>
#include <string>

namespace imgeo::x3d {

struct PrototypeReport {
  std::size_t instances = 0, prototypes = 0; ///< written out
  /// What prototypes hold beside the node that is seen, by element.
  std::map<std::string, std::size_t> leftOut;
};

/// Puts a copy of a prototype's first node, which is the one that is seen (ISO/IEC
/// 19775-1, 4.4.4.3), in the place of each of its instances, with the fields that the
/// instance gives it, and takes the declarations out. Instances of prototypes of
/// other files stay. Safe for untrusted documents: Error{limit} names `name` where
/// prototypes of prototypes grow without measure.
PrototypeReport writeOutPrototypes(Elements& elements, const std::string& name);

} // namespace imgeo::x3d
