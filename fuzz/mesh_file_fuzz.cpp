// Reads the work file of small meshes. Requires that a mesh that is read keeps the invariants of meshes, and is the
// same after it has been written.
#include "base/error.h"
#include "scene/mesh.h"
#include "transcode/out_of_core/mesh_file.h"

#include <cstdlib>

namespace {

using namespace imgeo;

void require(bool condition) {
  if (!condition)
    std::abort();
}

void check(const MeshFile& file, const MeshFileEntry& entry) {
  const Mesh mesh = file.read(entry);
  require(isConsistent(mesh) && mesh.elementCount() == entry.elements);
  MeshFileWriter writer;
  writer.add(entry.mesh, mesh);
  const Bytes bytes = writer.finish(file.findings());
  const MeshFile again(bytes, "again");
  require(again.entries().size() == 1 && again.entries()[0].mesh == entry.mesh);
  require(again.findings().warnings == file.findings().warnings);
  const Mesh same = again.read(again.entries()[0]);
  require(same.positions == mesh.positions && same.corners == mesh.corners && same.name == mesh.name);
  require(same.texCoordMappings == mesh.texCoordMappings && same.wedgePositions == mesh.wedgePositions);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const MeshFile file({data, size}, "fuzz");
    for (const MeshFileEntry& entry : file.entries())
      check(file, entry);
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::malformed && !error.message().empty() && error.location() == "fuzz");
  }
  return 0;
}
