#pragma once
// A writer of binary STL for tests.

#include "base/bytes.h"
#include "scene/mesh.h"

#include <string>

namespace imgeo::testing {

/// The triangles of a mesh, without normals. `header`: filled up to 80 bytes with spaces.
inline Bytes binaryStl(const Mesh& mesh, std::string header = "") {
  header.resize(80, ' ');
  Bytes bytes(header.begin(), header.end());
  appendLittle(bytes, static_cast<std::uint32_t>(mesh.elementCount()));
  for (std::size_t at = 0; at < mesh.corners.size(); at += 3) {
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(bytes, 0.0f);
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(bytes, mesh.cornerPosition(at + k)[axis]);
    appendLittle(bytes, std::uint16_t{0});
  }
  return bytes;
}

} // namespace imgeo::testing
