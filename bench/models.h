#pragma once
// Shared by the benchmarks of models: command line, reading of meshes, sizes of images, and error handling of main.

#include "base/error.h"
#include "containers/patch_encoder.h"
#include "import/import.h"
#include "prepare/normals.h"
#include "prepare/patches.h"
#include "prepare/primitives.h"
#include "prepare/weld.h"

#include <fmt/format.h>
#include <string>
#include <vector>

namespace imgeo::bench {

struct ModelArguments {
  int effort = 0;
  std::vector<std::string> models; ///< at least one
};

/// Reads "[--effort 0..9] MODEL..."; `effort` is the default. Throws Error{usage}.
inline ModelArguments modelArguments(int count, char** words, const std::string& program, int effort) {
  ModelArguments arguments{effort, {}};
  for (int i = 1; i < count; ++i) {
    if (std::string(words[i]) != "--effort") {
      arguments.models.emplace_back(words[i]);
      continue;
    }
    const std::string value = i + 1 < count ? words[++i] : "";
    if (value.size() != 1 || value[0] < '0' || value[0] > '9')
      throw Error(ErrorKind::usage, "--effort", "takes a digit");
    arguments.effort = value[0] - '0';
  }
  if (arguments.models.empty())
    throw Error(ErrorKind::usage, "", "usage: " + program + " [--effort 0..9] MODEL...");
  return arguments;
}

/// Calls visit(mesh) for every mesh of triangles in a file, welded and with normals
/// as `imgeo convert` prepares it.
template <typename Visit> void visitSurfaces(const std::string& model, Visit visit) {
  for (Mesh& mesh : importFile(model).scene.meshes) {
    if (mesh.topology != Topology::triangles)
      continue;
    weld(mesh);
    if (mesh.normals.empty())
      computeNormals(mesh, NormalWeighting::area);
    visit(mesh);
  }
}

/// The patches that `imgeo convert` makes of a mesh with its default options.
inline PatchedMesh patchesOf(const Mesh& mesh) {
  return cutIntoPatches(mesh, latticeFor(boxOf(mesh), 16), 65535);
}

/// The patches of a mesh as triangles in fan order.
inline std::vector<IndexedPatch> patchesInFanOrder(const PatchedMesh& mesh) {
  std::vector<IndexedPatch> patches;
  for (const Patch& patch : mesh.patches)
    patches.push_back(asTriangles(patch));
  return patches;
}

/// Bytes of images of SIG classic.
struct ImageBytes {
  std::size_t index = 0;
  std::size_t high = 0; ///< first coordinate images
  std::size_t low = 0;  ///< further coordinate images
  std::size_t other = 0;

  std::size_t all() const { return index + high + low + other; }

  void add(const EncodedPatch& patch) {
    bool isHigh = true;
    for (const EncodedFile& file : patch.files) {
      const bool isCoord = file.role == Role::coord;
      (file.role == Role::index ? index : !isCoord ? other : isHigh ? high : low) += file.bytes.size();
      isHigh = isHigh && !isCoord;
    }
  }
};

/// For main: calls body(); the exit code is that of an Error, whose sentence is printed.
template <typename Body> int run(Body body) {
  try {
    body();
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exitCode(error.kind());
  }
}

} // namespace imgeo::bench
