#include "transcode/encode/encode_mesh.h"

#include "base/parallel.h"
#include "containers/encodings.h"
#include "containers/normals.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/degenerate_elements.h"
#include "prepare/levels/point_levels.h"
#include "prepare/patches.h"
#include "prepare/source_lattice.h"
#include "transcode/encode/levels.h"
#include "transcode/options/resolve_options.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace imgeo {

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
          .colorBits = options.colorBits,
          .primitives = options.primitives,
          .indexed = options.indexed,
          .images = options.images};
}

void noteAttributes(EncodedMesh& mesh, const VertexAttributes& vertices, const ConvertOptions& options) {
  mesh.hasNormals |= !vertices.normals.empty();
  mesh.hasColors |= !vertices.colors.empty();
  const bool areBytes = std::ranges::all_of(vertices.colors, isRgba8);
  if (!areBytes || (!vertices.colors.empty() && options.colorBits < 8)) // 8, 16, 24 and 32 bits hold bytes exactly
    mesh.colorError = colorErrorBound(mesh.geometry, options.colorBits);
  for (std::size_t set = 0; set < texCoordSetCount(vertices); ++set) {
    const Vec2<double> error = texCoordErrorBound(mesh.geometry, set, options.texCoordBits);
    mesh.texCoordError = std::max({mesh.texCoordError.value_or(0), error.x, error.y});
  }
}

PatchDescription writePatch(const EncodedPatch& patch, ContentFiles& files) {
  std::vector<std::string> urls;
  for (const EncodedFile& file : patch.files)
    urls.push_back(files.write(file.bytes, file.extension));
  return describeWithUrls(patch, urls);
}

namespace {

/// Keeps the only patch of a mesh for PatchFiles.
void addSmall(EncodedMesh& mesh, Patch patch, const EncodeOptions& encoding, const FileSharing& sharing) {
  mesh.small = sharing.prepare(std::move(patch), mesh.geometry, encoding);
  mesh.geometry.patches = {mesh.small->describe(mesh.geometry)};
  mesh.vertices = mesh.geometry.patches[0].vertexCount;
  for (const Draw& draw : mesh.geometry.patches[0].draws)
    mesh.elements += elementsOf(draw);
  mesh.positionError = positionErrorBound(mesh.geometry);
}

/// Encodes and writes all patches, several at a time. Frees each patch when its files are written.
void encodePatches(EncodedMesh& mesh, std::vector<Patch> patches, const EncodeOptions& encoding, ContentFiles& files,
                   const ElementsDone& done) {
  std::vector<PatchDescription> descriptions(patches.size());
  std::vector<ElementCounts> elements(patches.size());
  std::vector<double> normalErrors(patches.size());
  parallelFor(patches.size(), [&](std::size_t i) {
    const std::size_t elementCount = patches[i].elementCount();
    const EncodedPatch encoded = encodePatch(std::exchange(patches[i], {}), mesh.geometry, encoding);
    descriptions[i] = writePatch(encoded, files);
    elements[i] = encoded.elements;
    normalErrors[i] = encoded.normalError;
    done(elementCount);
  });
  for (const PatchDescription& patch : descriptions)
    mesh.vertices += patch.vertexCount;
  for (const ElementCounts& counts : elements)
    mesh.elements += counts;
  if (!descriptions.empty() && (descriptions.front().vertexAttributes[VertexRole::normal] || descriptions.front().data))
    mesh.normalErrorDegrees =
        std::max(normalErrorBound(mesh.geometry), *std::ranges::max_element(normalErrors)) * (180 / std::numbers::pi);
  mesh.positionError = positionErrorBound(mesh.geometry);
  mesh.geometry.patches = std::move(descriptions);
}

EncodedMesh encodeOn(const Lattice& lattice, Mesh mesh, bool mayHaveBase, const ConvertOptions& options,
                     ContentFiles& files, const ElementsDone& done) {
  EncodedMesh result;
  std::vector<Vec3u> points = quantise(mesh.positions, lattice);
  result.collapsed.of(mesh.topology) = countCollapsedElements(mesh, points, lattice.bits);
  const bool moves = isDeformed(mesh); // a base mesh would stand in for its form at rest
  PatchedMesh patched = cutIntoPatches(std::move(mesh), std::move(points), lattice, options.patchVertices);

  const EncodeOptions encoding = encodeOptionsFrom(options);
  const EncodingRow& row = rowOf(encoding.encoding);
  result.geometry = describe(patched, encoding);
  for (const Patch& patch : patched.patches)
    noteAttributes(result, patch, options);
  if (mayHaveBase && !moves && row.capabilities.base && options.primitives == Primitives::triangles)
    if (const std::optional<BaseMesh> base = baseOf(patched, options.basePercent.value_or(0)))
      result.base = row.sharing->prepareBase(*base, result.geometry, encoding);
  if (row.sharing != nullptr && patched.patches.size() == 1 &&
      patched.patches[0].wedgeCount() <= row.sharing->maxFileVertices) {
    addSmall(result, std::move(patched.patches[0]), encoding, *row.sharing);
    done(result.small->elementCount());
    return result;
  }
  encodePatches(result, std::move(patched.patches), encoding, files, done);
  return result;
}

} // namespace

namespace {

/// The lattice on which positions lie. That of clouds is estimated from the points by which regions are chosen, which
/// are at hand out of core as well.
std::optional<SourceLattice> sourceLatticeOf(const Mesh& mesh, const Lattice& requested) {
  if (mesh.topology != Topology::points)
    return findSourceLattice(mesh.positions, requested);
  std::vector<Vec3f> sample;
  for (const std::uint32_t position : sampledPoints(mesh))
    sample.push_back(mesh.positions[position]);
  return findSourceLattice(sample, mesh.positions, requested);
}

} // namespace

EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done,
                       const Atlas& atlas) {
  const Box3d box = boxOf(mesh);
  const Lattice lattice =
      latticeFor(box, options.coordType.value_or(ElementType::uint32), positionBitsFor(box, options));
  const bool anyLattice = rowOf(*options.encoding).storage == PatchStorage::packed;
  const std::optional<SourceLattice> source = anyLattice ? sourceLatticeOf(mesh, lattice) : std::nullopt;
  const Lattice& chosen = source ? source->lattice : lattice;
  EncodedMesh encoded = getsLevels(mesh, chosen, options)
                            ? encodeLevels(std::move(mesh), chosen, options, files, done, atlas)
                            : encodeOn(chosen, std::move(mesh), true, options, files, done);
  if (source)
    encoded.positionError = source->error;
  return encoded;
}

EncodedMesh encodeMesh(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                       const ElementsDone& done) {
  return encodeOn(lattice, std::move(mesh), false, options, files, done);
}

} // namespace imgeo
