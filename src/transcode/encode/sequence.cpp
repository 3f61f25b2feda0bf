#include "transcode/encode/sequence.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/option_checks.h"
#include "containers/stored_coords.h"
#include "live/quantise.h"
#include "prepare/normals.h"
#include "prepare/patches.h"
#include "sequence/sequence_file.h"
#include "transcode/options/resolve_options.h"
#include "video/sequence_video.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

/// Longer files are cut earlier than after a second, so that no seek loads much more.
constexpr std::uint64_t maxFileVertices = std::uint64_t{1} << 22;

/// Deflate's level for the frames; decoding takes as long at any.
int compressionLevelOf(int effort) {
  return std::max(1, effort);
}

/// The vertices in the order of the source.
IndexedPatch inSourceOrder(const Patch& patch) {
  std::vector<std::uint32_t> order(patch.wedgeCount()), vertexOf(patch.wedgeCount());
  std::iota(order.begin(), order.end(), 0u);
  const NamedAttribute& numbers = patch.namedAttributes.back();
  std::ranges::sort(order, {}, [&](std::uint32_t wedge) { return numbers.values[wedge]; });
  for (std::uint32_t vertex = 0; vertex < order.size(); ++vertex)
    vertexOf[order[vertex]] = vertex;
  IndexedPatch result;
  static_cast<VertexAttributes&>(result) = gather(patch, order);
  result.positions = gather(patch.positions, gather(patch.wedgePositions, order));
  result.indices = gather(vertexOf, patch.corners);
  result.draws = {{Primitive::triangles, narrow<std::uint32_t>(result.indices.size())}};
  return result;
}

/// The vertices in a row of a mesh whose vertices, in the order of the source, are a grid with triangles between
/// neighbours; 0: they are none.
std::uint32_t columnsOf(const Mesh& mesh) {
  if (mesh.topology != Topology::triangles || mesh.corners.empty())
    return 0;
  const NamedAttribute& numbers = mesh.namedAttributes.back();
  const auto vertexAt = [&](std::size_t corner) { return std::int64_t(numbers.values[mesh.corners[corner]]); };
  const auto vertices = static_cast<std::int64_t>(mesh.wedgeCount());
  std::int64_t columns = 0;
  for (std::size_t corner = 0; corner < 3; ++corner) // of the first triangle one edge leads to the next row
    columns = std::max(columns, std::abs(vertexAt(corner) - vertexAt((corner + 1) % 3)));
  for (const std::int64_t candidate : {columns, columns - 1}) {
    if (candidate < 2 || vertices % candidate != 0)
      continue;
    const auto isStep = [&](std::int64_t a, std::int64_t b) {
      return std::abs(a / candidate - b / candidate) <= 1 && std::abs(a % candidate - b % candidate) <= 1;
    };
    bool areNeighbours = true;
    for (std::size_t corner = 0; corner < mesh.corners.size() && areNeighbours; ++corner)
      areNeighbours = isStep(vertexAt(corner), vertexAt(corner % 3 == 2 ? corner - 2 : corner + 1));
    if (areNeighbours)
      return narrow<std::uint32_t>(candidate);
  }
  return 0;
}

IndexedPatch verticesOf(const Patch& patch, bool isGrid) {
  switch (patch.topology) {
  case Topology::points: {
    IndexedPatch points = inSourceOrder(patch); // a scanner's neighbours follow one another
    points.indices.clear();
    points.draws = {{Primitive::points, narrow<std::uint32_t>(points.positions.size())}};
    return points;
  }
  case Topology::lines:
    return asLines(patch);
  case Topology::triangles:
    break;
  }
  return isGrid ? inSourceOrder(patch) : asTriangles(patch);
}

std::vector<float> numbersOf(const std::vector<Vec3f>& vectors, const std::vector<std::uint32_t>& order) {
  std::vector<float> numbers;
  numbers.reserve(3 * order.size());
  for (const std::uint32_t i : order)
    numbers.insert(numbers.end(), {vectors[i].x, vectors[i].y, vectors[i].z});
  return numbers;
}

std::vector<float> numbersOf(const std::vector<Rgba>& colors, const std::vector<std::uint32_t>& order,
                             std::uint32_t components) {
  std::vector<float> numbers;
  for (const std::uint32_t i : order) {
    const float channels[] = {colors[i].r, colors[i].g, colors[i].b, colors[i].a};
    numbers.insert(numbers.end(), channels, channels + components);
  }
  return numbers;
}

std::vector<Bytes> joined(std::vector<std::vector<Bytes>> lists) {
  std::vector<Bytes> all;
  for (std::vector<Bytes>& list : lists)
    std::ranges::move(list, std::back_inserter(all));
  return all;
}

std::vector<float> numbersOf(const NamedAttribute& attribute, const std::vector<std::uint32_t>& order) {
  std::vector<float> numbers;
  for (const std::uint32_t i : order)
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      numbers.push_back(attribute.values[std::size_t{i} * attribute.components + c]);
  return numbers;
}

const NamedAttribute& attributeNamed(const Mesh& mesh, const std::string& name) {
  return *std::ranges::find(mesh.namedAttributes, name, &NamedAttribute::name);
}

/// One sequence: the description of its frames, and what they need of the first.
class SequenceEncoding {
public:
  SequenceEncoding(const FrameSource& frames, const FrameSurvey& survey, const ConvertOptions& options)
      : frames_(frames), survey_(survey), options_(options) {
    if (!(survey.box.longestEdge() > 0))
      throw Error(ErrorKind::usage, "", "all vertices of the sequence are at one point");
  }

  /// Writes the static mesh, which is the first frame.
  EncodedMesh encodeStatic(Mesh mesh, ContentFiles& files) {
    const Lattice lattice = latticeFor(survey_.box, positionBitsFor(survey_.box, options_));
    if (lattice.bits > 24)
      refuseOption("--position-bits", "the frames of a sequence have at most 24 bits");
    describeFrames(mesh, lattice);
    prepared_ = mesh;
    sourceVertices_ = takeVertexNumbers(prepared_);
    PatchedMesh patched = cutIntoPatches(std::move(mesh), lattice, maxPatchWedges);
    if (patched.patches.size() != 1)
      throw Error(ErrorKind::limit, "", fmt::format("a sequence has at most {} corners", maxPatchCorners));
    IndexedPatch vertices = verticesOf(patched.patches.front(), description_.layout.columns > 0);
    order_ = takeVertexNumbers(vertices);
    takeVertexNumbers(patched.patches.front());
    const EncodeOptions encoding = encodeOptionsFrom(options_);
    EncodedMesh result;
    result.geometry = describe(patched, encoding);
    // Indices are those of vertices: the images of frames have other columns than those of the document.
    result.geometry.indexType = ElementType::uint32;
    const EncodedPatch encoded = encodePatch(vertices, result.geometry, encoding);
    PatchDescription patch = writePatch(encoded, files);
    patch.box = result.geometry.box = survey_.box;
    result.vertices = patch.vertexCount;
    result.elements = encoded.elements;
    noteAttributes(result, vertices, options_);
    result.geometry.patches.push_back(std::move(patch));
    result.positionError = positionErrorBound(result.geometry);
    return result;
  }

  /// Writes the frames and their index, and the video if one is asked for.
  EncodedFrames encodeFrames(double rate, bool hasVideo, ContentFiles& files, const ElementsDone& done) {
    EncodedFrames encoded;
    SequenceIndex& index = encoded.index;
    description_.rate = rate;
    index.description = description_;
    index.valueName = survey_.valueName;
    const std::size_t perFile = framesInFile(rate);
    index.files.resize((frames_.count() + perFile - 1) / perFile);
    const VideoSize size = hasVideo ? videoSizeOf(description_.layout, "") : VideoSize{};
    std::vector<std::vector<Bytes>> packets(index.files.size());
    parallelFor(index.files.size(), [&](std::size_t file) {
      const std::size_t first = file * perFile, end = std::min(frames_.count(), first + perFile);
      std::vector<live::Frame> frames;
      for (std::size_t frame = first; frame < end; ++frame) {
        frames.push_back(quantisedFrame(frame));
        done(1);
      }
      const Bytes bytes = encodeSequenceFile(frames, compressionLevelOf(options_.effort));
      const std::filesystem::path url = files.write(bytes, ".igf");
      index.files[file] = {url.filename(), narrow<std::uint32_t>(frames.size()), bytes.size()};
      if (hasVideo)
        packets[file] = encodeVideoFrames(frames, size, options_.effort);
    });
    encoded.url = files.write(asBytes(writeSequenceIndex(index)), ".json");
    if (hasVideo) {
      const Bytes video = writeWebm(size, joined(std::move(packets)), rate);
      encoded.videoBytes = video.size();
      encoded.video = files.write(video, ".webm");
    }
    return encoded;
  }

private:
  void describeFrames(const Mesh& mesh, const Lattice& lattice) {
    live::FrameLayout& layout = description_.layout;
    layout.vertices = narrow<std::uint32_t>(mesh.wedgeCount());
    layout.columns = columnsOf(mesh);
    layout.positionBits = lattice.bits;
    // Pages derive the normals of triangles. Where vertices of one point differ otherwise, as on the seam of a texture,
    // these would have a crease.
    const bool hasSeams = mesh.wedgeCount() > mesh.positions.size();
    computesNormals_ = !survey_.hasNormals && hasSeams && mesh.topology == Topology::triangles;
    layout.normalBits = survey_.hasNormals || computesNormals_ ? options_.normalBits : 0;
    layout.colorComponents = survey_.colorsMove ? mesh.colorComponents : 0;
    layout.valueComponents = narrow<std::uint32_t>(survey_.valueRange.size());
    layout.valueBits = layout.valueComponents > 0 ? options_.attributeBits : 0;
    description_.valueRange = survey_.valueRange;
    description_.box = survey_.box;
  }

  /// The frames of a file of about a second.
  std::size_t framesInFile(double rate) const {
    const std::uint64_t fitting = maxFileVertices / description_.layout.vertices;
    return std::clamp<std::uint64_t>(std::llround(rate), 1,
                                     std::clamp<std::uint64_t>(fitting, 1, maxSequenceFileFrames));
  }

  /// Smooth normals of a frame, by the number of the source's vertex: those of the prepared mesh with its positions.
  std::vector<Vec3f> normalsOf(const Mesh& frame) const {
    Mesh mesh = prepared_;
    mesh.normals.clear();
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      mesh.positions[mesh.wedgePositions[wedge]] = frame.positions[frame.wedgePositions[sourceVertices_[wedge]]];
    computeNormals(mesh, options_.normalWeighting);
    std::vector<Vec3f> normals(frame.wedgeCount(), Vec3f{0, 0, 1});
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      normals[sourceVertices_[wedge]] = mesh.normals[wedge];
    return normals;
  }

  live::Frame quantisedFrame(std::size_t number) const {
    const Mesh mesh = frames_.read(number);
    const live::FrameLayout& layout = description_.layout;
    const std::vector<float> positions = numbersOf(gather(mesh.positions, mesh.wedgePositions), order_);
    std::vector<float> normals, colors, values;
    if (layout.normalBits > 0)
      normals = numbersOf(computesNormals_ ? normalsOf(mesh) : mesh.normals, order_);
    if (layout.colorComponents > 0)
      colors = numbersOf(mesh.colors, order_, layout.colorComponents);
    if (layout.valueComponents > 0)
      values = numbersOf(attributeNamed(mesh, survey_.valueName), order_);
    live::Frame frame;
    live::quantise({positions, normals, colors, values}, description_, frame);
    frame.number = number;
    frame.time = static_cast<double>(number) / description_.rate;
    return frame;
  }

  const FrameSource& frames_;
  const FrameSurvey& survey_;
  const ConvertOptions& options_;
  live::Description description_;
  bool computesNormals_ = false;
  Mesh prepared_;                             ///< the first frame
  std::vector<std::uint32_t> sourceVertices_; ///< of the wedges of prepared_
  std::vector<std::uint32_t> order_;          ///< the source's vertex of each vertex of a frame
};

} // namespace

EncodedSequence encodeSequence(Mesh mesh, const Recording& recording, const ConvertOptions& options,
                               ContentFiles& files, const ElementsDone& done) {
  SequenceEncoding encoding(*recording.frames, recording.survey, options);
  EncodedSequence result;
  result.still = encoding.encodeStatic(std::move(mesh), files);
  result.frames = encoding.encodeFrames(recording.rate, recording.hasVideo, files, done);
  return result;
}

} // namespace imgeo
