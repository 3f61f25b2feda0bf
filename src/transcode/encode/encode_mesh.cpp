#include "transcode/encode/encode_mesh.h"

#include "base/parallel.h"
#include "containers/compact/base.h"
#include "containers/compact/compact.h"
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
  ElementCounts counts; ///< of what it draws
};

/// Of compact, in integers.
compact::CompactPatch quantisedAs(Patch patch, const GeometryDescription& geometry, const ConvertOptions& options,
                                  const EncodeOptions& encoding) {
  if (options.primitives == Primitives::points)
    patch.topology = Topology::points;
  return quantisePatch(std::move(patch), geometry, encoding);
}

EncodedPatch encodeAlone(const compact::CompactPatch& patch, const GeometryDescription& geometry, int effort) {
  EncodedCompact encoded = encodeCompact({&patch, 1}, effort);
  EncodedPatch result{.description = describe(patch, geometry), .normalError = encoded.normalErrors[0]};
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
    // The joins of strips draw nothing, so strips are walked.
    if (options.primitives == Primitives::strips && patch.topology == Topology::triangles)
      encoded.counts.triangles = trianglesOf(indexed).size();
    encoded.patch = encodePatch(indexed, geometry, encoding);
  }
  if (encoded.counts.sum() == 0)
    encoded.counts = drawnBy(encoded.patch.description);
  return encoded;
}

/// The only patch of a mesh, to be written with others.
void addSmall(EncodedMesh& mesh, Patch patch, const ConvertOptions& options, const EncodeOptions& encoding) {
  mesh.small = quantisedAs(std::move(patch), mesh.geometry, options, encoding);
  mesh.geometry.patches = {describe(*mesh.small, mesh.geometry)};
  mesh.vertices = mesh.geometry.patches[0].vertexCount;
  mesh.elements = drawnBy(mesh.geometry.patches[0]);
  mesh.positionError = positionErrorBound(mesh.geometry);
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

  const EncodeOptions encoding{.encoding = *options.encoding,
                               .normalBits = options.normalBits,
                               .effort = options.effort,
                               .target = options.target,
                               .normals = options.normals,
                               .coordType = options.coordType,
                               .layout = options.layout,
                               .attributeBits = options.attributeBits,
                               .texCoordBits = options.texCoordBits,
                               .colorBits = options.colorBits};
  result.geometry = describe(patched, encoding);
  for (const Patch& patch : patched.patches) {
    result.hasNormals |= !patch.normals.empty();
    result.hasColors |= !patch.colors.empty();
    if (!patch.texCoords.empty()) {
      const Vec2<double> error = texCoordErrorBound(result.geometry, options.texCoordBits);
      result.texCoordError = std::max(error.x, error.y);
    }
  }
  if (options.encoding == Encoding::compact && options.primitives == Primitives::triangles)
    if (const std::optional<BaseMesh> base = baseOf(patched, options.basePercent.value_or(0)))
      result.base = baseInIntegers(*base, result.geometry, options.texCoordBits, options.colorBits);
  if (options.encoding == Encoding::compact && patched.patches.size() == 1 &&
      patched.patches[0].wedgeCount() <= sharedFileVertices) {
    addSmall(result, std::move(patched.patches[0]), options, encoding);
    done(result.small->elementCount());
    return result;
  }
  std::vector<PatchDescription> descriptions(patched.patches.size());
  std::vector<ElementCounts> elements(patched.patches.size());
  std::vector<double> normalErrors(patched.patches.size());
  parallelFor(patched.patches.size(), [&](std::size_t i) {
    const std::size_t elementCount = patched.patches[i].elementCount();
    EncodedElements encoded = encodeElements(std::exchange(patched.patches[i], {}), result.geometry, options, encoding);
    std::vector<std::string> urls;
    for (const EncodedFile& file : encoded.patch.files)
      urls.push_back(files.write(file.bytes, file.extension));
    descriptions[i] = describeWithUrls(encoded.patch, urls);
    elements[i] = encoded.counts;
    normalErrors[i] = encoded.patch.normalError;
    done(elementCount);
  });
  for (const PatchDescription& patch : descriptions)
    result.vertices += patch.vertexCount;
  for (const ElementCounts& counts : elements)
    result.elements += counts;
  if (!descriptions.empty() && (descriptions.front().normal || descriptions.front().data))
    result.normalErrorDegrees =
        std::max(normalErrorBound(result.geometry), *std::ranges::max_element(normalErrors)) * (180 / std::numbers::pi);
  result.positionError = positionErrorBound(result.geometry);
  result.geometry.patches = std::move(descriptions);
  return result;
}

} // namespace imgeo
