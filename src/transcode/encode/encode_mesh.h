#pragma once
// A prepared mesh -> the geometry files of a site.

#include "containers/compact/compact_patch.h"
#include "containers/container.h"
#include "transcode/transcode.h"

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace imgeo {

/// The files of one folder of a site under construction, each written once however
/// often it is referred to. Safe to call from any thread.
class ContentFiles {
public:
  /// `site` is the site's root; its folder is made by the first file.
  ContentFiles(std::filesystem::path site, std::string folder) : site_(std::move(site)), folder_(std::move(folder)) {}

  /// Writes a file named by its content and returns its url, relative to the site.
  std::string write(ByteSpan bytes, const std::string& extension);

  /// The length of a written file, in bytes.
  std::uint64_t bytesOf(const std::string& url) const { return bytes_.at(url); }

private:
  std::filesystem::path site_;
  std::string folder_;
  std::mutex mutex_;
  std::map<std::string, std::uint64_t> bytes_;
};

/// What became of a mesh, counted as it is drawn.
struct EncodedMesh {
  GeometryDescription geometry;
  std::optional<compact::CompactPatch> base;  ///< the geometry's, which has no file yet
  std::optional<compact::CompactPatch> small; ///< its only patch, which has none either: many share one
  ElementCounts elements;
  std::size_t vertices = 0;
  ElementCounts collapsed;       ///< those that lost their area or length on the lattice
  double positionError = 0;      ///< by which its vertices may be off, along an axis
  double normalErrorDegrees = 0; ///< by which its stored normals may be off
  bool hasNormals = false, hasColors = false;
  std::optional<double> texCoordError; ///< by which its texture coordinates may be off, where it has any
};

/// Called with how many more elements have been written.
using ElementsDone = std::function<void(std::size_t count)>;

/// Vertices (wedges) of a patch of compact that shares its file with others, at most; and
/// of all patches of such a file: docs/decisions/compact.md has the measurement.
inline constexpr std::size_t sharedFileVertices = 16384;

/// Cuts a mesh into patches and writes them, but for what is to share a file, several at a time; a patch's
/// memory is given back when its files are written, so that the peak is the patches and not their encodings.
/// `mesh` is used up. Deterministic.
EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done);

} // namespace imgeo
