// What the order of triangles and vertices costs and gains: bytes of each image,
// indices a triangle and time, for fan order, for stitched strips and for the order
// of the source. Checks first that each draws the source's triangles.
//
//   build/bench/order [--effort 0..9] MODEL...

#include "base/error.h"
#include "containers/container.h"
#include "import/import.h"
#include "prepare/normals.h"
#include "prepare/weld.h"

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

/// A patch as it came: triangles and wedges in the order of the source.
IndexedPatch asInSource(const Patch& patch) {
  IndexedPatch result;
  for (const std::uint32_t position : patch.wedgePositions)
    result.positions.push_back(patch.positions[position]);
  result.normals = patch.normals;
  result.texCoords = patch.texCoords;
  result.colors = patch.colors;
  result.colorComponents = patch.colorComponents;
  result.indices = patch.corners;
  result.draws = {{Primitive::triangles, static_cast<std::uint32_t>(patch.corners.size())}};
  return result;
}

/// The triangles by the lattice points of their corners, turned so that the
/// least sequence comes first (two corners may share a point), and sorted.
std::vector<std::array<std::uint32_t, 9>> drawnTriangles(const IndexedPatch& patch) {
  std::vector<std::array<std::uint32_t, 9>> triangles;
  for (const Vec3u& t : trianglesOf(patch)) {
    const Vec3u a = patch.positions[t.x], b = patch.positions[t.y], c = patch.positions[t.z];
    const auto from = [](Vec3u p, Vec3u q, Vec3u r) {
      return std::array{p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z};
    };
    triangles.push_back(std::min({from(a, b, c), from(b, c, a), from(c, a, b)}));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct Measured {
  double seconds = 0; ///< of processor time
  std::size_t indices = 0, index = 0, high = 0, low = 0, other = 0;
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
    bool isHigh = true;
    for (const EncodedFile& file : encodePatch(arranged, geometry, options).files) {
      const bool isCoord = file.role == Role::coord;
      (file.role == Role::index ? measured.index
       : !isCoord               ? measured.other
       : isHigh                 ? measured.high
                                : measured.low) += file.bytes.size();
      if (isCoord)
        isHigh = false;
    }
  }
  return measured;
}

void printTable(const std::string& path, const EncodeOptions& options) {
  const Order orders[] = {{"source", asInSource}, {"strips", asStrips}, {"fans", asTriangles}};
  for (Mesh& mesh : importFile(path).scene.meshes) {
    if (mesh.topology != Topology::triangles)
      continue;
    weld(mesh);
    if (mesh.normals.empty()) {
      computeNormals(mesh, NormalWeighting::area);
      weld(mesh);
    }
    const double triangles = static_cast<double>(mesh.elementCount());
    const PatchedMesh patches = cutIntoPatches(mesh, latticeFor(boxOf(mesh), 16), 65535);
    fmt::print("\n{}: {} triangles, {} vertices, {} patches\n\n", path, mesh.elementCount(),
               mesh.wedgeCount(), patches.patches.size());
    fmt::print("| order | s | indices/triangle | index | coord high | coord low | normal and other | all | "
               "bytes/triangle |\n|---|---|---|---|---|---|---|---|---|\n");
    for (const Order& order : orders) {
      const Measured m = measure(patches, order, options);
      const std::size_t all = m.index + m.high + m.low + m.other;
      fmt::print("| {} | {:.2f} | {:.3f} | {} | {} | {} | {} | {} | {:.3f} |\n", order.name, m.seconds,
                 static_cast<double>(m.indices) / triangles, m.index, m.high, m.low, m.other, all,
                 static_cast<double>(all) / triangles);
      std::fflush(stdout);
    }
  }
}

int run(const std::vector<std::string>& arguments) {
  EncodeOptions options;
  options.effort = 8;
  std::vector<std::string> models;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] != "--effort") {
      models.push_back(arguments[i]);
      continue;
    }
    const std::string& value = i + 1 < arguments.size() ? arguments[++i] : std::string();
    if (value.size() != 1 || value[0] < '0' || value[0] > '9')
      throw Error(ErrorKind::usage, "--effort", "takes a digit");
    options.effort = value[0] - '0';
  }
  if (models.empty())
    throw Error(ErrorKind::usage, "", "usage: order [--effort 0..9] MODEL...");
  fmt::print("SIG classic, 16-bit positions, 8-bit normals, PNG effort {}; s: processor time to arrange\n",
             options.effort);
  for (const std::string& model : models)
    printTable(model, options);
  return 0;
}

} // namespace
} // namespace imgeo

int main(int argc, char** argv) {
  try {
    return imgeo::run({argv + 1, argv + argc});
  } catch (const imgeo::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return imgeo::exitCode(error.kind());
  }
}
