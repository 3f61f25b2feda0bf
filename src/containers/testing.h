#pragma once
// Patches for tests of containers and documents.

#include "base/error.h"
#include "containers/container_reader.h"
#include "scene/testing.h"

#include <cmath>
#include <map>
#include <string>

namespace imgeo::testing {

/// A mesh on the lattice of its box, as one patch of unsplit wedges.
inline PatchedMesh onePatch(const Mesh& mesh, std::uint32_t bits) {
  PatchedMesh patched;
  const Box3d box = boxOf(mesh);
  patched.lattice.origin = box.min;
  patched.lattice.bits = bits;
  if (box.longestEdge() > 0)
    patched.lattice.step = box.longestEdge() / patched.lattice.maximum();
  Patch patch{mesh, mesh.topology, {}, mesh.wedgePositions, mesh.corners};
  for (const Vec3f& position : mesh.positions) {
    const Vec3d steps = (Vec3d(position) - box.min) * (1 / patched.lattice.step);
    const auto nearest = [](double value) { return static_cast<std::uint32_t>(std::llround(value)); };
    patch.positions.push_back({nearest(steps.x), nearest(steps.y), nearest(steps.z)});
    patched.box.add(patched.lattice.point(patch.positions.back()));
  }
  patched.patches.push_back(std::move(patch));
  return patched;
}

/// A patch's wedges as vertices, drawn by its corners (`indexed`) or in order, as `primitive`.
inline IndexedPatch verticesOf(const Patch& patch, Primitive primitive, bool indexed) {
  IndexedPatch vertices;
  for (const std::uint32_t position : patch.wedgePositions)
    vertices.positions.push_back(patch.positions[position]);
  static_cast<VertexAttributes&>(vertices) = patch;
  if (indexed)
    vertices.indices = patch.corners;
  const std::size_t count = indexed ? vertices.indices.size() : vertices.positions.size();
  vertices.draws = {{primitive, static_cast<std::uint32_t>(count)}};
  return vertices;
}

/// The description of a patch whose files have their indices as urls.
inline PatchDescription describedByIndex(const EncodedPatch& encoded) {
  std::vector<std::string> urls;
  for (std::size_t i = 0; i < encoded.files.size(); ++i)
    urls.push_back(std::to_string(i));
  return describeWithUrls(encoded, urls);
}

/// The files of an encoded patch by the urls of describedByIndex.
inline FetchFile filesOf(const EncodedPatch& encoded) {
  return [&encoded](const std::string& url) {
    std::size_t i = encoded.files.size();
    if (!url.empty() && url.size() < 6 && url.find_first_not_of("0123456789") == std::string::npos)
      i = std::stoul(url);
    if (i >= encoded.files.size())
      throw Error(ErrorKind::io, url, "no such file");
    return encoded.files[i].bytes;
  };
}

} // namespace imgeo::testing
