#include "containers/compact/code_normals.h"
#include "containers/compact/code_positions.h"
#include "containers/compact/code_values.h"
#include "containers/compact/header.h"
#include "containers/compact/parts.h"
#include "containers/compact/patch_coding.h"
#include "containers/stored.h"
#include "containers/unit_vectors.h"

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

/// The largest angle between two lists of normals, in radians.
double largestAngle(const std::vector<Value>& a, const std::vector<Value>& b) {
  const auto vector = [](const Value& value) {
    return unitNormal({double(value[0]), double(value[1]), double(value[2])});
  };
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, angleBetween(vector(a[i]), vector(b[i])));
  return largest;
}

/// A stream, and for an attribute its type as it turned out best.
struct EncodedAttribute {
  AttributeType type;
  Bytes bytes;
  double normalError = 0;
};

class PatchEncoder {
public:
  PatchEncoder(const CompactPatch& patch, const Ordered& ordered, const std::optional<Grid>& grid,
               std::uint32_t normalShift, int effort)
      : patch_(patch), ordered_(ordered), effort_(effort) {
    header_.topology = patch.topology;
    header_.positionBits = patch.positionBits;
    header_.normalShift = normalShift;
    header_.vertexCount = static_cast<std::uint32_t>(patch.positions.size());
    header_.wedgeCount = static_cast<std::uint32_t>(patch.wedgeCount());
    header_.elementCount = static_cast<std::uint32_t>(patch.elementCount());
    header_.grid = grid;
    header_.partCount = patch.partCount;
    header_.residualShift = patch.residualShift;
  }

  PatchBytes run() {
    if (header_.hasConnectivity())
      addStream(ordered_.bytes);
    const Parts parts = encodeParts();
    std::vector<Vec3u> positions = orderedPositions();
    const NormalSums sums = encodePositions(positions, {header_.residualShift, &parts.isShared});
    const Wedges wedges = encodeWedges();
    const Surface surface{patch_.topology,    ordered_.connectivity, wedges, positions, sums,
                          header_.normalShift};
    PatchBytes result;
    for (const Attribute& attribute : patch_.attributes) {
      const EncodedAttribute encoded = encodeAttribute(surface, attribute);
      header_.attributes.push_back(encoded.type);
      addStream(encoded.bytes);
      result.normalError = std::max(result.normalError, encoded.normalError);
    }
    appendHeader(result.bytes, header_);
    result.bytes.insert(result.bytes.end(), streams_.begin(), streams_.end());
    return result;
  }

private:
  void addStream(const Bytes& stream) {
    header_.streamLengths.push_back(static_cast<std::uint32_t>(stream.size()));
    streams_.insert(streams_.end(), stream.begin(), stream.end());
  }

  std::vector<Vec3u> orderedPositions() const { return gather(patch_.positions, ordered_.sourceVertex); }

  Parts encodeParts() {
    if (!header_.hasParts())
      return {};
    std::vector<std::uint32_t> parts;
    for (std::size_t corner = 0; corner < ordered_.sourceCorner.size(); corner += 3)
      parts.push_back(patch_.parts[ordered_.sourceCorner[corner] / 3]);
    RangeEncoder encoder(partModels::count);
    Parts coded = codeParts(encoder, ordered_.connectivity, header_.partCount, std::move(parts));
    addStream(encoder.finish());
    return coded;
  }

  NormalSums encodePositions(std::vector<Vec3u>& positions, CoarseResiduals residuals) {
    RangeEncoder encoder(header_.grid ? positionModels::countWithGrid : positionModels::count);
    NormalSums sums = PositionCoder(encoder, ordered_.connectivity, header_.positionBits, header_.grid,
                                    header_.normalShift, residuals, positions)
                          .run();
    addStream(encoder.finish());
    return sums;
  }

  std::uint32_t sourceWedge(std::uint32_t corner) const {
    return patch_.corners[ordered_.sourceCorner[corner]];
  }

  Wedges encodeWedges() {
    if (!header_.hasSeams())
      return plainWedges(ordered_.connectivity);
    RangeEncoder encoder(wedgeModels::count);
    Wedges wedges = WedgeCoder(encoder, ordered_.connectivity, header_.wedgeCount, [&](std::uint32_t corner) {
                      return sourceWedge(corner);
                    }).run();
    addStream(encoder.finish());
    return wedges;
  }

  EncodedAttribute encodeAttribute(const Surface& surface, const Attribute& attribute) const {
    std::vector<Value> values;
    values.reserve(surface.wedges.count());
    for (const std::uint32_t corner : surface.wedges.corner)
      values.push_back(attribute.values[sourceWedge(corner)]);
    if (attribute.type.kind == AttributeKind::normal)
      return encodeNormals(surface, attribute.type, values);
    RangeEncoder encoder(attributeModels::count);
    ValueCoder(encoder, surface, attribute.type, values).run();
    return {attribute.type, encoder.finish()};
  }

  EncodedAttribute encodeNormals(const Surface& surface, const AttributeType& type,
                                 const std::vector<Value>& values) const {
    const auto encode = [&](const AttributeType& as) {
      std::vector<Value> coded = values;
      RangeEncoder encoder(attributeModels::count);
      codeNormals(encoder, surface, as, coded);
      return as.isDerived()
                 ? EncodedAttribute{as, {}, largestAngle(values, coded) + octahedronErrorBound(as.bits)}
                 : EncodedAttribute{as, encoder.finish(), octahedronErrorBound(as.bits)};
    };
    if (effort_ == 0 || patch_.topology != Topology::triangles)
      return encode(type);
    AttributeType other = type;
    other.mode = static_cast<NormalMode>(static_cast<unsigned>(type.mode) ^ 1u); // area, uniform
    if (!type.isDerived() && effort_ < effortOfWholeTrials) {
      const std::size_t size = sampleSize(surface, type, values);
      return encode(size > smallSample && sampleSize(surface, other, values) < size ? other : type);
    }
    EncodedAttribute given = encode(type), tried = encode(other);
    const bool isBetter =
        type.isDerived() ? tried.normalError < given.normalError : tried.bytes.size() < given.bytes.size();
    return isBetter ? tried : given;
  }

  /// What the first normals take: below the efforts that try all of them, enough to choose a mode.
  static std::size_t sampleSize(const Surface& surface, const AttributeType& as, std::vector<Value> values) {
    RangeEncoder encoder(attributeModels::count);
    codeNormals(encoder, surface, as, values, sampledNormals);
    return encoder.finish().size();
  }
  static constexpr std::uint32_t sampledNormals = 4096;
  static constexpr std::size_t smallSample = sampledNormals / 16; ///< half a bit a normal: the mode is right
  static constexpr int effortOfWholeTrials = 7;

  const CompactPatch& patch_;
  const Ordered& ordered_;
  int effort_;
  Header header_;
  Bytes streams_;
};

} // namespace

PatchBytes encodePatchBytes(const CompactPatch& patch, int effort) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(patch.corners.size());
  for (const std::uint32_t wedge : patch.corners)
    vertices.push_back(patch.wedgePositions[wedge]);
  const std::optional<Grid> grid = patch.positionBits <= 16 ? findGrid(patch.positions) : std::nullopt;
  const Ordered ordered = orderOf(patch, vertices, 0);
  return PatchEncoder(patch, ordered, grid, normalShiftFor(patch, vertices), effort).run();
}

} // namespace imgeo::compact
