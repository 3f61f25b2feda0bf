#pragma once
// Makes the description and the files of a patch from fuzz input, and checks what container readers return for them. A
// failed check aborts the process.

#include "base/error.h"
#include "containers/container_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

namespace imgeo::fuzz {

inline void require(bool condition) {
  if (!condition)
    std::abort();
}

/// Reads values from the front of the input; 0 after its end.
class InputReader {
public:
  explicit InputReader(ByteSpan bytes) : bytes_(bytes) {}

  /// A big-endian number of `count` bits, a multiple of 8.
  std::uint32_t bits(std::uint32_t count) {
    std::uint32_t value = 0;
    for (const std::uint8_t byte : take(count / 8))
      value = value << 8 | byte;
    return value;
  }
  ByteSpan take(std::size_t count) {
    const ByteSpan taken = bytes_.first(std::min(count, bytes_.size()));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }
  ByteSpan rest() { return take(bytes_.size()); }

private:
  ByteSpan bytes_;
};

/// A patch of one to three draws whose files are named "0", "1" ... in the order index, `coords` files of coordinates,
/// normal, texCoord, color. Bits of the input decide which files other than coordinates exist.
inline PatchDescription readDescription(InputReader& input, Encoding encoding, std::size_t coords) {
  PatchDescription patch;
  const std::uint32_t present = input.bits(8);
  patch.vertexCount = present & 16 ? input.bits(32) : input.bits(16);
  for (std::uint32_t draws = 1 + present / 32 % 3; draws > 0; --draws)
    patch.draws.push_back({static_cast<Primitive>(input.bits(8) % 4), present & 16 ? input.bits(32) : input.bits(8)});
  patch.implicitMeshSize = {input.bits(8), 1};
  std::size_t file = 0;
  const auto reference = [&] {
    const std::uint32_t small = input.bits(8);
    ByteLocation location{small & 15, small / 16};
    if (small == 255)
      location = {input.bits(32), input.bits(32)};
    const std::string url = std::to_string(file++);
    return encoding == Encoding::bg ? Reference{url, location} : Reference{url, TexelLocation{location.byteOffset}};
  };
  if (present & 1)
    patch.index = reference();
  for (std::size_t i = 0; i < coords; ++i)
    patch.coord.push_back(reference());
  for (const VertexRole role : vertexRoles)
    if (present >> (1 + static_cast<unsigned>(role)) & 1)
      patch.vertexAttributes[role] = reference();
  return patch;
}

/// Decodes a patch and checks that it is consistent, or that the Error has a message. Returns 0, as fuzz targets do.
inline int decodeOrRefuse(const PatchDescription& patch, const GeometryDescription& geometry,
                          const std::map<std::string, Bytes>& files) {
  const FetchFile fetch = [&](const std::string& url) {
    const auto found = files.find(url);
    if (found == files.end())
      throw Error(ErrorKind::io, url, "no such file");
    return found->second;
  };
  try {
    const IndexedPatch decoded = decodePatch(patch, geometry, fetch);
    const std::size_t count = decoded.vertexCount();
    require(count > 0 && decoded.indices.empty() == !patch.index);
    std::uint64_t drawn = 0;
    for (const Draw& draw : decoded.draws)
      drawn += draw.count;
    require(patch.index ? drawn == decoded.indices.size() : drawn <= count);
    for (const std::uint32_t index : decoded.indices)
      require(index < count);
    for (const Vec3u& position : decoded.positions)
      require(std::max({position.x, position.y, position.z}) <= geometry.lattice.maximum());
    require(isConsistent(decoded, count));
    for (const Vec3f& normal : decoded.normals)
      require(std::abs(length(Vec3d(normal)) - 1) < 1e-5);
  } catch (const Error& error) {
    require(!error.message().empty());
  }
  return 0;
}

} // namespace imgeo::fuzz
