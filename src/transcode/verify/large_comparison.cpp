#include "transcode/verify/large_comparison.h"

#include "transcode/node_geometry/prepare_as.h"
#include "transcode/verify/check_levels.h"
#include "transcode/verify/check_point_levels.h"
#include "transcode/verify/mesh_checks.h"
#include "transcode/verify/scattered_site.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

void addToWorst(const ElementDifference& difference, ElementDifference& worst) {
  addToWorst(static_cast<const AttributeDifference&>(difference), worst);
  worst.missing += difference.missing;
  worst.extra += difference.extra;
  worst.colorsDiffering += difference.colorsDiffering;
}

/// An element where there will be those of a large mesh, whose shapes are kept for it.
Mesh placeholderOf(const ChunkedMesh& mesh) {
  Mesh placeholder;
  placeholder.topology = mesh.topology();
  placeholder.positions.resize(1);
  placeholder.wedgePositions = {0};
  placeholder.corners.resize(mesh.elementCount() > 0 ? cornersPerElement(mesh.topology()) : 0);
  placeholder.normals = {{0, 0, 1}};
  return placeholder;
}

/// Begins with a mesh, whose work files the destructor removes.
class WorkOfMesh {
public:
  WorkOfMesh(VerifyWork& work, std::size_t mesh) : work_(work) { work_.beginMesh(mesh); }
  ~WorkOfMesh() { work_.endMesh(); }
  WorkOfMesh(const WorkOfMesh&) = delete;
  WorkOfMesh& operator=(const WorkOfMesh&) = delete;

private:
  VerifyWork& work_;
};

} // namespace

LargeComparison::LargeComparison(ChosenComparison chosen, const ImportOptions& options, const SiteManifest& manifest,
                                 const std::filesystem::path& workFolder, std::uint64_t memory)
    : source_(std::move(chosen.source)), options_(options), manifest_(manifest),
      work_(workFolder, memory - std::min(memory, chosen.wholeBytes + chosen.structureBytes)),
      input_(source_->readScene(chosen.storesWhole ? std::set<std::size_t>() : chosen.whole, options_)) {
  std::uint64_t disk = 0;
  for (const std::size_t mesh : chosen.large) {
    work_.beginMesh(mesh);
    const auto [source, isNew] = sources_.try_emplace(mesh, source_->mesh(mesh), options_, manifest_, work_);
    disk = std::max(disk, source->second.diskBytes());
  }
  work_.folder().requireDisk(disk);
  std::vector<Mesh>& meshes = input_.scene.meshes;
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh)
    if (!chosen.whole.contains(mesh))
      meshes[mesh] = placeholderOf(source_->mesh(mesh));
  if (chosen.storesWhole)
    store(chosen.whole);
  prepareAs(manifest_, input_.scene, source_->name());
  for (const auto& [mesh, source] : sources_)
    meshes.at(mesh) = source.extremes();
  if (sources_.empty())
    source_.reset(); // what it knows of many meshes takes memory
}

/// Prepares meshes and writes them to the disk. Of each an element is in the scene.
void LargeComparison::store(const std::set<std::size_t>& meshes) {
  work_.beginWholeMeshes();
  stored_ = std::make_unique<MeshFiles>();
  for (const std::set<std::size_t>& batch : batchesOf(*source_, meshes, work_.batchElements())) {
    const std::string file = fileOfBatch(batch);
    work_.folder().write(file, readBatch(*source_, batch, options_, [&](Scene& scene) {
                           prepareAs(manifest_, scene, source_->name());
                           return PreparationReport{};
                         }));
    stored_->add(work_.folder().file(file));
  }
  for (const std::size_t mesh : stored_->emptyMeshes())
    input_.scene.meshes.at(mesh) = {};
}

void LargeComparison::compare(std::size_t mesh, const ContainerReader& reader, const GeometryDescription& geometry,
                              VerifyReport& report, Findings& findings) {
  ScatteredSource& source = sources_.at(mesh);
  std::optional<WorkOfMesh> folder;
  try {
    folder.emplace(work_, mesh);
    source.scatterAs(geometry);
  } catch (const Error& error) {
    throw WorkFault{error};
  }
  const ScatteredSite site(reader, geometry, source.regions(), work_);
  site.boxes().report(findings);
  const Topology topology = source.topology();
  if (topology == Topology::points)
    checkPointLevels(*geometry.levels, reader.fetch(), findings, work_.folder().path());
  else
    checkLevels(*geometry.levels, reader.fetch(), findings);
  checkAttributesPresent(source.extremes(), {site.firstPatch()}, findings);
  reportPositions(geometry, source.positionError(), boxOf(source.extremes()), report, findings);

  const AttributeBounds bounds = boundsOf(geometry, reader.precisionOf(geometry), manifest_);
  ElementDifference worst;
  ElementTotals totals;
  std::mutex mutex;
  work_.forEach(source.regions().regionCount(), [&](std::size_t i) {
    const auto region = static_cast<std::uint32_t>(i);
    ElementList ofInput, ofSite;
    try {
      ofInput = source.elementsOf(region);
      ofSite = site.elementsOf(region);
    } catch (const Error& error) {
      throw WorkFault{error};
    }
    const ElementTotals each{ofInput.elements.size(), ofSite.elements.size()};
    const ElementDifference difference = imgeo::compare(std::move(ofInput), std::move(ofSite), bounds);
    const std::lock_guard lock(mutex);
    addToWorst(difference, worst);
    totals.input += each.input;
    totals.site += each.site;
  });
  addCounts(worst, totals, topology, report);
  addFindings(worst, bounds, topology, report, findings);
  if (!source.extremes().normals.empty())
    report.normalBoundDegrees = std::max(report.normalBoundDegrees, bounds.normalDegrees);
}

} // namespace imgeo
