#include "containers/bg/element_types.h"

#include "base/error.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"

#include <algorithm>
#include <cassert>

namespace imgeo {

namespace {

ElementType normalTypeOf(const EncodeOptions& options) {
  assert(options.normals != NormalEncoding::palette);
  assert(options.normalBits == 8 || options.normalBits == 16 || options.normalBits == 32);
  if (isPair(options.normals))
    return unsignedTypeOf(options.normalBits / 8);
  return options.normalBits == 8    ? ElementType::int8
         : options.normalBits == 16 ? ElementType::int16
                                    : ElementType::float32;
}

/// The type of a fraction of 8, 16 or 32 bits.
ElementType fractionTypeOf(std::uint32_t bits) {
  return bits == 32 ? ElementType::float32 : unsignedTypeOf(bits / 8);
}

/// X3DOM reads all attributes of interleaved records as elements of the coordinates' type.
void chooseOneType(GeometryDescription& geometry, const PatchedMesh& mesh) {
  const ElementType type = geometry.coordType;
  const auto has = [&](auto attribute) {
    return std::ranges::any_of(mesh.patches, [&](const Patch& patch) { return !(patch.*attribute).empty(); });
  };
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::unsupported, "",
                "X3DOM reads interleaved records as one element type, and " + std::string(nameOf(type)) + " holds no " +
                    what);
  };
  if (has(&Patch::normals) && isUnsigned(type) && !isPair(geometry.normalEncoding))
    refuse("components of normals; Int16, Float32 and spherical normals beside Uint16 do");
  if (has(&Patch::texCoords) &&
      (byteSizeOf(type) == 1 ||
       (geometry.attributeTypes[VertexRole::texCoord] == ElementType::float32 && type != ElementType::float32)))
    refuse("such texture coordinates; Float32 does");
  for (const VertexRole role : vertexRoles)
    if (role != VertexRole::normal || !isPair(geometry.normalEncoding))
      geometry.attributeTypes[role] = type;
}

} // namespace

void chooseTypes(GeometryDescription& geometry, const PatchedMesh& mesh, const EncodeOptions& options) {
  const std::uint32_t bits = mesh.lattice.bits;
  geometry.coordType = options.coordType.value_or(unsignedTypeOf(coordBytes(Encoding::bg, bits)));
  geometry.attributeTypes[VertexRole::normal] = normalTypeOf(options);
  for (const VertexRole set : texCoordRoles)
    geometry.attributeTypes[set] = fractionTypeOf(options.texCoordBits);
  if (options.target == Target::x3dom && !hasUnitTexCoords(mesh)) // X3DOM's integers hold 0..1 alone
    geometry.attributeTypes[VertexRole::texCoord] = ElementType::float32;
  geometry.attributeTypes[VertexRole::color] = fractionTypeOf(options.colorBits);
  assert(holdsLattice(geometry.coordType, bits));
  assert(!isPair(options.normals) || options.normalBits == 16 || byteSizeOf(geometry.coordType) == 2);
  if (options.target == Target::x3dom && options.layout == Layout::interleaved)
    chooseOneType(geometry, mesh);
  if (geometry.coordType == ElementType::float32 && !geometry.box.empty())
    geometry.box = {Vec3d(Vec3f(geometry.box.min)), Vec3d(Vec3f(geometry.box.max))};
}

} // namespace imgeo
