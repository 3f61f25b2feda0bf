#include "transcode/site/sequences.h"

#include "base/file.h"
#include "containers/unit_vectors.h"
#include "sequence/sequence_file.h"
#include "video/sequence_video.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace imgeo {

std::string SiteSequence::urlOf(std::size_t file) const {
  return (std::filesystem::path(url).parent_path() / index.files.at(file).url).string();
}

void readFrames(const SiteDocument& document, const SiteSequence& sequence, std::uint32_t first, std::uint32_t end,
                const std::function<void(const live::Frame&)>& visit) {
  if (sequence.video.empty())
    return readFrameFiles(document, sequence, first, end, visit);
  const std::filesystem::path path = fileOf(document, sequence.video);
  decodeVideoFrames(readFile(path), sequence.index, first, end, path.string(), visit);
}

void readFrameFiles(const SiteDocument& document, const SiteSequence& sequence, std::uint32_t first, std::uint32_t end,
                    const std::function<void(const live::Frame&)>& visit) {
  const SequenceIndex& index = sequence.index;
  for (std::size_t file = index.fileOf(first); file < index.files.size() && index.firstFrameOf(file) < end; ++file) {
    const std::filesystem::path path = fileOf(document, sequence.urlOf(file));
    decodeSequenceFile(
        readFile(path), index, file, path.string(),
        [&](const live::Frame& frame) {
          if (frame.number >= first)
            visit(frame);
        },
        end);
  }
}

void moveVertices(Mesh& mesh, const live::Frame& frame, const SequenceIndex& index) {
  const live::Description& description = index.description;
  const live::FrameLayout& layout = frame.layout;
  const std::size_t vertices = layout.vertices;
  const Vec3d origin = description.origin();
  const double step = description.step();
  for (std::size_t i = 0; i < vertices; ++i)
    mesh.positions[mesh.wedgePositions[i]] = Vec3f(
        origin +
        Vec3d{double(frame.component(0)[i]), double(frame.component(1)[i]), double(frame.component(2)[i])} * step);
  std::uint32_t component = 3;
  mesh.normals.clear();
  if (layout.normalBits > 0) {
    for (std::size_t i = 0; i < vertices; ++i)
      mesh.normals.push_back(
          unitFromOctahedral({frame.component(component)[i], frame.component(component + 1)[i]}, layout.normalBits));
    component += 2;
  }
  if (layout.colorComponents > 0) {
    mesh.colors.assign(vertices, Rgba(0, 0, 0, 1));
    mesh.colorComponents = layout.colorComponents;
    for (std::size_t i = 0; i < vertices; ++i) {
      const auto channel = [&](std::uint32_t c) {
        return static_cast<float>(frame.component(component + c)[i] / 255.0);
      };
      mesh.colors[i] = {channel(0), channel(1), channel(2), layout.colorComponents == 4 ? channel(3) : 1};
    }
    component += layout.colorComponents;
  }
  const auto values = std::ranges::find(mesh.namedAttributes, index.valueName, &NamedAttribute::name);
  if (layout.valueComponents == 0 || values == mesh.namedAttributes.end() ||
      values->components != layout.valueComponents)
    return;
  const double largest = std::exp2(layout.valueBits) - 1;
  for (std::uint32_t c = 0; c < layout.valueComponents; ++c) {
    const auto [min, max] = description.valueRange[c];
    for (std::size_t i = 0; i < vertices; ++i)
      values->values[i * layout.valueComponents + c] =
          static_cast<float>(min + frame.component(component + c)[i] / largest * (max - min));
  }
}

Mesh meshOfFrame(const IndexedPatch& still, const live::Frame& frame, const SequenceIndex& index) {
  const std::size_t vertices = frame.layout.vertices;
  Mesh mesh;
  static_cast<VertexAttributes&>(mesh) = still;
  mesh.topology = still.draws.empty() ? Topology::triangles : topologyOf(still.draws.front().primitive);
  mesh.corners = still.indices;
  mesh.positions.resize(vertices);
  mesh.wedgePositions.resize(vertices);
  std::iota(mesh.wedgePositions.begin(), mesh.wedgePositions.end(), 0u);
  if (mesh.corners.empty())
    mesh.corners = mesh.wedgePositions;
  moveVertices(mesh, frame, index);
  return mesh;
}

std::vector<SiteSequence> sequencesOf(const SiteDocument& document) {
  const SceneGraph& graph = document.scene.graph;
  std::vector<SiteSequence> sequences;
  for (const std::size_t shape : shapeNodes(graph))
    for (const std::size_t child : graph.nodes[shape].children)
      if (hasFrames(graph.nodes[child])) {
        const auto& frames = std::get<Interpolator>(graph.nodes[child].content);
        const std::filesystem::path file = fileOf(document, frames.url);
        sequences.push_back(
            {shape, frames.url, readSequenceIndex(asText(readFile(file)), file.string()), frames.video});
      }
  return sequences;
}

} // namespace imgeo
