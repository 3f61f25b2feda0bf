// Shape Resource Containers, in both layouts.
#include "base/error.h"
#include "import/gltf/shape_resource.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  for (const bool withMaterials : {false, true})
    try {
      const gltf::ShapeResource resource = gltf::readShapeResource({data, size}, "fuzz.src", "", withMaterials);
      for (const auto& [mesh, material] : resource.shapes) {
        fuzz::require(isConsistent(mesh) && (!material || *material < resource.materials.size()));
        for (const Vec3f& position : mesh.positions)
          fuzz::require(fuzz::isFinite(position));
        for (const Vec3f& normal : mesh.normals)
          fuzz::require(std::abs(length(Vec3d(normal)) - 1) < 1e-5);
      }
    } catch (const Error& error) {
      fuzz::require(!error.message().empty() && error.location().starts_with("fuzz.src"));
    }
  return 0;
}
