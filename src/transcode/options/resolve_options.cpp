#include "transcode/options/resolve_options.h"

#include "base/error.h"
#include "containers/encodings.h"
#include "containers/limits.h"
#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "images/raster.h"
#include "prepare/patches.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

[[noreturn]] void refuse(const char* option, const std::string& why) {
  throw Error(ErrorKind::usage, option, why);
}

void requireWithin(const char* option, std::int64_t value, std::int64_t min, std::int64_t max) {
  if (value < min || value > max)
    refuse(option, fmt::format("{} is not within {}..{}", value, min, max));
}

const Capabilities& capabilitiesOf(const ConvertOptions& options) {
  return rowOf(*options.encoding).capabilities;
}

/// Whether all attributes must have one element type: X3DOM reads interleaved records that way.
bool needsOneElementType(const ConvertOptions& options) {
  return options.target == Target::x3dom && options.layout == Layout::interleaved;
}

bool has16BitCoords(const ConvertOptions& options) {
  return (options.coordType ? byteSizeOf(*options.coordType) : coordBytes(Encoding::bg, options.positionBits)) == 2;
}

std::uint32_t defaultPositionBits(const ConvertOptions& options) {
  if (!options.coordType)
    return 16;
  if (*options.coordType == ElementType::float32)
    return sourceBits;
  const bool losesOneBit = options.target == Target::x3dom && *options.coordType == ElementType::int16;
  return 8 * byteSizeOf(*options.coordType) - losesOneBit;
}

/// The largest number of bits that adds no bytes: two components of 8 bits fit into the padding of 16-bit coordinates.
std::uint32_t defaultNormalBits(const ConvertOptions& options) {
  if (needsOneElementType(options) && options.normals == NormalEncoding::rgb && options.coordType)
    return 8 * byteSizeOf(*options.coordType);
  const bool hasNoPadding = options.encoding == Encoding::bg && !has16BitCoords(options);
  return options.normals == NormalEncoding::octahedral && hasNoPadding ? 16 : 8;
}

void requireCoordType(ElementType type, const ConvertOptions& options) {
  const std::uint32_t bits = options.positionBits;
  const bool forX3dom = options.target == Target::x3dom;
  if (forX3dom && type == ElementType::int8)
    refuse("--coord-type", "X3DOM spends a bit of int8 on what lies outside of the box; uint8 holds 8");
  if (type == ElementType::float32 && !holdsLattice(type, bits))
    refuse("--position-bits", fmt::format("float32 holds lattices of at most 24 bits, not {}; without "
                                          "--position-bits it holds the source's numbers",
                                          bits));
  if (!holdsLattice(type, bits))
    refuse("--position-bits",
           fmt::format("{} holds at most {} bits, not {}", nameOf(type), 8 * byteSizeOf(type), bits));
  if (forX3dom && type == ElementType::int16 && bits > 15)
    refuse("--position-bits",
           "X3DOM spends a bit of int16 on what lies outside of the box, which leaves 15; uint16 holds 16");
}

void requireCoords(const ConvertOptions& options) {
  if (!capabilitiesOf(options).elementTypes) {
    if (options.coordType)
      refuse("--coord-type", "images hold bytes; element types belong to bg");
    if (options.layout != Layout::separate)
      refuse("--layout", "images are not interleaved; that belongs to bg");
    return;
  }
  if (options.coordType)
    requireCoordType(*options.coordType, options);
  else if (options.target == Target::x3dom && options.positionBits > 16)
    refuse("--position-bits",
           fmt::format("X3DOM reads bg with at most 16 bits, not {}; float32 and sig hold more", options.positionBits));
}

void requireNormals(const ConvertOptions& options) {
  const std::uint32_t bits = options.normalBits;
  if (!hasElementTypes(*options.encoding)) {
    if (bits != 8)
      refuse("--normal-bits", fmt::format("sig stores normals in 8 bits, not {}; bg also in 16 or 32", bits));
    if (options.normals == NormalEncoding::derived)
      refuse("--normals", "only compact derives normals");
    if (options.target == Target::x3dom && isPair(options.normals))
      refuse("--normals",
             fmt::format("X3DOM reads no {} normals from images; rgb and palette it does", nameOf(options.normals)));
    return;
  }
  switch (options.normals) {
  case NormalEncoding::rgb:
    if (needsOneElementType(options) && options.coordType && bits != 8 * byteSizeOf(*options.coordType))
      refuse("--normal-bits", fmt::format("X3DOM reads interleaved records as one element type, so that normals "
                                          "beside {} have its bits, not {}",
                                          nameOf(*options.coordType), bits));
    if (bits != 8 && bits != 16 && bits != 32)
      refuse("--normal-bits", fmt::format("bg stores normals in 8, 16 or 32 bits, not {}", bits));
    return;
  case NormalEncoding::palette:
    refuse("--normals", "a palette belongs to images, and bg has none");
  case NormalEncoding::derived:
    refuse("--normals", "only compact derives normals");
  case NormalEncoding::octahedral:
    if (options.target == Target::x3dom)
      refuse("--normals", "X3DOM reads no octahedral normals; spherical ones take the same room");
    if (bits != 16 && (bits != 8 || !has16BitCoords(options)))
      refuse("--normal-bits", fmt::format("octahedral normals have 16 bits in bg, or 8 beside coordinates of "
                                          "9..16 bits, not {}",
                                          bits));
    return;
  case NormalEncoding::spherical:
    if (bits != 8)
      refuse("--normal-bits", fmt::format("spherical normals have 8 bits, not {}", bits));
    if (!has16BitCoords(options))
      refuse("--normals", "spherical normals in bg lie beside coordinates of 9..16 bits");
    if (options.target == Target::x3dom && options.coordType == ElementType::int16)
      refuse("--normals", "X3DOM takes spherical normals beside int16 for signed numbers; uint16 holds them");
  }
}

void requireAttributes(const ConvertOptions& options) {
  const bool isAny = options.keepAttributes.all || !options.keepAttributes.names.empty();
  if (isAny && options.target == Target::x3dom)
    refuse("--keep-attributes", "X3DOM reads no further attributes out of images and arrays");
  if (!capabilitiesOf(options).attributeBits && options.attributeBits != 0)
    refuse("--attribute-bits", fmt::format("bg stores attributes as Float32, not in {} bits", options.attributeBits));
  if (options.attributeBits % 8 != 0 || options.attributeBits > 24)
    refuse("--attribute-bits", fmt::format("images hold 8, 16 or 24 bits, not {}", options.attributeBits));
  if (!isAny && options.attributeBits != 0)
    refuse("--attribute-bits", "only attributes that --keep-attributes names have bits");
}

void requireMaxError(const ConvertOptions& options) {
  if (options.positionBits != 0)
    refuse("--max-error", "chooses the bits that --position-bits states");
  if (!capabilitiesOf(options).maxError)
    refuse("--max-error", "chooses bits for images; bg has --position-bits and --coord-type");
}

/// Whether an encoding supports the options.
bool canHold(const EncodingRow& row, const ConvertOptions& options) {
  const Capabilities& can = row.capabilities;
  return (options.target != Target::x3dom || row.x3domVersion != nullptr) &&
         (options.primitives != Primitives::strips || can.strips) && (options.indexed || can.unindexed) &&
         std::ranges::find(can.normals, options.normals) != can.normals.end() &&
         options.positionBits <= can.maxPositionBits && options.patchVertices <= can.maxPatchVertices;
}

/// The first of the automatic encodings that supports the options; the last one if none does.
Encoding automaticEncoding(const ConvertOptions& options) {
  Encoding last = Encoding::classic;
  for (const EncodingRow* row : allEncodings())
    if (row->isAutomatic) {
      last = row->encoding;
      if (canHold(*row, options))
        return last;
    }
  return last;
}

void requireTextures(const TextureOptions& textures) {
  if (textures.size != 0)
    requireWithin("--texture-size", textures.size, 1, maxRasterEdge);
  requireWithin("--texture-preview", textures.previewEdge, 0, 256);
  if (!textures.quality)
    return;
  requireWithin("--texture-quality", *textures.quality, 0, 100);
  if (textures.format == TextureFormat::png)
    refuse("--texture-quality", "PNG loses nothing; webp and avif have a quality");
  if (textures.format == TextureFormat::keep && textures.size == 0)
    refuse("--texture-quality", "textures are kept as they are unless --textures or --texture-size says otherwise");
}

/// Checks the options of compact and replaces rgb normals by octahedral ones.
ConvertOptions resolvedCompact(ConvertOptions options) {
  if (options.target == Target::x3dom)
    refuse("--profile", "X3DOM reads no compact images; it reads classic ones");
  if (options.primitives == Primitives::strips)
    refuse("--primitives", "compact holds triangles, lines and points; strips are --profile classic's");
  if (!options.indexed)
    refuse("--index", "compact always has an index; --profile classic need not");
  if (options.normals == NormalEncoding::rgb)
    options.normals = NormalEncoding::octahedral;
  if (options.normals != NormalEncoding::octahedral && options.normals != NormalEncoding::derived)
    refuse("--normals", fmt::format("compact stores octahedral normals or derives them, but has no {} ones",
                                    nameOf(options.normals)));
  requireWithin("--normal-bits", options.normalBits, 4, 16);
  requireWithin("--patch-vertices", options.patchVertices, 256, capabilitiesOf(options).maxPatchVertices);
  return options;
}

void requireOtherBits(ConvertOptions& options) {
  const auto resolve = [](const char* option, std::uint32_t& bits, const BitRange& range) {
    if (bits == 0)
      bits = range.defaultBits;
    requireWithin(option, bits, range.min, range.max);
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
  refuse("--max-error", fmt::format("takes more than {} bits, the most there are", maxBits));
}

ConvertOptions resolvedFor(const Scene& scene, const ConvertOptions& given) {
  ConvertOptions options = resolved(given);
  std::size_t attributeCount = 0;
  for (const Mesh& mesh : scene.meshes)
    attributeCount = std::max(attributeCount, mesh.namedAttributes.size());
  const std::size_t maxAttributeCount = capabilitiesOf(options).maxNamedAttributes;
  if (attributeCount <= maxAttributeCount)
    return options;
  if (given.encoding)
    refuse("--profile", fmt::format("compact holds {} further attributes of a mesh, not {}; classic holds any "
                                    "number, and --keep-attributes says which",
                                    maxAttributeCount, attributeCount));
  options = given;
  options.encoding = Encoding::classic;
  return resolved(options);
}

bool hasStatedError(const ConvertOptions& options) {
  return options.normals == NormalEncoding::palette || rowOf(*options.encoding).hasMeasuredNormalError;
}

ConvertOptions resolved(ConvertOptions options) {
  if (!options.encoding)
    options.encoding = automaticEncoding(options);
  if (options.maxError)
    requireMaxError(options);
  if (options.positionBits == 0)
    options.positionBits = defaultPositionBits(options);
  requireWithin("--position-bits", options.positionBits, 8, capabilitiesOf(options).maxPositionBits);
  requireWithin("--patch-vertices", options.patchVertices, 256, maxPatchWedges);
  requireWithin("--effort", options.effort, 0, 9);
  requireTextures(options.textures);
  if (options.normalBits == 0)
    options.normalBits = defaultNormalBits(options);
  requireCoords(options);
  if (options.basePercent && !capabilitiesOf(options).base)
    refuse("--base", "only compact has a base; classic shows its first bytes");
  if (options.basePercent && !(*options.basePercent >= 0 && *options.basePercent <= 25))
    refuse("--base", fmt::format("{} is not within 0..25", *options.basePercent));
  if (!options.basePercent)
    options.basePercent = 2;
  if (options.encoding == Encoding::compact)
    options = resolvedCompact(options);
  else
    requireNormals(options);
  requireOtherBits(options);
  requireAttributes(options);
  if (options.attributeBits == 0)
    options.attributeBits = 16;
  if (options.target == Target::x3dom && options.encoding == Encoding::classic &&
      options.patchVertices > maxShortIndexedVertices)
    refuse("--patch-vertices",
           fmt::format("X3DOM's index images name at most 65,535 vertices, not {}; bg's arrays more",
                       options.patchVertices));
  if (options.target != Target::x3dom && !options.x3domUrl.empty())
    refuse("--x3dom-url", "only a page for X3DOM needs X3DOM: --target x3dom");
  return options;
}

} // namespace imgeo
