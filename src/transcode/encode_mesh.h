#pragma once
// A prepared mesh -> the geometry files of a site.

#include "containers/container.h"
#include "transcode/transcode.h"

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace imgeo {

/// The files of a site under construction, each written once however often it
/// is referred to. Safe to call from any thread.
class GeometryFiles {
public:
  /// `site` is the site's root; its geometry folder is made by the first file.
  explicit GeometryFiles(std::filesystem::path site) : site_(std::move(site)) {}

  /// Writes a file named by its content and returns its url, relative to the site.
  std::string write(const EncodedFile& file);

  /// The length of a written file, in bytes.
  std::uint64_t bytesOf(const std::string& url) const { return bytes_.at(url); }

private:
  std::filesystem::path site_;
  std::mutex mutex_;
  std::map<std::string, std::uint64_t> bytes_;
};

/// What became of a mesh, counted as it is drawn.
struct EncodedMesh {
  GeometryDescription geometry;
  ElementCounts elements;
  std::size_t vertices = 0;
  ElementCounts collapsed;       ///< those that lost their area or length on the lattice
  double positionError = 0;      ///< by which its vertices may be off, along an axis
  double normalErrorDegrees = 0; ///< by which its stored normals may be off
};

/// Called with how many more elements have been written.
using ElementsDone = std::function<void(std::size_t count)>;

/// Cuts a mesh into patches and writes them, several at a time; a patch's memory
/// is given back when its files are written, so that the peak is the patches
/// and not their encodings. `mesh` is used up. Deterministic.
EncodedMesh encodeMesh(Mesh mesh, const ConvertOptions& options, GeometryFiles& files,
                       const ElementsDone& done);

} // namespace imgeo
