#include "containers/compact/header.h"

#include "base/error.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace imgeo::compact {

namespace {

constexpr std::uint8_t signature[] = {'I', 'G', 'C'};
constexpr std::uint8_t baseFlag = 1; // in the flags of a patch type

/// Reads the fields of a header.
class FieldReader {
public:
  FieldReader(ByteSpan bytes, const std::string& location) : bytes_(bytes), location_(location) {}

  std::uint8_t takeByte() {
    if (byteOffset_ == bytes_.size())
      throw Error(ErrorKind::truncated, location_, "the image ends before its header does");
    return bytes_[byteOffset_++];
  }
  std::uint8_t takeByte(std::uint32_t min, std::uint32_t max, const char* what) {
    const std::uint8_t value = takeByte();
    require(value >= min && value <= max, what);
    return value;
  }
  /// Reads a number below 2^28, stored as seven bits per byte, the least significant bits first.
  std::uint32_t takeNumber() {
    std::uint32_t value = 0;
    for (std::uint32_t shift = 0; shift < 28; shift += 7) {
      const std::uint8_t byte = takeByte();
      value |= (byte & 127u) << shift;
      if (byte < 128)
        return value;
    }
    throw Error(ErrorKind::malformed, location_, "the header states a number that is too long");
  }
  /// Reads a number of things. Throws Error{limit} if it is above `max`; `what` names the things.
  std::uint32_t takeCount(std::uint32_t max, const char* what) {
    const std::uint32_t value = takeNumber();
    if (value > max)
      throw Error(ErrorKind::limit, location_, "a file has at most " + std::to_string(max) + " " + what);
    return value;
  }
  void require(bool condition, const char* what) const {
    if (!condition)
      throw Error(ErrorKind::malformed, location_, std::string("the header states impossible ") + what);
  }
  std::size_t byteOffset() const { return byteOffset_; }

private:
  ByteSpan bytes_;
  std::size_t byteOffset_ = 0;
  const std::string& location_;
};

void appendNumber(Bytes& out, std::uint32_t value) {
  assert(value < 1u << 28);
  for (; value >= 128; value >>= 7)
    out.push_back(static_cast<std::uint8_t>(value | 128));
  out.push_back(static_cast<std::uint8_t>(value));
}

/// Reads the signature, the version and, from version 2 on, the features, of which there are none yet.
Version takeVersion(FieldReader& reader, const std::string& location) {
  std::uint8_t begin[4];
  for (std::uint8_t& byte : begin)
    byte = reader.takeByte();
  if (!std::equal(std::begin(signature), std::end(signature), begin))
    throw Error(ErrorKind::malformed, location, "is no image of compact");
  const std::uint8_t version = begin[3];
  if (version < 1 || version > 2)
    throw Error(ErrorKind::unsupported, location, "compact of version " + std::to_string(version) + " is not known");
  if (version == 2 && reader.takeByte() != 0)
    throw Error(ErrorKind::unsupported, location, "has features of compact that are not known");
  return static_cast<Version>(version);
}

AttributeType takeAttribute(FieldReader& reader) {
  struct Range {
    std::uint32_t minComponents, maxComponents, minBits, maxBits, maxMode;
  };
  // By AttributeKind.
  static constexpr Range ranges[] = {{3, 3, 4, 16, 3}, {2, 2, 1, 16, 0}, {3, 4, 1, 16, 0}, {1, 4, 1, 24, 0}};
  AttributeType type;
  const std::uint8_t kind = reader.takeByte(0, 3, "attributes");
  const Range& range = ranges[kind];
  type.kind = static_cast<AttributeKind>(kind);
  type.components = reader.takeByte(range.minComponents, range.maxComponents, "attributes");
  type.bits = reader.takeByte(range.minBits, range.maxBits, "attributes");
  type.mode = static_cast<NormalMode>(reader.takeByte(0, range.maxMode, "attributes"));
  return type;
}

PatchType takeType(FieldReader& reader, std::size_t attributeCount) {
  PatchType type;
  type.topology = static_cast<Topology>(reader.takeByte(1, 3, "elements"));
  type.positionBits = reader.takeByte(minPositionBits, maxPositionBits, "position bits");
  type.isBase = reader.takeByte(0, baseFlag, "flags") == baseFlag;
  reader.require(!type.isBase || type.topology == Topology::triangles, "segments");
  const std::uint8_t count = reader.takeByte(0, maxAttributes, "attributes");
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint8_t attribute = reader.takeByte();
    const bool isNew = std::ranges::find(type.attributes, attribute) == type.attributes.end();
    reader.require(attribute < attributeCount && isNew, "attributes");
    type.attributes.push_back(attribute);
  }
  return type;
}

} // namespace

void appendHeader(Bytes& out, const FileHeader& header) {
  assert(header.streamLengths.size() == header.streamCount() && header.attributes.size() <= maxFileAttributes &&
         header.types.size() <= maxFileTypes && header.patchCount <= maxFilePatches);
  out.insert(out.end(), std::begin(signature), std::end(signature));
  out.push_back(static_cast<std::uint8_t>(header.version));
  if (header.version != Version::one)
    out.push_back(0); // no features
  appendNumber(out, static_cast<std::uint32_t>(header.attributes.size()));
  for (const AttributeType& type : header.attributes)
    out.insert(out.end(), {static_cast<std::uint8_t>(type.kind), type.components, type.bits,
                           static_cast<std::uint8_t>(type.mode)});
  appendNumber(out, static_cast<std::uint32_t>(header.types.size()));
  for (const PatchType& type : header.types) {
    out.insert(out.end(),
               {static_cast<std::uint8_t>(type.topology), static_cast<std::uint8_t>(type.positionBits),
                type.isBase ? baseFlag : std::uint8_t{0}, static_cast<std::uint8_t>(type.attributes.size())});
    for (const std::uint32_t attribute : type.attributes)
      out.push_back(static_cast<std::uint8_t>(attribute));
  }
  appendNumber(out, header.patchCount);
  for (const std::uint32_t length : header.streamLengths)
    appendNumber(out, length);
}

ParsedHeader readHeader(ByteSpan payload, const std::string& location) {
  FieldReader reader(payload, location);
  FileHeader header;
  header.version = takeVersion(reader, location);
  const std::uint32_t attributeCount = reader.takeCount(maxFileAttributes, "attributes");
  for (std::uint32_t i = 0; i < attributeCount; ++i)
    header.attributes.push_back(takeAttribute(reader));
  const std::uint32_t typeCount = reader.takeCount(maxFileTypes, "types of patches");
  for (std::uint32_t i = 0; i < typeCount; ++i)
    header.types.push_back(takeType(reader, header.attributes.size()));
  for (const PatchType& type : header.types)
    reader.require(type.isBase == header.types[0].isBase, "bases beside patches");
  header.patchCount = reader.takeCount(maxFilePatches, "patches");
  reader.require(header.patchCount > 0, "patches");
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < header.streamCount(); ++i) {
    header.streamLengths.push_back(reader.takeNumber());
    total += header.streamLengths.back();
  }
  if (total > payload.size() - reader.byteOffset())
    throw Error(ErrorKind::truncated, location, "the image ends before its streams do");
  return {std::move(header), reader.byteOffset()};
}

} // namespace imgeo::compact
