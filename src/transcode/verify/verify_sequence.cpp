// verifySequence(): reads the frames of a site back and compares them with the files that they were made from.

#include "base/error.h"
#include "containers/container_reader.h"
#include "imgeo/verify.h"
#include "live/quantise.h"
#include "transcode/site/sequences.h"
#include "transcode/source/frame_files.h"
#include "transcode/source/preparation.h"
#include "transcode/verify/check_files.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

namespace fs = std::filesystem;

/// The stored integers of the corners of an element, one corner after the other.
using ElementKey = std::vector<std::uint32_t>;

/// The elements of a frame, sorted. Corners begin with the smallest, in their order.
std::vector<ElementKey> elementsOf(const live::Frame& frame, std::uint32_t components,
                                   const std::vector<std::uint32_t>& corners, Topology topology) {
  const std::size_t size = cornersPerElement(topology);
  std::vector<ElementKey> elements;
  elements.reserve(corners.size() / size);
  for (std::size_t first = 0; first + size <= corners.size(); first += size) {
    std::vector<ElementKey> keys(size);
    for (std::size_t i = 0; i < size; ++i)
      for (std::uint32_t component = 0; component < components; ++component)
        keys[i].push_back(frame.component(component)[corners[first + i]]);
    if (topology == Topology::triangles)
      std::ranges::rotate(keys, std::ranges::min_element(keys));
    else
      std::ranges::sort(keys);
    ElementKey element;
    for (const ElementKey& key : keys)
      element.insert(element.end(), key.begin(), key.end());
    elements.push_back(std::move(element));
  }
  std::ranges::sort(elements);
  return elements;
}

std::vector<float> numbersOf(const std::vector<Vec3f>& vectors) {
  std::vector<float> numbers;
  for (const Vec3f& vector : vectors)
    numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
  return numbers;
}

/// The frames of one sequence beside their source.
class FrameComparison {
public:
  FrameComparison(const SiteDocument& document, const SiteSequence& sequence, const FrameFiles& files,
                  VerifyReport& report, Findings& findings)
      : sequence_(sequence), files_(files), report_(report), findings_(findings) {
    const Shape& shape = shapeOf(document.scene.graph, sequence.shape);
    const GeometryDescription& geometry = document.scene.geometries.at(shape.mesh);
    still_ = ContainerReader(fetchFrom(document)).decode(geometry.patches.at(0), geometry);
    if (still_.vertexCount() != sequence.index.description.layout.vertices)
      throw Error(ErrorKind::malformed, sequence.url, "has another number of vertices than the document");
    stillCorners_ = still_.indices;
    if (stillCorners_.empty()) {
      stillCorners_.resize(still_.vertexCount());
      std::iota(stillCorners_.begin(), stillCorners_.end(), 0u);
    }
    report.positionBound = sequence.index.description.step() / 2;
  }

  /// Compares a frame; the first of the site is its static mesh, too.
  void compare(const live::Frame& frame) {
    const Mesh source = files_.read(frame.number);
    const live::Frame expected = quantised(source);
    if (frame.number == 0) {
      report_.input.of(source.topology) = source.elementCount();
      report_.site.of(source.topology) = stillCorners_.size() / cornersPerElement(source.topology);
      compareStill(frame);
      corners_ = source.corners;
    }
    const auto inSite = elementsOf(frame, comparedComponents_, stillCorners_, source.topology),
               inSource = elementsOf(expected, comparedComponents_, corners_, source.topology);
    std::vector<ElementKey> missing;
    std::ranges::set_difference(inSource, inSite, std::back_inserter(missing));
    if (!missing.empty() || inSource.size() != inSite.size())
      findings_.add("{} of {} {} of frame {} are not those of its file.",
                    std::max(missing.size(), inSite.size() - std::min(inSite.size(), inSource.size())), inSource.size(),
                    nameOf(source.topology), frame.number);
    report_.missing.of(source.topology) += missing.size();
    ++report_.frames;
  }

private:
  /// The frame that the source's vertices make, in their own order.
  live::Frame quantised(const Mesh& source) {
    const live::Description& description = sequence_.index.description;
    live::Description positions = description;
    const bool hasSourceNormals = !source.normals.empty() && description.layout.normalBits > 0;
    if (!hasSourceNormals)
      positions.layout.normalBits = 0; // computed ones follow from the positions
    positions.layout.vertices = static_cast<std::uint32_t>(source.wedgeCount());
    positions.layout.columns = 0;
    if (source.colors.empty() || (description.layout.normalBits > 0 && !hasSourceNormals))
      positions.layout.colorComponents = 0; // colours come after the normals
    comparedComponents_ = 3 + (hasSourceNormals ? 2 : 0) + positions.layout.colorComponents;
    const std::vector<Vec3f> points = gather(source.positions, source.wedgePositions);
    std::vector<float> colors;
    for (const Rgba& color : source.colors) {
      const float channels[] = {color.r, color.g, color.b, color.a};
      colors.insert(colors.end(), channels, channels + positions.layout.colorComponents);
    }
    live::Frame frame;
    live::quantise({numbersOf(points), hasSourceNormals ? numbersOf(source.normals) : std::vector<float>{}, colors, {}},
                   positions, frame);
    noteErrors(points, frame);
    return frame;
  }

  void noteErrors(const std::vector<Vec3f>& points, const live::Frame& frame) {
    const live::Description& description = sequence_.index.description;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double stored = description.origin()[axis] + frame.component(axis)[i] * description.step();
        report_.positionError = std::max(report_.positionError, std::abs(stored - points[i][axis]));
      }
  }

  /// The static mesh has the positions of the first frame.
  void compareStill(const live::Frame& first) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < still_.vertexCount(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        different += still_.positions[i][axis] != first.component(axis)[i];
    if (different > 0)
      findings_.add("{} coordinates of the document's own geometry are not those of the first frame.", different);
  }

  const SiteSequence& sequence_;
  const FrameFiles& files_;
  VerifyReport& report_;
  Findings& findings_;
  IndexedPatch still_;
  std::vector<std::uint32_t> stillCorners_;
  std::vector<std::uint32_t> corners_; ///< of the source's first frame
  std::uint32_t comparedComponents_ = 3;
};

/// The video has the integers of the frames, each bit of them.
void compareVideo(const SiteDocument& document, const SiteSequence& sequence, Findings& findings) {
  const SequenceIndex& index = sequence.index;
  std::size_t different = 0;
  for (std::size_t file = 0; file < index.files.size(); ++file) {
    const std::uint32_t first = index.firstFrameOf(file), end = first + index.files[file].frames;
    std::vector<live::Frame> frames;
    readFrameFiles(document, sequence, first, end, [&](const live::Frame& frame) { frames.push_back(frame); });
    readFrames(document, sequence, first, end, [&](const live::Frame& frame) {
      different += frame.components != frames.at(frame.number - first).components;
    });
  }
  if (different > 0)
    findings.add("{} of {} frames of the video are not those of the sequence.", different, index.frameCount());
}

} // namespace

VerifyReport verifySequence(const fs::path& site, const std::vector<fs::path>& frames, bool outside) {
  if (frames.size() == 1)
    return verify(site, frames.front(), outside);
  VerifyReport report;
  Findings findings(report);
  const SiteDocument document = openDocument(site);
  std::uint64_t bytes = 0;
  ImportOptions options;
  options.outside = outside;
  const Imported first = importInput(frames.at(0), options, bytes);
  const FrameFiles files(frames, first.scene, outside);
  try {
    if (const std::optional<SiteManifest> manifest = manifestOf(document)) {
      checkDocuments(document, findings);
      checkPictures(document, *manifest, findings);
    }
    const std::vector<SiteSequence> sequences = sequencesOf(document);
    if (sequences.size() != 1)
      findings.add("The site has {} sequences, the input one.", sequences.size());
    else if (sequences[0].index.frameCount() != frames.size())
      findings.add("The site has {} frames, the input {}.", sequences[0].index.frameCount(), frames.size());
    else if (checkFiles(document, false, first.scene.graph, findings)) {
      FrameComparison comparison(document, sequences[0], files, report, findings);
      readFrameFiles(document, sequences[0], 0, sequences[0].index.frameCount(),
                     [&](const live::Frame& frame) { comparison.compare(frame); });
      if (!sequences[0].video.empty())
        compareVideo(document, sequences[0], findings);
    }
  } catch (const Error& error) {
    findings.add("{}.", error.what());
  }
  report.equal = report.findings.empty();
  return report;
}

} // namespace imgeo
