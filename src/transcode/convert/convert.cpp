// The order of the steps: import, prepare, encode, document, exchange.

#include "base/error.h"
#include "base/file.h"
#include "documents/page_sanitizer.h"
#include "import/warnings.h"
#include "transcode/convert/peak_memory.h"
#include "transcode/convert/resolve_options.h"
#include "transcode/encode/encode_scene.h"
#include "transcode/site/runtime.h"
#include "transcode/site/site_manifest.h"
#include "transcode/site/staged_site.h"
#include "transcode/site/x3dom_release.h"
#include "transcode/source/preparation.h"
#include "transcode/transcode.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mutex>
#include <ranges>
#include <set>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

constexpr const char* generator = "imgeo " IMGEO_VERSION;

class Stopwatch {
public:
  /// Since it was made, or since the last call.
  double lapSeconds() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(lap_, now)).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point lap_ = Clock::now();
};

/// The exchange would remove the input with the directory it lies in.
void requireOutside(const fs::path& input, const fs::path& directory) {
  std::error_code none;
  const fs::path file = fs::weakly_canonical(input, none), target = fs::weakly_canonical(directory, none);
  if (std::mismatch(target.begin(), target.end(), file.begin(), file.end()).first == target.end())
    throw Error(ErrorKind::usage, input.string(), "lies inside the directory that is to be replaced");
}

/// The name of the input without its endings, "statue" for "scans/statue.ply.gz".
std::string titleFrom(const fs::path& input) {
  if (input == "-")
    return "Untitled";
  fs::path name = input.filename();
  if (name.extension() == ".gz")
    name = name.stem();
  return name.stem();
}

void requireAttributes(const Imported& imported, const ConvertOptions& options) {
  for (const std::string& name : options.keepAttributes.names)
    if (std::ranges::find(imported.attributes, name) == imported.attributes.end())
      throw Error(ErrorKind::usage, "--keep-attributes",
                  imported.attributes.empty() ? fmt::format("the input has no attribute \"{}\", nor any other", name)
                                              : fmt::format("the input has no attribute \"{}\" but {}", name,
                                                            fmt::join(imported.attributes, ", ")));
}

/// A title of the user's wins over the source's own, which wins over the file's name.
void nameScene(SceneGraph& graph, const std::string& title, bool isWanted) {
  if (isWanted || graph.title.empty())
    graph.title = title;
  if (graph.isComplete)
    return;
  // Scripts find shapes by name, and the only object of a file rarely has one.
  const std::vector<std::size_t> shapes = shapeNodes(graph);
  if (shapes.size() == 1 && graph.nodes[shapes[0]].name.empty())
    graph.nodes[shapes[0]].name = graph.title;
}

std::size_t documentOf(const SceneGraph& graph, std::size_t inlineNode) {
  return *std::get<GenericNode>(graph.nodes[inlineNode].content).document;
}

/// The documents that the scene inlines, the innermost first: they are named by their
/// content, and the url is part of that of the one around.
void writeInlinedDocuments(SceneDocument& document, Target target, const fs::path& site) {
  std::vector<std::size_t> firstInlines; // of each document; what stands in it comes behind
  std::set<std::size_t> seen;
  for (const std::size_t node : nodesInOrder(document.graph))
    if (inlinesDocument(document.graph.nodes[node]) && seen.insert(documentOf(document.graph, node)).second)
      firstInlines.push_back(node);
  for (const std::size_t node : firstInlines | std::views::reverse) {
    const std::string text =
        target == Target::x3dom ? writeInlinedX3domX3d(document, node) : writeInlinedX3d(document, node);
    std::string& url = document.graph.inlined[documentOf(document.graph, node)].url;
    url = contentName(asBytes(text)) + ".x3d";
    writeFile(site / url, asBytes(text));
  }
}

/// The documents of a site for X3DOM, which brings its own runtime.
void writeX3domPage(const SceneDocument& document, const X3domRelease& release, const fs::path& site) {
  writeFile(site / sceneName, asBytes(writeX3domX3d(document)));
  writeFile(site / pageName, asBytes(writeX3domHtml(document, release.files, stylesheetName)));
}

/// The documents of a site with our runtime, and it.
void writePage(const SceneDocument& document, const fs::path& site) {
  const Runtime runtime = runtimeOfSite();
  const auto urlOf = [](const RuntimeFile& file) { return fmt::format("{}/{}", runtimeFolder, file.name); };
  fs::create_directory(site / runtimeFolder);
  for (const RuntimeFile& file : {runtime.page, runtime.shared, runtime.scene, runtime.worker})
    writeFile(site / runtimeFolder / file.name, asBytes(file.text));
  writeFile(site / sceneName, asBytes(writeX3d(document)));
  writeFile(site / pageName,
            asBytes(writeHtml(document,
                              {urlOf(runtime.page), stylesheetName, {urlOf(runtime.shared)}, {urlOf(runtime.scene)}})));
}

/// Scans have slivers, a few of which any lattice flattens; more than one element in
/// a hundred speaks of too few bits.
void warnOfCollapsed(ConvertReport& report) {
  const auto warn = [&](Topology topology, const char* lost) {
    if (const std::size_t count = report.collapsed.of(topology); 100 * count > report.elements.of(topology))
      report.warnings.push_back(fmt::format("{} of {} {} have no {} at {} bits", count, report.elements.of(topology),
                                            nameOf(topology), lost, report.leastPositionBits));
  };
  warn(Topology::triangles, "area");
  warn(Topology::lines, "length");
}

void warnOfPage(const SceneGraph& graph, ConvertReport& report) {
  std::vector<std::string> elements;
  for (const auto& [element, count] : elementsLeftOutOfPage(graph))
    elements.push_back(fmt::format("{} ({})", element, count));
  if (!elements.empty())
    report.warnings.push_back(
        fmt::format("{} alone has what does not go into a page: {}", sceneName, fmt::join(elements, ", ")));
}

/// Bytes by role, in the order in which `inspect` lists the roles.
std::vector<RoleBytes> sumByRole(const std::vector<SiteFile>& files) {
  std::vector<RoleBytes> roles;
  for (const SiteFile& file : files) {
    auto role = std::ranges::find(roles, file.role, &RoleBytes::role);
    if (role == roles.end())
      role = roles.insert(role, {file.role, 0, 0});
    role->bytes += file.bytes;
    ++role->files;
  }
  return roles;
}

} // namespace

ConvertReport convert(const fs::path& input, const fs::path& directory, const ConvertOptions& given,
                      const Progress& progress) {
  resolved(given); // says at once what cannot be
  if (input != "-")
    requireOutside(input, directory);
  StagedSite site(directory, given.force);

  ConvertReport report;
  Stopwatch total, step;
  const auto tell = [&](double share, const std::string& doing) {
    if (progress)
      progress(share, doing);
  };

  tell(0, "reading");
  Imported imported = importInput(input,
                                  {.attributes = given.keepAttributes,
                                   .folder = {},
                                   .outside = given.outside,
                                   .inlineBytes = inlineBytes,
                                   .strict = given.strict},
                                  report.sourceBytes);
  requireAttributes(imported, given);
  const ConvertOptions options = resolvedFor(imported.scene, given);
  report.encoding = *options.encoding;
  report.normalBits = options.normalBits;
  report.texCoordBits = options.texCoordBits;
  report.colorBits = options.colorBits;
  report.normalEncoding = options.normals;
  report.format = imported.format;
  report.warnings = std::move(imported.warnings);
  nameScene(imported.scene.graph, options.title.empty() ? titleFrom(input) : options.title, !options.title.empty());
  report.importSeconds = step.lapSeconds();

  tell(0.2, "preparing");
  PreparationReport prepared =
      prepareScene(imported.scene, options.dropped, options.normalWeighting, locationOf(input));
  report.weld = prepared.weld;
  report.normalsComputed = prepared.normalsComputed;
  std::ranges::move(prepared.warnings, std::back_inserter(report.warnings));
  report.prepareSeconds = step.lapSeconds();

  tell(0.3, "writing");
  std::size_t elementCount = 0, elementsDone = 0;
  for (const Mesh& mesh : imported.scene.meshes)
    elementCount += mesh.elementCount();
  std::mutex doneMutex;
  SiteContent content{{site.path(), geometryFolder}, {site.path(), textureFolder}};
  SceneDocument document = encodeScene(std::move(imported.scene), options, content, report, [&](std::size_t count) {
    const std::lock_guard lock(doneMutex);
    elementsDone += count;
    tell(0.3 + 0.69 * static_cast<double>(elementsDone) / static_cast<double>(elementCount), "writing");
  });
  writeInlinedDocuments(document, options.target, site.path());
  warnOfCollapsed(report);
  warnOfPage(document.graph, report);
  SiteManifest manifest{generator,
                        input == "-" ? "" : input.filename().string(),
                        *options.encoding,
                        options.primitives,
                        report.normalsComputed,
                        options.normalWeighting,
                        report.elements,
                        hasStatedError(options) ? report.normalErrorDegrees : 0,
                        options.dropped,
                        {},
                        report.textures.sourceBytes};
  for (const AttributeReport& attribute : report.attributes)
    manifest.attributes.push_back(attribute.name);
  writeFile(site.path() / stylesheetName, asBytes(pageStylesheet()));
  writeFile(site.path() / manifestName, asBytes(writeManifest(manifest)));
  if (options.target == Target::x3dom) {
    const X3domRelease release = x3domReleaseFor(*options.encoding, options.x3domUrl);
    report.x3domVersion = release.version;
    report.x3domUrl = release.files.scriptUrl;
    writeX3domPage(document, release, site.path());
  } else {
    writePage(document, site.path());
  }
  const SiteInfo written = inspect(site.path());
  report.roles = sumByRole(written.files);
  report.bytesPerTriangle = written.bytesPerTriangle;
  if (options.strict && !written.warnings.empty())
    throw Error(ErrorKind::malformed, locationOf(input), withoutFullStop(written.warnings.front()));
  std::ranges::copy(written.warnings, std::back_inserter(report.warnings));
  report.encodeSeconds = step.lapSeconds();

  tell(1, "publishing");
  site.publish();
  report.totalSeconds = total.lapSeconds();
  report.peakMemoryBytes = peakMemoryBytes();
  return report;
}

} // namespace imgeo
