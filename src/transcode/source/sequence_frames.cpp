#include "transcode/source/sequence_frames.h"

#include "base/error.h"
#include "base/file.h"
#include "containers/lru_cache.h"
#include "sequence/sequence_file.h"
#include "transcode/site/sequences.h"

#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace imgeo {

namespace {

/// The frames of the files of an index, whose vertices are the wedges of a mesh.
class SequenceFrames : public FrameSource {
public:
  SequenceFrames(std::filesystem::path path, SequenceIndex index, Mesh mesh)
      : path_(std::move(path)), index_(std::move(index)), mesh_(std::move(mesh)) {}

  std::size_t count() const override { return index_.frameCount(); }

  Mesh read(std::size_t frame) const override {
    const auto number = static_cast<std::uint32_t>(frame);
    const std::size_t file = index_.fileOf(number);
    const auto frames = files_.get(index_.files[file].url, [&](const std::string& url) {
      std::vector<live::Frame> read;
      const std::filesystem::path path = path_.parent_path() / url;
      decodeSequenceFile(readFile(path), index_, file, path.string(),
                         [&](const live::Frame& each) { read.push_back(each); });
      return read;
    });
    Mesh mesh = mesh_;
    moveVertices(mesh, frames->at(number - index_.firstFrameOf(file)), index_);
    return mesh;
  }

private:
  std::filesystem::path path_;
  SequenceIndex index_;
  Mesh mesh_;
  mutable LruCache<std::vector<live::Frame>> files_;
};

} // namespace

std::vector<Recording> recordedSequences(Scene& scene) {
  SceneGraph& graph = scene.graph;
  std::vector<Recording> recordings;
  for (const std::size_t shape : shapeNodes(graph))
    for (const std::size_t child : graph.nodes[shape].children) {
      if (!hasFrames(graph.nodes[child]))
        continue;
      auto& interpolator = std::get<Interpolator>(graph.nodes[child].content);
      const std::filesystem::path path = interpolator.url;
      SequenceIndex index = readSequenceIndex(asText(readFile(path)), path.string());
      Mesh& mesh = scene.meshes[shapeOf(graph, shape).mesh];
      if (mesh.wedgeCount() != index.description.layout.vertices)
        throw Error(ErrorKind::malformed, path.string(),
                    fmt::format("has {} vertices, the geometry that names it {}", index.description.layout.vertices,
                                mesh.wedgeCount()));
      const double rate = index.description.rate;
      const bool hasVideo = !interpolator.video.empty();
      interpolator = Interpolator{InterpolatorKind::coordinate, {}, {}, "frames"};
      auto frames = std::make_shared<SequenceFrames>(path, std::move(index), mesh);
      mesh = frames->read(0);
      recordings.push_back(
          {.shape = shape, .interpolator = child, .frames = std::move(frames), .rate = rate, .hasVideo = hasVideo});
    }
  return recordings;
}

} // namespace imgeo
