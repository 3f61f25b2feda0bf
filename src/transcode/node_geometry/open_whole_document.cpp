#include "transcode/node_geometry/open_whole_document.h"

#include "base/data_url.h"
#include "containers/patch_encoder.h"
#include "containers/stored_coords.h"
#include "import/x3d/geometry_nodes.h"
#include "transcode/node_geometry/prepare_as.h"
#include "transcode/source/preparation.h"

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// A lattice whose steps are a power of two and which has a point at 0, so that it changes no number but those that are
/// tiny beside the mesh, and is the same for a mesh whose box has been rounded. Its cube is as readers of BG expect it:
/// twice to four times as large as the box.
Lattice latticeOfFloats(const Box3d& box) {
  Lattice lattice;
  lattice.bits = sourceBits;
  const double edge = box.longestEdge() > 0 ? 2 * box.longestEdge() : 1;
  lattice.step = std::exp2(std::ceil(std::log2(edge / lattice.maximum())));
  for (int axis = 0; axis < 3; ++axis)
    lattice.origin[axis] =
        std::floor((box.center()[axis] - lattice.step * lattice.maximum() / 2) / lattice.step) * lattice.step;
  return lattice;
}

/// The mesh as arrays that hold its numbers.
GeometryDescription encodedInDocument(Mesh mesh) {
  const EncodeOptions options{.encoding = Encoding::bg,
                              .normalBits = 32,
                              .effort = 0,
                              .coordType = ElementType::float32,
                              .texCoordBits = 32,
                              .colorBits = 32};
  const Lattice lattice = latticeOfFloats(boxOf(mesh));
  PatchedMesh patched = cutIntoPatches(std::move(mesh), lattice, maxPatchWedges);
  GeometryDescription geometry = describe(patched, options);
  for (Patch& patch : patched.patches) {
    const EncodedPatch encoded = encodePatch(std::move(patch), geometry, options);
    std::vector<std::string> urls;
    for (const EncodedFile& file : encoded.files)
      urls.push_back(dataUrlOf(file.bytes, "application/octet-stream"));
    geometry.patches.push_back(describeWithUrls(encoded, urls));
  }
  return geometry;
}

/// Reads geometry nodes of all documents of a site.
class NodeReader {
public:
  explicit NodeReader(const fs::path& folder)
      : manifest_(manifestIn(folder)), options_(importOptionsFor(manifest_, false)) {}

  std::optional<NodeGeometry> read(std::string_view text, const std::string& name, std::size_t offset) {
    std::unique_ptr<GeometryNodes>& nodes = documents_[name];
    if (!nodes)
      nodes = std::make_unique<GeometryNodes>(text, name, options_);
    std::optional<NodeMesh> node = nodes->read(offset);
    if (!node)
      return {};
    NodeGeometry read{{}, node->solid};
    if (node->mesh.corners.empty())
      return read;
    Scene scene = prepared(std::move(node->mesh), name);
    if (scene.meshes[0].elementCount() > 0)
      read.geometry = encodedInDocument(std::move(scene.meshes[0]));
    return read;
  }

private:
  Scene prepared(Mesh mesh, const std::string& name) const {
    Scene scene;
    scene.graph.isComplete = true; // so that it may become empty
    addRoot(scene.graph, {"", Shape{}, {}, ""});
    scene.meshes.push_back(std::move(mesh));
    if (manifest_)
      prepareAs(*manifest_, scene, name);
    else
      prepareScene(scene, {.byteColors = false}, name);
    return scene;
  }

  std::optional<SiteManifest> manifest_;
  ImportOptions options_;
  std::map<std::string, std::unique_ptr<GeometryNodes>> documents_; ///< by name
};

} // namespace

SiteDocument openWholeDocument(const fs::path& site) {
  std::error_code ignored;
  NodeReader reader(fs::is_directory(site, ignored) ? site : site.parent_path());
  return openDocument(site, [&](std::string_view text, const std::string& name, std::size_t offset) {
    return reader.read(text, name, offset);
  });
}

} // namespace imgeo
