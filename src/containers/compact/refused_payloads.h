#pragma once
// Payloads for tests that every reader refuses, each with a name that says what is wrong with it. Damage to a few bytes
// of a valid payload does not produce them.

#include "containers/compact/code_positions.h"
#include "containers/compact/conquest.h"
#include "containers/compact/header.h"
#include "containers/compact/lines.h"
#include "containers/compact/range_encoder.h"
#include "containers/compact/sizes.h"
#include "containers/compact/wedges.h"

#include <map>
#include <string>
#include <utility>

namespace imgeo::compact::testing {

/// The payload of patches of one type without attributes; streams that are missing from `streams` are empty.
inline Bytes payloadOf(Version version, const PatchType& type, std::uint32_t patchCount,
                       const std::map<StreamName, Bytes>& streams) {
  FileHeader header{{}, {type}, patchCount, std::vector<std::uint32_t>(5), version};
  for (const auto& [name, bytes] : streams)
    header.streamLengths[static_cast<std::size_t>(name)] = static_cast<std::uint32_t>(bytes.size());
  Bytes payload;
  appendHeader(payload, header);
  for (const auto& [name, bytes] : streams)
    payload.insert(payload.end(), bytes.begin(), bytes.end());
  return payload;
}

/// The stream of the sizes of patches of one type. The sizes may be invalid.
inline Bytes sizesStream(Version version, const PatchType& type, const std::vector<PatchSizes>& patches) {
  RangeEncoder encoder(sizeModels::count);
  for (const PatchSizes& sizes : patches) {
    codeNumber(encoder, sizeModels::type, 0);
    codeNumber(encoder, sizeModels::vertices, sizes.vertexCount - 1);
    if (type.topology != Topology::points) {
      codeNumber(encoder, sizeModels::seams, sizes.wedgeCount - sizes.vertexCount);
      codeNumber(encoder, sizeModels::elements, sizes.elementCount - 1);
    }
    if (type.positionBits > maxGridBitsOf(version))
      continue;
    encoder.bit(sizeModels::grid, sizes.grid.has_value());
    for (int axis = 0; axis < 3 && sizes.grid; ++axis) {
      codeWord(encoder, sizes.grid->origin[axis], gridNumberBits(version));
      codeWord(encoder, sizes.grid->step[axis], gridNumberBits(version));
    }
  }
  return encoder.finish();
}

/// Four lines between two vertices. The first end of the last line refers to a wedge of the other vertex.
inline Bytes wedgeOfAnotherVertex(Version version) {
  const PatchType type{Topology::lines, 30, false, {}};
  const PositionModels models = positionModelsOf(version);
  RangeEncoder connectivity(lineModelOffsets::count), positions(models.count), wedges(wedgeModels::count);
  for (int line = 0; line < 4; ++line) {
    if (line > 0)
      connectivity.bit(lineModelOffsets::chain, false);
    for (std::uint32_t end = 0; end < 2; ++end) {
      connectivity.bit(lineModelOffsets::old + end, line > 0);
      if (line > 0)
        codeNumber(connectivity, lineModelOffsets::vertex, 1 - end);
    }
  }
  for (int vertex = 0; vertex < 2; ++vertex) // both in the middle of the lattice
    for (const Residual kind : {Residual::first, Residual::second, Residual::third})
      codeSigned(positions, models.residual[static_cast<std::size_t>(kind)], 0);
  wedges.bit(wedgeModels::split, true);
  wedges.bit(wedgeModels::split + 1, false);
  for (std::size_t extra = 0; extra < 2; ++extra) {
    wedges.bit(wedgeModels::same + 3 * extra, false);
    wedges.bit(wedgeModels::made + extra, true);
  }
  wedges.bit(wedgeModels::same + 6, false);
  wedges.bit(wedgeModels::made + 2, false);
  codeTree(wedges, wedgeModels::step, 4, 15);
  codeNumber(wedges, wedgeModels::wedge, 2); // a wedge of the other vertex
  return payloadOf(version, type, 1,
                   {{StreamName::sizes, sizesStream(version, type, {{0, 2, 4, 4, 0, {}, 0, 0}})},
                    {StreamName::connectivity, connectivity.finish()},
                    {StreamName::positions, positions.finish()},
                    {StreamName::wedges, wedges.finish()}});
}

/// The name and the bytes of each payload. refused.json in vectors/compact-1 and compact-2 lists the names.
inline std::vector<std::pair<std::string, Bytes>> refusedPayloads(Version version) {
  const PatchType points{Topology::points, 30, false, {}}, lines{Topology::lines, 30, false, {}},
      onGrid{Topology::points, maxGridBitsOf(version), false, {}};
  const auto withSizes = [version](const PatchType& type, const std::vector<PatchSizes>& sizes) {
    return payloadOf(version, type, static_cast<std::uint32_t>(sizes.size()),
                     {{StreamName::sizes, sizesStream(version, type, sizes)}});
  };
  const auto withGrid = [&](std::uint64_t origin, std::uint64_t step) {
    const VertexGrid grid{{0, 0, origin}, {1u << 20, 1u << 20, step}};
    return withSizes(onGrid, {{0, 1, 1, 1, 0, grid, 0, 0}});
  };
  Bytes begin{'I', 'G', 'C', static_cast<std::uint8_t>(version)};
  if (version != Version::one)
    begin.push_back(0);
  const auto withHeader = [&](std::initializer_list<std::uint8_t> rest) {
    Bytes bytes = begin;
    bytes.insert(bytes.end(), rest);
    bytes.resize(64);
    return bytes;
  };
  const auto withHalf = [&](std::initializer_list<std::uint8_t> rest) {
    Bytes bytes = begin;
    bytes.insert(bytes.end(), rest);
    return bytes;
  };
  std::vector<std::pair<std::string, Bytes>> payloads{
      {"more vertices", withSizes(points, {{0, maxCount, 0, 0, 0, {}, 0, 0}, {0, 1, 0, 0, 0, {}, 0, 0}})},
      {"more wedges", withSizes(lines, {{0, 1, maxCount + 1, maxCount, 0, {}, 0, 0}})},
      {"more elements", withSizes(lines, {{0, 1, 1, maxCount + 1, 0, {}, 0, 0}})},
      {"another format", {'I', 'G', 'D', 1, 0, 0}},
      {"another version", {'I', 'G', 'C', 3, 0, 0}},
      {"half a header", withHalf({1, 0})},
      {"more attributes", withHeader({0x81, 2})},
      {"more types", withHeader({0, 0x81, 2})},
      {"more patches", withHeader({0, 1, 1, 16, 0, 0, 0x81, 0x80, 4})},
      {"no patches", withHeader({0, 1, 1, 16, 0, 0, 0})},
      {"a patch of no type", withHeader({0, 0, 1, 3, 0, 0, 0, 0})},
      {"a number of five bytes", withHeader({0x80, 0x80, 0x80, 0x80, 0})},
      {"streams of more than 32 bits",
       withHeader({0, 1, 1, 16, 0, 0, 1, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 0x7f})},
      {"a base of points", withHeader({0, 1, 1, 16, 1, 0, 1, 0, 0, 0, 0, 0})},
      {"bases beside patches", withHeader({0, 2, 3, 16, 1, 0, 3, 16, 0, 0, 1, 0, 0, 0, 0, 0})},
      {"lines of a grid that are too near", withGrid(0, 2 * 65536 - 1)},
      {"a grid that begins behind its first line", withGrid(1u << 20, 1u << 20)},
      {"a wedge of another vertex", wedgeOfAnotherVertex(version)},
  };
  if (version != Version::one) {
    payloads.emplace_back("unknown features", Bytes{'I', 'G', 'C', 2, 1, 0, 0});
    payloads.emplace_back("lines of a grid that are too far", withGrid(0, maxGridStep(version) + 1));
  }
  return payloads;
}

} // namespace imgeo::compact::testing
