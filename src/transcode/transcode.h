#pragma once
// transcode: the one place that knows the order of the steps. The public C++ API.

#include "containers/container.h"
#include "documents/documents.h"
#include "prepare/normals.h"
#include "prepare/weld.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace imgeo {

enum class Primitives { triangles, strips, points };

struct ConvertOptions {
  Container container = Container::sig;
  Primitives primitives = Primitives::triangles; ///< point clouds are always points
  std::uint32_t positionBits = 16;               ///< 8..32
  std::uint32_t normalBits = 8;                  ///< see EncodeOptions
  NormalWeighting normalWeighting = NormalWeighting::area; ///< where the source has no normals
  std::uint32_t patchVertices = 65535;           ///< 256..65,535
  int effort = 5;                                ///< 0 fastest .. 9 smallest
  std::string title;                             ///< empty: the source's name
  bool force = false;                            ///< replace a directory that is not one of our sites
};

/// Bytes of one kind of file.
struct RoleBytes {
  std::string role; ///< "document", "runtime", "index", "coord", "normal", ...
  std::uint64_t bytes = 0;
  std::size_t files = 0;
};

struct ConvertReport {
  std::string format;                ///< of the source
  std::uint64_t sourceBytes = 0;
  std::size_t triangles = 0, vertices = 0, points = 0, patches = 0;
  WeldReport weld;
  bool normalsComputed = false;
  Lattice lattice;                   ///< of the first mesh: step states the precision
  std::vector<RoleBytes> roles;
  std::vector<std::string> warnings;
  double importSeconds = 0, prepareSeconds = 0, encodeSeconds = 0, totalSeconds = 0;
  std::uint64_t peakMemoryBytes = 0;
};

/// Called from any thread, serialised, with the share of the work done, 0..1, and what is being done.
using Progress = std::function<void(double share, const std::string& doing)>;

/// Converts `input` into the site `directory`. The site is built beside its
/// target and takes its place in one step; killed at any moment, the target is
/// the old site or the new one. Throws Error; the target is then untouched.
ConvertReport convert(const std::filesystem::path& input, const std::filesystem::path& directory,
                      const ConvertOptions& options, const Progress& progress = {});

struct SiteFile {
  std::string path; ///< relative to the site
  std::string role; ///< "document", "runtime", or a geometry role
  std::uint64_t bytes = 0;
};

struct SiteInfo {
  std::size_t triangles = 0, vertices = 0, points = 0, patches = 0;
  std::uint64_t documentBytes = 0, containerBytes = 0, runtimeBytes = 0;
  double bytesPerTriangle = 0; ///< containers and the document's geometry nodes; 0 without triangles
  std::vector<SiteFile> files;
};

/// Reads a site (its directory, its index.html or its scene.x3d) without decoding it.
SiteInfo inspect(const std::filesystem::path& site);

struct VerifyReport {
  bool equal = false;               ///< all of the below within their bounds
  std::size_t inputTriangles = 0, siteTriangles = 0, missingTriangles = 0, extraTriangles = 0;
  std::size_t inputPoints = 0, sitePoints = 0, missingPoints = 0, extraPoints = 0;
  double positionError = 0, positionBound = 0;  ///< largest error per axis and step / 2, in the mesh's units
  double normalErrorDegrees = 0, normalBoundDegrees = 0;
  std::vector<std::string> findings; ///< one sentence per bound that is broken
};

/// Reads the site back through our own readers and compares it with the input,
/// prepared as `convert` does it (weld, drop unreferenced, computed normals).
VerifyReport verify(const std::filesystem::path& site, const std::filesystem::path& input);

} // namespace imgeo
