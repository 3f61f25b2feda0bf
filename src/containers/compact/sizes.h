#pragma once
// Encodes and decodes the sizes of each patch, the first stream of a file:
// docs/formats/compact.md, "Sizes".

#include "containers/compact/header.h"
#include "containers/compact/symbols.h"

namespace imgeo::compact {

/// Sizes of a patch.
struct PatchSizes {
  std::uint32_t type = 0; ///< index into FileHeader::types
  std::uint32_t vertexCount = 0, wedgeCount = 0, elementCount = 0;
  std::uint32_t normalShift = 0;
  std::optional<VertexGrid> grid;
  std::uint32_t segmentCount = 0, residualShift = 0; ///< of a base; 0: a patch

  bool hasSeams() const { return wedgeCount > vertexCount; }
};

/// The sums over the patches of a file, which are limited.
struct SizeSums {
  std::uint64_t vertices = 0, wedges = 0, elements = 0;

  void add(std::uint64_t vertexCount, std::uint64_t wedgeCount, std::uint64_t elementCount) {
    vertices += vertexCount;
    wedges += wedgeCount;
    elements += elementCount;
  }
  bool fits() const { return vertices <= maxCount && wedges <= maxCount && elements <= maxCount; }
};

/// The first model of each symbol in the stream.
namespace sizeModels {
inline constexpr std::size_t type = 0, vertices = type + numberModels, seams = vertices + numberModels,
                             elements = seams + numberModels, shift = elements + numberModels,
                             segments = shift + numberModels, residual = segments + numberModels,
                             grid = residual + numberModels, count = grid + 1;
}

/// The largest number of bits of positions with a grid.
constexpr std::uint32_t maxGridBitsOf(Version version) {
  return version == Version::one ? 16 : maxGridBits;
}
/// The numbers of a grid have so many raw bits.
constexpr std::uint32_t gridNumberBits(Version version) {
  return version == Version::one ? 32 : 48;
}
/// The largest step that a file can state, in 1/65536 lattice steps: a grid of one line.
constexpr std::uint64_t maxGridStep(Version version) {
  return version == Version::one ? UINT32_MAX : std::uint64_t{1} << 41;
}

/// Codes `bits` raw bits, a multiple of 16, the least significant first.
template <typename Coder> std::uint64_t codeWord(Coder& coder, std::uint64_t value, std::uint32_t bits) {
  std::uint64_t word = 0;
  for (std::uint32_t shift = 0; shift < bits; shift += 16)
    word |= std::uint64_t{coder.raw(16, static_cast<std::uint32_t>(value >> shift & 0xffff))} << shift;
  return word;
}

template <typename Coder> VertexGrid codeGrid(Coder& coder, Version version, VertexGrid grid) {
  const std::uint32_t bits = gridNumberBits(version);
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = codeWord(coder, grid.origin[axis], bits);
    grid.step[axis] = codeWord(coder, grid.step[axis], bits);
    coder.require(grid.step[axis] >= std::uint64_t{2} << 16 && grid.step[axis] <= maxGridStep(version) &&
                      grid.origin[axis] < grid.step[axis],
                  "a patch states impossible grid lines");
  }
  return grid;
}

/// Decoders ignore the values of `sizes`.
template <typename Coder> PatchSizes codeSizes(Coder& coder, const FileHeader& header, PatchSizes sizes = {}) {
  namespace models = sizeModels;
  sizes.type = codeNumber(coder, models::type, sizes.type);
  coder.require(sizes.type < header.types.size(), "a patch is of a type that there is not");
  const PatchType& type = header.types[sizes.type];
  const std::uint32_t seams = sizes.wedgeCount - sizes.vertexCount;
  sizes.vertexCount = 1 + codeNumber(coder, models::vertices, sizes.vertexCount - 1);
  if (type.topology == Topology::points) {
    sizes.wedgeCount = sizes.elementCount = sizes.vertexCount;
  } else {
    sizes.wedgeCount = sizes.vertexCount + codeNumber(coder, models::seams, seams);
    sizes.elementCount = 1 + codeNumber(coder, models::elements, sizes.elementCount - 1);
    coder.require(sizes.wedgeCount <= std::uint64_t{sizes.elementCount} * cornersPerElement(type.topology),
                  "a patch has more wedges than corners");
  }
  if (type.topology == Topology::triangles) {
    sizes.normalShift = codeNumber(coder, models::shift, sizes.normalShift);
    coder.require(sizes.normalShift <= 30, "a patch states impossible normals");
  }
  if (type.positionBits <= maxGridBitsOf(header.version)) {
    const bool hasGrid = coder.bit(models::grid, sizes.grid.has_value());
    sizes.grid =
        hasGrid ? std::optional(codeGrid(coder, header.version, sizes.grid.value_or(VertexGrid{}))) : std::nullopt;
  }
  if (type.isBase) {
    sizes.segmentCount = 1 + codeNumber(coder, models::segments, sizes.segmentCount - 1);
    sizes.residualShift = codeNumber(coder, models::residual, sizes.residualShift);
    coder.require(sizes.segmentCount <= sizes.elementCount && sizes.residualShift < type.positionBits,
                  "a base states impossible segments");
  }
  return sizes;
}

} // namespace imgeo::compact
