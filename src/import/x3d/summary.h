#pragma once
// What becomes of the nodes of an X3D document that do not become meshes: one
// sentence per kind.

#include "base/vec.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

/// Geometries that our runtime draws from the document.
bool isDrawnInPages(std::string_view element);

/// Nodes that make a scene move or answer, which our runtime leaves at rest.
bool isLeftAtRest(std::string_view element);

struct Summary {
  using Counts = std::map<std::string, std::size_t>; ///< by element

  Counts notCopied; ///< nodes with urls
  Counts notDrawn;  ///< geometries
  Counts empty;     ///< geometries without any element
  Counts atRest;
  std::size_t remoteImages = 0, remoteInlines = 0, fans = 0;
  std::size_t flatTransforms = 0, absurdTransforms = 0; ///< that scale to nothing, or out of all measure

  void noteScale(Vec3d scale);

  void addTo(std::vector<std::string>& warnings) const;
};

/// "What: Group (2), Shape (1)." Nothing where there are none.
void warnOfElements(std::vector<std::string>& warnings, const char* what, const Summary::Counts& counts);

} // namespace imgeo::x3d
