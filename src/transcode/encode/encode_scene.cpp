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

EncodedMesh encode(Mesh mesh, const ConvertOptions& options, ContentFiles& files, const ElementsDone& done,
                   const Atlas& atlas) {
  if (options.form == MeshForm::geometryImage && !isDeformed(mesh))
    if (std::optional<EncodedMesh> encoded = encodeGeometryImages(mesh, options, files)) {
      done(mesh.elementCount());
      return *std::move(encoded);
    }
  if (options.form == MeshForm::heightMap) {
    EncodedMesh encoded = encodeHeightMap(mesh, options, files);
    done(mesh.elementCount());
    return encoded;
  }
  return encodeMesh(std::move(mesh), options, files, done, atlas);
}

/// Writes a sequence, of which the document gets the URL.
GeometryDescription encodeFrames(Mesh mesh, const Recording& recording, const ConvertOptions& options,
                                 ContentFiles& files, SceneGraph& graph, ConvertReport& report,
                                 const ElementsDone& done) {
  EncodedSequence sequence = encodeSequence(std::move(mesh), recording, options, files, done);
  const EncodedFrames& frames = sequence.frames;
  Interpolator& interpolator = std::get<Interpolator>(graph.nodes[recording.interpolator].content);
  interpolator.url = frames.url;
  interpolator.video = frames.video;
  addToReport(report, sequence.still);
  report.frames += frames.index.frameCount();
  report.frameRate = recording.rate;
  for (const SequenceFile& file : frames.index.files)
    report.frameBytes += file.bytes;
  report.videoBytes += frames.videoBytes;
  return std::move(sequence.still.geometry);
}

} // namespace

EncodedScene encodeScene(Scene&& scene, const ConvertOptions& options, std::span<const Recording> recordings,
                         const ConvertOptions& ofSequences, std::map<std::size_t, WrittenMesh> written,
                         const StoredMeshes* stored, ContentFiles& files, ConvertReport& report,
                         const ElementsDone& done) {
  SceneDocument document;
  document.graph = std::move(scene.graph);
  const std::vector<std::size_t> meshOf = numberGeometries(document.graph);
  document.geometries.resize(meshOf.size());
  const std::vector<std::size_t> groups = loadGroups(document.graph);
  const FileSharing* sharing = rowOf(*options.encoding).sharing;
  BaseFiles baseFiles(files, sharing);
  PatchFiles patchFiles(files, sharing, options.effort);
  TinyMeshes tinyMeshes(document, options, files, patchFiles, report, done, stored);
  const bool sharesNodes = meshOf.size() >= minTinyMeshScene && sharing != nullptr;
  const std::vector<std::size_t> transforms =
      sharesNodes ? transformsAbove(document.graph) : std::vector<std::size_t>{};
  std::vector<bool> isEncoded(meshOf.size()), hasNormals(meshOf.size());
  for (const std::size_t node :
       spatialOrder(document.graph, boxesOf(SceneMeshes(scene.meshes, stored), meshOf, written))) {
    const std::size_t geometry = shapeOf(document.graph, node).mesh;
    if (isEncoded[geometry])
      continue;
    isEncoded[geometry] = true;
    Mesh& mesh = scene.meshes[meshOf[geometry]];
    const bool isStored = stored && stored->has(meshOf[geometry]);
    if (isStored)
      mesh = stored->read(meshOf[geometry]);
    if (const auto found = written.find(meshOf[geometry]); found != written.end()) {
      addToReport(report, found->second.encoded);
      hasNormals[geometry] = found->second.encoded.hasNormals;
      document.geometries[geometry] = std::move(found->second.encoded.geometry);
      done(mesh.elementCount());
      continue;
    }
    if (const auto recording = std::ranges::find(
            recordings, geometry, [&](const Recording& each) { return shapeOf(document.graph, each.shape).mesh; });
        recording != recordings.end()) {
      document.geometries[geometry] =
          encodeFrames(std::move(mesh), *recording, ofSequences, files, document.graph, report, done);
      continue;
    }
    if (sharesNodes && isTiny(mesh, options)) {
      tinyMeshes.add(std::move(mesh), geometry, groups[node], transforms[node],
                     isStored ? std::optional(meshOf[geometry]) : std::nullopt);
      continue;
    }
    const Atlas atlas = atlasOf(document.graph, geometry, mesh);
    EncodedMesh encoded = encode(std::move(mesh), options, files, done, atlas);
    addToReport(report, encoded);
    hasNormals[geometry] = encoded.hasNormals;
    if (encoded.base)
      baseFiles.add(std::move(encoded.base), geometry);
    if (encoded.small)
      patchFiles.add(std::move(encoded.small), geometry, groups[node]);
    document.geometries[geometry] = std::move(encoded.geometry);
  }
  tinyMeshes.finish();
  const double normalError = patchFiles.finish(document.geometries);
  report.normalErrorDegrees = std::max(report.normalErrorDegrees, normalError * (180 / std::numbers::pi));
  baseFiles.finish(document.geometries);
  return {std::move(document), std::move(hasNormals)};
}

} // namespace imgeo
