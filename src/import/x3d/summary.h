#pragma once
// Warnings about the nodes of an X3D document that do not become meshes, one per kind.

#include "base/vec.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

/// Whether the runtime draws this geometry node from the document.
bool isDrawnInPages(std::string_view element);

/// Whether a node animates the scene or responds to input; the runtime ignores such nodes.
bool isInteractive(std::string_view element);

struct Summary {
  using Counts = std::map<std::string, std::size_t>; ///< number of nodes by element name

  Counts notCopied;                 ///< nodes with URLs whose files are not copied
  Counts notDrawn;                  ///< geometries that the runtime does not draw
  Counts empty;                     ///< geometries without faces, lines or points
  Counts interactive;               ///< animating and interactive nodes
  Counts approximatedTexCoords;     ///< modes of TextureCoordinateGenerator that are approximated
  std::size_t furtherTexCoords = 0; ///< geometries with sets of texture coordinates after the first
  std::size_t remoteImages = 0, remoteInlines = 0, fans = 0;
  std::size_t flatTransforms = 0, extremeTransforms = 0; ///< scales of 0, and outside of 10^-15 .. 10^15

  void noteScale(Vec3d scale);

  void addTo(std::vector<std::string>& warnings) const;
};

/// Adds "What: Group (2), Shape (1)." where there are counts.
void warnOfElements(std::vector<std::string>& warnings, const char* what, const Summary::Counts& counts);

} // namespace imgeo::x3d
