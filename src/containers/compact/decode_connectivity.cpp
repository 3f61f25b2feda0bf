#include "containers/compact/conquest.h"
#include "containers/compact/lines.h"

namespace imgeo::compact {

namespace {
struct NoGuide {};
} // namespace

const std::size_t connectivityModels = lineModelOffsets::count;

Connectivity decodeTriangles(RangeDecoder& decoder, std::uint32_t triangleCount, std::uint32_t vertexCount) {
  NoGuide guide;
  return Conquest(decoder, guide, triangleCount, vertexCount).run();
}

Connectivity decodeLines(RangeDecoder& decoder, std::uint32_t lineCount, std::uint32_t vertexCount) {
  NoGuide guide;
  return codeLines(decoder, guide, lineCount, vertexCount);
}

} // namespace imgeo::compact
