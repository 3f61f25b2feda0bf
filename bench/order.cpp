// Compares orders of triangles and vertices: bytes of each image, indices a triangle and time, for fan order, triangle
// strips and the order of the source; also a lower bound for the number of indices of strips. Checks first that each
// order draws the source's triangles.
//
//   build/bench/order [--effort 0..9] MODEL...

#include "base/error.h"
#include "bench/models.h"
#include "containers/container_reader.h"
#include "prepare/half_edges.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <string>

namespace imgeo {
namespace {

struct Order {
  const char* name;
  std::function<IndexedPatch(const Patch&)> arrange;
};

/// A patch in the order of the source.
IndexedPatch asInSource(const Patch& patch) {
  IndexedPatch result;
  static_cast<VertexAttributes&>(result) = patch;
  result.positions = gather(patch.positions, patch.wedgePositions);
  result.indices = patch.corners;
  result.draws = {{Primitive::triangles, static_cast<std::uint32_t>(patch.corners.size())}};
  return result;
}

/// The triangles as the lattice points of their corners, each rotated to the lexicographically smallest sequence (two
/// corners may share a point), and sorted.
std::vector<std::array<std::uint32_t, 9>> drawnTriangles(const IndexedPatch& patch) {
  std::vector<std::array<std::uint32_t, 9>> triangles;
  for (const Vec3u& t : trianglesOf(patch)) {
    const Vec3u a = patch.positions[t.x], b = patch.positions[t.y], c = patch.positions[t.z];
    const auto from = [](Vec3u p, Vec3u q, Vec3u r) { return std::array{p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z}; };
    triangles.push_back(std::min({from(a, b, c), from(b, c, a), from(c, a, b)}));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// A lower bound for the number of indices of strips over a patch: an index serves at most three triangles, which
/// follow one another around its vertex, so a fan of n triangles needs its centre n / 3 times.
std::size_t minStripIndices(const Patch& patch) {
  const std::vector<std::uint32_t> opposites = oppositeHalfEdges(patch.corners);
  std::vector<bool> isSeen(patch.corners.size());
  std::size_t minimum = 0;
  for (std::uint32_t corner = 0; corner < patch.corners.size(); ++corner) {
    const std::uint32_t* triangle = &patch.corners[corner - corner % 3];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    std::uint32_t first = corner, size = 0;
    while (opposites[first] != noHalfEdge && nextHalfEdge(opposites[first]) != corner)
      first = nextHalfEdge(opposites[first]);
    for (std::uint32_t at = first; at != noHalfEdge && !isSeen[at]; at = opposites[previousHalfEdge(at)]) {
      isSeen[at] = true;
      ++size;
    }
    minimum += (size + 2) / 3;
  }
  return minimum;
}

struct Measured {
  double seconds = 0; ///< of processor time
  std::size_t indices = 0;
  bench::ImageBytes bytes;
};

Measured measure(const PatchedMesh& mesh, const Order& order, const EncodeOptions& options) {
  Measured measured;
  const GeometryDescription geometry = describe(mesh, options);
  for (const Patch& patch : mesh.patches) {
    const std::clock_t start = std::clock();
    const IndexedPatch arranged = order.arrange(patch);
    measured.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (drawnTriangles(arranged) != drawnTriangles(asInSource(patch)))
      throw Error(ErrorKind::malformed, order.name, "draws other triangles than the source has");
    measured.indices += arranged.indices.size();
    measured.bytes.add(encodePatch(arranged, geometry, options));
  }
  return measured;
}

void printTable(const std::string& path, const EncodeOptions& options) {
  const auto strips = [&](const Patch& patch) { return asStrips(patch, options.effort); };
  const Order orders[] = {{"source", asInSource}, {"strips", strips}, {"fans", asTriangles}};
  bench::visitSurfaces(path, [&](const Mesh& mesh) {
    const double triangles = static_cast<double>(mesh.elementCount());
    const PatchedMesh patches = bench::patchesOf(mesh);
    fmt::print("\n{}: {} triangles, {} vertices, {} patches\n\n", path, mesh.elementCount(), mesh.wedgeCount(),
               patches.patches.size());
    fmt::print("| order | s | indices/triangle | index | coord high | coord low | normal and other | all | "
               "bytes/triangle |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const Order& order : orders) {
      const Measured m = measure(patches, order, options);
      const bench::ImageBytes& bytes = m.bytes;
      fmt::print("| {} | {:.2f} | {:.3f} | {} | {} | {} | {} | {} | {:.3f} |\n", order.name, m.seconds,
                 static_cast<double>(m.indices) / triangles, bytes.index, bytes.high, bytes.low, bytes.other,
                 bytes.all(), static_cast<double>(bytes.all()) / triangles);
      std::fflush(stdout);
    }
    std::size_t minimum = 0;
    for (const Patch& patch : patches.patches)
      minimum += minStripIndices(patch);
    fmt::print("\nNo strips have fewer than {:.3f} indices a triangle.\n", static_cast<double>(minimum) / triangles);
  });
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  using namespace imgeo;
  return bench::run([&] {
    const bench::ModelArguments arguments = bench::modelArguments(count, words, "order", 8);
    EncodeOptions options;
    options.effort = arguments.effort;
    fmt::print("SIG classic, 16-bit positions, 8-bit normals, PNG effort {}; s: processor time to arrange\n",
               options.effort);
    for (const std::string& model : arguments.models)
      printTable(model, options);
  });
}
