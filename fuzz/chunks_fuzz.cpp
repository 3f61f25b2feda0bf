// The first byte is the number of faces, facets or points of a piece; the others are a PLY, STL, OBJ, GLB, LAS, E57,
// PTS or XYZ file.
#include "base/error.h"
#include "import/chunks/chunked_source.h"
#include "import/e57/e57.h"
#include "import/import.h"

#include "e57_checksums.h"
#include "require.h"

#include <fmt/format.h>
#include <map>
#include <sys/mman.h>
#include <unistd.h>

namespace imgeo::fuzz {

/// A file that is not on disk, under a name by whose extension PTS and XYZ are known.
class MemoryFile {
public:
  explicit MemoryFile(ByteSpan bytes)
      : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)),
        path_(std::filesystem::temp_directory_path() / fmt::format("imgeo-fuzz-{}.pts", getpid())) {
    require(descriptor_ >= 0 && write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    std::filesystem::remove(path_);
    std::filesystem::create_symlink(fmt::format("/proc/self/fd/{}", descriptor_), path_);
  }
  ~MemoryFile() {
    std::filesystem::remove(path_);
    close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return path_; }

private:
  int descriptor_;
  std::filesystem::path path_;
};

/// The positions of corners and, of points, all other values.
struct Content {
  std::vector<Vec3f> corners;
  std::vector<Rgba> colors;
  std::map<std::string, std::vector<float>> values;
  friend bool operator==(const Content&, const Content&) = default;

  void append(const Mesh& mesh) {
    require(isConsistent(mesh));
    if (mesh.topology != Topology::triangles && mesh.topology != Topology::points)
      return;
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
      corners.push_back(mesh.cornerPosition(corner));
      require(isFinite(corners.back()));
    }
    if (mesh.topology == Topology::triangles || mesh.corners.empty())
      return;
    colors.insert(colors.end(), mesh.colors.begin(), mesh.colors.end());
    for (const NamedAttribute& attribute : mesh.namedAttributes) {
      std::vector<float>& to = values[attribute.name];
      to.insert(to.end(), attribute.values.begin(), attribute.values.end());
    }
  }
};

/// Requires that the pieces of a file are refused or have the triangles or points of the whole, mesh by mesh.
void readInPieces(const std::string& path, std::uint64_t chunkRecords) {
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  std::vector<Content> pieces;
  std::vector<Topology> topologies;
  try {
    const auto source = ChunkedSource::open(path, std::filesystem::temp_directory_path(), chunkRecords);
    const Imported scene = source->readScene({}, options);
    require(scene.scene.meshes.size() == source->meshCount());
    for (std::size_t i = 0; i < source->meshCount(); ++i) {
      const ChunkedMesh mesh = source->mesh(i);
      topologies.push_back(mesh.topology());
      pieces.emplace_back();
      for (std::size_t chunk = 0; chunk < mesh.chunkCount(); ++chunk) {
        const Imported read = mesh.read(chunk, options);
        const Mesh& piece = read.scene.meshes.at(0);
        require(piece.topology != mesh.topology() || piece.elementCount() == mesh.elementsOf(chunk));
        if (piece.topology == mesh.topology()) // otherwise no face has three corners
          pieces.back().append(piece);
      }
    }
  } catch (const Error& error) {
    require(!error.message().empty() && error.location().starts_with(path));
    return;
  }
  Imported imported;
  try {
    imported = importFile(path, options);
  } catch (const Error&) { // of a vertex that no face uses, which pieces leave out
    return;
  }
  if (imported.scene.meshes.size() != pieces.size())
    return; // some are left out for such a vertex
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Content whole;
    if (imported.scene.meshes[i].topology == topologies[i])
      whole.append(imported.scene.meshes[i]);
    require(pieces[i] == whole);
  }
}

} // namespace imgeo::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  imgeo::ByteSpan bytes(data + 1, size - 1);
  imgeo::Bytes repaired;
  if (imgeo::isE57(bytes)) // others than with right checksums are refused
    bytes = repaired = imgeo::fuzz::withChecksums(bytes);
  const imgeo::fuzz::MemoryFile file(bytes);
  imgeo::fuzz::readInPieces(file.path(), std::uint64_t{data[0]} + 1);
  return 0;
}
