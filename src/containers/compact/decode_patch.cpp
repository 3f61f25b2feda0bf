#include "containers/compact/code_normals.h"
#include "containers/compact/code_values.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/streams.h"

#include <numeric>

namespace imgeo::compact {

namespace {

class FileDecoder {
public:
  FileDecoder(ByteSpan payload, const ParsedHeader& parsed, const std::string& location)
      : header_(parsed.header), location_(location),
        streams_(payload.subspan(parsed.streamsByteOffset), parsed.header, location) {}

  std::vector<CompactPatch> run() {
    std::vector<CompactPatch> patches;
    for (const PatchSizes& sizes : decodeSizes())
      patches.push_back(decodePatch(sizes));
    streams_.finish();
    return patches;
  }

  /// Decodes the sizes of all patches and checks them. Throws Error{limit} for more than a file may have.
  std::vector<PatchSizes> decodeSizes() {
    std::vector<PatchSizes> all;
    SizeSums sums;
    for (std::uint32_t i = 0; i < header_.patchCount; ++i) {
      const PatchSizes& sizes = all.emplace_back(codeSizes(streams_[StreamName::sizes], header_));
      sums.add(sizes.vertexCount, sizes.wedgeCount, sizes.elementCount);
    }
    streams_.finish(streamOf(StreamName::sizes));
    if (!sums.fits())
      throw Error(ErrorKind::limit, location_,
                  "a file has at most " + std::to_string(maxCount) + " vertices and elements");
    return all;
  }

private:
  CompactPatch decodePatch(const PatchSizes& sizes) {
    const PatchType& type = header_.types[sizes.type];
    CompactPatch patch;
    patch.topology = type.topology;
    patch.positionBits = type.positionBits;
    Connectivity connectivity = decodeConnectivity(type.topology, sizes);
    Segments segments;
    if (type.isBase)
      segments = codeSegments(streams_[StreamName::segments], connectivity, sizes.segmentCount,
                              std::vector<std::uint32_t>(sizes.elementCount));
    patch.positions.resize(sizes.vertexCount);
    const NormalSums sums = PositionCoder(streams_[StreamName::positions], header_.version, connectivity,
                                          {type.positionBits, sizes.normalShift, sizes.grid},
                                          {sizes.residualShift, &segments.isShared}, patch.positions)
                                .run();
    Wedges wedges = decodeWedges(connectivity, sizes);
    const Surface surface{type.topology, connectivity, wedges, patch.positions, sums, sizes.normalShift, type.isBase};
    for (const std::uint32_t attribute : type.attributes)
      patch.attributes.push_back({header_.attributes[attribute], decodeValues(surface, attribute)});
    patch.segments = std::move(segments.ofTriangle);
    patch.segmentCount = sizes.segmentCount;
    patch.residualShift = sizes.residualShift;
    patch.fans = std::move(connectivity.fans);
    patch.corners = std::move(wedges.ofCorner);
    patch.wedgePositions = std::move(wedges.vertex);
    return patch;
  }

  Connectivity decodeConnectivity(Topology topology, const PatchSizes& sizes) {
    if (topology == Topology::triangles)
      return decodeTriangles(streams_[StreamName::connectivity], sizes.elementCount, sizes.vertexCount);
    if (topology == Topology::lines)
      return decodeLines(streams_[StreamName::connectivity], sizes.elementCount, sizes.vertexCount);
    Connectivity points;
    points.vertexCount = sizes.vertexCount;
    points.vertex.resize(sizes.vertexCount);
    std::iota(points.vertex.begin(), points.vertex.end(), 0u);
    return points;
  }

  Wedges decodeWedges(const Connectivity& connectivity, const PatchSizes& sizes) {
    if (!sizes.hasSeams())
      return plainWedges(connectivity);
    return WedgeCoder(streams_[StreamName::wedges], connectivity, sizes.wedgeCount, [](std::uint32_t) { return none; })
        .run();
  }

  std::vector<Value> decodeValues(const Surface& surface, std::uint32_t attribute) {
    const AttributeType& type = header_.attributes[attribute];
    std::vector<Value> values(surface.wedges.count());
    if (type.isDerived()) {
      RangeDecoder nothing({}, attributeModels::count, location_);
      codeNormals(nothing, surface, type, values);
    } else if (type.kind == AttributeKind::normal) {
      codeNormals(streams_[streamOfAttribute(attribute)], surface, type, values);
    } else {
      ValueCoder(streams_[streamOfAttribute(attribute)], surface, type, values).run();
    }
    return values;
  }

  const FileHeader& header_;
  const std::string& location_;
  StreamDecoders streams_;
};

} // namespace

std::vector<CompactPatch> decodePatches(ByteSpan payload, const std::string& location) {
  return FileDecoder(payload, readHeader(payload, location), location).run();
}

std::vector<std::vector<AttributeType>> attributesOfPatches(ByteSpan payload, const std::string& location) {
  const ParsedHeader parsed = readHeader(payload, location);
  std::vector<std::vector<AttributeType>> all;
  for (const PatchSizes& sizes : FileDecoder(payload, parsed, location).decodeSizes()) {
    all.emplace_back();
    for (const std::uint32_t attribute : parsed.header.types[sizes.type].attributes)
      all.back().push_back(parsed.header.attributes[attribute]);
  }
  return all;
}

} // namespace imgeo::compact
