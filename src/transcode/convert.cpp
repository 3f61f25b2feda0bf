// The order of the steps: import, prepare, encode, document, exchange.

#include "base/error.h"
#include "base/file.h"
#include "containers/named_attributes.h"
#include "transcode/encode_mesh.h"
#include "transcode/marker.h"
#include "transcode/options.h"
#include "transcode/peak_memory.h"
#include "transcode/preparation.h"
#include "transcode/runtime.h"
#include "transcode/site.h"
#include "transcode/transcode.h"
#include "transcode/x3dom_release.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mutex>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

constexpr const char* generator = "imgeo " IMGEO_VERSION;

/// A warm stone: shape shows by shading, and nothing of it is clipped where both
/// lights meet: (1 + 0.45) * (diffuse + specular) is about 1.
constexpr Material stone{
    .diffuseColor{0.56f, 0.55f, 0.52f}, .specularColor{0.14f, 0.14f, 0.13f}, .shininess = 0.25f};

/// From above and to the left of the viewer, warmer than the headlight, so that
/// carving casts light and shade across the view.
constexpr DirectionalLight keyLight{{-0.45, -0.8, -0.4}, {1.0f, 0.96f, 0.9f}, 0.45f};

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
                  imported.attributes.empty()
                      ? fmt::format("the input has no attribute \"{}\", nor any other", name)
                      : fmt::format("the input has no attribute \"{}\" but {}", name,
                                    fmt::join(imported.attributes, ", ")));
}

/// What a report says of the attributes of a geometry, which are those of others, too.
void addAttributes(std::vector<AttributeReport>& reports, const GeometryDescription& geometry) {
  for (const AttributeDescription& attribute : geometry.attributes) {
    auto report = std::ranges::find(reports, attribute.name, &AttributeReport::name);
    if (report == reports.end())
      report = reports.insert(report, {attribute.name, attribute.components, 0, 0});
    const bool isSig = geometry.container == Container::sig;
    report->bits = std::max(report->bits, isSig ? 8 * attribute.bytes : 32);
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      report->error = std::max(report->error, numberBound(geometry.container, attribute, c));
  }
}

/// Encodes every shape's mesh; two shapes of one mesh share its files.
SceneDocument encodeScene(Scene&& scene, const ConvertOptions& options, GeometryFiles& files,
                          ConvertReport& report, const ElementsDone& done) {
  SceneDocument document;
  document.title = options.title.empty() ? scene.title : options.title;
  constexpr std::size_t notEncoded = ~std::size_t{0};
  std::vector<std::size_t> geometryOf(scene.meshes.size(), notEncoded);
  Box3d whole;
  for (Shape& shape : scene.shapes) {
    std::size_t& geometry = geometryOf[shape.mesh];
    if (geometry == notEncoded) {
      EncodedMesh encoded = encodeMesh(std::move(scene.meshes[shape.mesh]), options, files, done);
      report.elements += encoded.elements;
      report.vertices += encoded.vertices;
      report.patches += encoded.geometry.patches.size();
      report.collapsed += encoded.collapsed;
      report.positionError = std::max(report.positionError, encoded.positionError);
      report.normalErrorDegrees = std::max(report.normalErrorDegrees, encoded.normalErrorDegrees);
      addAttributes(report.attributes, encoded.geometry);
      geometry = document.geometries.size();
      document.geometries.push_back(std::move(encoded.geometry));
    }
    whole.add(document.geometries[geometry].box.min);
    whole.add(document.geometries[geometry].box.max);
    if (shape.material == Material{})
      shape.material = stone;
    // X3D does not light points and lines: it shows their own or the emissive colour.
    const Primitive primitive = document.geometries[geometry].patches.front().draws.front().primitive;
    const bool isSurface = primitive == Primitive::triangles || primitive == Primitive::triangleStrip;
    if (!isSurface && shape.material.emissiveColor == Vec3f{})
      shape.material.emissiveColor = shape.material.diffuseColor;
    shape.mesh = geometry;
    document.shapes.push_back(std::move(shape));
  }
  report.lattice = document.geometries.front().lattice;
  document.viewpoints = std::move(scene.viewpoints);
  if (document.viewpoints.empty())
    document.viewpoints.push_back(viewpointFor(whole));
  document.lights = std::move(scene.lights);
  if (document.lights.empty())
    document.lights.push_back(keyLight);
  document.headlight = scene.headlight;
  return document;
}

/// The documents of a site for X3DOM, which brings its own runtime.
void writeX3domPage(const SceneDocument& document, const X3domRelease& release, const fs::path& site) {
  writeFile(site / sceneName, asBytes(writeX3domX3d(document)));
  writeFile(site / pageName, asBytes(writeX3domHtml(document, release.files, stylesheetName)));
}

/// The documents of a site with our runtime, and it.
void writePage(const SceneDocument& document, const fs::path& site) {
  const Runtime runtime = runtimeOfSite();
  const std::string runtimeUrl = fmt::format("{}/{}", runtimeFolder, runtime.module.name);
  fs::create_directory(site / runtimeFolder);
  for (const RuntimeFile& file : {runtime.module, runtime.worker})
    writeFile(site / runtimeFolder / file.name, asBytes(file.text));
  writeFile(site / sceneName, asBytes(writeX3d(document)));
  writeFile(site / pageName, asBytes(writeHtml(document, {runtimeUrl, stylesheetName})));
}

/// Scans have slivers, a few of which any lattice flattens; more than one element in
/// a hundred speaks of too few bits.
void warnOfCollapsed(ConvertReport& report) {
  const auto warn = [&](Topology topology, const char* lost) {
    if (const std::size_t count = report.collapsed.of(topology); 100 * count > report.elements.of(topology))
      report.warnings.push_back(fmt::format("{} of {} {} have no {} at {} bits", count,
                                            report.elements.of(topology), nameOf(topology), lost,
                                            report.lattice.bits));
  };
  warn(Topology::triangles, "area");
  warn(Topology::lines, "length");
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
  const ConvertOptions options = resolved(given);
  if (input != "-")
    requireOutside(input, directory);
  StagedSite site(directory, options.force);

  ConvertReport report;
  report.normalBits = options.normalBits;
  report.texCoordBits = options.texCoordBits;
  report.colorBits = options.colorBits;
  report.normalEncoding = options.normals;
  Stopwatch total, step;
  const auto tell = [&](double share, const std::string& doing) {
    if (progress)
      progress(share, doing);
  };

  tell(0, "reading");
  Imported imported = importInput(input, {options.keepAttributes}, report.sourceBytes);
  requireAttributes(imported, options);
  report.format = imported.format;
  report.warnings = std::move(imported.warnings);
  if (imported.scene.title.empty())
    imported.scene.title = titleFrom(input);
  // Scripts find shapes by name, and the only object of a file rarely has one.
  if (imported.scene.shapes.size() == 1 && imported.scene.shapes[0].name.empty())
    imported.scene.shapes[0].name = options.title.empty() ? imported.scene.title : options.title;
  report.importSeconds = step.lapSeconds();

  tell(0.2, "preparing");
  PreparationReport prepared = prepareScene(imported.scene, options.normalWeighting, placeOf(input));
  report.weld = prepared.weld;
  report.normalsComputed = prepared.normalsComputed;
  std::ranges::move(prepared.warnings, std::back_inserter(report.warnings));
  report.prepareSeconds = step.lapSeconds();

  tell(0.3, "writing");
  std::size_t elementCount = 0, elementsDone = 0;
  for (const Mesh& mesh : imported.scene.meshes)
    elementCount += mesh.elementCount();
  std::mutex doneMutex;
  GeometryFiles files(site.path());
  const SceneDocument document =
      encodeScene(std::move(imported.scene), options, files, report, [&](std::size_t count) {
        const std::lock_guard lock(doneMutex);
        elementsDone += count;
        tell(0.3 + 0.69 * static_cast<double>(elementsDone) / static_cast<double>(elementCount), "writing");
      });
  warnOfCollapsed(report);
  Marker marker{generator,
                input == "-" ? "" : input.filename().string(),
                options.container,
                options.profile,
                options.primitives,
                report.normalsComputed,
                options.normalWeighting,
                report.elements,
                hasStatedError(options) ? report.normalErrorDegrees : 0,
                {}};
  for (const AttributeReport& attribute : report.attributes)
    marker.attributes.push_back(attribute.name);
  writeFile(site.path() / stylesheetName, asBytes(pageStylesheet()));
  writeFile(site.path() / markerName, asBytes(writeMarker(marker)));
  if (options.target == Target::x3dom) {
    const X3domRelease release = x3domReleaseFor(options.container, options.x3domUrl);
    report.x3domVersion = release.version;
    report.x3domUrl = release.files.scriptUrl;
    writeX3domPage(document, release, site.path());
  } else {
    writePage(document, site.path());
  }
  const SiteInfo written = inspect(site.path());
  report.roles = sumByRole(written.files);
  report.bytesPerTriangle = written.bytesPerTriangle;
  report.encodeSeconds = step.lapSeconds();

  tell(1, "publishing");
  site.publish();
  report.totalSeconds = total.lapSeconds();
  report.peakMemoryBytes = peakMemoryBytes();
  return report;
}

} // namespace imgeo
