#include "containers/compact/code_normals.h"
#include "containers/compact/code_values.h"
#include "containers/compact/normal_tolerance.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/starts.h"
#include "containers/compact/streams.h"
#include "containers/stored.h"
#include "containers/unit_vectors.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace imgeo::compact {

namespace {

/// An order of the corners and vertices of a patch.
struct Ordered {
  Connectivity connectivity;
  std::vector<std::uint32_t> sourceCorner; ///< corner -> corner of the source
  std::vector<std::uint32_t> sourceVertex; ///< vertex -> vertex of the source
};

/// Chooses an order and encodes it.
Ordered orderOf(const CompactPatch& patch, const std::vector<std::uint32_t>& vertices, std::uint32_t firstTriangle,
                StreamEncoders& streams) {
  const auto vertexCount = static_cast<std::uint32_t>(patch.positions.size());
  Ordered ordered;
  if (patch.topology == Topology::triangles) {
    ordered.connectivity =
        encodeTriangles(streams[StreamName::connectivity], vertices, vertexCount, firstTriangle, ordered.sourceCorner);
  } else {
    ordered.sourceCorner.resize(vertices.size());
    std::iota(ordered.sourceCorner.begin(), ordered.sourceCorner.end(), 0u);
    if (patch.topology == Topology::lines) {
      ordered.connectivity = encodeLines(streams[StreamName::connectivity], vertices, vertexCount);
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

/// Whether the sums of absolute triangle normals around each vertex are below 2^30, with edges shifted right.
bool normalSumsFit(const CompactPatch& patch, const std::vector<std::uint32_t>& vertices, std::uint32_t shift) {
  constexpr std::int64_t limit = 1 << 30;
  std::vector<std::int64_t> sums(patch.positions.size());
  for (std::size_t corner = 0; corner < vertices.size(); corner += 3) {
    const Vec3i64 a(patch.positions[vertices[corner]]);
    const auto edge = [&](std::size_t i) {
      const Vec3i64 e = Vec3i64(patch.positions[vertices[corner + i]]) - a;
      return Vec3i64{std::abs(e.x >> shift), std::abs(e.y >> shift), std::abs(e.z >> shift)};
    };
    const Vec3i64 e = edge(1), f = edge(2); // below 2^30 each
    const std::int64_t size = std::max({e.y * f.z + e.z * f.y, e.z * f.x + e.x * f.z, e.x * f.y + e.y * f.x});
    for (std::size_t i = 0; i < 3; ++i) {
      std::int64_t& sum = sums[vertices[corner + i]];
      sum += size;
      if (sum >= limit)
        return false;
    }
  }
  return true;
}

/// The smallest shift for which normalSumsFit holds.
std::uint32_t normalShiftFor(const CompactPatch& patch, const std::vector<std::uint32_t>& vertices) {
  std::uint32_t shift = 0;
  while (patch.topology == Topology::triangles && !normalSumsFit(patch, vertices, shift))
    ++shift;
  return shift;
}

/// The largest angle between two lists of normals, in radians.
double largestAngle(const std::vector<Value>& a, const std::vector<Value>& b) {
  const auto vector = [](const Value& value) { return unitNormal(directionOf(value)); };
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, angleBetween(vector(a[i]), vector(b[i])));
  return largest;
}

/// A patch in coded order, as a decoder returns it.
struct CodedPatch {
  const CompactPatch& source;
  Ordered ordered;
  PatchSizes sizes;
  std::vector<Vec3u> positions;
  NormalSums normalSums{0, 0};
  Wedges wedges;

  std::uint32_t sourceWedge(std::uint32_t corner) const { return source.corners[ordered.sourceCorner[corner]]; }
  Surface surface() const {
    return {source.topology,   ordered.connectivity,   wedges, positions, normalSums,
            sizes.normalShift, source.segmentCount > 0};
  }
  /// The values of an attribute of the source.
  std::vector<Value> valuesOf(const Attribute& attribute) const {
    std::vector<Value> values;
    values.reserve(wedges.count());
    for (const std::uint32_t corner : wedges.corner)
      values.push_back(attribute.values[sourceWedge(corner)]);
    return values;
  }
  /// Which predictions may stand for the normals `values` of an attribute.
  NormalTolerance toleranceOf(const Attribute& attribute, const std::vector<Value>& values) const {
    std::vector<Vec3f> sources;
    if (!attribute.sourceNormals.empty())
      for (const std::uint32_t corner : wedges.corner)
        sources.push_back(attribute.sourceNormals[sourceWedge(corner)]);
    return {surface(), attribute.type, values, std::move(sources)};
  }
};

/// In patches with fewer points a grid saves less than its own 24 bytes.
constexpr std::size_t minGridPoints = 64;

std::optional<VertexGrid> gridOf(const CompactPatch& patch, Version version) {
  if (patch.positionBits > maxGridBitsOf(version) || patch.positions.size() < minGridPoints)
    return std::nullopt;
  return patch.grid && isWorthwhile(*patch.grid, patch.positions) ? patch.grid : findVertexGrid(patch.positions);
}

/// The index of a value in a list, to which it is appended if it is missing.
template <typename T> std::uint32_t indexIn(std::vector<T>& list, const T& value) {
  const auto found = std::ranges::find(list, value);
  if (found != list.end())
    return static_cast<std::uint32_t>(found - list.begin());
  list.push_back(value);
  return static_cast<std::uint32_t>(list.size() - 1);
}

/// The position of each corner.
std::vector<std::uint32_t> verticesOf(const CompactPatch& patch) {
  return gather(patch.wedgePositions, patch.corners);
}

/// The first effort that tries several orders.
constexpr int effortOfSearches = 7;
constexpr Search searches[] = {{2, 0, 16, 1}, {4, 2, 48, 1}, {8, 4, 192, 3}};

/// The first triangles of the orders to encode. Those of an effort begin with those of the effort before.
std::vector<std::uint32_t> startsOf(const CompactPatch& patch, int effort) {
  if (effort < effortOfSearches || patch.topology != Topology::triangles)
    return {0};
  const std::vector<std::uint32_t> vertices = verticesOf(patch);
  std::vector<std::uint32_t> starts;
  for (int i = effortOfSearches; i <= effort; ++i)
    appendStarts(starts, vertices, static_cast<std::uint32_t>(patch.positions.size()), searches[i - effortOfSearches]);
  return starts;
}

class FileEncoder {
public:
  /// `firstTriangleOf(i)` is the triangle that the order of a patch begins with.
  template <typename FirstTriangle>
  FileEncoder(std::span<const CompactPatch> patches, int effort, Version version, FirstTriangle firstTriangleOf)
      : effort_(effort) {
    header_.version = version;
    header_.patchCount = static_cast<std::uint32_t>(patches.size());
    std::vector<std::uint32_t> types;
    for (const CompactPatch& patch : patches)
      types.push_back(indexIn(header_.types, typeOf(patch)));
    streams_ = StreamEncoders(header_.streamCount(), version);
    coded_.reserve(patches.size());
    for (std::size_t i = 0; i < patches.size(); ++i)
      code(patches[i], types[i], firstTriangleOf(i));
  }

  EncodedPatches run() {
    EncodedPatches result{{}, std::vector<double>(coded_.size())};
    for (std::uint32_t attributeIndex = 0; attributeIndex < header_.attributes.size(); ++attributeIndex)
      encodeAttribute(attributeIndex, result.normalErrors);
    const std::vector<Bytes> streams = streams_.finish();
    for (const Bytes& stream : streams)
      header_.streamLengths.push_back(static_cast<std::uint32_t>(stream.size()));
    appendHeader(result.bytes, header_);
    for (const Bytes& stream : streams)
      result.bytes.insert(result.bytes.end(), stream.begin(), stream.end());
    return result;
  }

private:
  /// The type of a patch. Adds missing attribute types to the header; attributes of one patch never share an entry of
  /// the header, even if they have the same type.
  PatchType typeOf(const CompactPatch& patch) {
    PatchType type{patch.topology, patch.positionBits, patch.segmentCount > 0, {}};
    for (const Attribute& attribute : patch.attributes) {
      const auto isUnusedMatch = [&](std::uint32_t attributeIndex) {
        return header_.attributes[attributeIndex] == attribute.type &&
               std::ranges::find(type.attributes, attributeIndex) == type.attributes.end();
      };
      std::uint32_t attributeIndex = 0;
      while (attributeIndex < header_.attributes.size() && !isUnusedMatch(attributeIndex))
        ++attributeIndex;
      if (attributeIndex == header_.attributes.size())
        header_.attributes.push_back(attribute.type);
      type.attributes.push_back(attributeIndex);
    }
    return type;
  }

  /// Encodes a patch without its attributes.
  void code(const CompactPatch& patch, std::uint32_t type, std::uint32_t firstTriangle) {
    const std::vector<std::uint32_t> vertices = verticesOf(patch);
    CodedPatch coded{patch, orderOf(patch, vertices, firstTriangle, streams_), {}, {}, NormalSums(0, 0), {}};
    coded.sizes = codeSizes(streams_[StreamName::sizes], header_,
                            {type, static_cast<std::uint32_t>(patch.positions.size()),
                             static_cast<std::uint32_t>(patch.wedgeCount()),
                             static_cast<std::uint32_t>(patch.elementCount()), normalShiftFor(patch, vertices),
                             gridOf(patch, header_.version), patch.segmentCount, patch.residualShift});
    const Connectivity& connectivity = coded.ordered.connectivity;
    Segments segments;
    if (patch.segmentCount > 0)
      segments = codeSegments(streams_[StreamName::segments], connectivity, patch.segmentCount, segmentsOf(coded));
    coded.positions = gather(patch.positions, coded.ordered.sourceVertex);
    coded.normalSums = PositionCoder(streams_[StreamName::positions], header_.version, connectivity,
                                     {patch.positionBits, coded.sizes.normalShift, coded.sizes.grid},
                                     {patch.residualShift, &segments.isShared}, coded.positions)
                           .run();
    coded.wedges = codeWedges(coded);
    coded_.push_back(std::move(coded));
  }

  static std::vector<std::uint32_t> segmentsOf(const CodedPatch& coded) {
    std::vector<std::uint32_t> segments;
    for (std::size_t corner = 0; corner < coded.ordered.sourceCorner.size(); corner += 3)
      segments.push_back(coded.source.segments[coded.ordered.sourceCorner[corner] / 3]);
    return segments;
  }

  Wedges codeWedges(const CodedPatch& coded) {
    if (!coded.sizes.hasSeams())
      return plainWedges(coded.ordered.connectivity);
    return WedgeCoder(streams_[StreamName::wedges], coded.ordered.connectivity, coded.sizes.wedgeCount,
                      [&](std::uint32_t corner) { return coded.sourceWedge(corner); })
        .run();
  }

  /// Calls visit(patch, attribute of its source, patch index) for all patches that have an attribute of the header.
  template <typename Visit> void forEachWith(std::uint32_t attributeIndex, Visit visit) const {
    for (std::size_t i = 0; i < coded_.size(); ++i) {
      const CodedPatch& coded = coded_[i];
      const std::vector<std::uint32_t>& attributeIndices = header_.types[coded.sizes.type].attributes;
      for (std::size_t a = 0; a < attributeIndices.size(); ++a)
        if (attributeIndices[a] == attributeIndex)
          visit(coded, coded.source.attributes[a], i);
    }
  }

  void encodeAttribute(std::uint32_t attributeIndex, std::vector<double>& normalErrors) {
    const AttributeType& type = header_.attributes[attributeIndex];
    if (type.kind == AttributeKind::normal)
      return encodeNormals(attributeIndex, normalErrors);
    forEachWith(attributeIndex, [&](const CodedPatch& coded, const Attribute& source, std::size_t) {
      std::vector<Value> values = coded.valuesOf(source);
      ValueCoder(streams_[streamOfAttribute(attributeIndex)], coded.surface(), type, values).run();
    });
  }

  /// The normals of a patch in coded order.
  struct CodedNormals {
    const CodedPatch& coded;
    std::vector<Value> values;
    NormalTolerance tolerance;
    std::size_t patch;
  };

  void encodeNormals(std::uint32_t attributeIndex, std::vector<double>& normalErrors) {
    AttributeType& type = header_.attributes[attributeIndex];
    std::vector<CodedNormals> all;
    forEachWith(attributeIndex, [&](const CodedPatch& coded, const Attribute& source, std::size_t patch) {
      std::vector<Value> values = coded.valuesOf(source);
      NormalTolerance tolerance = coded.toleranceOf(source, values);
      all.push_back({coded, std::move(values), std::move(tolerance), patch});
    });
    if (effort_ > 0)
      type.mode = bestModeOf(type, all);
    for (CodedNormals& normals : all) {
      double& error = normalErrors[normals.patch];
      if (type.isDerived()) {
        error = std::max(error, derivedError(normals.coded, type, normals.values));
      } else {
        codeNormals(streams_[streamOfAttribute(attributeIndex)], normals.coded.surface(), type, normals.values,
                    normals.tolerance);
        error = std::max(error, octahedronErrorBound(type.bits));
      }
    }
  }

  /// The largest error of derived normals, in radians.
  static double derivedError(const CodedPatch& coded, const AttributeType& type, const std::vector<Value>& values) {
    std::vector<Value> derived = values;
    RangeEncoder nothing(attributeModels::count);
    codeNormals(nothing, coded.surface(), type, derived);
    return largestAngle(values, derived) + octahedronErrorBound(type.bits);
  }

  /// The weighting with the smaller stream or, for derived normals, with the smaller error.
  NormalMode bestModeOf(const AttributeType& given, const std::vector<CodedNormals>& all) const {
    AttributeType other = given;
    other.mode = static_cast<NormalMode>(static_cast<unsigned>(given.mode) ^ 1u);
    const double cost = costOf(all, given);
    if (!given.isDerived() && effort_ < effortOfWholeTrials && cost <= smallSample)
      return given.mode;
    return costOf(all, other) < cost ? other.mode : given.mode;
  }

  /// The cost of a mode: bytes, or radians for derived normals. Lower efforts measure only the first normals.
  double costOf(const std::vector<CodedNormals>& all, const AttributeType& as) const {
    std::uint32_t left = effort_ < effortOfWholeTrials ? sampledNormals : maxCount;
    double error = 0;
    RangeEncoder encoder(attributeModels::count);
    for (const CodedNormals& normals : all) {
      if (normals.coded.source.topology != Topology::triangles || (!as.isDerived() && left == 0))
        continue;
      if (as.isDerived()) {
        error = std::max(error, derivedError(normals.coded, as, normals.values));
      } else {
        std::vector<Value> values = normals.values;
        codeNormals(encoder, normals.coded.surface(), as, values, normals.tolerance, left);
        left -= std::min(left, static_cast<std::uint32_t>(values.size()));
      }
    }
    return as.isDerived() ? error : static_cast<double>(encoder.finish().size());
  }
  static constexpr std::uint32_t sampledNormals = 4096;
  static constexpr double smallSample =
      sampledNormals / 16.0; ///< half a bit per normal: another mode would save little
  static constexpr int effortOfWholeTrials = 7;

  int effort_;
  FileHeader header_;
  StreamEncoders streams_{0, Version::two};
  std::vector<CodedPatch> coded_;
};

} // namespace

EncodedPatches encodePatches(std::span<const CompactPatch> patches, int effort, Version version) {
  std::vector<std::vector<std::uint32_t>> starts;
  std::size_t attempts = 1;
  for (const CompactPatch& patch : patches)
    attempts = std::max(attempts, starts.emplace_back(startsOf(patch, effort)).size());
  EncodedPatches best;
  for (std::size_t attempt = 0; attempt < attempts; ++attempt) {
    const auto firstTriangleOf = [&](std::size_t i) { return attempt < starts[i].size() ? starts[i][attempt] : 0; };
    EncodedPatches encoded = FileEncoder(patches, effort, version, firstTriangleOf).run();
    if (attempt == 0 || encoded.bytes.size() < best.bytes.size())
      best = std::move(encoded);
  }
  return best;
}

} // namespace imgeo::compact
