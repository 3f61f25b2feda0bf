#include "transcode/out_of_core/memory_needs.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr std::uint64_t inCoreBytes = 110;     ///< of an element of a source that is converted in memory
constexpr std::uint64_t structureBytes = 7000; ///< of a mesh, while the page is read back: docs/massive.md

constexpr std::uint64_t maxPieceRecords = 1u << 18;

} // namespace

std::uint64_t pieceRecords(std::uint32_t regionTriangles) {
  return std::min(maxPieceRecords, std::uint64_t{4} * regionTriangles);
}

std::uint64_t minimumMemory(std::uint32_t regionTriangles) {
  return processBytes + std::max(recordBytes * pieceRecords(regionTriangles), regionBytes * regionTriangles);
}

std::uint64_t inCoreMemory(std::uint64_t elements) {
  return processBytes + inCoreBytes * elements;
}

std::uint64_t structureMemory(std::uint64_t meshes) {
  return structureBytes * meshes;
}

} // namespace imgeo
