#include "import/chunks/chunked_source.h"

#include "base/error.h"
#include "import/chunks/chunked_e57.h"
#include "import/chunks/chunked_glb.h"
#include "import/chunks/chunked_las.h"
#include "import/chunks/chunked_obj.h"
#include "import/chunks/chunked_ply.h"
#include "import/chunks/chunked_pts.h"
#include "import/chunks/chunked_text_ply.h"
#include "import/chunks/chunked_xyz.h"
#include "import/e57/e57.h"
#include "import/format.h"
#include "import/gltf/gltf.h"
#include "import/gltf/gltf1.h"
#include "import/obj/obj.h"
#include "import/ply/header.h"
#include "import/ply/ply.h"
#include "import/pts/pts.h"
#include "import/stl/stl.h"
#include "import/xyz/xyz.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr std::size_t stlHeaderBytes = 80, stlPrefixBytes = 84, stlFacetBytes = 50;

bool isBinaryStl(ByteSpan bytes) {
  return bytes.size() >= stlPrefixBytes &&
         bytes.size() ==
             stlPrefixBytes + stlFacetBytes * std::uint64_t{loadLittle<std::uint32_t>(&bytes[stlHeaderBytes])};
}

/// Pieces of binary STL files: facets with a header of their own.
class ChunkedStl : public ChunkedSource {
public:
  ChunkedStl(SourceContent content, std::uint64_t chunkRecords) : ChunkedSource(std::move(content)) {
    if (!isBinaryStl(bytes()))
      throw Error(ErrorKind::unsupported, name_, "is no binary STL file");
    const std::uint64_t count = (bytes().size() - stlPrefixBytes) / stlFacetBytes;
    for (std::uint64_t first = 0; first < count; first += chunkRecords) {
      const std::uint64_t records = std::min(chunkRecords, count - first);
      const std::size_t offset = stlPrefixBytes + stlFacetBytes * first;
      add({offset, offset + stlFacetBytes * records, records, records});
    }
  }

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override {
    Bytes file(bytes().begin(), bytes().begin() + stlHeaderBytes);
    appendLittle(file, static_cast<std::uint32_t>(chunk.records));
    const ByteSpan facets = bytesOf(chunk);
    file.insert(file.end(), facets.begin(), facets.end());
    return readStl(file, name_, options);
  }
};

} // namespace

ChunkedMesh ChunkedSource::mesh(std::size_t number) const {
  return {*this, number};
}

std::uint64_t ChunkedSource::elementCount() const {
  std::uint64_t count = 0;
  for (const Pieces& mesh : meshes_)
    count += mesh.elements;
  return count;
}

ImportOptions ChunkedSource::besideFile(ImportOptions options) const {
  const std::filesystem::path path = name_;
  options.folder = path.has_parent_path() ? path.parent_path() : ".";
  return options;
}

Imported ChunkedSource::readScene(const std::set<std::size_t>&, const ImportOptions& options) const {
  if (mesh(0).chunkCount() == 0)
    throw Error(ErrorKind::malformed, name_, "has no triangles, lines or points");
  return mesh(0).read(0, options); // of one mesh, whose pieces are small files of the format
}

Imported ChunkedSource::readMeshes(const std::set<std::size_t>& meshes, const ImportOptions& options) const {
  Imported imported = readScene(meshes, options);
  std::vector<Mesh> read;
  for (const std::size_t mesh : meshes)
    read.push_back(std::move(imported.scene.meshes.at(mesh)));
  imported.scene = {{}, std::move(read)};
  return imported;
}

std::unique_ptr<ChunkedSource> ChunkedSource::open(const std::filesystem::path& path,
                                                   const std::filesystem::path& scratch, std::uint64_t chunkRecords) {
  SourceContent content(path, scratch);
  if (isPly(content.bytes())) {
    if (readPlyHeader(content.bytes(), content.name()).encoding == PlyEncoding::ascii)
      return std::make_unique<ChunkedTextPly>(std::move(content), scratch, chunkRecords);
    return std::make_unique<ChunkedPly>(std::move(content), scratch, chunkRecords);
  }
  if (isBinaryStl(content.bytes()))
    return std::make_unique<ChunkedStl>(std::move(content), chunkRecords);
  if (isLas(content.bytes()))
    return std::make_unique<ChunkedLas>(std::move(content), chunkRecords);
  if (isGlb(content.bytes()) && isGltf(content.bytes()))
    return std::make_unique<ChunkedGlb>(std::move(content), chunkRecords);
  if (isE57(content.bytes()))
    return std::make_unique<ChunkedE57>(std::move(content), chunkRecords);
  const auto read = formatOf(content.bytes(), content.name()).read;
  if (read == &readPts)
    return std::make_unique<ChunkedPts>(std::move(content), chunkRecords);
  if (read == &readXyz)
    return std::make_unique<ChunkedXyz>(std::move(content), chunkRecords);
  if (read == &readObj && resemblesObj(content.bytes()))
    return std::make_unique<ChunkedObj>(std::move(content), scratch, chunkRecords);
  throw Error(ErrorKind::unsupported, content.name(),
              "is read whole into memory; imgeo reads PLY, binary STL, OBJ, GLB, LAS, E57, PTS and XYZ piece by piece");
}

} // namespace imgeo
