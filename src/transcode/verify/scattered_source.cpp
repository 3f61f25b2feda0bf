#include "transcode/verify/scattered_source.h"

#include "base/file.h"
#include "containers/stored_coords.h"
#include "prepare/levels/build_level.h"
#include "prepare/levels/point_levels.h"
#include "prepare/weld.h"
#include "transcode/out_of_core/region_triangles.h"
#include "transcode/verify/mesh_checks.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <utility>

namespace imgeo {

namespace {

/// Disk of a triangle's record beside its floats: those that touch other regions are there several times.
constexpr std::uint64_t spareRecordBytes = 24;
/// The work file of the sample by which regions are chosen, between the survey of all meshes and the comparison of one.
constexpr const char* sampleFile = "sample";

} // namespace

ScatteredSource::ScatteredSource(const ChunkedMesh& mesh, const ImportOptions& options, const SiteManifest& manifest,
                                 const VerifyWork& work)
    : mesh_(mesh), importOptions_(options), work_(work) {
  convertOptions_.colorBits = manifest.colorBits;
  level_.weighting = manifest.normalWeighting;
  const Survey found = survey();
  WorkWriter sample;
  sample.addAll(std::span<const Vec3f>(found.sample));
  work_.folder().write(sampleFile, sample.bytes);
  box_ = found.box;
  level_.layout = found.layout;
  level_.triangles = found.elements;
  level_.computesNormals = found.lacksNormals(manifest.flatWithoutNormals);
  extremes_ = extremesOf(found);
  extremes_.name = found.meshName;
  if (level_.computesNormals) {
    extremes_.normals.assign(2, {0, 0, 1});
    EdgeReport guessed;
    level_.creaseDegrees = found.creaseDegrees(guessed);
  }
}

Survey ScatteredSource::survey() const {
  std::vector<Survey> surveys(mesh_.chunkCount());
  work_.forEach(surveys.size(), [&](std::size_t chunk) {
    surveys[chunk] = surveyPiece(mesh_, chunk, importOptions_, convertOptions_);
  });
  Survey all;
  for (Survey& each : surveys)
    all.add(std::move(each));
  return all;
}

std::uint64_t ScatteredSource::diskBytes() const {
  return level_.triangles * 2 * (level_.layout.recordFloats() * sizeof(float) + spareRecordBytes);
}

void ScatteredSource::scatterAs(const GeometryDescription& geometry) {
  geometry_ = &geometry;
  lattice_ = expectedLattice(geometry, box_);
  level_.lattice = &lattice_;
  level_.frame = frameOfLevel(0);
  const Bytes bytes = readFile(work_.folder().file(sampleFile));
  const std::vector<Vec3f> sample =
      latticePoints(WorkReader(bytes, work_.folder().file(sampleFile)).takeAll<Vec3f>(), &lattice_);
  level_.tree = topology() == Topology::points
                    ? regionsOfPoints(sample, level_.triangles, work_.regionTriangles())
                    : regionsOfSample(sample, level_.triangles, work_.regionTriangles(), level_.frame);
  level_.scatterTasks = mesh_.chunkCount();

  std::mutex mutex;
  work_.forEach(mesh_.chunkCount(), [&](std::size_t chunk) {
    const Imported imported = readPiece(chunk);
    const Mesh& mesh = imported.scene.meshes.at(0);
    const std::vector<Vec3u> quantised = pointsOf(mesh);
    std::vector<Vec3f> points;
    points.reserve(quantised.size());
    for (const Vec3u& point : quantised)
      points.emplace_back(point);
    Scatter scatter(level_);
    for (std::size_t element = 0; element < mesh.elementCount(); ++element)
      scatter.add(mesh, points, element, 0);
    work_.folder().write(taskFile("scatter", 0, chunk), writeScattered(scatter.take()));
    const double error = imgeo::positionError(mesh.positions, quantised, geometry.lattice);
    const std::lock_guard lock(mutex);
    positionError_ = std::max(positionError_, error);
  });
  if (level_.computesNormals)
    work_.forEach(level_.tree.regionCount(), [&](std::size_t region) {
      work_.folder().write(taskFile("normals", 0, region),
                           borderNormalsOf(level_, work_.folder(), static_cast<std::uint32_t>(region)));
    });
}

Imported ScatteredSource::readPiece(std::size_t chunk) const {
  return imgeo::readPiece(mesh_, chunk, importOptions_, convertOptions_);
}

ElementList ScatteredSource::elementsOf(std::uint32_t region) const {
  RegionTriangles triangles(level_, work_.folder(), region);
  std::vector<Vec3f> normals;
  if (level_.computesNormals)
    normals = triangles.ownNormals(triangles.points(), work_.folder(), region);
  Mesh mesh = level_.layout.meshOf(triangles.takeOwnRecords());
  if (level_.computesNormals)
    mesh.normals = std::move(normals);
  weld(mesh);
  return imgeo::elementsOf(mesh, pointsOf(mesh), {.topology = topology()});
}

std::vector<Vec3u> ScatteredSource::pointsOf(const Mesh& mesh) const {
  return quantisedOn(lattice_, *geometry_, mesh.positions);
}

} // namespace imgeo
