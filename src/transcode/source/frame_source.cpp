#include "transcode/source/frame_source.h"

#include "base/error.h"
#include "base/parallel.h"
#include "live/frame.h"

#include <algorithm>
#include <fmt/format.h>
#include <mutex>

namespace imgeo {

namespace {

/// The range of each component of an attribute, wider than the other one's.
void addRange(std::vector<std::array<double, 2>>& range, const NamedAttribute& attribute) {
  if (range.empty() && !attribute.values.empty())
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      range.push_back({attribute.values[c], attribute.values[c]});
  for (std::size_t i = 0; i < attribute.values.size(); ++i) {
    auto& [min, max] = range[i % attribute.components];
    min = std::min<double>(min, attribute.values[i]);
    max = std::max<double>(max, attribute.values[i]);
  }
}

/// Adds frames to a survey, in any order.
class Surveyor {
public:
  explicit Surveyor(const Mesh& first)
      : first_(first), ranges_(first.namedAttributes.size()), moves_(first.namedAttributes.size()) {
    survey_.hasNormals = !first.normals.empty();
  }

  void add(const Mesh& mesh) {
    const Box3d box = boxOf(mesh);
    survey_.box.add(box.min);
    survey_.box.add(box.max);
    survey_.colorsMove |= mesh.colors != first_.colors;
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      addRange(ranges_[i], mesh.namedAttributes[i]);
      moves_[i] = moves_[i] || mesh.namedAttributes[i] != first_.namedAttributes[i];
    }
  }

  FrameSurvey finish(const std::string& location) {
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      if (!moves_[i])
        continue;
      const std::string& name = first_.namedAttributes[i].name;
      if (!survey_.valueName.empty())
        throw Error(ErrorKind::unsupported, location,
                    fmt::format("\"{}\" and \"{}\" change from frame to frame; a sequence has one attribute that does: "
                                "name it with --keep-attributes",
                                survey_.valueName, name));
      survey_.valueName = name;
      survey_.valueRange = ranges_[i];
    }
    for (auto& [min, max] : survey_.valueRange)
      max = max > min ? max : min + 1; // a component that does not change has a range, too
    return survey_;
  }

private:
  const Mesh& first_;
  FrameSurvey survey_;
  std::vector<std::vector<std::array<double, 2>>> ranges_; ///< by further attribute, then by component
  std::vector<bool> moves_;                                ///< by further attribute
};

} // namespace

FrameSurvey survey(const FrameSource& frames, const std::string& location, const std::function<void()>& done) {
  const Mesh first = frames.read(0);
  Surveyor surveyor(first);
  std::mutex mutex;
  parallelFor(frames.count(), [&](std::size_t frame) {
    const Mesh mesh = frames.read(frame);
    const std::lock_guard lock(mutex);
    surveyor.add(mesh);
    done();
  });
  return surveyor.finish(location);
}

void numberVertices(Mesh& mesh) {
  // Up to 2^24 integers are exact floats.
  static_assert(live::maxFrameVertices <= 1 << 24);
  if (mesh.wedgeCount() > live::maxFrameVertices)
    throw Error(
        ErrorKind::limit, "",
        fmt::format("a frame has {} vertices; sequences have at most {}", mesh.wedgeCount(), live::maxFrameVertices));
  NamedAttribute numbers{sourceVertexName, 1, {}};
  numbers.values.reserve(mesh.wedgeCount());
  for (std::size_t i = 0; i < mesh.wedgeCount(); ++i)
    numbers.values.push_back(static_cast<float>(i));
  mesh.namedAttributes.push_back(std::move(numbers));
  mesh.creaseDegrees = smoothDegrees;
}

std::vector<std::uint32_t> takeVertexNumbers(VertexAttributes& vertices) {
  const auto found = std::ranges::find(vertices.namedAttributes, sourceVertexName, &NamedAttribute::name);
  std::vector<std::uint32_t> numbers;
  for (const float number : found->values)
    numbers.push_back(static_cast<std::uint32_t>(number));
  vertices.namedAttributes.erase(found);
  return numbers;
}

} // namespace imgeo
