#include "transcode/encode/geometry_images.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/classic/classic.h"
#include "containers/encodings.h"
#include "containers/grid.h"
#include "containers/normals.h"
#include "containers/option_checks.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/geometry_image/geometry_image.h"
#include "prepare/geometry_image/surface_distance.h"
#include "prepare/grid_parts.h"
#include "transcode/options/resolve_options.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

/// Fewer texels hardly show the shape of a chart.
constexpr std::size_t minTexelsPerChart = 16;

/// The largest number of columns or rows of a chart's grid, however long the chart.
constexpr std::uint32_t maxChartEdge = 65536;

/// Cuts grids that no image of `maxEdge` columns and rows holds.
std::vector<GeometryImage> cutToFit(std::vector<GeometryImage> images, std::uint32_t maxEdge) {
  std::vector<GeometryImage> result;
  for (GeometryImage& image : images) {
    const std::vector<GridPart> parts = gridParts({image.columns, image.rows}, maxEdge);
    if (parts.size() == 1) {
      result.push_back(std::move(image));
      continue;
    }
    for (const GridPart& part : parts) {
      const std::vector<std::uint32_t> vertices = verticesOf(part, image.columns);
      result.push_back({gather(image, vertices), part.size.x, part.size.y, gather(image.positions, vertices)});
    }
  }
  return result;
}

/// Several grids of the same number of columns, one below the other in the same images.
struct GridStack {
  std::vector<std::size_t> grids; ///< indices
  std::uint32_t rows = 0;
};

/// Stacks grids that have the same number of columns, up to `maxEdge` rows.
std::vector<GridStack> stacksOf(const std::vector<GeometryImage>& images, std::uint32_t maxEdge) {
  std::vector<GridStack> stacks;
  std::map<std::uint32_t, std::size_t> open; // by columns
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto [stack, isNew] = open.try_emplace(images[i].columns, stacks.size());
    if (isNew || stacks[stack->second].rows + images[i].rows > maxEdge) {
      stack->second = stacks.size();
      stacks.emplace_back();
    }
    stacks[stack->second].grids.push_back(i);
    stacks[stack->second].rows += images[i].rows;
  }
  return stacks;
}

/// The grids as patches on a lattice, without corners.
PatchedMesh quantised(std::vector<GeometryImage> images, const Lattice& lattice) {
  PatchedMesh mesh{lattice, {}, std::vector<Patch>(images.size())};
  parallelFor(images.size(), [&](std::size_t i) {
    Patch& patch = mesh.patches[i];
    static_cast<VertexAttributes&>(patch) = std::move(static_cast<VertexAttributes&>(images[i]));
    patch.positions = quantise(images[i].positions, lattice);
  });
  for (const Patch& patch : mesh.patches) {
    const Box3d box = boxOf(patch, lattice);
    mesh.box.add(box.min);
    mesh.box.add(box.max);
  }
  return mesh;
}

/// The triangles that readers of the grids get.
Mesh surfaceOf(const PatchedMesh& grids, const std::vector<Vec2<std::uint32_t>>& sizes) {
  Mesh mesh;
  for (std::size_t i = 0; i < grids.patches.size(); ++i) {
    const std::vector<Vec3u>& positions = grids.patches[i].positions;
    const auto first = narrow<std::uint32_t>(mesh.positions.size());
    for (const std::uint32_t corner : gridTriangles(GridKind::geometryImage, sizes[i], positions))
      mesh.corners.push_back(first + corner);
    for (const Vec3u& q : positions) {
      mesh.wedgePositions.push_back(narrow<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(Vec3f(grids.lattice.point(q)));
    }
  }
  return mesh;
}

/// A mesh sampled on grids, and how far they are from it.
struct SampledMesh {
  PatchedMesh grids;
  std::vector<Vec2<std::uint32_t>> sizes; ///< columns and rows, by patch
  std::vector<GridStack> stacks;
  SurfaceDistance distance;
  std::size_t triangles = 0; ///< of more than a point or a line
};

SampledMesh sampled(const Mesh& mesh, const std::vector<ParametrisedChart>& charts, std::uint32_t gridEdge,
                    const Lattice& lattice, std::uint32_t imageEdge) {
  SampledMesh result;
  std::vector<GeometryImage> images = cutToFit(geometryImages(mesh, charts, gridEdge, maxChartEdge), imageEdge);
  result.stacks = stacksOf(images, imageEdge);
  for (const GeometryImage& image : images)
    result.sizes.push_back({image.columns, image.rows});
  result.grids = quantised(std::move(images), lattice);
  const Mesh surface = surfaceOf(result.grids, result.sizes);
  result.triangles = surface.elementCount();
  if (result.triangles > 0)
    result.distance = distanceBetween(mesh, surface);
  return result;
}

double allowedDistance(const MaxError& error, const Box3d& box) {
  return error.isPercent ? error.value / 100 * box.longestEdge() : error.value;
}

/// Doubles the grid until the surfaces are close enough.
SampledMesh sampledWithin(double allowed, const Mesh& mesh, const std::vector<ParametrisedChart>& charts,
                          const Lattice& lattice, std::uint32_t imageEdge) {
  std::uint32_t gridEdge = 32;
  while (std::size_t{gridEdge} * gridEdge < minTexelsPerChart * charts.size() && gridEdge < maxGridEdge)
    gridEdge *= 2;
  for (;; gridEdge *= 2) {
    SampledMesh result = sampled(mesh, charts, gridEdge, lattice, imageEdge);
    if (result.distance.largest <= allowed)
      return result;
    if (2 * gridEdge > maxGridEdge)
      refuseOption("--max-error", fmt::format("is {:.4g}; a grid of {} x {} is off by {:.4g}", allowed, gridEdge,
                                              gridEdge, result.distance.largest));
  }
}

SampledMesh sampledAs(const ConvertOptions& options, const Mesh& mesh, const std::vector<ParametrisedChart>& charts) {
  const Box3d box = boxOf(mesh);
  ConvertOptions forLattice = options;
  if (forLattice.maxError)
    forLattice.maxError->value /= 16; // hardly more than the distance of the samples alone
  const std::uint32_t bits = options.maxError ? std::max(positionBitsFor(box, forLattice), 16u) : options.positionBits;
  const Lattice lattice = latticeFor(box, bits);
  if (options.maxError)
    return sampledWithin(allowedDistance(*options.maxError, box), mesh, charts, lattice, options.gridImageEdge);
  const std::size_t texels = std::size_t{options.grid} * options.grid, needed = minTexelsPerChart * charts.size();
  if (texels < needed)
    refuseOption("--grid", fmt::format("{} x {} texels are too few for {} charts, into which the seams of the texture "
                                       "coordinates and the creases cut a mesh; {} is enough",
                                       options.grid, options.grid, charts.size(),
                                       std::ceil(std::sqrt(static_cast<double>(needed)))));
  return sampled(mesh, charts, options.grid, lattice, options.gridImageEdge);
}

/// The vertices of several grids, one after the other.
IndexedPatch stackedVertices(const std::vector<Patch>& patches, const GridStack& stack) {
  IndexedPatch vertices;
  for (const std::size_t grid : stack.grids) {
    append(vertices, vertices.vertexCount(), patches[grid], patches[grid].positions.size());
    vertices.positions.insert(vertices.positions.end(), patches[grid].positions.begin(), patches[grid].positions.end());
  }
  return vertices;
}

/// Writes the images of a stack and describes its grids.
void writeStack(const SampledMesh& sampledMesh, const GridStack& stack, const GeometryDescription& geometry,
                const EncodeOptions& options, ContentFiles& files, std::vector<PatchDescription>& descriptions) {
  const std::uint32_t columns = sampledMesh.sizes[stack.grids[0]].x;
  const EncodedPatch encoded =
      encodeGrids(stackedVertices(sampledMesh.grids.patches, stack), columns, geometry, options);
  const PatchDescription written = writePatch(encoded, files);
  std::uint32_t firstTexel = 0;
  for (const std::size_t grid : stack.grids) {
    PatchDescription patch = written;
    visitReferences(patch, [&](Role, Reference& reference) { reference.location = TexelLocation{firstTexel}; });
    const std::vector<Vec3u>& positions = sampledMesh.grids.patches[grid].positions;
    patch.box = boxOf(positions, geometry);
    patch.vertexCount = narrow<std::uint32_t>(positions.size());
    patch.implicitMeshSize = sampledMesh.sizes[grid];
    patch.draws = {{Primitive::triangles,
                    narrow<std::uint32_t>(3 * gridTriangleCount(GridKind::geometryImage, patch.implicitMeshSize))}};
    firstTexel += patch.vertexCount;
    descriptions[grid] = std::move(patch);
  }
}

} // namespace

std::optional<EncodedMesh> encodeGeometryImages(const Mesh& mesh, const ConvertOptions& options, ContentFiles& files) {
  if (mesh.topology != Topology::triangles)
    return {};
  const std::vector<ParametrisedChart> charts = parametrise(mesh);
  if (charts.empty())
    return {};
  const SampledMesh grids = sampledAs(options, mesh, charts);
  if (grids.triangles == 0)
    return {};
  EncodedMesh result;
  const EncodeOptions encoding = encodeOptionsFrom(options);
  result.geometry = describe(grids.grids, encoding);
  result.geometry.grid = GridKind::geometryImage;
  result.geometry.surfaceDistance = grids.distance;
  result.geometry.indexType = ElementType::uint16; // there is no index
  result.geometry.patches.resize(grids.sizes.size());
  parallelFor(grids.stacks.size(), [&](std::size_t i) {
    writeStack(grids, grids.stacks[i], result.geometry, encoding, files, result.geometry.patches);
  });
  for (const PatchDescription& patch : result.geometry.patches) {
    result.vertices += patch.vertexCount;
    for (const Draw& draw : patch.draws)
      result.elements += elementsOf(draw);
  }
  noteAttributes(result, mesh, options);
  if (result.hasNormals)
    result.normalErrorDegrees = normalErrorBound(result.geometry) * (180 / std::numbers::pi);
  result.positionError = positionErrorBound(result.geometry);
  result.resampled = ResampledMesh{.name = mesh.name,
                                   .geometryImages = grids.sizes.size(),
                                   .texels = result.vertices,
                                   .largestDistance = grids.distance.largest,
                                   .meanDistance = grids.distance.mean,
                                   .diagonal = length(boxOf(mesh).size())};
  return result;
}

} // namespace imgeo
