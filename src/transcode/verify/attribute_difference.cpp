#include "transcode/verify/attribute_difference.h"

#include "containers/encodings.h"
#include "containers/named_attributes.h"
#include "containers/normals.h"
#include "containers/stored.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace imgeo {

namespace {

/// Allowed error of normals, in degrees. For palettes and compact no formula bounds it: imgeo.json states it.
double normalBoundDegrees(const GeometryDescription& geometry, const SiteManifest& manifest) {
  const bool isStated = geometry.normalEncoding == NormalEncoding::palette || rowOf(geometry).hasMeasuredNormalError;
  const double bound = isStated ? manifest.normalErrorDegrees : normalErrorBound(geometry) * (180 / std::numbers::pi);
  return std::max(bound, 1e-5);
}

/// Allowed error of a colour's channel, 0 .. 1.
double colorBound(const GeometryDescription& geometry, const StoredPrecision& precision) {
  return colorErrorBound(geometry, std::max(precision.bits[VertexRole::color], 1u));
}

/// Allowed error of texture coordinates, by set.
std::array<Vec2<double>, maxTexCoordSets> texCoordBounds(const GeometryDescription& geometry,
                                                         const StoredPrecision& precision) {
  std::array<Vec2<double>, maxTexCoordSets> bounds;
  for (const VertexRole role : texCoordRoles)
    bounds[texCoordSetOf(role)] = texCoordErrorBound(geometry, texCoordSetOf(role), std::max(precision.bits[role], 1u));
  return bounds;
}

/// Allowed error of each component of the further attributes, by name.
std::map<std::string, std::vector<double>> namedBounds(const GeometryDescription& geometry) {
  std::map<std::string, std::vector<double>> bounds;
  for (const AttributeDescription& attribute : geometry.attributes)
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      bounds[attribute.name].push_back(numberErrorBound(geometry.encoding, attribute, c));
  return bounds;
}

} // namespace

AttributeBounds boundsOf(const GeometryDescription& geometry, const StoredPrecision& precision,
                         const std::optional<SiteManifest>& manifest) {
  return {normalBoundDegrees(geometry, manifest.value_or(SiteManifest{})), texCoordBounds(geometry, precision),
          colorBound(geometry, precision), namedBounds(geometry)};
}

double divisor(double bound) {
  return std::max(bound, 1e-300);
}

double angleDegrees(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * (180 / std::numbers::pi);
}

double shareOfBounds(const AttributeDifference& difference, const AttributeBounds& bounds) {
  double share = std::max(difference.named, difference.color / divisor(bounds.color));
  for (std::size_t set = 0; set < maxTexCoordSets; ++set)
    share = std::max({share, difference.texCoords[set].x / divisor(bounds.texCoords[set].x),
                      difference.texCoords[set].y / divisor(bounds.texCoords[set].y)});
  return share;
}

double cost(const AttributeDifference& difference, const AttributeBounds& bounds) {
  return std::max(shareOfBounds(difference, bounds), difference.normalDegrees / divisor(bounds.normalDegrees));
}

void addToWorst(const Vec2<double>& difference, Vec2<double>& worst) {
  worst = {std::max(worst.x, difference.x), std::max(worst.y, difference.y)};
}

void addToWorst(const AttributeDifference& difference, AttributeDifference& worst) {
  worst.normalDegrees = std::max(worst.normalDegrees, difference.normalDegrees);
  for (std::size_t set = 0; set < maxTexCoordSets; ++set)
    addToWorst(difference.texCoords[set], worst.texCoords[set]);
  worst.named = std::max(worst.named, difference.named);
  worst.color = std::max(worst.color, difference.color);
}

void reportAttributes(const AttributeDifference& difference, const AttributeBounds& bounds, VerifyReport& report,
                      Findings& findings) {
  // Decoders compute in single precision, which may turn a normal by this much more.
  constexpr double normalTolerance = 2e-5;
  report.normalErrorDegrees = std::max(report.normalErrorDegrees, difference.normalDegrees);
  if (difference.normalDegrees > bounds.normalDegrees + normalTolerance)
    findings.add("Normals are off by up to {:.4g} degrees, more than their rounding, {:.4g}.", difference.normalDegrees,
                 bounds.normalDegrees);
  for (std::size_t set = 0; set < maxTexCoordSets; ++set) {
    const Vec2<double>&is = difference.texCoords[set], &bound = bounds.texCoords[set];
    if (is.x > bound.x || is.y > bound.y)
      findings.add("Texture coordinates{} are off by up to {:.4g} and {:.4g}, more than their rounding, {:.4g} "
                   "and {:.4g}.",
                   set == 0 ? "" : fmt::format(" of set {}", set), is.x, is.y, bound.x, bound.y);
  }
  report.attributeError = std::max(report.attributeError, shareOfBounds(difference, bounds));
  if (difference.named > 1)
    findings.add("Further attributes are off by up to {:.4g} times what their rounding allows.", difference.named);
}

} // namespace imgeo
