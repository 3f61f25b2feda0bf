#include "containers/compact/code_normals.h"
#include "containers/compact/code_positions.h"
#include "containers/compact/code_values.h"
#include "containers/compact/header.h"
#include "containers/compact/patch_coding.h"

#include <numeric>

namespace imgeo::compact {

namespace {

/// An order of a patch's corners and vertices, and the bytes that tell it.
struct Ordered {
  Connectivity connectivity;
  std::vector<std::uint32_t> sourceCorner; ///< corner -> corner of the source
  std::vector<std::uint32_t> sourceVertex; ///< vertex -> vertex of the source
  Bytes bytes;
};

Ordered orderOf(const CompactPatch& patch, const std::vector<std::uint32_t>& vertices,
                std::uint32_t firstTriangle) {
  const auto vertexCount = static_cast<std::uint32_t>(patch.positions.size());
  Ordered ordered;
  if (patch.topology == Topology::triangles) {
    RangeEncoder encoder(triangleModels);
    ordered.connectivity =
        encodeTriangles(encoder, vertices, vertexCount, firstTriangle, ordered.sourceCorner);
    ordered.bytes = encoder.finish();
  } else {
    ordered.sourceCorner.resize(vertices.size());
    std::iota(ordered.sourceCorner.begin(), ordered.sourceCorner.end(), 0u);
    if (patch.topology == Topology::lines) {
      RangeEncoder encoder(lineModels);
      ordered.connectivity = encodeLines(encoder, vertices, vertexCount);
      ordered.bytes = encoder.finish();
    } else {
      ordered.connectivity.vertexCount = vertexCount;
      ordered.connectivity.vertex.resize(vertexCount);
      std::iota(ordered.connectivity.vertex.begin(), ordered.connectivity.vertex.end(), 0u);
    }
  }
  ordered.sourceVertex.resize(vertexCount);
  for (std::size_t corner = 0; corner < ordered.sourceCorner.size(); ++corner)
    ordered.sourceVertex[ordered.connectivity.vertex[corner]] = vertices[ordered.sourceCorner[corner]];
  return ordered;
}

/// The least shift with which no sum of the triangle normals' absolute values around
/// a vertex reaches 2^30.
std::uint32_t normalShiftFor(const CompactPatch& patch, const std::vector<std::uint32_t>& vertices) {
  if (patch.topology != Topology::triangles)
    return 0;
  for (std::uint32_t shift = 0;; ++shift) {
    std::vector<double> sums(patch.positions.size());
    double largest = 0;
    for (std::size_t corner = 0; corner < vertices.size(); corner += 3) {
      const Place a(patch.positions[vertices[corner]]);
      const auto edge = [&](std::size_t i) {
        const Place e = Place(patch.positions[vertices[corner + i]]) - a;
        return Vec3d{std::abs(static_cast<double>(e.x >> shift)), std::abs(static_cast<double>(e.y >> shift)),
                     std::abs(static_cast<double>(e.z >> shift))};
      };
      const Vec3d e = edge(1), f = edge(2);
      const double size = std::max({e.y * f.z + e.z * f.y, e.z * f.x + e.x * f.z, e.x * f.y + e.y * f.x});
      for (std::size_t i = 0; i < 3; ++i)
        largest = std::max(largest, sums[vertices[corner + i]] += size);
    }
    if (largest < 1 << 30)
      return shift;
  }
}

class PatchEncoder {
public:
  PatchEncoder(const CompactPatch& patch, const std::vector<std::uint32_t>& vertices)
      : patch_(patch), normalShift_(normalShiftFor(patch, vertices)) {
    if (patch.positionBits <= 16)
      grid_ = findGrid(patch.positions);
  }

  /// Positions by an order; also what attributes are predicted from.
  Bytes encodePositions(const Ordered& ordered, std::vector<Vec3u>& positions, NormalSums& sums) const {
    positions.resize(ordered.sourceVertex.size());
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
      positions[vertex] = patch_.positions[ordered.sourceVertex[vertex]];
    RangeEncoder encoder(grid_ ? positionModels::countWithGrid : positionModels::count);
    sums = PositionCoder(encoder, ordered.connectivity, patch_.positionBits, grid_, normalShift_, positions)
               .run();
    return encoder.finish();
  }

  Bytes encode(const Ordered& ordered) const {
    Header header;
    header.topology = patch_.topology;
    header.positionBits = patch_.positionBits;
    header.normalShift = normalShift_;
    header.vertexCount = static_cast<std::uint32_t>(patch_.positions.size());
    header.wedgeCount = static_cast<std::uint32_t>(patch_.wedgeCount());
    header.elementCount = static_cast<std::uint32_t>(patch_.elementCount());
    header.grid = grid_;
    std::vector<Bytes> streams;
    if (header.hasConnectivity())
      streams.push_back(ordered.bytes);
    std::vector<Vec3u> positions;
    NormalSums sums(0, 0);
    streams.push_back(encodePositions(ordered, positions, sums));

    Wedges wedges;
    const auto sourceWedge = [&](std::uint32_t corner) {
      return patch_.corners[ordered.sourceCorner[corner]];
    };
    if (header.hasSeams()) {
      RangeEncoder encoder(wedgeModels::count);
      wedges = WedgeCoder(encoder, ordered.connectivity, header.wedgeCount, sourceWedge).run();
      streams.push_back(encoder.finish());
    } else {
      wedges = plainWedges(ordered.connectivity);
    }
    const Surface surface{patch_.topology, ordered.connectivity, wedges, positions, sums, normalShift_};
    for (const Attribute& attribute : patch_.attributes) {
      header.attributes.push_back(attribute.type);
      streams.push_back(encodeAttribute(surface, attribute, [&](std::uint32_t wedge) {
        return attribute.values[sourceWedge(wedges.corner[wedge])];
      }));
    }
    Bytes bytes;
    for (const Bytes& stream : streams)
      header.streamLengths.push_back(static_cast<std::uint32_t>(stream.size()));
    appendHeader(bytes, header);
    for (const Bytes& stream : streams)
      bytes.insert(bytes.end(), stream.begin(), stream.end());
    return bytes;
  }

private:
  template <typename ValueOf>
  Bytes encodeAttribute(const Surface& surface, const Attribute& attribute, ValueOf valueOf) const {
    if (attribute.type.isDerived())
      return {};
    std::vector<Value> values;
    for (std::uint32_t wedge = 0; wedge < surface.wedges.count(); ++wedge)
      values.push_back(valueOf(wedge));
    RangeEncoder encoder(attributeModels::count);
    if (attribute.type.kind == AttributeKind::normal)
      codeNormals(encoder, surface, attribute.type, values);
    else
      ValueCoder(encoder, surface, attribute.type, values).run();
    return encoder.finish();
  }

  const CompactPatch& patch_;
  std::uint32_t normalShift_;
  std::optional<Grid> grid_;
};

} // namespace

Bytes encodePatchBytes(const CompactPatch& patch, int effort) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(patch.corners.size());
  for (const std::uint32_t wedge : patch.corners)
    vertices.push_back(patch.wedgePositions[wedge]);
  (void)effort;
  const PatchEncoder encoder(patch, vertices);
  return encoder.encode(orderOf(patch, vertices, 0));
}

} // namespace imgeo::compact
