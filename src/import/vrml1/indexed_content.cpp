#include "import/vrml1/indexed_content.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <span>

namespace imgeo::vrml1 {

namespace {

constexpr double maxIndex = 4294967295;

/// The indices of a field, `noIndex` for negative numbers. Empty for the default, a single -1.
Indices indicesOf(const Node& node, const char* field) {
  const std::vector<double>& numbers = node.numbers(field);
  Indices indices(numbers.size(), noIndex);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= 0)
      indices[i] = static_cast<std::size_t>(std::min(numbers[i], maxIndex));
  return indices == Indices{noIndex} ? Indices{} : indices;
}

bool isByVertex(const std::string& binding) {
  return binding.starts_with("PER_VERTEX");
}

std::vector<Run> runsOf(const Indices& coordIndex) {
  std::vector<Run> runs;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= coordIndex.size(); ++i)
    if (i == coordIndex.size() || coordIndex[i] == noIndex) {
      if (i > begin)
        runs.push_back({begin, i, runs.size()});
      begin = i + 1;
    }
  return runs;
}

/// The index of each corner in a list of values that is bound to vertices, faces or parts; `given` is the field with
/// the indices of a binding that ends in _INDEXED. Empty for a binding to the whole shape.
Indices boundIndices(const std::string& binding, const Indices& given, const Indices& coordIndex,
                     const std::vector<Run>& runs) {
  Indices indices(coordIndex.size(), noIndex);
  const bool isIndexed = binding.ends_with("_INDEXED");
  if (isByVertex(binding)) {
    std::size_t corner = 0;
    for (const Run& run : runs)
      for (std::size_t i = run.begin; i < run.end; ++i, ++corner)
        if (!isIndexed)
          indices[i] = corner;
        else if (given.empty())
          indices[i] = coordIndex[i];
        else if (i < given.size())
          indices[i] = given[i];
    return indices;
  }
  if (!binding.starts_with("PER_FACE") && !binding.starts_with("PER_PART"))
    return {};
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i < run.end; ++i)
      indices[i] = !isIndexed || given.empty() ? run.number : run.number < given.size() ? given[run.number] : noIndex;
  return indices;
}

/// The value of a MaterialBinding or NormalBinding.
std::string bindingOf(const Node* binding) {
  return binding ? binding->word("value", "DEFAULT") : "DEFAULT";
}

/// The segments of polylines, as runs of two corners.
std::vector<Run> segmentsOf(const std::vector<Run>& runs) {
  std::vector<Run> segments;
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i + 1 < run.end; ++i)
      segments.push_back({i, i + 2, segments.size()});
  return segments;
}

bool areBelow(std::size_t count, const Indices& indices, const std::vector<Run>& runs) {
  return std::ranges::all_of(runs, [&](const Run& run) {
    return std::ranges::all_of(std::span(indices).subspan(run.begin, run.end - run.begin),
                               [&](std::size_t index) { return index < count; });
  });
}

class ContentReader {
public:
  ContentReader(const Node& node, Properties& properties, const x3d::VrmlTokens& tokens, Report& report)
      : node_(node), properties_(properties), tokens_(tokens), report_(report) {}

  std::optional<IndexedContent> read() {
    if (!readCorners() || content_.runs.empty() || !bindMaterials())
      return {};
    if (content_.isSurface) {
      content_.hints = properties_.get(Property::shapeHints);
      content_.key += fmt::format(" {}", fmt::ptr(content_.hints));
      bindNormals();
      if (!bindTextureCoordinates())
        return {};
    }
    return std::move(content_);
  }

private:
  /// Reports an index out of range.
  bool isInRange(std::size_t index, std::size_t count, const char* what) {
    if (index < count)
      return true;
    report_.omissions.push_back(fmt::format("{}: {}: left out: {}.", tokens_.locationOf(node_.where), node_.type,
                                            index == noIndex ? fmt::format("has corners without a {}", what)
                                                             : fmt::format("names {} {} of {}", what, index, count)));
    return false;
  }

  // The following return false after an index out of range has been reported.

  bool readCorners() {
    static const std::vector<double> origin{0, 0, 0};
    content_.isSurface = node_.is("IndexedFaceSet");
    content_.isPoints = node_.is("PointSet");
    const Node* const coordinates = properties_.get(Property::coordinates);
    content_.points = coordinates && coordinates->field("point") ? &coordinates->numbers("point") : &origin;
    const std::size_t pointCount = content_.points->size() / 3;
    if (content_.isPoints) {
      const auto first =
          static_cast<std::size_t>(std::clamp(node_.real("startIndex", 0), 0.0, static_cast<double>(pointCount)));
      const double count = node_.real("numPoints", -1);
      const std::size_t end = count < 0 ? pointCount : first + static_cast<std::size_t>(std::min(count, maxIndex));
      if (end > first && !isInRange(end - 1, pointCount, "point"))
        return false;
      for (std::size_t i = first; i < end; ++i)
        content_.coordIndex.push_back(i);
    } else {
      content_.coordIndex = indicesOf(node_, "coordIndex");
    }
    content_.allRuns = runsOf(content_.coordIndex);
    const std::size_t minCorners = content_.isSurface ? 3 : content_.isPoints ? 1 : 2;
    std::ranges::copy_if(content_.allRuns, std::back_inserter(content_.runs),
                         [&](const Run& run) { return run.end - run.begin >= minCorners; });
    for (const std::size_t index : content_.coordIndex)
      if (index != noIndex && !isInRange(index, pointCount, "point"))
        return false;
    content_.key = fmt::format("{} {}", fmt::ptr(&node_), fmt::ptr(coordinates));
    return true;
  }

  bool bindMaterials() {
    content_.surfaces = Surfaces(properties_.get(Property::material));
    if (content_.surfaces.count() == 1)
      return true;
    std::string binding = bindingOf(properties_.get(Property::materialBinding));
    if (content_.isPoints && binding.starts_with("PER_")) // each point is a part, a face and a vertex
      binding = "PER_VERTEX";
    if (node_.is("IndexedLineSet") && binding.starts_with("PER_PART"))
      content_.runs = content_.allRuns = segmentsOf(content_.runs);
    content_.isMaterialByRun = !isByVertex(binding);
    content_.materialIndex =
        boundIndices(binding, indicesOf(node_, "materialIndex"), content_.coordIndex, content_.allRuns);
    if (content_.materialIndex.empty())
      return true;
    for (const Run& run : content_.runs)
      for (std::size_t i = run.begin; i < run.end; ++i)
        if (!isInRange(content_.materialIndex[i], noIndex, "material")) // indices are cycled
          return false;
    return true;
  }

  /// Leaves normals out where there are too few: they are computed by crease angle.
  void bindNormals() {
    const Node* const normals = properties_.get(Property::normals);
    if (!normals)
      return;
    const Node* const bindingNode = properties_.get(Property::normalBinding);
    std::string binding = bindingOf(bindingNode);
    if (binding == "DEFAULT")
      binding = "PER_VERTEX_INDEXED";
    content_.normalIndex =
        boundIndices(binding, indicesOf(node_, "normalIndex"), content_.coordIndex, content_.allRuns);
    if (content_.normalIndex.empty())
      content_.normalIndex.assign(content_.coordIndex.size(), 0);
    if (areBelow(normals->numbers("vector").size() / 3, content_.normalIndex, content_.runs))
      content_.normals = &normals->numbers("vector");
    content_.key += fmt::format(" {} {}", fmt::ptr(normals), fmt::ptr(bindingNode));
  }

  bool bindTextureCoordinates() {
    content_.isTextured = Appearances::isTextured(properties_);
    if (!content_.isTextured)
      return true;
    const Node* const texCoords = properties_.get(Property::textureCoordinates);
    content_.key += fmt::format(" textured {}", fmt::ptr(texCoords));
    const std::size_t count = texCoords ? texCoords->numbers("point").size() / 2 : 0;
    if (count == 0)
      return true;
    content_.texCoords = &texCoords->numbers("point");
    content_.texCoordIndex = boundIndices("PER_VERTEX_INDEXED", indicesOf(node_, "textureCoordIndex"),
                                          content_.coordIndex, content_.allRuns);
    for (const Run& run : content_.runs)
      for (std::size_t i = run.begin; i < run.end; ++i)
        if (!isInRange(content_.texCoordIndex[i], count, "texture coordinate"))
          return false;
    return true;
  }

  const Node& node_;
  Properties& properties_;
  const x3d::VrmlTokens& tokens_;
  Report& report_;
  IndexedContent content_;
};

} // namespace

std::optional<IndexedContent> readIndexedContent(const Node& node, Properties& properties,
                                                 const x3d::VrmlTokens& tokens, Report& report) {
  return ContentReader(node, properties, tokens, report).read();
}

} // namespace imgeo::vrml1
