#include "import/x3d/summary.h"

#include "import/warnings.h"
#include "import/x3d/nurbs.h"
#include "scene/shape_instances.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo::x3d {

namespace {

/// Whether an element is a part of a prototype that has not been expanded, since it is still there.
bool isUnexpanded(const NodeRow& row) {
  return row.component == "statement" && row.treatment == NodeTreatment::converted;
}

} // namespace

bool isDrawnInPages(std::string_view element) {
  const NodeRow* row = nodeRow(element);
  return row && row->containerField == "geometry" && row->treatment == NodeTreatment::drawn && !isNurbs(element);
}

bool isLeftOut(std::string_view element) {
  const NodeRow* row = nodeRow(element);
  return !row || row->treatment == NodeTreatment::dropped || isUnexpanded(*row);
}

std::string_view reasonToLeaveOut(std::string_view element) {
  const NodeRow* row = nodeRow(element);
  return !row ? "it is no node of X3D 4.0" : isUnexpanded(*row) ? "no prototype for it could be read" : row->note;
}

void Summary::noteScale(Vec3d scale) {
  // Beyond these, single precision cannot represent lengths together with those of other nodes.
  constexpr double minScale = 1 / maxDrawableLength, maxScale = maxDrawableLength;
  bool isFlat = false, isExtreme = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::abs(scale[axis]);
    isFlat |= size == 0;
    isExtreme |= size > maxScale || (size > 0 && size < minScale);
  }
  flatTransforms_ += isFlat;
  extremeTransforms_ += isExtreme;
}

void Summary::noteKept(std::string_view element) {
  const NodeRow* row = nodeRow(element);
  if (row && row->treatment == NodeTreatment::kept && !row->note.empty())
    ++kept_[std::string(row->note)][std::string(element)];
}

void Summary::noteLeftOut(std::string_view element, const std::string& location) {
  LeftOut& kind = leftOut_[std::string(element)];
  if (++kind.count == 1)
    kind.firstLocation = location;
}

void Summary::noteNurbs(double relativeError) {
  ++nurbs_;
  nurbsError_ = std::max(nurbsError_, relativeError);
}

void Summary::addTo(std::vector<std::string>& warnings) const {
  for (const auto& [element, kind] : leftOut_)
    warnings.push_back(fmt::format("{} ({}) left out, since {}; {} at {}.", element, kind.count,
                                   reasonToLeaveOut(element), kind.count == 1 ? "it is" : "the first is",
                                   kind.firstLocation));
  for (const auto& [reason, counts] : kept_)
    warnOfElements(warnings, fmt::format("Without effect, since {}", reason), counts);
  if (remoteImages > 0)
    warnings.push_back(fmt::format("{} left on other hosts.", counted(remoteImages, "texture is", "textures are")));
  if (remoteInlines > 0)
    warnings.push_back(fmt::format("{} left on other hosts.", counted(remoteInlines, "Inline is", "Inlines are")));
  warnOfElements(warnings, "Files named by these nodes are not copied", notCopied);
  if (nurbs_ > 0)
    warnings.push_back(
        fmt::format("{} triangles or lines, which differ from the exact shape by at most {:.2g} % of its size.",
                    counted(nurbs_, "NURBS geometry became", "NURBS geometries became"), 100 * nurbsError_));
  warnOfElements(warnings, "Geometry without faces, lines or points", empty);
  warnOfElements(warnings,
                 "Texture coordinates that depend on the camera or on noise are made of the shape's own normals "
                 "or positions instead",
                 approximatedTexCoords);
  if (furtherTexCoords > 0)
    warnings.push_back(fmt::format("{} several sets of texture coordinates, of which the first is used.",
                                   counted(furtherTexCoords, "geometry has", "geometries have")));
  if (flatTransforms_ > 0)
    warnings.push_back(fmt::format("{} by 0: what stands there is flat, or not seen at all.",
                                   counted(flatTransforms_, "Transform scales", "Transforms scale")));
  if (extremeTransforms_ > 0)
    warnings.push_back(fmt::format("{} by more than 10^15 or less than 10^-15: what stands there cannot be drawn.",
                                   counted(extremeTransforms_, "Transform scales", "Transforms scale")));
  warnOfFans(warnings, fans);
}

void warnOfElements(std::vector<std::string>& warnings, const std::string& what, const Summary::Counts& counts) {
  std::vector<std::string> elements;
  for (const auto& [element, count] : counts)
    elements.push_back(fmt::format("{} ({})", element, count));
  if (!elements.empty())
    warnings.push_back(fmt::format("{}: {}.", what, fmt::join(elements, ", ")));
}

} // namespace imgeo::x3d
