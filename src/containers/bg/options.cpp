// Options of convert for bg.

#include "containers/bg/bg.h"
#include "containers/option_checks.h"
#include "containers/stored_coords.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

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
  const bool isPair = options.normals == NormalEncoding::octahedral || options.normals == NormalEncoding::spherical;
  return isPair && options.target != Target::x3dom && !has16BitCoords(options) ? 16 : 8;
}

void requireCoordType(ElementType type, const ConvertOptions& options) {
  const std::uint32_t bits = options.positionBits;
  const bool isForX3dom = options.target == Target::x3dom;
  if (isForX3dom && type == ElementType::int8)
    refuseOption("--coord-type", "X3DOM spends a bit of int8 on what lies outside of the box; uint8 holds 8");
  if (type == ElementType::float32 && !holdsLattice(type, bits))
    refuseOption("--position-bits", fmt::format("float32 holds lattices of at most 24 bits, not {}; without "
                                                "--position-bits it holds the source's numbers",
                                                bits));
  if (!holdsLattice(type, bits))
    refuseOption("--position-bits",
                 fmt::format("{} holds at most {} bits, not {}", nameOf(type), 8 * byteSizeOf(type), bits));
  if (isForX3dom && type == ElementType::int16 && bits > 15)
    refuseOption("--position-bits",
                 "X3DOM spends a bit of int16 on what lies outside of the box, which leaves 15; uint16 holds 16");
}

void requireCoords(const ConvertOptions& options) {
  if (options.coordType)
    requireCoordType(*options.coordType, options);
  else if (options.target == Target::x3dom && options.positionBits > 16)
    refuseOption(
        "--position-bits",
        fmt::format("X3DOM reads bg with at most 16 bits, not {}; float32 and sig hold more", options.positionBits));
}

void requireNormals(const ConvertOptions& options) {
  const std::uint32_t bits = options.normalBits;
  switch (options.normals) {
  case NormalEncoding::rgb:
    if (needsOneElementType(options) && options.coordType && bits != 8 * byteSizeOf(*options.coordType))
      refuseOption("--normal-bits", fmt::format("X3DOM reads interleaved records as one element type, so that normals "
                                                "beside {} have its bits, not {}",
                                                nameOf(*options.coordType), bits));
    if (bits != 8 && bits != 16 && bits != 32)
      refuseOption("--normal-bits", fmt::format("bg stores normals in 8, 16 or 32 bits, not {}", bits));
    return;
  case NormalEncoding::palette:
    refuseOption("--normals", "a palette belongs to images, and bg has none");
  case NormalEncoding::derived:
    refuseOption("--normals", "only compact derives normals");
  case NormalEncoding::octahedral:
    if (options.target == Target::x3dom)
      refuseOption("--normals", "X3DOM reads no octahedral normals; spherical ones take the same room");
    if (bits != 16 && (bits != 8 || !has16BitCoords(options)))
      refuseOption("--normal-bits", fmt::format("octahedral normals have 16 bits in bg, or 8 beside coordinates of "
                                                "9..16 bits, not {}",
                                                bits));
    return;
  case NormalEncoding::spherical:
    if (options.target == Target::x3dom && bits != 8)
      refuseOption("--normal-bits", fmt::format("X3DOM reads spherical normals of 8 bits, not {}", bits));
    if (options.target == Target::x3dom && !has16BitCoords(options))
      refuseOption("--normals", "X3DOM reads spherical normals beside coordinates of 9..16 bits");
    if (bits != 16 && (bits != 8 || !has16BitCoords(options)))
      refuseOption("--normal-bits", fmt::format("spherical normals have 16 bits in bg, or 8 beside coordinates of "
                                                "9..16 bits, not {}",
                                                bits));
    if (options.target == Target::x3dom && options.coordType == ElementType::int16)
      refuseOption("--normals", "X3DOM takes spherical normals beside int16 for signed numbers; uint16 holds them");
  }
}

void requireOtherBits(const ConvertOptions& options) {
  if (options.texCoordBits == 24)
    refuseOption("--texcoord-bits", "arrays hold texture coordinates of 8, 16 or 32 bits, not 24");
  if (options.colorBits == 24)
    refuseOption("--color-bits", "arrays hold colours of 8, 16 or 32 bits, not 24");
}

} // namespace

void resolveBgOptions(ConvertOptions& options) {
  if (options.positionBits == 0)
    options.positionBits = defaultPositionBits(options);
  if (options.normalBits == 0)
    options.normalBits = defaultNormalBits(options);
  requireCoords(options);
  requireNormals(options);
  requireOtherBits(options);
}

} // namespace imgeo
