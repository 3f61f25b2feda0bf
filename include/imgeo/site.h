#pragma once
/// @file
/// Reading of a site: inspect() describes it, readSiteMeshes() decodes its meshes.

#include "imgeo/elements.h"
#include "imgeo/encoding.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace imgeo {

/// A file of a site.
struct SiteFile {
  std::string path;        ///< relative to the site
  std::string role;        ///< "document" (the page), "runtime", "coord" and other geometry roles, "frames", "video",
                           ///< "texture", "preview", "picture", "scene", "style", "marker"
  std::uint64_t bytes = 0; ///< size
};

/// A level of detail of a geometry.
struct LevelInfo {
  std::size_t groups = 0;      ///< files
  std::uint64_t triangles = 0; ///< of all groups
  std::uint64_t points = 0;    ///< of all groups; of a mesh 0
  std::uint64_t bytes = 0;     ///< of all groups
  /// Largest stated distance of the geometry from this level, in its units; 0 on level 0.
  double error = 0;
  /// Whether all members are equal.
  friend bool operator==(const LevelInfo&, const LevelInfo&) = default;
};

/// How the numbers of one geometry are stored.
struct GeometryInfo {
  Encoding encoding = Encoding::classic; ///< encoding of the patches
  std::uint32_t positionBits = 0;        ///< bits of a coordinate
  std::string coordType;                 ///< BG: "Uint16" ...; SIG: empty
  std::string indexType;                 ///< empty if there is no index
  std::string normalEncoding;            ///< empty if there are no normals
  std::uint32_t normalBits = 0;          ///< 0: there are no normals
  std::uint32_t texCoordBits = 0;        ///< 0: there are no texture coordinates
  std::uint32_t texCoordSets = 0;        ///< sets of texture coordinates, 0..4
  std::uint32_t colorBits = 0;           ///< 0: there are no colours
  std::vector<std::string> attributes;   ///< names of further attributes
  std::string grid;                      ///< "heightMap", "geometryImage" or "sculpt"; empty: vertices in sequence
  std::vector<LevelInfo> levels;         ///< levels of detail, from 0; empty if there are none
  double surfaceDistance = 0;            ///< geometry images: as ResampledMesh::largestDistance; 0: not stated
  /// Whether all members are equal.
  friend bool operator==(const GeometryInfo&, const GeometryInfo&) = default;
};

/// Description of a site.
struct SiteInfo {
  std::vector<GeometryInfo> geometries; ///< every geometry of the document
  ElementCounts elements;               ///< elements of all geometries
  std::size_t vertices = 0;             ///< vertices of all patches
  std::size_t patches = 0;              ///< patches of all geometries
  std::size_t timeSensors = 0;          ///< TimeSensors: an animation has one
  std::size_t interpolators = 0;        ///< interpolators that are linear between their keys
  std::size_t routes = 0;               ///< ROUTEs
  std::size_t skins = 0;                ///< HAnimHumanoids, whose joints move vertices
  std::size_t displacers = 0;           ///< HAnimDisplacers: morph targets
  std::size_t frames = 0;               ///< frames of all sequences
  std::uint64_t frameBytes = 0;         ///< size of their files
  std::uint64_t videoBytes = 0;         ///< size of the videos of the same frames
  std::uint64_t documentBytes = 0;      ///< size of the document and of those that it inlines
  std::uint64_t containerBytes = 0;     ///< size of the geometry files
  std::uint64_t runtimeBytes = 0;       ///< size of the runtime's modules
  std::uint64_t textureBytes = 0;       ///< size of the textures and their previews
  std::uint64_t sourceTextureBytes = 0; ///< size of the source's images; 0: unknown
  double bytesPerTriangle = 0;          ///< geometry files and nodes; 0 if there are no triangles
  std::vector<SiteFile> files;          ///< files in the order of first mention
  std::vector<std::string> missing;     ///< URLs of textures and previews that are not files of the site
  std::vector<std::string> warnings;    ///< malformed content of the document, which is ignored
};

/// Reads a site (its directory, its index.html or a scene.x3d). Decodes geometry only where its node does not state the
/// numbers of vertices and elements. Safe for untrusted bytes. Throws Error, also for files of geometry and runtime
/// that are missing.
SiteInfo inspect(const std::filesystem::path& site);

/// A further vertex attribute.
struct SiteAttribute {
  std::string name;             ///< the document's name
  std::uint32_t components = 1; ///< 1..4
  std::vector<float> values;    ///< `components` numbers a vertex
};

/// A decoded mesh. Attributes are empty, or have one entry for each vertex.
struct SiteMesh {
  std::string name;                                                ///< of the first shape that shows it; may be empty
  Topology topology = Topology::triangles;                         ///< kind of elements
  std::vector<std::array<float, 3>> positions;                     ///< local coordinates
  std::vector<std::array<float, 3>> normals;                       ///< unit length
  std::vector<std::array<float, 2>> texCoords;                     ///< first set
  std::vector<std::vector<std::array<float, 2>>> furtherTexCoords; ///< sets beside the first, up to 3
  std::vector<std::array<std::uint8_t, 4>> colors;                 ///< RGBA, rounded to 8 bits
  std::vector<SiteAttribute> attributes;                           ///< further attributes
  std::vector<std::uint32_t> indices; ///< vertex indices: 3 a triangle, 2 a line, 1 a point
};

/// An instance of a shape in the scene.
struct SiteShape {
  std::string name;                       ///< DEF name of the shape's node; may be empty
  std::size_t mesh = 0;                   ///< index into SiteMeshes::meshes
  std::array<double, 16> worldFromMesh{}; ///< 4 x 4 matrix by columns, as in glTF
};

/// The meshes of a site and where the scene shows them.
struct SiteMeshes {
  std::vector<SiteMesh> meshes;  ///< every mesh once
  std::vector<SiteShape> shapes; ///< instances in document order
};

/// Decodes the meshes of a site (its directory, its index.html or a scene.x3d). The patches of a mesh are joined.
/// Triangles without area are dropped. Safe for untrusted bytes. Throws Error; {malformed} if nothing is drawn.
SiteMeshes readSiteMeshes(const std::filesystem::path& site);

} // namespace imgeo
