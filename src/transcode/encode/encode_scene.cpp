#include "transcode/encode/encode_scene.h"

#include "containers/encodings.h"
#include "scene/skin.h"
#include "transcode/encode/base_files.h"
#include "transcode/encode/encode_report.h"
#include "transcode/encode/geometry_images.h"
#include "transcode/encode/height_map.h"
#include "transcode/encode/load_groups.h"
#include "transcode/encode/patch_files.h"
#include "transcode/encode/sequence.h"
#include "transcode/encode/spatial_order.h"
#include "transcode/encode/tiny_meshes.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

/// Replaces the mesh index of every shape by a geometry index; geometries are the used meshes in the order of their
/// first use. Returns the mesh index of each geometry.
std::vector<std::size_t> numberGeometries(SceneGraph& graph) {
  std::vector<std::size_t> meshOf;
  std::map<std::size_t, std::size_t> geometryOf;
  for (const std::size_t node : shapeNodes(graph)) {
    Shape& shape = std::get<Shape>(graph.nodes[node].content);
    const auto [geometry, isNew] = geometryOf.try_emplace(shape.mesh, meshOf.size());
    if (isNew)
      meshOf.push_back(shape.mesh);
    shape.mesh = geometry->second;
  }
  return meshOf;
}

std::vector<Box3d> boxesOf(const SceneMeshes& meshes, const std::vector<std::size_t>& meshOf,
                           const std::map<std::size_t, WrittenMesh>& written) {
  std::vector<Box3d> boxes;
  boxes.reserve(meshOf.size());
  for (const std::size_t mesh : meshOf) {
    const auto found = written.find(mesh);
    boxes.push_back(found != written.end() ? found->second.box : meshes.box(mesh));
  }
  return boxes;
}

EncodedMesh encode(Mesh mesh, const SceneEncoding& encoding, const Atlas& atlas) {
  const ConvertOptions& options = encoding.options;
  if (options.form == MeshForm::geometryImage && !isDeformed(mesh))
    if (std::optional<EncodedMesh> encoded = encodeGeometryImages(mesh, options, encoding.files)) {
      encoding.done(mesh.elementCount());
      return *std::move(encoded);
    }
  if (options.form == MeshForm::heightMap) {
    EncodedMesh encoded = encodeHeightMap(mesh, options, encoding.files);
    encoding.done(mesh.elementCount());
    return encoded;
  }
  return encodeMesh(std::move(mesh), options, encoding.files, encoding.done, atlas);
}

class SceneEncoder {
public:
  SceneEncoder(SceneSource&& source, const SceneEncoding& encoding)
      : encoding_(encoding), recordings_(source.recordings), written_(std::move(source.written)),
        stored_(source.stored), meshes_(std::move(source.scene.meshes)),
        sharing_(rowOf(*encoding.options.encoding).sharing), baseFiles_(encoding.files, sharing_),
        patchFiles_(encoding.files, sharing_, encoding.options.effort),
        tinyMeshes_(document_, encoding.options, encoding.files, patchFiles_, encoding.report, encoding.done, stored_) {
    document_.graph = std::move(source.scene.graph);
    meshOf_ = numberGeometries(document_.graph);
    document_.geometries.resize(meshOf_.size());
    isEncoded_.resize(meshOf_.size());
    hasNormals_.resize(meshOf_.size());
    groups_ = loadGroups(document_.graph);
    if (sharing_ && meshOf_.size() >= minTinyMeshScene)
      transforms_ = transformsAbove(document_.graph);
  }

  EncodedScene run() {
    const std::vector<Box3d> boxes = boxesOf(SceneMeshes(meshes_, stored_), meshOf_, written_);
    for (const std::size_t node : spatialOrder(document_.graph, boxes))
      encodeGeometryOf(node);
    tinyMeshes_.finish();
    const double normalError = patchFiles_.finish(document_.geometries);
    ConvertReport& report = encoding_.report;
    report.normalErrorDegrees = std::max(report.normalErrorDegrees, normalError * (180 / std::numbers::pi));
    baseFiles_.finish(document_.geometries);
    return {std::move(document_), std::move(hasNormals_)};
  }

private:
  /// Encodes the geometry of a shape, unless that has been done for a shape before.
  void encodeGeometryOf(std::size_t node) {
    const std::size_t geometry = shapeOf(document_.graph, node).mesh, number = meshOf_[geometry];
    if (isEncoded_[geometry])
      return;
    isEncoded_[geometry] = true;
    if (const auto written = written_.find(number); written != written_.end()) {
      encoding_.done(meshes_[number].elementCount());
      take(std::move(written->second.encoded), geometry, node);
      return;
    }
    const bool isStored = stored_ && stored_->has(number);
    Mesh mesh = isStored ? stored_->read(number) : std::move(meshes_[number]);
    if (const Recording* recording = recordingOf(geometry))
      encodeFrames(std::move(mesh), *recording, geometry);
    else if (!transforms_.empty() && isTiny(mesh, encoding_.options))
      tinyMeshes_.add(std::move(mesh), geometry, groups_[node], transforms_[node],
                      isStored ? std::optional(number) : std::nullopt);
    else {
      const Atlas atlas = atlasOf(document_.graph, geometry, mesh);
      take(encode(std::move(mesh), encoding_, atlas), geometry, node);
    }
  }

  void take(EncodedMesh encoded, std::size_t geometry, std::size_t node) {
    addToReport(encoding_.report, encoded);
    hasNormals_[geometry] = encoded.hasNormals;
    if (encoded.base)
      baseFiles_.add(std::move(encoded.base), geometry);
    if (encoded.small)
      patchFiles_.add(std::move(encoded.small), geometry, groups_[node]);
    document_.geometries[geometry] = std::move(encoded.geometry);
  }

  /// nullptr if the geometry is not one of a recording.
  const Recording* recordingOf(std::size_t geometry) const {
    const auto found = std::ranges::find(recordings_, geometry, [&](const Recording& recording) {
      return shapeOf(document_.graph, recording.shape).mesh;
    });
    return found != recordings_.end() ? &*found : nullptr;
  }

  /// Writes a sequence, of which the document gets the URL.
  void encodeFrames(Mesh mesh, const Recording& recording, std::size_t geometry) {
    EncodedSequence sequence =
        encodeSequence(std::move(mesh), recording, encoding_.ofSequences, encoding_.files, encoding_.done);
    const EncodedFrames& frames = sequence.frames;
    Interpolator& interpolator = std::get<Interpolator>(document_.graph.nodes[recording.interpolator].content);
    interpolator.url = frames.url;
    interpolator.video = frames.video;
    ConvertReport& report = encoding_.report;
    addToReport(report, sequence.still);
    report.frames += frames.index.frameCount();
    report.frameRate = recording.rate;
    for (const SequenceFile& file : frames.index.files)
      report.frameBytes += file.bytes;
    report.videoBytes += frames.videoBytes;
    document_.geometries[geometry] = std::move(sequence.still.geometry);
  }

  SceneEncoding encoding_;
  std::span<const Recording> recordings_;
  std::map<std::size_t, WrittenMesh> written_;
  const StoredMeshes* stored_;
  std::vector<Mesh> meshes_; ///< those in memory, until they are encoded
  SceneDocument document_;
  std::vector<std::size_t> meshOf_; ///< by geometry
  std::vector<std::size_t> groups_; ///< by node
  const FileSharing* sharing_;
  BaseFiles baseFiles_;
  PatchFiles patchFiles_;
  TinyMeshes tinyMeshes_;
  std::vector<std::size_t> transforms_; ///< by node, where tiny meshes share geometry nodes; otherwise empty
  std::vector<bool> isEncoded_, hasNormals_;
};

} // namespace

EncodedScene encodeScene(SceneSource&& source, const SceneEncoding& encoding) {
  return SceneEncoder(std::move(source), encoding).run();
}

} // namespace imgeo
