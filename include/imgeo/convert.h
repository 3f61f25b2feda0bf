#pragma once
/// @file
/// Conversion of a mesh or scene file into a site.

#include "imgeo/elements.h"
#include "imgeo/encoding.h"
#include "imgeo/preparation.h"
#include "imgeo/ranks.h"
#include "imgeo/source_axes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// How triangles are drawn.
enum class Primitives : std::uint8_t {
  triangles, ///< triangles; lines as separate segments
  strips,    ///< triangle strips; lines as line strips. Not in compact
  points,    ///< vertices only
};

/// "triangles", "strips", "points".
const char* nameOf(Primitives primitives);
/// "area", "angle", "uniform".
const char* nameOf(NormalWeighting weighting);

/// Side from which a scene is shown first. The front is +z, as in glTF.
enum class StartView : std::uint8_t {
  automatic, ///< the source's first viewpoint, else a three-quarter view that shows much of the surface
  front,
  left, ///< from -x
  back,
  right,
  top,
  bottom,
};

/// The largest distance by which quantisation may move a vertex.
struct MaxError {
  double value = 0;       ///< greater than 0
  bool isPercent = false; ///< true: percent of the mesh's longest edge; false: units of the source
};

/// What the triangles of a source become.
enum class MeshForm : std::uint8_t {
  mesh,          ///< the source's vertices and triangles, quantised
  geometryImage, ///< surfaces that are sampled anew on regular grids (Gu, Gortler and Hoppe 2002), in SIG classic
  heightMap,     ///< regular grids of heights, such as elevation models, as images of heights in SIG classic
  sequence, ///< as mesh, but shapes with animated joints or morph targets become frames, ConvertOptions::rate a second
  video,    ///< the frames of a sequence, as a lossless video beside their files
};

/// Which meshes get levels of detail (docs/massive.md).
enum class LevelChoice : std::uint8_t {
  never,
  automatic, ///< meshes of more than 2,000,000 triangles and clouds of more points, in compact
  always,    ///< all meshes of triangles and point clouds that do not fit into one group
};

/// The edge of the largest grid, in texels.
inline constexpr std::uint32_t maxGridEdge = 4096;

/// File format of texture images. Data maps (normals, roughness ...) are never lossy.
enum class TextureFormat : std::uint8_t {
  keep, ///< the source's files; formats that no browser displays become lossless WebP
  webp, ///< WebP
  avif, ///< AVIF; data maps become lossless WebP
  png,  ///< PNG
};

/// Options for texture images.
struct TextureOptions {
  TextureFormat format = TextureFormat::keep; ///< file format
  std::uint32_t size = 0;                     ///< longest edge in pixels; larger images are shrunk; 0: unlimited
  std::optional<int> quality{};               ///< 0..100 for lossy formats; default: 80 for WebP, 60 for AVIF
  std::uint32_t previewEdge = 64;             ///< longest edge of previews of large images, 0..256; 0: no previews
};

/// Options of a conversion. The defaults are those of the command line.
struct ConvertOptions {
  std::optional<Encoding> encoding{}; ///< default: compact, or classic if compact cannot hold what is asked for
  Target target = Target::web;        ///< runtime that shows the site
  std::string x3domUrl{};             ///< target x3dom: folder of x3dom.js and x3dom.css; empty: a public copy
  MeshForm form = MeshForm::mesh;     ///< meshes, geometry images, videos or height maps
  std::uint32_t grid = 0; ///< geometry images: a mesh gets grid * grid texels, 4..maxGridEdge; 0: 256, or by maxError
  std::uint32_t gridImageEdge = 2048; ///< grids: columns and rows of an image, 16..2048; larger ones have several
  Primitives primitives = Primitives::triangles; ///< point clouds are always points
  bool indexed = true;                    ///< false: vertices are repeated instead of indexed; points have no index
  std::uint32_t positionBits = 0;         ///< 8..32, compact 8..30; 0: 16, or what `coordType` holds
  std::optional<MaxError> maxError{};     ///< SIG: chooses the position bits of each mesh instead of positionBits;
                                          ///< geometry images: the largest distance between the surfaces
  std::optional<ElementType> coordType{}; ///< BG: type of coordinates; default: smallest unsigned type
  Layout layout = Layout::separate;       ///< BG: order of attributes
  ImageFormat images = ImageFormat::png;  ///< classic: file format of its images
  NormalEncoding normals = NormalEncoding::rgb; ///< how normals are stored; compact replaces rgb by octahedral
  std::uint32_t normalBits = 0;   ///< bits of a stored component; 0: 8, or more in BG if that costs no bytes
  std::uint32_t texCoordBits = 0; ///< compact: 1..16; classic: 8, 16, 24; BG: 8, 16, 32; 0: 12 in compact, 16 elsewhere
  std::uint32_t colorBits = 0;    ///< compact: 1..8; classic: 8, 16, 24; BG: 8, 16, 32; 0: 8. With at
                                  ///< most 8, colours of sources with more are rounded to 8 first
  DroppedElements dropped{};      ///< elements to leave out
  NormalWeighting normalWeighting = NormalWeighting::area; ///< for meshes without normals
  /// Edges at which triangles meet at a larger angle are sharp in meshes without normals: 0 .. 180. Default: 39 for the
  /// formats that Assimp reads, and for PLY, OBJ, STL and OFF if the shape seems to be a man-made object, otherwise
  /// 180.
  std::optional<double> creaseDegrees{};
  std::uint32_t patchVertices = 65535; ///< maximum of vertices in a patch, 256..4,194,304
  AttributeChoice keepAttributes{};    ///< further vertex attributes to keep
  std::uint32_t attributeBits = 0;     ///< SIG: bits of a further attribute, 8, 16 or 24; 0: 16
  std::optional<double> basePercent{}; ///< compact: triangles of the base mesh in percent, 0..25; default: 2
  bool findInstances = true; ///< shapes whose meshes are equal, also moved and turned, share one (docs/massive.md)
  LevelChoice levels = LevelChoice::automatic; ///< meshes and clouds with levels of detail
  std::uint32_t groupTriangles = 32768;        ///< maximum of triangles, or points, in a group of a level, 256..262,144
  std::uint32_t regionTriangles = 1u << 20;    ///< triangles of a region of a level, 4096..4,194,304
  std::uint64_t memoryBytes = 0;         ///< at least 2^28: PLY and binary STL files whose conversion would take more
                                         ///< memory are converted out of core; 0: three quarters of the machine's
  std::filesystem::path workFolder{};    ///< out of core: intermediate files; empty: a folder beside the site
  bool resume = false;                   ///< out of core: go on where an earlier run ended
  RankOptions ranks{};                   ///< out of core: processes that share the work, each with the same options
  TextureOptions textures{};             ///< texture images
  SourceAxesOptions axes{};              ///< axes and unit of the source
  double rate = 30;                      ///< frames per second of a sequence, above 0, at most 1000
  StartView view = StartView::automatic; ///< side from which the scene is shown first
  bool pictures = true;                  ///< draw the page's icon and the picture that previews of links show
  bool precompress = false;              ///< write FILE.br and FILE.gz for static hosts that compress nothing
  int effort = 5;                        ///< 0 fastest .. 9 smallest
  std::string title{};                   ///< title of the page; empty: the source's title or file name
  bool outside = false;                  ///< the source may refer to files outside of its folder
  bool strict = false;                   ///< refuse damaged sources instead of leaving the damaged content out
  bool force = false;                    ///< replace a directory that is not an imgeo site
};

/// Bytes of all files of one role.
struct RoleBytes {
  std::string role;        ///< "document", "runtime", "index", "coord", "normal" ...
  std::uint64_t bytes = 0; ///< sum of the files' sizes
  std::size_t files = 0;   ///< number of files
};

/// A stored further vertex attribute.
struct AttributeReport {
  std::string name;             ///< the source's name
  std::uint32_t components = 1; ///< 1..4
  std::uint32_t bits = 16;      ///< bits of a stored component
  double error = 0;             ///< maximum of a component's error
};

/// A mesh that became geometry images. Distances are those of points of either surface from the nearest point of the
/// other, in units of the source, at all vertices and at up to 100,000 points of each surface.
struct ResampledMesh {
  std::string name;               ///< of the source's mesh; may be empty
  std::size_t geometryImages = 0; ///< one for each chart of the surface, or several where an image cannot hold it
  std::size_t texels = 0;         ///< of all its geometry images
  double largestDistance = 0;     ///< the maximum
  double meanDistance = 0;        ///< the mean; of the two directions the larger
  double diagonal = 0;            ///< of the mesh's box
};

/// What was done to texture images.
struct TextureReport {
  std::size_t files = 0;          ///< texture images
  std::size_t resized = 0;        ///< images that were shrunk
  std::size_t reencoded = 0;      ///< images written in another format or size
  std::size_t previews = 0;       ///< preview images
  std::uint64_t sourceBytes = 0;  ///< size of the source's images
  std::uint64_t bytes = 0;        ///< size of the written images
  std::uint64_t previewBytes = 0; ///< size of the previews
};

/// Files that were compressed in advance, and the bytes that clients load instead.
struct PrecompressReport {
  std::size_t files = 0;         ///< files that a content coding makes smaller: text and BG's typed arrays
  std::uint64_t bytes = 0;       ///< their size
  std::uint64_t brotliBytes = 0; ///< the same for a client that accepts brotli
  std::uint64_t gzipBytes = 0;   ///< the same for a client that accepts gzip
};

/// Shapes that were found to be others, moved and turned.
struct InstanceReport {
  std::size_t shapes = 0;     ///< that show the mesh of another shape
  std::size_t meshes = 0;     ///< that the site does not have for that reason
  double largestDistance = 0; ///< of their vertices from where the source has them, in units of the source
};

/// What a conversion chose, wrote and measured.
struct ConvertReport {
  std::string format;                                  ///< format of the source: "PLY" ...
  std::uint64_t sourceBytes = 0;                       ///< size of the source
  SourceAxesReport axes;                               ///< how the source was brought upright and to metres
  std::array<double, 3> origin{};                      ///< point of the source that is 0 in the site
  Encoding encoding = Encoding::classic;               ///< the encoding chosen
  ElementCounts elements;                              ///< elements as drawn
  std::size_t vertices = 0;                            ///< vertices of all patches
  std::size_t patches = 0;                             ///< patches of all meshes
  std::uint32_t largestPatch = 0;                      ///< vertices of the largest patch
  std::size_t grids = 0;                               ///< patches that are grids, which have no index
  WeldReport weld;                                     ///< what welding did
  bool normalsComputed = false;                        ///< normals of at least one mesh were computed
  EdgeReport edges;                                    ///< of meshes without normals
  std::uint32_t minPositionBits = 0;                   ///< minimum over all meshes
  std::uint32_t maxPositionBits = 0;                   ///< maximum over all meshes
  double maxStep = 0;                                  ///< largest lattice step of all meshes, in units of the source
  ElementCounts collapsed;                             ///< elements that lost their area or length on the lattice
  double positionError = 0;                            ///< maximum of a vertex's error along an axis
  NormalEncoding normalEncoding = NormalEncoding::rgb; ///< how normals are stored
  std::uint32_t normalBits = 0;                        ///< bits of a normal's stored component
  std::uint32_t texCoordBits = 0;                      ///< bits of a texture coordinate
  std::uint32_t colorBits = 0;                         ///< bits of a colour's component
  double normalErrorDegrees = 0;                       ///< maximum of a normal's error
  std::optional<double> texCoordError;                 ///< maximum of a texture coordinate's error, if there are any
  bool hasNormals = false;                             ///< a mesh has normals
  bool hasColors = false;                              ///< a mesh has vertex colours
  double colorError = 0;                               ///< maximum error of a colour's channel, which is 0..1
  std::vector<AttributeReport> attributes;             ///< further attributes that were kept
  std::vector<ResampledMesh> resampled;                ///< meshes that became geometry images
  InstanceReport instances;                            ///< shapes that share the meshes of others
  TextureReport textures;                              ///< texture images
  std::size_t resampledTextures = 0;                   ///< meshes whose levels have images of new charts
  std::string x3domVersion;                            ///< target x3dom: the release that the page loads
  std::string x3domUrl;                                ///< target x3dom: URL of its script
  std::size_t frames = 0;                              ///< frames of a sequence; 0: the site has none
  double frameRate = 0;                                ///< frames per second
  std::uint64_t frameBytes = 0;                        ///< size of all frames
  std::uint64_t videoBytes = 0;                        ///< size of the video of the frames; 0: there is none
  std::vector<RoleBytes> roles;                        ///< sizes by role of the files
  double bytesPerTriangle = 0;                         ///< geometry files and nodes; 0 if there are no triangles
  PrecompressReport precompressed;                     ///< files compressed in advance, with option precompress
  std::vector<std::string> warnings;                   ///< one sentence each
  double importSeconds = 0;                            ///< time to read the source
  double prepareSeconds = 0;                           ///< time to weld and to compute normals
  double encodeSeconds = 0;                            ///< time to encode and write
  double precompressSeconds = 0;                       ///< time to compress files in advance
  double totalSeconds = 0;                             ///< time of the whole conversion
  std::size_t tasks = 0;                               ///< that several ranks shared; 0: there was one rank
  std::size_t tasksTaken = 0;                          ///< by this one
  std::uint64_t peakMemoryBytes = 0;                   ///< maximum of the process's resident memory; 0: unknown
};

/// Receives the share of the work that is done, 0..1, and the name of the current step ("reading"). Called from any
/// thread, one call at a time. An exception that it throws ends the conversion.
using Progress = std::function<void(double share, const std::string& step)>;

/// Converts `input` (a path; "-": standard input) into the site `directory`. The site is built beside its target and
/// replaces it in one step: after a crash the target is the old site or the new one. Equal input and options give equal
/// bytes, independent of the number of threads.
///
/// Where several ranks share the work, rank 0 writes the site, and the others return when it is in its place,
/// with a report that has the tasks, the total time and the memory alone. Where the source is not converted out
/// of core, rank 0 converts it alone.
///
/// Throws Error{usage} for options that contradict each other and for a target that must not be replaced, other Errors
/// for the input and the file system, and what `progress` throws. The target is unchanged then.
ConvertReport convert(const std::filesystem::path& input, const std::filesystem::path& directory,
                      const ConvertOptions& options = {}, const Progress& progress = {});

/// Converts the frames of a sequence, a file for each in their order, all with the elements of the first, into a site
/// that plays them (docs/sequences.md). Otherwise as convert(); a single file is converted by it. The encoding is SIG
/// classic. Throws Error{malformed} for a frame that has other elements than the first.
ConvertReport convertSequence(const std::vector<std::filesystem::path>& frames, const std::filesystem::path& directory,
                              const ConvertOptions& options = {}, const Progress& progress = {});

} // namespace imgeo
