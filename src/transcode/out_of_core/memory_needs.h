#pragma once
// The memory that conversion out of core takes. The figures were measured with scripts/bench massive: docs/massive.md.

#include <cstdint>

namespace imgeo {

/// Bytes of an element while its region is built.
inline constexpr std::uint64_t regionBytes = 300;

/// Bytes of a face or point of a piece of the source that is scattered.
inline constexpr std::uint64_t recordBytes = 384;

/// Bytes of everything else.
inline constexpr std::uint64_t processBytes = 64u << 20;

/// The faces or points of a piece of a source whose levels have regions of so many triangles or points.
std::uint64_t pieceRecords(std::uint32_t regionTriangles);

/// The least memory in which regions of so many triangles or points are built.
std::uint64_t minimumMemory(std::uint32_t regionTriangles);

/// An estimate of the memory that converting so many triangles or points in memory takes.
std::uint64_t inCoreMemory(std::uint64_t elements);

/// An estimate of the memory that what is known of so many meshes takes beside: nodes, descriptions, the document.
std::uint64_t structureMemory(std::uint64_t meshes);

} // namespace imgeo
