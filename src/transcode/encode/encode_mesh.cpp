#include "transcode/encode/encode_mesh.h"

#include "base/parallel.h"
#include "containers/compact/base.h"
#include "containers/compact/compact.h"
#include "containers/encodings.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/degenerate_elements.h"
#include "prepare/patches.h"
#include "transcode/options/resolve_options.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

IndexedPatch arrange(const Patch& patch, const ConvertOptions& options) {
  if (patch.topology == Topology::points || options.primitives == Primitives::points)
    return asPoints(patch);
  const bool asStrip = options.primitives == Primitives::strips;
  if (patch.topology == Topology::lines)
    return asStrip ? asLineStrips(patch) : asLines(patch);
  return asStrip ? asStrips(patch, options.effort) : asTriangles(patch);
}

IndexedPatch primitivesOf(const Patch& patch, const ConvertOptions& options) {
  IndexedPatch arranged = arrange(patch, options);
  return options.indexed ? arranged : withoutIndices(arranged);
}

ElementCounts drawnBy(const PatchDescription& patch) {
  ElementCounts counts;
  for (const Draw& draw : patch.draws)
    counts += elementsOf(draw);
  return counts;
}

struct EncodedElements {
  EncodedPatch patch;
  ElementCounts counts; ///< elements that it draws
};

/// The patch in the integers of compact.
compact::CompactPatch quantisedAs(Patch patch, const GeometryDescription& geometry, const ConvertOptions& options,
                                  const EncodeOptions& encoding) {
  if (options.primitives == Primitives::points)
    patch.topology = Topology::points;
  return quantisePatch(std::move(patch), geometry, encoding);
}

EncodedPatch encodeAlone(const compact::CompactPatch& patch, const GeometryDescription& geometry, int effort) {
  EncodedCompact encoded = encodeCompact({&patch, 1}, effort);
  EncodedPatch result{
      .description = describe(patch, geometry), .files = {}, .references = {}, .normalError = encoded.normalErrors[0]};
  result.references = {{Role::patch, addFile(result, std::move(encoded.file)), PatchLocation{}}};
  return result;
}

EncodedElements encodeElements(Patch patch, const GeometryDescription& geometry, const ConvertOptions& options,
                               const EncodeOptions& encoding) {
  EncodedElements encoded;
  if (geometry.encoding == Encoding::compact) {
    encoded.patch = encodeAlone(quantisedAs(std::move(patch), geometry, options, encoding), geometry, encoding.effort);
  } else {
    const IndexedPatch indexed = primitivesOf(patch, options);
    // Strips contain degenerate triangles, which draw nothing: count the others.
    if (options.primitives == Primitives::strips && patch.topology == Topology::triangles)
      encoded.counts.triangles = trianglesOf(indexed).size();
    encoded.patch = encodePatch(indexed, geometry, encoding);
  }
  if (encoded.counts.sum() == 0)
    encoded.counts = drawnBy(encoded.patch.description);
  return encoded;
}

/// Keeps the only patch of a mesh for PatchFiles.
void addSmall(EncodedMesh& mesh, Patch patch, const ConvertOptions& options, const EncodeOptions& encoding) {
  mesh.small = quantisedAs(std::move(patch), mesh.geometry, options, encoding);
  mesh.geometry.patches = {describe(*mesh.small, mesh.geometry)};
  mesh.vertices = mesh.geometry.patches[0].vertexCount;
  mesh.elements = drawnBy(mesh.geometry.patches[0]);
  mesh.positionError = positionErrorBound(mesh.geometry);
}

EncodeOptions encodeOptionsFrom(const ConvertOptions& options) {
  return {.encoding = *options.encoding,
          .normalBits = options.normalBits,
          .effort = options.effort,
          .target = options.target,
          .normals = options.normals,
          .coordType = options.coordType,
          .layout = options.layout,
          .attributeBits = options.attributeBits,
          .texCoordBits = options.texCoordBits,
          .colorBits = options.colorBits};
}

/// Notes which attributes any patch has.
void addAttributes(EncodedMesh& mesh, const std::vector<Patch>& patches, const ConvertOptions& options) {
  for (const Patch& patch : patches) {
    mesh.hasNormals |= !patch.normals.empty();
    mesh.hasColors |= !patch.colors.empty();
    if (!patch.texCoords.empty()) {
      const Vec2<double> error = texCoordErrorBound(mesh.geometry, options.texCoordBits);
      mesh.texCoordError = std::max(error.x, error.y);
    }
  }
}

/// Encodes and writes all patches, several at a time. Frees each patch when its files are written.
void encodePatches(EncodedMesh& mesh, std::vector<Patch> patches, const ConvertOptions& options,
                   const EncodeOptions& encoding, ContentFiles& files, const ElementsDone& done) {
  std::vector<PatchDescription> descriptions(patches.size());
  std::vector<ElementCounts> elements(patches.size());
  std::vector<double> normalErrors(patches.size());
  parallelFor(patches.size(), [&](std::size_t i) {
    const std::size_t elementCount = patches[i].elementCount();
    EncodedElements encoded = encodeElements(std::exchange(patches[i], {}), mesh.geometry, options, encoding);
    std::vector<std::string> urls;
    for (const EncodedFile& file : encoded.patch.files)
      urls.push_back(files.write(file.bytes, file.extension));
    descriptions[i] = describeWithUrls(encoded.patch, urls);
    elements[i] = encoded.counts;
    normalErrors[i] = encoded.patch.normalError;
    done(elementCount);
  });
  for (const PatchDescription& patch : descriptions)
    mesh.vertices += patch.vertexCount;
  for (const ElementCounts& counts : elements)
    mesh.elements += counts;
  if (!descriptions.empty() && (descriptions.front().normal || descriptions.front().data))
    mesh.normalErrorDegrees =
        std::max(normalErrorBound(mesh.geometry), *std::ranges::max_element(normalErrors)) * (180 / std::numbers::pi);
  mesh.positionError = positionErrorBound(mesh.geometry);
  mesh.geometry.patches = std::move(descriptions);
}

} // namespace

EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done) {
  const Box3d box = boxOf(mesh);
  const Lattice lattice =
      latticeFor(box, options.coordType.value_or(ElementType::uint32), positionBitsFor(box, options));
  EncodedMesh result;
  std::vector<Vec3u> points = quantise(mesh.positions, lattice);
  result.collapsed.of(mesh.topology) = countCollapsedElements(mesh, points, lattice.bits);
  PatchedMesh patched = cutIntoPatches(std::move(mesh), std::move(points), lattice, options.patchVertices);

  const EncodeOptions encoding = encodeOptionsFrom(options);
  result.geometry = describe(patched, encoding);
  addAttributes(result, patched.patches, options);
  const Capabilities& capabilities = rowOf(encoding.encoding).capabilities;
  if (capabilities.base && options.primitives == Primitives::triangles)
    if (const std::optional<BaseMesh> base = baseOf(patched, options.basePercent.value_or(0)))
      result.base = baseInIntegers(*base, result.geometry, options.texCoordBits, options.colorBits);
  if (capabilities.sharedFiles && patched.patches.size() == 1 &&
      patched.patches[0].wedgeCount() <= maxSharedFileWedges) {
    addSmall(result, std::move(patched.patches[0]), options, encoding);
    done(result.small->elementCount());
    return result;
  }
  encodePatches(result, std::move(patched.patches), options, encoding, files, done);
  return result;
}

} // namespace imgeo
