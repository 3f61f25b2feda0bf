#include "transcode/verify/compare_frames.h"

#include "base/error.h"
#include "containers/container_reader.h"
#include "live/quantise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

/// The stored integers of the corners of an element, one corner after the other.
using ElementKey = std::vector<std::uint32_t>;

/// The elements of a frame, sorted, by some of its components. Corners begin with the smallest, in their order.
std::vector<ElementKey> elementsOf(const live::Frame& frame, const std::vector<std::uint32_t>& components,
                                   const std::vector<std::uint32_t>& corners, Topology topology) {
  const std::size_t size = cornersPerElement(topology);
  std::vector<ElementKey> elements;
  elements.reserve(corners.size() / size);
  for (std::size_t first = 0; first + size <= corners.size(); first += size) {
    std::vector<ElementKey> keys(size);
    for (std::size_t i = 0; i < size; ++i)
      for (const std::uint32_t component : components)
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
  FrameComparison(const SiteDocument& document, const SiteSequence& sequence, const FrameSource& files,
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
    report.positionBound = std::max(report.positionBound, sequence.index.description.step() / 2);
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
    const auto inSite = elementsOf(frame, inSite_, stillCorners_, source.topology),
               inSource = elementsOf(expected, inSource_, corners_, source.topology);
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
    live::Description compared = description;
    compared.layout.vertices = static_cast<std::uint32_t>(source.wedgeCount());
    compared.layout.columns = 0;
    const bool hasComputedNormals = source.normals.empty() && description.layout.normalBits > 0;
    if (hasComputedNormals)
      compared.layout.normalBits = 0; // they follow from the positions
    inSource_.resize(componentCount(compared.layout));
    std::iota(inSource_.begin(), inSource_.end(), 0u);
    inSite_ = inSource_;
    for (std::size_t i = 3; hasComputedNormals && i < inSite_.size(); ++i)
      inSite_[i] += 2;
    const std::vector<Vec3f> points = gather(source.positions, source.wedgePositions);
    std::vector<float> colors;
    for (const Rgba& color : source.colors) {
      const float channels[] = {color.r, color.g, color.b, color.a};
      colors.insert(colors.end(), channels, channels + compared.layout.colorComponents);
    }
    live::Frame frame;
    const auto values = std::ranges::find(source.namedAttributes, sequence_.index.valueName, &NamedAttribute::name);
    if (compared.layout.valueComponents > 0 && values == source.namedAttributes.end())
      throw Error(ErrorKind::malformed, sequence_.url, "has values that the input lacks");
    live::quantise({numbersOf(points),
                    compared.layout.normalBits > 0 ? numbersOf(source.normals) : std::vector<float>{}, colors,
                    compared.layout.valueComponents > 0 ? values->values : std::vector<float>{}},
                   compared, frame);
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
  const FrameSource& files_;
  VerifyReport& report_;
  Findings& findings_;
  IndexedPatch still_;
  std::vector<std::uint32_t> stillCorners_;
  std::vector<std::uint32_t> corners_;           ///< of the source's first frame
  std::vector<std::uint32_t> inSite_, inSource_; ///< the components that are compared
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

void compareFrames(const SiteDocument& document, const SiteSequence& sequence, const FrameSource& source,
                   VerifyReport& report, Findings& findings) {
  const std::uint32_t count = sequence.index.frameCount();
  if (count != source.count())
    return findings.add("The site has {} frames, the input {}.", count, source.count());
  FrameComparison comparison(document, sequence, source, report, findings);
  readFrameFiles(document, sequence, 0, count, [&](const live::Frame& frame) { comparison.compare(frame); });
  if (!sequence.video.empty())
    compareVideo(document, sequence, findings);
}

void compareRecordings(const SiteDocument& document, const std::vector<Recording>& recordings, VerifyReport& report,
                       Findings& findings) {
  if (recordings.empty())
    return;
  const std::vector<SiteSequence> sequences = sequencesOf(document);
  if (sequences.size() != recordings.size())
    return findings.add("The site has {} sequences, the input {}.", sequences.size(), recordings.size());
  for (std::size_t i = 0; i < sequences.size(); ++i)
    compareFrames(document, sequences[i], *recordings[i].frames, report, findings);
}

} // namespace imgeo
