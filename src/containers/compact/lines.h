#pragma once
// Encodes and decodes lines by the same loop: docs/formats/compact.md, "Lines".

#include "containers/compact/conquest.h"
#include "containers/compact/symbols.h"

namespace imgeo::compact {

/// The first model of each symbol of lines. They follow the models of triangles in the same stream.
namespace lineModelOffsets {
inline constexpr std::size_t chain = conquestModels::count, old = chain + 1, vertex = old + 2,
                             count = vertex + numberModels;
}

/// Codes all lines. The `guide` of an encoder knows the source lines; decoders do not use it.
template <typename Coder, typename Guide>
Connectivity codeLines(Coder& coder, Guide& guide, std::uint32_t lineCount, std::uint32_t vertexCount) {
  namespace models = lineModelOffsets;
  Connectivity out;
  out.vertex.reserve(std::size_t{lineCount} * 2);
  out.from.assign(vertexCount, none);

  // Codes one end of a line. Returns true if it is a new vertex.
  const auto codeEnd = [&](std::uint32_t corner, std::uint32_t& vertex) {
    std::uint32_t known = none;
    if constexpr (Coder::encodes)
      known = guide.number(corner);
    const bool isOld = coder.bit(models::old + corner % 2, known != none);
    if (isOld) {
      const std::uint32_t distance = codeNumber(coder, models::vertex, out.vertexCount - 1 - known);
      coder.require(distance < out.vertexCount, "a vertex is named that has not come");
      vertex = out.vertexCount - 1 - distance;
    } else {
      coder.require(out.vertexCount < vertexCount, "there are more vertices than the header states");
      vertex = out.vertexCount++;
      if constexpr (Coder::encodes)
        guide.giveNumber(corner, vertex);
    }
    out.vertex.push_back(vertex);
    return !isOld;
  };

  std::uint32_t a = none, b = none;
  for (std::uint32_t line = 0; line < lineCount; ++line) {
    bool isChained = false;
    if constexpr (Coder::encodes)
      isChained = line > 0 && guide.isChained(line);
    if (line > 0 && coder.bit(models::chain, isChained))
      out.vertex.push_back(a = b);
    else
      codeEnd(2 * line, a);
    if (codeEnd(2 * line + 1, b))
      out.from[b] = a;
  }
  coder.require(out.vertexCount == vertexCount, "there are fewer vertices than the header states");
  return out;
}

} // namespace imgeo::compact
