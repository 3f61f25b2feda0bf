#pragma once
// How far the attributes of vertices may be, and are, from those of the input.

#include "containers/patch_reader.h"
#include "imgeo/verify.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/findings.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// Allowed differences.
struct AttributeBounds {
  double normalDegrees = 0;
  std::array<Vec2<double>, maxTexCoordSets> texCoords; ///< by set
  double color = 1e-6;                                 ///< of a channel, 0 .. 1; greater than 0
  std::map<std::string, std::vector<double>> named; ///< by name of a further attribute; one number for each component
};

/// The largest differences.
struct AttributeDifference {
  double normalDegrees = 0;
  std::array<Vec2<double>, maxTexCoordSets> texCoords; ///< by set: along each axis
  double named = 0;                                    ///< of a further attribute, as a fraction of its bound
  double color = 0;                                    ///< of a channel, 0 .. 1
};

/// What the rounding of stored attributes allows.
AttributeBounds boundsOf(const GeometryDescription& geometry, const StoredPrecision& precision,
                         const std::optional<SiteManifest>& manifest);

/// The bound as a divisor: attributes that are stored exactly have the bound 0.
double divisor(double bound);

/// The largest difference of colours, texture coordinates and further attributes as a share of its bound.
double shareOfBounds(const AttributeDifference& difference, const AttributeBounds& bounds);

/// The largest of all differences as a share of its bound.
double cost(const AttributeDifference& difference, const AttributeBounds& bounds);

/// Takes over what is larger than in `worst`.
void addToWorst(const Vec2<double>& difference, Vec2<double>& worst);
void addToWorst(const AttributeDifference& difference, AttributeDifference& worst);

double angleDegrees(const Vec3d& a, const Vec3d& b);

/// Adds a finding for each difference of normals, texture coordinates and further attributes beyond its bound, and the
/// largest to the report.
void reportAttributes(const AttributeDifference& difference, const AttributeBounds& bounds, VerifyReport& report,
                      Findings& findings);

} // namespace imgeo
