#include "transcode/encode/encode_report.h"

#include "containers/encodings.h"
#include "containers/named_attributes.h"

#include <algorithm>
#include <iterator>

namespace imgeo {

namespace {

/// Attributes of the same name in several geometries share one row, with the maximum of bits and error.
void addAttributes(std::vector<AttributeReport>& reports, const GeometryDescription& geometry) {
  for (const AttributeDescription& attribute : geometry.attributes) {
    auto report = std::ranges::find(reports, attribute.name, &AttributeReport::name);
    if (report == reports.end())
      report = reports.insert(report, {attribute.name, attribute.components, 0, 0});
    const bool isTyped = hasElementTypes(geometry.encoding);
    report->bits = std::max(report->bits, isTyped ? 32 : 8 * attribute.bytes);
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      report->error = std::max(report->error, numberErrorBound(geometry.encoding, attribute, c));
  }
}

} // namespace

void addToReport(ConvertReport& report, const EncodedMesh& encoded) {
  report.elements += encoded.elements;
  report.vertices += encoded.vertices;
  report.patches += encoded.geometry.patches.size();
  for (const PatchDescription& patch : encoded.geometry.patches)
    report.largestPatch = std::max(report.largestPatch, patch.vertexCount);
  report.grids += encoded.geometry.grid ? encoded.geometry.patches.size() : 0;
  report.collapsed += encoded.collapsed;
  report.positionError = std::max(report.positionError, encoded.positionError);
  report.normalErrorDegrees = std::max(report.normalErrorDegrees, encoded.normalErrorDegrees);
  const Lattice& lattice = encoded.geometry.lattice;
  const bool isHeightMap = encoded.geometry.grid == GridKind::heightMap; // whose columns and rows are exact
  report.maxStep = std::max(report.maxStep, isHeightMap ? lattice.step * lattice.stretch.y : lattice.step);
  report.minPositionBits = report.minPositionBits == 0 ? lattice.bits : std::min(report.minPositionBits, lattice.bits);
  report.maxPositionBits = std::max(report.maxPositionBits, lattice.bits);
  report.hasNormals |= encoded.hasNormals;
  report.hasColors |= encoded.hasColors;
  report.colorError = std::max(report.colorError, encoded.colorError);
  if (encoded.texCoordError)
    report.texCoordError = std::max(report.texCoordError.value_or(0), *encoded.texCoordError);
  if (encoded.resampled)
    report.resampled.push_back(*encoded.resampled);
  report.resampledTextures += encoded.hasResampledImages ? 1 : 0;
  std::ranges::copy(encoded.warnings, std::back_inserter(report.warnings));
  addAttributes(report.attributes, encoded.geometry);
}

} // namespace imgeo
