#include "containers/compact/code_normals.h"
#include "containers/compact/code_positions.h"
#include "containers/compact/code_values.h"
#include "containers/compact/header.h"
#include "containers/compact/parts.h"
#include "containers/compact/patch_coding.h"

#include <numeric>

namespace imgeo::compact {

namespace {

/// Hands out the streams of a patch one after the other.
class Streams {
public:
  Streams(ByteSpan bytes, const std::vector<std::uint32_t>& lengths, const std::string& place)
      : bytes_(bytes), lengths_(lengths), place_(place) {}

  /// Decodes the next stream by `decode(decoder)` and checks that it ends there.
  template <typename Decode> auto next(std::size_t modelCount, Decode decode) {
    RangeDecoder decoder(take(), modelCount, place_);
    auto result = decode(decoder);
    decoder.finish();
    return result;
  }
  /// A stream in which nothing stands.
  void skipEmpty() {
    if (!take().empty())
      throw Error(ErrorKind::malformed, place_, "a stream is not as long as what it holds");
  }

private:
  ByteSpan take() {
    const std::uint32_t length = lengths_[next_++];
    const ByteSpan stream = bytes_.first(length);
    bytes_ = bytes_.subspan(length);
    return stream;
  }

  ByteSpan bytes_;
  const std::vector<std::uint32_t>& lengths_;
  const std::string& place_;
  std::size_t next_ = 0;
};

Connectivity decodeConnectivity(const Header& header, Streams& streams) {
  if (header.topology == Topology::triangles)
    return streams.next(triangleModels, [&](RangeDecoder& decoder) {
      return decodeTriangles(decoder, header.elementCount, header.vertexCount);
    });
  if (header.topology == Topology::lines)
    return streams.next(lineModels, [&](RangeDecoder& decoder) {
      return decodeLines(decoder, header.elementCount, header.vertexCount);
    });
  Connectivity points;
  points.vertexCount = header.vertexCount;
  points.vertex.resize(header.vertexCount);
  std::iota(points.vertex.begin(), points.vertex.end(), 0u);
  return points;
}

Parts decodeParts(const Header& header, const Connectivity& connectivity, Streams& streams) {
  if (!header.hasParts())
    return {};
  return streams.next(partModels::count, [&](RangeDecoder& decoder) {
    return codeParts(decoder, connectivity, header.partCount,
                     std::vector<std::uint32_t>(header.elementCount));
  });
}

Wedges decodeWedges(const Header& header, const Connectivity& connectivity, Streams& streams) {
  if (!header.hasSeams())
    return plainWedges(connectivity);
  return streams.next(wedgeModels::count, [&](RangeDecoder& decoder) {
    return WedgeCoder(decoder, connectivity, header.wedgeCount, [](std::uint32_t) { return none; }).run();
  });
}

std::vector<Value> decodeValues(const Surface& surface, const AttributeType& type, Streams& streams) {
  std::vector<Value> values(surface.wedges.count());
  const auto decode = [&](RangeDecoder& decoder) {
    if (type.kind == AttributeKind::normal)
      codeNormals(decoder, surface, type, values);
    else
      ValueCoder(decoder, surface, type, values).run();
    return true;
  };
  if (type.isDerived()) {
    streams.skipEmpty();
    RangeDecoder nothing({}, attributeModels::count, std::string());
    decode(nothing);
  } else {
    streams.next(attributeModels::count, decode);
  }
  return values;
}

} // namespace

CompactPatch decodePatchBytes(ByteSpan payload, std::size_t first, const std::string& place) {
  const auto [header, streamsAt] = readHeader(payload, first, place);
  Streams streams(payload.subspan(streamsAt), header.streamLengths, place);

  CompactPatch patch;
  patch.topology = header.topology;
  patch.positionBits = header.positionBits;
  const Connectivity connectivity = decodeConnectivity(header, streams);
  Parts parts = decodeParts(header, connectivity, streams);
  patch.positions.resize(header.vertexCount);
  const NormalSums sums = streams.next(
      header.grid ? positionModels::countWithGrid : positionModels::count, [&](RangeDecoder& decoder) {
        return PositionCoder(decoder, connectivity, header.positionBits, header.grid, header.normalShift,
                             {header.residualShift, &parts.isShared}, patch.positions)
            .run();
      });
  Wedges wedges = decodeWedges(header, connectivity, streams);
  const Surface surface{header.topology, connectivity, wedges, patch.positions, sums, header.normalShift};
  for (const AttributeType& type : header.attributes)
    patch.attributes.push_back({type, decodeValues(surface, type, streams)});
  patch.parts = std::move(parts.ofTriangle);
  patch.partCount = header.partCount;
  patch.residualShift = header.residualShift;
  patch.corners = std::move(wedges.ofCorner);
  patch.wedgePositions = std::move(wedges.vertex);
  return patch;
}

} // namespace imgeo::compact
