#include "prepare/line_strips.h"

#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using Lines = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Lines sorted(Lines lines) {
  for (auto& [a, b] : lines)
    if (a > b)
      std::swap(a, b);
  std::sort(lines.begin(), lines.end());
  return lines;
}

Lines linesIn(const std::vector<std::uint32_t>& corners) {
  Lines lines;
  for (std::size_t i = 0; i < corners.size(); i += 2)
    lines.push_back({corners[i], corners[i + 1]});
  return sorted(lines);
}

/// The lines of a strip in order, each from its start to its end.
Lines linesIn(std::span<const std::uint32_t> strip, const std::vector<std::uint32_t>& corners) {
  Lines lines;
  for (const std::uint32_t corner : strip)
    lines.push_back({corners[corner], corners[corner ^ 1]});
  return lines;
}

/// The sum over connected components of half the number of vertices of odd degree, or 1 if there are none.
std::size_t minStripCount(const std::vector<std::uint32_t>& corners, std::size_t vertexCount) {
  std::vector<std::uint32_t> parent(vertexCount), valence(vertexCount);
  for (std::uint32_t v = 0; v < vertexCount; ++v)
    parent[v] = v;
  const auto componentOf = [&](std::uint32_t v) {
    while (parent[v] != v)
      v = parent[v];
    return v;
  };
  for (std::size_t i = 0; i < corners.size(); i += 2) {
    ++valence[corners[i]], ++valence[corners[i + 1]];
    parent[componentOf(corners[i])] = componentOf(corners[i + 1]);
  }
  std::vector<std::uint32_t> oddVertexCount(vertexCount), lineEndCount(vertexCount);
  for (std::uint32_t v = 0; v < vertexCount; ++v) {
    oddVertexCount[componentOf(v)] += valence[v] % 2;
    lineEndCount[componentOf(v)] += valence[v];
  }
  std::size_t strips = 0;
  for (std::uint32_t v = 0; v < vertexCount; ++v)
    strips += lineEndCount[v] == 0 ? 0 : std::max(1u, oddVertexCount[v] / 2);
  return strips;
}

TEST(LineStrips, DrawEveryLineOnceWithTheMinimumNumberOfStrips) {
  testing::Random random(1);
  for (std::uint32_t round = 0; round < 500; ++round) {
    const std::uint32_t vertices = 1 + random.below(round % 2 ? 60 : 8);
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = random.below(100); i > 0; --i)
      for (int end = 0; end < 2; ++end)
        corners.push_back(random.below(vertices));
    const LineStrips strips = findLineStrips(corners, vertices);
    EXPECT_EQ(sorted(linesIn(strips.corners, corners)), linesIn(corners));
    EXPECT_EQ(strips.count(), minStripCount(corners, vertices));
    for (std::size_t i = 0; i < strips.count(); ++i) {
      const Lines lines = linesIn(strips.strip(i), corners);
      EXPECT_FALSE(lines.empty());
      for (std::size_t n = 1; n < lines.size(); ++n)
        EXPECT_EQ(lines[n].first, lines[n - 1].second);
    }
  }
}

TEST(LineStrips, KeepTheDirectionOfAnOpenLine) {
  const std::vector<std::uint32_t> corners{3, 4, 4, 5, 5, 6, 0, 1, 1, 2};
  const LineStrips strips = findLineStrips(corners, 7);
  EXPECT_EQ(strips.corners, (std::vector<std::uint32_t>{6, 8, 0, 2, 4}));
  EXPECT_EQ(strips.ends, (std::vector<std::uint32_t>{2, 5}));
}

} // namespace
} // namespace imgeo
