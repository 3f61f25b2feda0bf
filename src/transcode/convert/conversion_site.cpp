// The steps from encoded meshes to a published site.

#include "base/error.h"
#include "base/file.h"
#include "imgeo/site.h"
#include "imgeo/version.h"
#include "import/warnings.h"
#include "transcode/convert/conversion.h"
#include "transcode/convert/peak_memory.h"
#include "transcode/convert/precompress.h"
#include "transcode/convert/report_sums.h"
#include "transcode/convert/sequence_options.h"
#include "transcode/default_scene/world_box.h"
#include "transcode/encode/textures.h"
#include "transcode/options/resolve_options.h"
#include "transcode/site/site_files.h"
#include "transcode/site/site_pages.h"
#include "transcode/source/preparation.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace imgeo {

void Conversion::completeScene() {
  ContentFiles files(site_.path(), textureFolder);
  report_.textures = writeTextures(document_.graph, options_, files, report_.warnings);
  if (!document_.graph.isComplete) {
    requireDrawable(worldBoxOf(document_).box, locationOf(input_));
    addDefaultNodes(document_, options_.view, viewSamples_, report_.warnings);
  }
}

void Conversion::writeDocuments() {
  writeInlinedDocuments(document_, options_.target, site_.path());
  warnOfCollapsed(report_);
  const PagePictures pictures =
      options_.pictures ? writePictures(document_.graph, pictureSamples_, site_.path()) : PagePictures{};
  writeFile(site_.path() / manifestName, asBytes(writeManifest(manifest(pictures))));
  if (options_.target == Target::x3dom) {
    const X3domRelease release = x3domReleaseFor(*options_.encoding, options_.x3domUrl);
    report_.x3domVersion = release.version;
    report_.x3domUrl = release.files.scriptUrl;
    writeX3domPages(document_, release, pictures, site_.path());
  } else {
    writePages(document_, pictures, site_.path());
  }
}

void Conversion::inspectSite() {
  // Reading the page of many shapes takes as much memory as what is known of them.
  document_ = {};
  pictureSamples_ = {};
  viewSamples_ = {};
  const SiteInfo written = inspect(site_.path());
  report_.roles = sumByRole(written.files);
  report_.bytesPerTriangle = written.bytesPerTriangle;
  if (options_.strict && !written.warnings.empty())
    throw Error(ErrorKind::malformed, locationOf(input_), withoutFullStop(written.warnings.front()));
  std::ranges::copy(written.warnings, std::back_inserter(report_.warnings));
  report_.encodeSeconds = step_.lapSeconds();
}

void Conversion::precompress() {
  if (!options_.precompress)
    return;
  reportProgress(0.995, "compressing");
  report_.precompressed = precompressSite(site_.path());
  report_.precompressSeconds = step_.lapSeconds();
}

void Conversion::publish() {
  reportProgress(1, "publishing");
  site_.publish();
  if (ranks_) {
    ranks_->leave([&] { reportProgress(1, "publishing"); });
    ranks_->removeWork();
  }
  report_.totalSeconds = total_.lapSeconds();
  report_.peakMemoryBytes = peakMemoryBytes();
}

std::set<std::string> Conversion::texCoordNames() const {
  std::set<std::string> names;
  for (const GeometryDescription& geometry : document_.geometries)
    for (const std::string& name : geometry.texCoordMappings)
      names.insert(name.empty() ? attributeRow<VertexRole::texCoord>.gltfName : name);
  return names;
}

SiteManifest Conversion::manifest(const PagePictures& pictures) const {
  std::map<std::string, std::string> pictureContents;
  for (const std::string& url : {pictures.iconUrl, pictures.pictureUrl})
    if (!url.empty())
      pictureContents[url] = contentName(readFile(site_.path() / url));
  std::vector<std::string> attributeNames;
  for (const AttributeReport& attribute : report_.attributes)
    attributeNames.push_back(attribute.name);
  if (options_.keepAttributes.all)
    std::ranges::copy(texCoordNames(), std::back_inserter(attributeNames));
  return {.generator = fmt::format("imgeo {}", version()),
          .source = input_ == "-" ? "" : input_.filename().string(),
          .encoding = *options_.encoding,
          .primitives = options_.primitives,
          .normalsComputed = report_.normalsComputed,
          .normalWeighting = options_.normalWeighting,
          .creaseDegrees = options_.creaseDegrees,
          .guessesCreases = !options_.creaseDegrees && (report_.normalsComputed || report_.edges.flat > 0),
          .flatWithoutNormals = report_.edges.flat > 0,
          .elements = report_.elements,
          .normalErrorDegrees = hasStatedError(options_) ? report_.normalErrorDegrees : 0,
          .axes = report_.axes.axes,
          .dropped = options_.dropped,
          .colorBits = report_.hasColors ? options_.colorBits : 8,
          .attributes = std::move(attributeNames),
          .sequenceRate = recordings_.empty() || frames_.size() > 1 ? 0 : options_.rate,
          .onlyLongSequences = !recordsAll(options_),
          .onlyFirstTexCoords = hasOnlyFirstTexCoords_,
          .instanceDistance =
              report_.instances.shapes > 0 ? std::optional(report_.instances.largestDistance) : std::nullopt,
          .sourceTextureBytes = report_.textures.sourceBytes,
          .pictures = std::move(pictureContents)};
}

} // namespace imgeo
