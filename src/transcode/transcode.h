#pragma once
// transcode: the one place that knows the order of the steps. The public C++ API.

#include "containers/container.h"
#include "documents/documents.h"
#include "import/import.h"
#include "prepare/normals.h"
#include "prepare/weld.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// How elements are drawn; lines as lines, as line strips or as points.
enum class Primitives { triangles, strips, points };

/// The distance by which quantising may move a vertex.
struct MaxError {
  double value = 0;
  bool isPercent = false; ///< of the mesh's longest edge; otherwise in the source's units
};

/// What images of textures are written as. Data maps (normals, roughness ...) are never lossy.
enum class TextureFormat : std::uint8_t {
  keep, ///< as they are; what no browser shows becomes lossless WebP
  webp,
  avif, ///< data maps: lossless WebP
  png,
};

struct TextureOptions {
  TextureFormat format = TextureFormat::keep;
  std::uint32_t size = 0;         ///< the longest edge, in pixels; 0: as large as it is
  std::optional<int> quality;     ///< 0 .. 100 of lossy ones; nothing: 80 of WebP, 60 of AVIF
  std::uint32_t previewEdge = 64; ///< of what is shown first of a large image, 0 .. 256; 0: no previews
};

struct ConvertOptions {
  std::optional<Encoding> encoding; ///< nothing: compact, or classic where compact cannot hold what is asked for
  Target target = Target::web;
  std::string x3domUrl; ///< target x3dom: the folder of x3dom.js and x3dom.css; empty: a public copy
  Primitives primitives = Primitives::triangles; ///< point clouds are always points
  bool indexed = true; ///< false: a vertex is repeated wherever it is drawn; points never have an index
  /// 8..32; 0: 16, or what `coordType` holds, of Float32 the source's own numbers.
  std::uint32_t positionBits = 0;
  std::optional<MaxError> maxError;     ///< SIG: chooses the position bits of each mesh instead
  std::optional<ElementType> coordType; ///< see EncodeOptions, as `layout`
  Layout layout = Layout::separate;
  NormalEncoding normals = NormalEncoding::rgb;
  std::uint32_t normalBits = 0;                            ///< see EncodeOptions; 0: the fewest that cost nothing
  std::uint32_t texCoordBits = 0, colorBits = 0;           ///< 0: 12 and 8 in compact, 16 and 8 elsewhere
  DroppedElements dropped;                                 ///< elements that are left out; otherwise none
  NormalWeighting normalWeighting = NormalWeighting::area; ///< where the source has no normals
  std::uint32_t patchVertices = 65535;                     ///< 256..4,194,304; above 65,535 with 32-bit indices
  AttributeChoice keepAttributes;                          ///< further attributes of vertices
  std::uint32_t attributeBits = 0;                         ///< SIG: 8, 16 or 24; 0: 16. BG has Float32
  /// Compact: a base of so many percent of the triangles, 0..25; 0: none. Nothing: 2.
  std::optional<double> basePercent;
  TextureOptions textures;
  int effort = 5;       ///< 0 fastest .. 9 smallest
  std::string title;    ///< empty: the source's name
  bool outside = false; ///< the source may refer to files outside of its folder
  bool strict = false;  ///< refuse a source of which something is damaged, instead of leaving that out
  bool force = false;   ///< replace a directory that is not one of our sites
};

/// Bytes of one kind of file.
struct RoleBytes {
  std::string role; ///< "document", "runtime", "index", "coord", "normal", ...
  std::uint64_t bytes = 0;
  std::size_t files = 0;
};

/// A further attribute as it is stored.
struct AttributeReport {
  std::string name;
  std::uint32_t components = 1, bits = 16;
  double error = 0; ///< by which its numbers may be off
};

/// What became of the images of textures.
struct TextureReport {
  std::size_t files = 0, resized = 0, reencoded = 0, previews = 0;
  std::uint64_t sourceBytes = 0, bytes = 0, previewBytes = 0; ///< sourceBytes: as they were found
};

struct ConvertReport {
  std::string format; ///< of the source
  std::uint64_t sourceBytes = 0;
  Encoding encoding = Encoding::classic;
  ElementCounts elements; ///< as they are drawn
  std::size_t vertices = 0, patches = 0;
  WeldReport weld;
  bool normalsComputed = false;
  std::uint32_t leastPositionBits = 0, mostPositionBits = 0; ///< of all meshes
  double largestStep = 0;                                    ///< of all meshes' lattices
  ElementCounts collapsed;                                   ///< that lost their area or length on so coarse a lattice
  double positionError = 0; ///< by which vertices of any mesh may be off, along an axis
  NormalEncoding normalEncoding = NormalEncoding::rgb;
  std::uint32_t normalBits = 0, texCoordBits = 0, colorBits = 0; ///< of a stored component
  double normalErrorDegrees = 0;                                 ///< by which stored normals may be off
  std::optional<double> texCoordError; ///< by which texture coordinates may be off, where there are any
  bool hasNormals = false, hasColors = false;
  std::vector<AttributeReport> attributes;
  TextureReport textures;
  std::string x3domVersion, x3domUrl; ///< target x3dom: the release that the page is for, and its script
  std::vector<RoleBytes> roles;
  double bytesPerTriangle = 0; ///< as SiteInfo has it
  std::vector<std::string> warnings;
  double importSeconds = 0, prepareSeconds = 0, encodeSeconds = 0, totalSeconds = 0;
  std::uint64_t peakMemoryBytes = 0;
};

/// Called from any thread, one call at a time, with the share of the work done, 0..1,
/// and what is being done ("reading"). What it throws ends the conversion.
using Progress = std::function<void(double share, const std::string& doing)>;

/// Converts `input` ("-": standard input) into the site `directory`. The site is
/// built beside its target and takes its place in one step; killed at any
/// moment, the target is the old site or the new one. The same input and options
/// give the same bytes, whatever the number of threads.
/// Throws Error{usage} for options that the encoding cannot honour and for a
/// target that must not be replaced, other Errors for the input and the file
/// system, and what `progress` throws; the target is then untouched.
ConvertReport convert(const std::filesystem::path& input, const std::filesystem::path& directory,
                      const ConvertOptions& options, const Progress& progress = {});

struct SiteFile {
  std::string path; ///< relative to the site
  std::string role; ///< "document" (the page), "runtime", a geometry role, "texture", "preview", "scene",
                    ///< "style", "marker"
  std::uint64_t bytes = 0;
};

/// How the numbers of one geometry are stored.
struct GeometryInfo {
  Encoding encoding = Encoding::classic;
  std::uint32_t positionBits = 0;
  std::string coordType;                                         ///< BG: "Uint16" ...; SIG: empty
  std::string indexType;                                         ///< empty where there is no index
  std::string normalEncoding;                                    ///< empty where there are no normals
  std::uint32_t normalBits = 0, texCoordBits = 0, colorBits = 0; ///< 0: there are none
  std::vector<std::string> attributes;                           ///< names of the further ones
  friend bool operator==(const GeometryInfo&, const GeometryInfo&) = default;
};

struct SiteInfo {
  std::vector<GeometryInfo> geometries; ///< one a shape
  ElementCounts elements;
  std::size_t vertices = 0, patches = 0;
  std::uint64_t documentBytes = 0, containerBytes = 0, runtimeBytes = 0;
  std::uint64_t textureBytes = 0;       ///< with their previews
  std::uint64_t sourceTextureBytes = 0; ///< of the images as the source had them; 0: nobody has noted that
  double bytesPerTriangle = 0;          ///< containers and the document's geometry nodes; 0 without triangles
  std::vector<SiteFile> files;
  std::vector<std::string> missing;  ///< urls of textures and previews that are no files of the site
  std::vector<std::string> warnings; ///< what of the document counts as absent, since it is malformed
};

/// Reads a site (its directory, its index.html or a scene.x3d) without decoding
/// it. The document is index.html where there is one: what a browser fetches
/// is document, runtime, style, containers and textures; `scene` is the same scene for
/// other readers. Safe for untrusted bytes; throws Error, also for files of the geometry
/// and the runtime that are missing.
SiteInfo inspect(const std::filesystem::path& site);

/// What import finds in a file that could be converted.
struct SourceInfo {
  std::string format;
  std::uint64_t bytes = 0;
  ElementCounts elements;
  std::size_t shapes = 0, vertices = 0;
  bool normals = false, texCoords = false, colors = false; ///< in any of its meshes
  std::vector<std::string> attributes;                     ///< names of further ones
  Box3d box;
  std::vector<std::string> warnings;
};

SourceInfo inspectSource(const std::filesystem::path& file, bool outside = false);

/// One geometry file of a site.
struct GeometryFileInfo {
  std::string kind; ///< "PNG image", "typed array"
  std::uint64_t bytes = 0;
  std::uint32_t width = 0, height = 0, channels = 0; ///< 0: no image
  bool namedByContent = false;                       ///< the content is what the name says
};

/// Reads a .png file whole, as the readers of containers do, or any other file's
/// bytes. Safe for untrusted bytes.
GeometryFileInfo inspectGeometryFile(const std::filesystem::path& file);

struct VerifyReport {
  bool equal = false;     ///< all of the below within their bounds
  bool isForeign = false; ///< there is no imgeo.json: another program wrote the site
  ElementCounts input, site, missing, extra;
  double positionError = 0, positionBound = 0; ///< largest error per axis and step / 2, in the mesh's units
  double normalErrorDegrees = 0, normalBoundDegrees = 0;
  std::size_t looks = 0;             ///< shapes whose materials were compared
  double attributeError = 0;         ///< of further attributes, in parts of what their rounding allows
  std::vector<std::string> findings; ///< one sentence per bound that is broken
};

/// Reads the site back through our own readers and compares it with the input,
/// prepared as `convert` does it (weld, drop unreferenced, computed normals). Of a
/// site of another program the files' names and normals that the input lacks are not
/// checked, and its vertices may be off by a twentieth of a step more.
/// Shapes are compared with their places and, where the input is no X3D, whose elements
/// stay as they are, with their materials; lights, viewpoints and pictures are not.
/// `outside`: the input may refer to files outside of its folder.
VerifyReport verify(const std::filesystem::path& site, const std::filesystem::path& input, bool outside = false);

struct ExportReport {
  std::string format; ///< "PLY", "OBJ", "GLB"
  ElementCounts elements;
  std::size_t shapes = 0, vertices = 0;
  std::uint64_t bytes = 0;       ///< of the file written
  std::size_t lightsLeftOut = 0; ///< of a GLB: those that glTF has no words for
};

/// Writes what a site holds as a mesh file, in the format that its name ends in
/// (export/export.h). Reads our sites and those of other writers of X3DOM's
/// containers. Throws Error; {usage} for an ending that stands for no format.
ExportReport exportSite(const std::filesystem::path& site, const std::filesystem::path& output);

/// Writes a generated hall (transcode/sample_hall.h) as GLB, and counts its shapes as
/// often as they are seen. Throws Error{usage} for another ending.
ExportReport writeSampleHall(std::uint32_t seats, const std::filesystem::path& output);

} // namespace imgeo
