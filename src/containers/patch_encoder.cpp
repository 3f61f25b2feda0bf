#include "containers/patch_encoder.h"

#include "containers/encodings.h"
#include "containers/named_attributes.h"
#include "containers/stored.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

/// Sets the bounding box of a set of texture coordinates, relative to which they are stored. Sites for X3DOM, which has
/// no field for the box, store 0..1 instead.
void setTexCoordBox(GeometryDescription& geometry, const PatchedMesh& mesh, std::size_t set) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  Vec2f min{infinite, infinite}, max{-infinite, -infinite};
  for (const Patch& patch : mesh.patches)
    for (const Vec2f& texCoord : texCoordsOf(patch, set)) {
      min = {std::min(min.x, texCoord.x), std::min(min.y, texCoord.y)};
      max = {std::max(max.x, texCoord.x), std::max(max.y, texCoord.y)};
    }
  if (!(min.x <= max.x))
    return;
  geometry.texCoordBoxes[set] = {min, {max.x - min.x, max.y - min.y}};
}

IndexedPatch primitivesOf(const Patch& patch, const EncodeOptions& options) {
  if (patch.topology == Topology::points || options.primitives == Primitives::points)
    return asPoints(patch);
  const bool asStrip = options.primitives == Primitives::strips;
  if (patch.topology == Topology::lines)
    return asStrip ? asLineStrips(patch) : asLines(patch);
  return asStrip ? asStrips(patch, options.effort) : asTriangles(patch);
}

ElementCounts drawnElements(const std::vector<Draw>& draws) {
  ElementCounts counts;
  for (const Draw& draw : draws)
    counts += elementsOf(draw);
  return counts;
}

/// Encodes a patch alone into a file that several patches could share.
EncodedPatch encodeAlone(const FileSharing& sharing, Patch patch, const GeometryDescription& geometry,
                         const EncodeOptions& options) {
  std::unique_ptr<PreparedPatch> prepared = sharing.prepare(std::move(patch), geometry, options);
  EncodedPatch encoded{.description = prepared->describe(geometry)};
  const std::unique_ptr<SharedFile> file = sharing.makeFile();
  file->add(std::move(prepared));
  EncodedSharedFile shared = file->encode(options.effort);
  encoded.normalError = shared.normalErrors[0];
  encoded.references = {{Role::patch, addFile(encoded, std::move(shared.file)), PatchLocation{}}};
  return encoded;
}

void addReference(PatchDescription& patch, Role role, std::size_t attribute, const Reference& reference) {
  switch (role) {
  case Role::index:
    patch.index = reference;
    break;
  case Role::coord:
    patch.coord.push_back(reference);
    break;
  case Role::attribute:
    patch.attributes.resize(std::max(patch.attributes.size(), attribute + 1));
    patch.attributes[attribute].push_back(reference);
    break;
  case Role::patch:
    patch.data = reference;
    break;
  case Role::base:
  case Role::levels:
  case Role::chips:
    assert(false); // a geometry has them, not a patch
    break;
  case Role::normal:
  case Role::texCoord:
  case Role::texCoord1:
  case Role::texCoord2:
  case Role::texCoord3:
  case Role::color:
    if (std::optional<Reference>& first = patch.vertexAttributes[*vertexRoleOf(role)])
      patch.lowBytes[*vertexRoleOf(role)].push_back(reference);
    else
      first = reference;
  }
}

} // namespace

GeometryDescription describe(const PatchedMesh& mesh, const EncodeOptions& options) {
  GeometryDescription geometry;
  geometry.encoding = options.encoding;
  geometry.lattice = mesh.lattice;
  geometry.box = mesh.box;
  if (options.target != Target::x3dom)
    for (std::size_t set = 0; set < maxTexCoordSets; ++set)
      setTexCoordBox(geometry, mesh, set);
  if (!mesh.patches.empty())
    geometry.texCoordMappings = mesh.patches[0].texCoordMappings;
  for (const Patch& patch : mesh.patches)
    geometry.colorComponents = std::max(geometry.colorComponents, patch.colorComponents);
  geometry.normalEncoding = options.normals;
  geometry.attributes = describeAttributes(mesh, options.encoding, options.attributeBits / 8);
  rowOf(geometry).describe(geometry, mesh, options);
  return geometry;
}

EncodedPatch encodePatch(const IndexedPatch& patch, const GeometryDescription& geometry, const EncodeOptions& options) {
  const EncodingRow& row = rowOf(geometry);
  assert(row.encodeIndexed != nullptr);
  EncodedPatch encoded = row.encodeIndexed(patch, geometry, options);
  encoded.elements = drawnElements(patch.draws);
  return encoded;
}

EncodedPatch encodePatch(Patch patch, const GeometryDescription& geometry, const EncodeOptions& options) {
  const EncodingRow& row = rowOf(geometry);
  if (row.encodeIndexed == nullptr) {
    EncodedPatch encoded = encodeAlone(*row.sharing, std::move(patch), geometry, options);
    encoded.elements = drawnElements(encoded.description.draws);
    return encoded;
  }
  IndexedPatch indexed = primitivesOf(patch, options);
  if (!options.indexed)
    indexed = withoutIndices(indexed);
  EncodedPatch encoded = encodePatch(indexed, geometry, options);
  if (options.primitives == Primitives::strips && patch.topology == Topology::triangles)
    encoded.elements = {.triangles = trianglesOf(indexed).size()};
  return encoded;
}

PatchDescription describeWithUrls(const EncodedPatch& encoded, std::span<const std::string> urls) {
  assert(urls.size() == encoded.files.size());
  PatchDescription description = encoded.description;
  for (const FileReference& reference : encoded.references)
    addReference(description, reference.role, reference.attributeIndex,
                 {urls[static_cast<std::size_t>(reference.file)], reference.location});
  return description;
}

} // namespace imgeo
