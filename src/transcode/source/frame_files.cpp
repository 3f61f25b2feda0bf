#include "transcode/source/frame_files.h"

#include "base/error.h"
#include "transcode/source/preparation.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace imgeo {

namespace {

/// Triangles of the largest polygon whose cuts are compared.
constexpr std::size_t maxPolygonTriangles = 64;

/// The number of triangles from corner `at` on that cover the same vertices in both meshes, as those of a polygon that
/// was cut in another way; 0: there are none.
std::size_t trianglesOfPolygon(const Mesh& a, const Mesh& b, std::size_t at) {
  std::set<std::uint32_t> inA, inB;
  const std::size_t last = std::min(a.corners.size(), at + 3 * maxPolygonTriangles);
  for (std::size_t corner = at; corner + 3 <= last; corner += 3) {
    inA.insert(a.corners.begin() + static_cast<std::ptrdiff_t>(corner),
               a.corners.begin() + static_cast<std::ptrdiff_t>(corner + 3));
    inB.insert(b.corners.begin() + static_cast<std::ptrdiff_t>(corner),
               b.corners.begin() + static_cast<std::ptrdiff_t>(corner + 3));
    if (inA == inB)
      return (corner - at) / 3 + 1;
  }
  return 0;
}

/// Whether two meshes of as many corners have the same elements. Where polygons are cut into triangles depends on their
/// shape, which changes from frame to frame.
bool haveSameElements(const Mesh& a, const Mesh& b) {
  if (a.corners == b.corners)
    return true;
  if (a.topology != Topology::triangles)
    return false;
  for (std::size_t corner = 0; corner < a.corners.size();) {
    const std::size_t count = trianglesOfPolygon(a, b, corner);
    if (count == 0)
      return false;
    corner += 3 * count;
  }
  return true;
}

/// What differs between the meshes of two frames; empty: nothing that must not.
std::string differenceOf(const Mesh& first, const Mesh& mesh) {
  if (mesh.topology != first.topology)
    return "has other elements";
  if (mesh.wedgeCount() != first.wedgeCount())
    return fmt::format("has {} vertices instead of {}", mesh.wedgeCount(), first.wedgeCount());
  if (mesh.corners.size() != first.corners.size())
    return fmt::format("has {} {} instead of {}", mesh.elementCount(), nameOf(mesh.topology), first.elementCount());
  if (!haveSameElements(first, mesh) || mesh.wedgePositions != first.wedgePositions)
    return fmt::format("joins its vertices to other {}", nameOf(mesh.topology));
  if (mesh.texCoords != first.texCoords)
    return "has other texture coordinates";
  if (mesh.normals.empty() != first.normals.empty())
    return first.normals.empty() ? "has normals" : "has no normals";
  if (mesh.colors.empty() != first.colors.empty())
    return first.colors.empty() ? "has colours" : "has no colours";
  const auto isSame = [](const NamedAttribute& a, const NamedAttribute& b) {
    return a.name == b.name && a.components == b.components;
  };
  if (!std::ranges::equal(mesh.namedAttributes, first.namedAttributes, isSame))
    return "has other further attributes";
  return "";
}

/// The only mesh of a scene.
const Mesh& onlyMesh(const Scene& scene, const std::string& file) {
  if (scene.meshes.size() != 1 || shapeNodes(scene.graph).size() != 1)
    throw Error(ErrorKind::unsupported, file,
                fmt::format("holds {} meshes; a frame of a sequence is one", scene.meshes.size()));
  return scene.meshes.front();
}

} // namespace

FrameFiles::FrameFiles(std::vector<std::filesystem::path> files, const Scene& first, ImportOptions options)
    : files_(std::move(files)), first_(onlyMesh(first, files_.front().string())), options_(std::move(options)) {
  options_.strict = true;
}

Mesh FrameFiles::read(std::size_t frame) const {
  const std::filesystem::path& file = files_.at(frame);
  std::uint64_t bytes = 0;
  Imported imported = importInput(file, options_, bytes);
  onlyMesh(imported.scene, file.string());
  Mesh mesh = std::move(imported.scene.meshes.front());
  if (const std::string difference = differenceOf(first_, mesh); !difference.empty())
    throw Error(ErrorKind::malformed, file.string(),
                fmt::format("{}, unlike {}: frames of a sequence differ in positions, normals, colours and values only",
                            difference, files_.front().string()));
  return mesh;
}

std::uint64_t FrameFiles::bytes() const {
  std::uint64_t sum = 0;
  for (const std::filesystem::path& file : files_) {
    std::error_code fault; // read() reports a file that is not there
    const std::uintmax_t size = std::filesystem::file_size(file, fault);
    sum += fault ? 0 : size;
  }
  return sum;
}

} // namespace imgeo
