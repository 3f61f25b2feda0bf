#pragma once
// Warnings about the nodes of an X3D document that are left out, stay without effect, or are replaced, one per kind.

#include "base/vec.h"
#include "import/x3d/node_table.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

/// Whether the runtime draws this geometry node from the document.
bool isDrawnInPages(std::string_view element);

/// Whether an element is left out with its children: a row `dropped`, or no row.
bool isLeftOut(std::string_view element);

/// Why an element is left out: "pages run no scripts".
std::string_view reasonToLeaveOut(std::string_view element);

class Summary {
public:
  using Counts = std::map<std::string, std::size_t>; ///< number of nodes by element name

  Counts notCopied;                 ///< nodes with URLs whose files are not copied
  Counts empty;                     ///< geometries without faces, lines or points
  Counts approximatedTexCoords;     ///< modes of TextureCoordinateGenerator that are approximated
  std::size_t furtherTexCoords = 0; ///< geometries with sets of texture coordinates after the first
  std::size_t remoteImages = 0, remoteInlines = 0, fans = 0;

  void noteScale(Vec3d scale);
  /// Counts a NURBS node that became a mesh, with its error relative to its size.
  void noteNurbs(double relativeError);
  /// Counts a node that stays, where its row says that it has no effect.
  void noteKept(std::string_view element);
  /// Counts an element that is left out; `location` is its file, line and column.
  void noteLeftOut(std::string_view element, const std::string& location);

  void addTo(std::vector<std::string>& warnings) const;

private:
  struct LeftOut {
    std::size_t count = 0;
    std::string firstLocation;
  };

  std::map<std::string, Counts, std::less<>> kept_; ///< by reason
  std::map<std::string, LeftOut, std::less<>> leftOut_;
  std::size_t nurbs_ = 0;
  double nurbsError_ = 0;                                  ///< the largest
  std::size_t flatTransforms_ = 0, extremeTransforms_ = 0; ///< scales of 0, and outside of 10^-15 .. 10^15
};

/// Adds "What: Group (2), Shape (1)." where there are counts.
void warnOfElements(std::vector<std::string>& warnings, const std::string& what, const Summary::Counts& counts);

} // namespace imgeo::x3d
