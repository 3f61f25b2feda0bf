// The first byte is the number of faces, facets or points of a piece; the others are a PLY, STL, OBJ, GLB, LAS, E57
// or PTS file.
#include "base/error.h"
#include "import/chunks/chunked_source.h"
#include "import/e57/e57.h"
#include "import/import.h"

#include "e57_checksums.h"
#include "import_check.h"

#include <fmt/format.h>
#include <map>
#include <sys/mman.h>
#include <unistd.h>

namespace imgeo::fuzz {

/// A file that is not on disk, under a name by whose extension PTS is known.
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

/// Requires that the pieces of a file are refused or have the triangles or points of the whole.
void readInPieces(const std::string& path, std::uint64_t chunkRecords) {
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  Content pieces, whole;
  Topology topology{};
  try {
    const auto source = ChunkedSource::open(path, std::filesystem::temp_directory_path(), chunkRecords);
    topology = source->topology();
    for (std::size_t chunk = 0; chunk < source->chunkCount(); ++chunk) {
      const Imported piece = source->read(chunk, options);
      const Mesh& mesh = piece.scene.meshes.at(0);
      require(mesh.topology != topology || mesh.elementCount() == source->elementsOf(chunk));
      if (mesh.topology == topology) // otherwise no face has three corners
        pieces.append(mesh);
    }
  } catch (const Error& error) {
    require(!error.message().empty() && error.location().starts_with(path));
    return;
  }
  try {
    const Imported imported = importFile(path, options);
    if (imported.scene.meshes.at(0).topology == topology)
      whole.append(imported.scene.meshes.at(0));
  } catch (const Error&) { // of a vertex that no face uses, which pieces leave out
    return;
  }
  require(pieces == whole);
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
