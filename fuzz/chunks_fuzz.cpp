// The first byte is the number of faces or facets of a piece; the others are a PLY or STL file.
#include "base/error.h"
#include "import/chunks/chunked_source.h"
#include "import/import.h"

#include "import_check.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

namespace imgeo::fuzz {

/// A file without a name on disk.
class MemoryFile {
public:
  explicit MemoryFile(ByteSpan bytes) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    require(descriptor_ >= 0 && write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

private:
  int descriptor_;
};

void append(std::vector<Vec3f>& corners, const Mesh& mesh) {
  require(isConsistent(mesh));
  for (std::size_t corner = 0; corner < mesh.corners.size() && mesh.topology == Topology::triangles; ++corner) {
    corners.push_back(mesh.cornerPosition(corner));
    require(isFinite(corners.back()));
  }
}

/// Requires that the pieces of a file are refused or have the triangles of the whole.
void readInPieces(const std::string& path, std::uint64_t chunkRecords) {
  std::vector<Vec3f> pieces, whole;
  try {
    const auto source = ChunkedSource::open(path, std::filesystem::temp_directory_path(), chunkRecords);
    for (std::size_t chunk = 0; chunk < source->chunkCount(); ++chunk)
      append(pieces, source->read(chunk, {}).scene.meshes.at(0));
  } catch (const Error& error) {
    require(!error.message().empty() && error.location().starts_with(path));
    return;
  }
  try {
    const Imported imported = importFile(path);
    append(whole, imported.scene.meshes.at(0));
  } catch (const Error&) { // of a vertex that no face uses, which pieces leave out
    return;
  }
  require(pieces == whole);
}

} // namespace imgeo::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  const imgeo::fuzz::MemoryFile file({data + 1, size - 1});
  imgeo::fuzz::readInPieces(file.path(), std::uint64_t{data[0]} + 1);
  return 0;
}
