#pragma once
// What the expansion of prototypes reports about a document.

#include <cstddef>
#include <map>
#include <string>
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

} // namespace imgeo::x3d
