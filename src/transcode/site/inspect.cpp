// inspect(): the description of a site, from its document and the sizes of its files.

#include "base/error.h"
#include "base/file.h"
#include "containers/encodings.h"
#include "imgeo/site.h"
#include "transcode/site/sequences.h"
#include "transcode/site/site_document.h"
#include "transcode/site/site_files.h"
#include "transcode/site/site_manifest.h"

#include <algorithm>
#include <cctype>
#include <optional>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

std::uint64_t sizeOf(const fs::path& file) {
  std::error_code reason;
  const std::uintmax_t bytes = fs::file_size(file, reason);
  if (reason)
    throw Error(ErrorKind::io, file.string(), "is named by the document but cannot be read: " + reason.message());
  return bytes;
}

/// Adds the numbers of elements and vertices. Documents of other programs need not state them: then the files do, and
/// files that cannot be decoded are warnings.
void addCounts(const GeometryDescription& geometry, const ContainerReader& reader, SiteInfo& info) {
  for (const PatchDescription& patch : geometry.patches) {
    std::vector<Draw> draws = patch.draws;
    std::size_t vertices = patch.vertexCount;
    if (vertices == 0 || std::ranges::any_of(draws, [](const Draw& draw) { return draw.count == 0; }))
      try {
        GeometryDescription decodable = geometry;
        decodable.lattice = reader.latticeOf(geometry);
        const IndexedPatch decoded = reader.decode(patch, decodable);
        draws = decoded.draws;
        vertices = decoded.vertexCount();
      } catch (const Error& error) {
        info.warnings.push_back(error.what());
      }
    for (const Draw& draw : draws)
      info.elements += elementsOf(draw);
    info.vertices += vertices;
  }
}

std::vector<LevelInfo> levelInfosOf(const GeometryDescription& geometry) {
  const LevelIndex& index = geometry.levels->index;
  std::vector<LevelInfo> levels(index.levelCount());
  for (const LevelGroup& group : index.groups) {
    LevelInfo& level = levels[group.level];
    ++level.groups;
    level.triangles += group.triangles;
    level.points += index.hasPoints ? group.vertices : 0;
    level.bytes += group.bytes;
    if (group.level + 1u < levels.size()) {
      double& error = levels[group.level + 1].error;
      error = std::max(error, statedError(group.errorCode) * geometry.lattice.step);
    }
  }
  return levels;
}

GeometryInfo infoOf(const GeometryDescription& geometry, const ContainerReader& reader) {
  GeometryInfo info;
  info.encoding = geometry.encoding;
  info.positionBits = geometry.lattice.bits;
  if (hasElementTypes(geometry.encoding))
    info.coordType = nameOf(geometry.coordType);
  if (std::ranges::any_of(geometry.patches, [](const PatchDescription& patch) { return patch.index.has_value(); }))
    info.indexType = nameOf(geometry.indexType);
  const StoredPrecision precision = reader.precisionOf(geometry);
  info.normalBits = precision.bits[VertexRole::normal];
  info.texCoordBits = precision.bits[VertexRole::texCoord];
  for (const VertexRole role : texCoordRoles)
    info.texCoordSets += precision.bits[role] > 0;
  info.colorBits = precision.bits[VertexRole::color];
  if (info.normalBits > 0)
    info.normalEncoding = nameOf(precision.normalEncoding);
  if (geometry.grid)
    info.grid = nameOf(*geometry.grid);
  if (geometry.surfaceDistance)
    info.surfaceDistance = geometry.surfaceDistance->largest;
  if (geometry.levels)
    info.levels = levelInfosOf(geometry);
  for (const AttributeDescription& attribute : geometry.attributes)
    info.attributes.push_back(attribute.name);
  return info;
}

/// Length of the geometry nodes in a document's text, in bytes.
std::uint64_t geometryNodeBytes(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::uint64_t bytes = 0;
  for (const std::string node : {"imagegeometry", "binarygeometry"})
    for (std::size_t begin = text.find("<" + node); begin != text.npos; begin = text.find("<" + node, begin)) {
      const std::string endTag = "</" + node + ">";
      const std::size_t endsAt = text.find(endTag, begin);
      const std::size_t end = endsAt == text.npos ? text.find('>', begin) : endsAt + endTag.size();
      bytes += std::min(end, text.size()) - begin;
      begin = std::min(end, text.size());
    }
  return bytes;
}

} // namespace

SiteInfo inspect(const fs::path& site) {
  const SiteDocument document = openDocument(site);
  SiteInfo info;
  const auto add = [&](const std::string& url, const char* role) {
    info.files.push_back({url, role, sizeOf(fileOf(document, url))});
    return info.files.back().bytes;
  };
  info.documentBytes = add(document.name, "document");
  std::uint64_t geometryBytes = geometryNodeBytes(document.text);
  for (const InlinedText& inlined : document.inlined) {
    info.documentBytes += add(inlined.url, "document");
    geometryBytes += geometryNodeBytes(inlined.text);
  }
  for (const std::string& url : pageFilesOf(document)) {
    const bool isModule = url.ends_with(".js");
    const std::uint64_t bytes = add(url, isModule ? "runtime" : "style");
    if (isModule)
      info.runtimeBytes += bytes;
  }
  for (const NamedFile& file : geometryFilesOf(document.scene))
    info.containerBytes += add(file.url, nameOf(file.role));
  for (const SiteSequence& sequence : sequencesOf(document)) {
    info.frames += sequence.index.frameCount();
    info.frameBytes += add(sequence.url, "frames");
    for (std::size_t file = 0; file < sequence.index.files.size(); ++file)
      info.frameBytes += add(sequence.urlOf(file), "frames");
    if (!sequence.video.empty())
      info.videoBytes += add(sequence.video, "video");
  }
  const auto addImages = [&](const std::vector<std::string>& urls, const char* role) {
    for (const std::string& url : urls)
      if (exists(document, url))
        info.textureBytes += add(url, role);
      else
        info.missing.push_back(url);
  };
  addImages(textureFilesOf(document.scene), "texture");
  addImages(previewFilesOf(document.scene), "preview");
  info.warnings = document.scene.warnings;
  info.timeSensors = countNodes<TimeSensor>(document.scene.graph);
  info.interpolators = countNodes<Interpolator>(document.scene.graph);
  info.skins = countNodes<Humanoid>(document.scene.graph);
  info.displacers = countNodes<Displacer>(document.scene.graph);
  if (const auto routes = document.scene.otherElements.find("ROUTE"); routes != document.scene.otherElements.end())
    info.routes = routes->second;

  const ContainerReader reader(fetchFrom(document));
  for (const GeometryDescription& geometry : document.scene.geometries) {
    info.geometries.push_back(infoOf(geometry, reader));
    info.patches += geometry.patches.size();
    addCounts(geometry, reader, info);
  }
  std::error_code ignored;
  if (document.name == pageName && fs::exists(document.root / sceneName, ignored))
    add(sceneName, "scene");
  for (const char* name : {iconName, pictureName})
    if (document.name == pageName && fs::exists(document.root / name, ignored))
      add(name, "picture");
  if (fs::exists(document.root / manifestName, ignored)) {
    add(manifestName, "marker");
    const SiteManifest manifest =
        readManifest(asText(readFile(document.root / manifestName)), (document.root / manifestName).string());
    info.sourceTextureBytes = manifest.sourceTextureBytes;
    // The document gives lengths of strips, which include degenerate triangles; the manifest has the number drawn.
    if (manifest.primitives == Primitives::strips)
      info.elements.triangles = manifest.elements.triangles;
  }
  if (info.elements.triangles > 0)
    info.bytesPerTriangle =
        static_cast<double>(info.containerBytes + geometryBytes) / static_cast<double>(info.elements.triangles);
  return info;
}

} // namespace imgeo
