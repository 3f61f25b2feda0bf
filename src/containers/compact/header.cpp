#include "containers/compact/header.h"

#include "base/error.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace imgeo::compact {

namespace {

constexpr std::uint8_t signature[] = {'I', 'G', 'C', 1};
constexpr std::uint8_t gridFlag = 1, partsFlag = 2;

/// Takes numbers off a payload.
class FieldReader {
public:
  FieldReader(ByteSpan bytes, std::size_t at, const std::string& place)
      : bytes_(bytes), at_(at), place_(place) {}

  template <typename T> T take() {
    if (at_ > bytes_.size() || bytes_.size() - at_ < sizeof(T))
      throw Error(ErrorKind::truncated, place_, "the image ends before the patch does");
    at_ += sizeof(T);
    return loadLittle<T>(&bytes_[at_ - sizeof(T)]);
  }
  std::uint8_t takeByte(std::uint32_t least, std::uint32_t most, const char* what) {
    const auto value = take<std::uint8_t>();
    require(value >= least && value <= most, what);
    return value;
  }
  /// A count of at most maxPatchCount.
  std::uint32_t takeCount(std::uint64_t least, std::uint64_t most, const char* what) {
    const auto value = take<std::uint32_t>();
    if (value > maxPatchCount)
      throw Error(ErrorKind::limit, place_,
                  "a patch has at most " + std::to_string(maxPatchCount) + " " + what);
    require(value >= least && value <= most, what);
    return value;
  }
  void require(bool condition, const char* what) const {
    if (!condition)
      throw Error(ErrorKind::malformed, place_, std::string("the patch's header states impossible ") + what);
  }
  std::size_t at() const { return at_; }

private:
  ByteSpan bytes_;
  std::size_t at_;
  const std::string& place_;
};

AttributeType takeAttribute(FieldReader& reader) {
  struct Range {
    std::uint32_t leastComponents, mostComponents, leastBits, mostBits, mostMode;
  };
  static constexpr Range ranges[] = {{3, 3, 4, 16, 3}, {2, 2, 1, 16, 0}, {3, 4, 1, 16, 0}, {1, 4, 1, 24, 0}};
  AttributeType type;
  const std::uint8_t kind = reader.takeByte(0, 3, "attributes");
  const Range& range = ranges[kind];
  type.kind = static_cast<AttributeKind>(kind);
  type.components = reader.takeByte(range.leastComponents, range.mostComponents, "attributes");
  type.bits = reader.takeByte(range.leastBits, range.mostBits, "attributes");
  type.mode = static_cast<NormalMode>(reader.takeByte(0, range.mostMode, "attributes"));
  return type;
}

Grid takeGrid(FieldReader& reader) {
  Grid grid;
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = reader.take<std::uint32_t>();
    grid.step[axis] = reader.take<std::uint32_t>();
    reader.require(grid.step[axis] >= 2 * 65536 && grid.origin[axis] < grid.step[axis], "grid lines");
  }
  return grid;
}

} // namespace

void appendHeader(Bytes& out, const Header& header) {
  assert(header.streamLengths.size() == header.streamCount());
  out.insert(out.end(), std::begin(signature), std::end(signature));
  out.push_back(static_cast<std::uint8_t>(header.topology));
  out.push_back(static_cast<std::uint8_t>(header.positionBits));
  out.push_back(static_cast<std::uint8_t>(header.normalShift));
  out.push_back(
      static_cast<std::uint8_t>((header.grid ? gridFlag : 0) | (header.hasParts() ? partsFlag : 0)));
  appendLittle(out, header.vertexCount);
  appendLittle(out, header.wedgeCount);
  appendLittle(out, header.elementCount);
  appendLittle(out, static_cast<std::uint32_t>(header.attributes.size()));
  for (const AttributeType& type : header.attributes)
    out.insert(out.end(), {static_cast<std::uint8_t>(type.kind), type.components, type.bits,
                           static_cast<std::uint8_t>(type.mode)});
  for (int axis = 0; axis < 3 && header.grid; ++axis) {
    appendLittle(out, header.grid->origin[axis]);
    appendLittle(out, header.grid->step[axis]);
  }
  if (header.hasParts()) {
    appendLittle(out, header.partCount);
    appendLittle(out, header.residualShift);
  }
  for (const std::uint32_t length : header.streamLengths)
    appendLittle(out, length);
}

PlacedHeader readHeader(ByteSpan payload, std::size_t first, const std::string& place) {
  FieldReader reader(payload, first, place);
  std::uint8_t begin[4];
  for (std::uint8_t& byte : begin)
    byte = reader.take<std::uint8_t>();
  if (!std::equal(begin, begin + 3, signature))
    throw Error(ErrorKind::malformed, place, "no patch of compact begins here");
  if (begin[3] != signature[3])
    throw Error(ErrorKind::unsupported, place,
                "compact of version " + std::to_string(begin[3]) + " is not known");

  Header header;
  header.topology = static_cast<Topology>(reader.takeByte(1, 3, "elements"));
  header.positionBits = reader.takeByte(1, 30, "position bits");
  header.normalShift = reader.takeByte(0, 30, "normals");
  const std::uint8_t flags = reader.takeByte(0, gridFlag | partsFlag, "flags");
  const std::uint64_t corners = cornersPerElement(header.topology);
  header.vertexCount = reader.takeCount(1, maxPatchCount, "vertices");
  header.wedgeCount = reader.takeCount(header.vertexCount, maxPatchCount, "wedges");
  header.elementCount =
      reader.takeCount((header.wedgeCount + corners - 1) / corners, maxPatchCount, "elements");
  if (header.topology == Topology::points)
    reader.require(header.wedgeCount == header.vertexCount && header.elementCount == header.vertexCount,
                   "points");
  const auto attributeCount = reader.take<std::uint32_t>();
  reader.require(attributeCount <= maxAttributes, "attributes");
  for (std::uint32_t i = 0; i < attributeCount; ++i)
    header.attributes.push_back(takeAttribute(reader));
  if (flags & gridFlag) {
    reader.require(header.positionBits <= 16, "grid lines");
    header.grid = takeGrid(reader);
  }
  if (flags & partsFlag) {
    reader.require(header.topology == Topology::triangles, "parts");
    header.partCount = reader.takeCount(1, header.elementCount, "parts");
    header.residualShift = reader.take<std::uint32_t>();
    reader.require(header.residualShift < header.positionBits, "parts");
  }
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < header.streamCount(); ++i) {
    header.streamLengths.push_back(reader.take<std::uint32_t>());
    total += header.streamLengths.back();
  }
  if (total > payload.size() - reader.at())
    throw Error(ErrorKind::truncated, place, "the image ends before the patch does");
  return {header, reader.at()};
}

} // namespace imgeo::compact
