#include "transcode/options/resolve_options.h"

#include "containers/encodings.h"
#include "containers/limits.h"
#include "containers/option_checks.h"
#include "images/raster.h"
#include "prepare/patches.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

const Capabilities& capabilitiesOf(const ConvertOptions& options) {
  return rowOf(*options.encoding).capabilities;
}

void requireAttributes(const ConvertOptions& options) {
  const bool isAny = options.keepAttributes.all || !options.keepAttributes.names.empty();
  if (isAny && options.target == Target::x3dom)
    refuseOption("--keep-attributes", "X3DOM reads no further attributes out of images and arrays");
  if (!capabilitiesOf(options).attributeBits && options.attributeBits != 0)
    refuseOption("--attribute-bits",
                 fmt::format("bg stores attributes as Float32, not in {} bits", options.attributeBits));
  if (options.attributeBits % 8 != 0 || options.attributeBits > 24)
    refuseOption("--attribute-bits", fmt::format("images hold 8, 16 or 24 bits, not {}", options.attributeBits));
  if (!isAny && options.attributeBits != 0)
    refuseOption("--attribute-bits", "only attributes that --keep-attributes names have bits");
}

void requireMaxError(const ConvertOptions& options) {
  if (options.positionBits != 0)
    refuseOption("--max-error", "chooses the bits that --position-bits states");
  if (!capabilitiesOf(options).maxError)
    refuseOption("--max-error", "chooses bits for images; bg has --position-bits and --coord-type");
}

/// Whether an encoding supports the options and meshes with so many further attributes, among which are the sets of
/// texture coordinates beyond the first.
bool canHold(const EncodingRow& row, const ConvertOptions& options, std::size_t attributeCount) {
  const Capabilities& can = row.capabilities;
  return (options.target != Target::x3dom || row.x3domVersion != nullptr) &&
         (options.primitives != Primitives::strips || can.strips) && (options.indexed || can.unindexed) &&
         std::ranges::find(can.normals, options.normals) != can.normals.end() &&
         (options.images == ImageFormat::png || can.webp) &&
         (options.texCoordBits == 0 || can.texCoordBits.holds(options.texCoordBits)) &&
         (options.colorBits == 0 || can.colorBits.holds(options.colorBits)) &&
         options.positionBits <= can.maxPositionBits && options.patchVertices <= can.maxPatchVertices &&
         attributeCount <= can.maxNamedAttributes;
}

/// Geometry images and height maps are SIG classic.
void resolveGrids(ConvertOptions& options) {
  const bool isGeometryImage = options.form == MeshForm::geometryImage;
  if (!isGeometryImage && options.grid != 0)
    refuseOption("--grid", "is the resolution of geometry images: --as geometry-image");
  if (options.form == MeshForm::mesh || options.form == MeshForm::sequence || options.form == MeshForm::video)
    return;
  const char* const form = isGeometryImage ? "geometry images" : "height maps";
  if (options.encoding.value_or(Encoding::classic) != Encoding::classic)
    refuseOption("--as", fmt::format("{} are stored in sig, profile classic", form));
  options.encoding = Encoding::classic;
  if (options.target == Target::x3dom)
    refuseOption("--as", fmt::format("X3DOM draws no {}", form));
  if (options.primitives != Primitives::triangles || !options.indexed)
    refuseOption("--as", fmt::format("the triangles of {} follow from their grid: no --primitives, no --index", form));
  if (options.normals != NormalEncoding::rgb)
    refuseOption("--normals", isGeometryImage ? "geometry images have rgb normals"
                                              : "height maps have the normals that follow from their slope");
  requireWithin("gridImageEdge", options.gridImageEdge, 16, guaranteedImageEdge);
  if (!isGeometryImage) {
    if (options.positionBits != 0 || options.maxError)
      refuseOption(options.maxError ? "--max-error" : "--position-bits", "height maps have heights of 16 bits");
    return;
  }
  if (options.grid != 0 && options.maxError)
    refuseOption("--max-error", "chooses the grid that --grid states");
  if (options.grid == 0)
    options.grid = 256;
  requireWithin("--grid", options.grid, 4, maxGridEdge);
}

/// The first of the automatic encodings that supports the options; the last one if none does.
Encoding automaticEncoding(const ConvertOptions& options, std::size_t attributeCount) {
  Encoding last = Encoding::classic;
  for (const EncodingRow* row : allEncodings())
    if (row->isAutomatic) {
      last = row->encoding;
      if (canHold(*row, options, attributeCount))
        return last;
    }
  return last;
}

void requireImages(const ConvertOptions& options) {
  if (options.images == ImageFormat::png)
    return;
  if (!capabilitiesOf(options).webp)
    refuseOption("--images", fmt::format("{} is an image format of classic; {} has its own files",
                                         nameOf(options.images), nameOf(*options.encoding)));
  if (options.target == Target::x3dom)
    refuseOption("--images", "pages for X3DOM have PNG images");
}

void requireTextures(const TextureOptions& textures) {
  if (textures.size != 0)
    requireWithin("--texture-size", textures.size, 1, maxWebpEdge);
  requireWithin("--texture-preview", textures.previewEdge, 0, 256);
  if (!textures.quality)
    return;
  requireWithin("--texture-quality", *textures.quality, 0, 100);
  if (textures.format == TextureFormat::png)
    refuseOption("--texture-quality", "PNG loses nothing; webp and avif have a quality");
  if (textures.format == TextureFormat::keep && textures.size == 0)
    refuseOption("--texture-quality",
                 "textures are kept as they are unless --textures or --texture-size says otherwise");
}

void requireOtherBits(ConvertOptions& options) {
  const auto resolve = [&](const char* option, std::uint32_t& bits, const BitRange& range) {
    if (bits == 0)
      bits = range.defaultBits;
    requireWithin(option, bits, range.min, range.max);
    if (!range.holds(bits))
      refuseOption(option, fmt::format("{} is no multiple of {}", bits, range.step));
    if (options.target == Target::x3dom && bits != range.defaultBits)
      refuseOption(option, fmt::format("pages for X3DOM have {} bits, not {}", range.defaultBits, bits));
  };
  resolve("--texcoord-bits", options.texCoordBits, capabilitiesOf(options).texCoordBits);
  resolve("--color-bits", options.colorBits, capabilitiesOf(options).colorBits);
}

} // namespace

std::uint32_t positionBitsFor(const Box3d& box, const ConvertOptions& options) {
  if (!options.maxError || !(box.longestEdge() > 0))
    return options.positionBits;
  const MaxError& error = *options.maxError;
  const double allowed = error.isPercent ? error.value / 100 * box.longestEdge() : error.value;
  // Rounding moves a vertex by at most half the diagonal of a lattice cell.
  const double steps = box.longestEdge() * std::sqrt(3.0) / 2 / allowed;
  const std::uint32_t maxBits = capabilitiesOf(options).maxPositionBits;
  for (std::uint32_t bits = 8; bits <= maxBits; ++bits)
    if (std::ldexp(1.0, static_cast<int>(bits)) - 1 >= steps)
      return bits;
  refuseOption("--max-error", fmt::format("takes more than {} bits, the most there are", maxBits));
}

ConvertOptions resolvedFor(const Scene& scene, const ConvertOptions& given) {
  if (scene.graph.isComplete && given.view != StartView::automatic)
    refuseOption("--view", "an X3D source shows its own viewpoints");
  ConvertOptions options = resolved(given);
  std::size_t attributeCount = 0;
  for (const Mesh& mesh : scene.meshes)
    attributeCount =
        std::max(attributeCount, mesh.namedAttributes.size() + std::max(texCoordSetCount(mesh), std::size_t{1}) - 1);
  const std::size_t maxAttributeCount = capabilitiesOf(options).maxNamedAttributes;
  if (attributeCount <= maxAttributeCount)
    return options;
  if (given.encoding)
    refuseOption("--profile", fmt::format("compact holds {} further attributes of a mesh, not {}; classic holds any "
                                          "number, and --keep-attributes says which",
                                          maxAttributeCount, attributeCount));
  options = given;
  options.encoding = automaticEncoding(options, attributeCount);
  return resolved(options);
}

bool hasStatedError(const ConvertOptions& options) {
  return options.normals == NormalEncoding::palette || rowOf(*options.encoding).hasMeasuredNormalError;
}

ConvertOptions resolved(ConvertOptions options) {
  resolveGrids(options);
  if (!options.encoding)
    options.encoding = automaticEncoding(options, 0);
  if (options.maxError)
    requireMaxError(options);
  const EncodingRow& row = rowOf(*options.encoding);
  row.resolveOptions(options);
  if (options.positionBits == 0)
    options.positionBits = 16;
  requireWithin("--position-bits", options.positionBits, 8, capabilitiesOf(options).maxPositionBits);
  requireWithin("--patch-vertices", options.patchVertices, 256, maxPatchWedges);
  requireWithin("--effort", options.effort, 0, 9);
  requireImages(options);
  requireTextures(options.textures);
  if (options.basePercent && !row.capabilities.base)
    refuseOption("--base", "only compact has a base; classic shows its first bytes");
  if (options.basePercent && !(*options.basePercent >= 0 && *options.basePercent <= 25))
    refuseOption("--base", fmt::format("{} is not within 0..25", *options.basePercent));
  if (!options.basePercent)
    options.basePercent = 2;
  if (options.levels == LevelChoice::always && !row.capabilities.levels)
    refuseOption("--levels", fmt::format("only compact has levels of detail, and not {}",
                                         row.profile[0] ? row.profile : row.container));
  requireWithin("--group-triangles", options.groupTriangles, 256, 262144);
  requireWithin("--region-triangles", options.regionTriangles, 4096, 4194304);
  requireOtherBits(options);
  requireAttributes(options);
  if (options.attributeBits == 0)
    options.attributeBits = 16;
  if (options.target != Target::x3dom && !options.x3domUrl.empty())
    refuseOption("--x3dom-url", "only a page for X3DOM needs X3DOM: --target x3dom");
  return options;
}

} // namespace imgeo
