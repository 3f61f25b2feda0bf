#pragma once
// Reads the elements of a PLY file that hold polygons: `face` and `tristrips`.

#include "import/ply/content.h"
#include "import/ply/records.h"
#include "import/ply/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

template <typename Cursor> class PlyFaceReader {
public:
  /// Indices must be below `vertexCount`, at most 2^32.
  PlyFaceReader(PlyRecords<Cursor>& records, PlyContent& content, std::uint64_t vertexCount)
      : records_(records), content_(content), vertexCount_(vertexCount) {}

  void readFaces(const PlyElement& element) {
    const PlyType indexType = checkProperties(element, true);
    content_.indices.reserve(content_.indices.size() +
                             std::min<std::uint64_t>(3 * element.count, records_.valuesLeft(indexType)));
    std::vector<Role> roles;
    for (const PlyProperty& property : element.properties)
      roles.push_back(roleOf(property));
    std::vector<Vec2f> texCoords;
    records_.forEach(element, [&] {
      std::size_t corners = 0;
      bool hasTexCoords = false;
      std::optional<std::uint32_t> texture;
      for (std::size_t p = 0; p < roles.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        switch (roles[p]) {
        case Role::indices:
          corners = addPolygon(records_.list(property));
          break;
        case Role::texCoords:
          texCoords = readTexCoords(property);
          hasTexCoords = true;
          break;
        case Role::texture:
          texture = plyTextureOf(records_.scalar(property.type));
          break;
        case Role::other:
          records_.skip(property);
          break;
        }
      }
      if (hasTexCoords && corners > 0)
        addTexCoords(texCoords, corners);
      if (texture && corners > 0) {
        content_.textures.resize(content_.polygonCount() - 1, noPlyTexture); // of strips
        content_.textures.push_back(*texture);
      }
    });
  }

  void readStrips(const PlyElement& element) {
    checkProperties(element, false);
    records_.forEach(element, [&] {
      for (const PlyProperty& property : element.properties)
        if (isIndexList(property))
          addStrips(records_.list(property));
        else
          records_.skip(property);
    });
  }

private:
  /// What a property of faces says; found out once, as comparing names takes longer than reading a face.
  enum class Role : std::uint8_t { indices, texCoords, texture, other };

  static Role roleOf(const PlyProperty& property) {
    return isIndexList(property)          ? Role::indices
           : isTexCoordList(property)     ? Role::texCoords
           : isPlyTextureNumber(property) ? Role::texture
                                          : Role::other;
  }
  static bool isIndexList(const PlyProperty& property) {
    return property.isList() && (property.name == "vertex_indices" || property.name == "vertex_index");
  }
  static bool isTexCoordList(const PlyProperty& property) { return property.isList() && property.name == "texcoord"; }

  /// Finds the list of indices and returns its type; notes properties that are not read.
  PlyType checkProperties(const PlyElement& element, bool areFaces) {
    records_.checkCount(element);
    const PlyProperty* indices = nullptr;
    for (const PlyProperty& property : element.properties) {
      if (isIndexList(property)) {
        if (indices)
          records_.fail(ErrorKind::malformed, fmt::format("'{}' has two lists of vertices", element.name));
        indices = &property;
      } else if (!areFaces || !(isTexCoordList(property) || isPlyTextureNumber(property))) {
        content_.noteIgnored(element, property);
      }
    }
    if (!indices)
      records_.fail(ErrorKind::malformed, fmt::format("'{}' has no list 'vertex_indices'", element.name));
    if (!isInteger(indices->type))
      records_.fail(ErrorKind::malformed, "vertex_indices are of a type that has fractions");
    return indices->type;
  }

  void checkIndex(double index) const { records_.checkVertexIndex(index, vertexCount_); }

  /// Returns the number of corners added: 0 for a face of fewer than three corners.
  std::size_t addPolygon(std::span<const double> polygon) {
    for (const double index : polygon)
      checkIndex(index);
    if (polygon.size() < 3) {
      ++content_.facesTooSmall;
      return 0;
    }
    if (polygon.size() != 3 && content_.sizes.empty())
      content_.sizes.assign(content_.indices.size() / 3, 3);
    const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>(polygon[i]); };
    content_.indices.insert(content_.indices.end(), {at(0), at(1), at(2)});
    for (std::size_t i = 3; i < polygon.size(); ++i)
      content_.indices.push_back(at(i));
    if (polygon.size() != 3 || !content_.sizes.empty())
      content_.sizes.push_back(static_cast<std::uint32_t>(polygon.size()));
    return polygon.size();
  }

  std::vector<Vec2f> readTexCoords(const PlyProperty& property) {
    const std::span<const double> numbers = records_.list(property);
    std::vector<Vec2f> texCoords;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      const Vec2f texCoord{static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1])};
      if (!std::isfinite(texCoord.x) || !std::isfinite(texCoord.y))
        records_.fail(ErrorKind::malformed, "a texture coordinate is not a number");
      texCoords.push_back(texCoord);
    }
    return texCoords;
  }

  /// Faces without texture coordinates, this one or earlier ones, get (0, 0).
  void addTexCoords(const std::vector<Vec2f>& texCoords, std::size_t corners) {
    if (!texCoords.empty() && texCoords.size() != corners)
      records_.fail(ErrorKind::malformed,
                    fmt::format("a face of {} corners has {} texture coordinates", corners, texCoords.size()));
    std::vector<Vec2f>& all = content_.cornerTexCoords;
    all.resize(content_.indices.size());
    std::ranges::copy(texCoords, all.end() - static_cast<std::ptrdiff_t>(corners));
  }

  /// Consecutive strips, separated by -1. Every second triangle of a strip has the opposite winding. Triangles with two
  /// equal corners only connect strips and are skipped.
  void addStrips(std::span<const double> indices) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] == -1) {
        begin = i + 1;
        continue;
      }
      checkIndex(indices[i]);
      if (i < begin + 2)
        continue;
      const bool isOdd = (i - begin) % 2 == 1;
      const std::array<double, 3> triangle{indices[i - (isOdd ? 1 : 2)], indices[i - (isOdd ? 2 : 1)], indices[i]};
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[0] != triangle[2])
        addPolygon(triangle);
    }
  }

  PlyRecords<Cursor>& records_;
  PlyContent& content_;
  std::uint64_t vertexCount_;
};

} // namespace imgeo
