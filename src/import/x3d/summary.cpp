#include "import/x3d/summary.h"

#include "import/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace imgeo::x3d {

bool isDrawnInPages(std::string_view element) {
  static const std::set<std::string_view> drawn{"Arc2D",
                                                "ArcClose2D",
                                                "Box",
                                                "Circle2D",
                                                "Cone",
                                                "Cylinder",
                                                "Disk2D",
                                                "ElevationGrid",
                                                "Extrusion",
                                                "IndexedFaceSet",
                                                "IndexedLineSet",
                                                "IndexedQuadSet",
                                                "IndexedTriangleFanSet",
                                                "IndexedTriangleSet",
                                                "IndexedTriangleStripSet",
                                                "LineSet",
                                                "PointSet",
                                                "Polyline2D",
                                                "Polypoint2D",
                                                "QuadSet",
                                                "Rectangle2D",
                                                "Sphere",
                                                "Text",
                                                "TriangleFanSet",
                                                "TriangleSet",
                                                "TriangleSet2D",
                                                "TriangleStripSet",
                                                "ImageGeometry",
                                                "BinaryGeometry"};
  return drawn.contains(element);
}

bool isInteractive(std::string_view element) {
  static constexpr std::array endings{"Interpolator", "Interpolator2D", "Sequencer", "Sensor",
                                      "Trigger",      "Chaser",         "Damper",    "Follower"};
  return element == "ROUTE" || element == "Script" ||
         std::ranges::any_of(endings, [&](const char* ending) { return element.ends_with(ending); });
}

void Summary::noteScale(Vec3d scale) {
  // Beyond these, single precision cannot represent lengths together with those of other nodes.
  constexpr double minScale = 1e-15, maxScale = 1e15;
  bool isFlat = false, isExtreme = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::abs(scale[axis]);
    isFlat |= size == 0;
    isExtreme |= size > maxScale || (size > 0 && size < minScale);
  }
  flatTransforms += isFlat;
  extremeTransforms += isExtreme;
}

void Summary::addTo(std::vector<std::string>& warnings) const {
  if (remoteImages > 0)
    warnings.push_back(fmt::format("{} left on other hosts.", counted(remoteImages, "texture is", "textures are")));
  if (remoteInlines > 0)
    warnings.push_back(fmt::format("{} left on other hosts.", counted(remoteInlines, "Inline is", "Inlines are")));
  warnOfElements(warnings, "Files named by these nodes are not copied", notCopied);
  warnOfElements(warnings, "Geometry that stays as it is and that imgeo's pages do not draw", notDrawn);
  warnOfElements(warnings, "Geometry without faces, lines or points", empty);
  warnOfElements(warnings, "Nodes that animate or interact stay as they are, and imgeo's pages do not run them",
                 interactive);
  warnOfElements(warnings,
                 "Texture coordinates that depend on the camera or on noise are made of the shape's own normals "
                 "or positions instead",
                 approximatedTexCoords);
  if (furtherTexCoords > 0)
    warnings.push_back(fmt::format("{} several sets of texture coordinates, of which the first is used.",
                                   counted(furtherTexCoords, "geometry has", "geometries have")));
  if (flatTransforms > 0)
    warnings.push_back(fmt::format("{} by 0: what stands there is flat, or not seen at all.",
                                   counted(flatTransforms, "Transform scales", "Transforms scale")));
  if (extremeTransforms > 0)
    warnings.push_back(fmt::format("{} by more than 10^15 or less than 10^-15: what stands there cannot be drawn.",
                                   counted(extremeTransforms, "Transform scales", "Transforms scale")));
  warnOfFans(warnings, fans);
}

void warnOfElements(std::vector<std::string>& warnings, const char* what, const Summary::Counts& counts) {
  std::vector<std::string> elements;
  for (const auto& [element, count] : counts)
    elements.push_back(fmt::format("{} ({})", element, count));
  if (!elements.empty())
    warnings.push_back(fmt::format("{}: {}.", what, fmt::join(elements, ", ")));
}

} // namespace imgeo::x3d
