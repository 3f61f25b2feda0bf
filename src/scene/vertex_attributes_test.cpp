#include "scene/vertex_attributes.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(VertexAttributes, AreGatheredByVertex) {
  VertexAttributes attributes;
  attributes.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  attributes.colors = {Rgba8{1, 0, 0, 9}, Rgba8{2, 0, 0, 9}, Rgba8{3, 0, 0, 9}};
  attributes.colorComponents = 4;
  attributes.namedAttributes = {{"heat", 1, {10, 20, 30}}, {"flow", 2, {1, 2, 3, 4, 5, 6}}};
  const VertexAttributes gathered = gather(attributes, std::vector<std::uint32_t>{2, 0, 2, 2});
  EXPECT_EQ(gathered.normals, (std::vector<Vec3f>{{0, 0, 1}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_TRUE(gathered.texCoords.empty());
  EXPECT_EQ(gathered.colors[1], (Rgba8{1, 0, 0, 9}));
  EXPECT_EQ(gathered.colorComponents, 4u);
  EXPECT_EQ(gathered.namedAttributes,
            (std::vector<NamedAttribute>{{"heat", 1, {30, 10, 30, 30}}, {"flow", 2, {5, 6, 1, 2, 5, 6, 5, 6}}}));
  EXPECT_TRUE(isConsistent(gathered, 4));
}

TEST(VertexAttributes, AreFilledWithDefaultsWhereOneSideLacksThem) {
  VertexAttributes plain, rich;
  rich.texCoords = {{1, 2}, {3, 4}};
  rich.namedAttributes = {{"flow", 2, {1, 2, 3, 4}}};
  append(plain, 1, rich, 2);
  EXPECT_EQ(plain.texCoords, (std::vector<Vec2f>{{0, 0}, {1, 2}, {3, 4}}));
  EXPECT_EQ(plain.namedAttributes, (std::vector<NamedAttribute>{{"flow", 2, {0, 0, 1, 2, 3, 4}}}));
  EXPECT_TRUE(isConsistent(plain, 3));
  append(plain, 3, {}, 1);
  EXPECT_EQ(plain.namedAttributes[0].values.size(), 8u);
  EXPECT_TRUE(isConsistent(plain, 4));
}

TEST(VertexAttributes, AreVisitedInTheOrderOfTheirRoles) {
  VertexAttributes attributes, others;
  attributes.texCoords = {{1, 2}};
  others.colors = {Rgba8{1, 2, 3, 4}, Rgba8{5, 6, 7, 8}};
  std::vector<std::string> visited;
  visitAttributes(attributes, others, [&](const auto& row, const auto& values, const auto& otherValues) {
    EXPECT_EQ(row.role, vertexRoles[visited.size()]);
    EXPECT_STREQ(row.name, nameOf(row.role));
    EXPECT_EQ(hasAttribute(attributes, row.role), !values.empty());
    visited.push_back(row.name + std::to_string(values.size()) + std::to_string(otherValues.size()));
  });
  EXPECT_EQ(visited, (std::vector<std::string>{"normal00", "texCoord10", "texCoord100", "texCoord200", "texCoord300",
                                               "color02"}));
  EXPECT_FALSE(hasAnyAttribute({}));
  EXPECT_TRUE(hasAnyAttribute(attributes));
  others = {};
  others.namedAttributes = {{"heat", 1, {1}}};
  EXPECT_TRUE(hasAnyAttribute(others));
}

TEST(VertexAttributes, AreInconsistentWithAnotherCountOrARepeatedName) {
  VertexAttributes attributes;
  attributes.namedAttributes = {{"heat", 1, {1, 2}}};
  EXPECT_TRUE(isConsistent(attributes, 2));
  EXPECT_FALSE(isConsistent(attributes, 3));
  attributes.namedAttributes.push_back({"heat", 1, {1, 2}});
  EXPECT_FALSE(isConsistent(attributes, 2));
}

} // namespace
} // namespace imgeo
