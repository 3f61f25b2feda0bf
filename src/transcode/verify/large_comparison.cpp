#include "transcode/verify/large_comparison.h"

#include "transcode/verify/check_levels.h"
#include "transcode/verify/check_point_levels.h"
#include "transcode/verify/mesh_checks.h"
#include "transcode/verify/scattered_site.h"

#include <algorithm>
#include <mutex>

namespace imgeo {

namespace {

void addToWorst(const ElementDifference& difference, ElementDifference& worst) {
  addToWorst(static_cast<const AttributeDifference&>(difference), worst);
  worst.missing += difference.missing;
  worst.extra += difference.extra;
  worst.colorsDiffering += difference.colorsDiffering;
}

} // namespace

LargeComparison::LargeComparison(std::unique_ptr<ChunkedSource> source, const ImportOptions& options,
                                 const SiteManifest& manifest, const GeometryDescription& geometry,
                                 const std::filesystem::path& workFolder, std::uint64_t memory)
    : work_(workFolder, memory), source_(std::move(source), options, manifest, work_), geometry_(geometry) {
  source_.scatterAs(geometry);
}

void LargeComparison::compare(const ContainerReader& reader, const SiteManifest& manifest, VerifyReport& report,
                              Findings& findings) const {
  const ScatteredSite site(reader, geometry_, source_.regions(), work_);
  site.boxes().report(findings);
  const Topology topology = source_.topology();
  if (topology == Topology::points)
    checkPointLevels(*geometry_.levels, reader.fetch(), findings, work_.folder().path());
  else
    checkLevels(*geometry_.levels, reader.fetch(), findings);
  const Mesh& extremes = source_.extremes().scene.meshes.at(0);
  checkAttributesPresent(extremes, {site.firstPatch()}, findings);
  reportPositions(geometry_, source_.positionError(), boxOf(extremes), report, findings);

  const AttributeBounds bounds = boundsOf(geometry_, reader.precisionOf(geometry_), manifest);
  ElementDifference worst;
  ElementTotals totals;
  std::mutex mutex;
  work_.forEach(source_.regions().regionCount(), [&](std::size_t i) {
    const auto region = static_cast<std::uint32_t>(i);
    ElementList ofInput, ofSite;
    try {
      ofInput = source_.elementsOf(region);
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
  if (!extremes.normals.empty())
    report.normalBoundDegrees = std::max(report.normalBoundDegrees, bounds.normalDegrees);
}

} // namespace imgeo
