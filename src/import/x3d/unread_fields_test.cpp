// Reads each node of the table of unread fields with the field's default and with another value.

#include "import/x3d/unread_fields.h"

#include "import/testing.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo::x3d {
namespace {

std::vector<std::string> warningsOf(const std::string& scene) {
  Elements elements = parseXml("<X3D><Scene>" + scene + "</Scene></X3D>", "a.x3d");
  std::vector<std::string> warnings;
  warnOfUnreadFields(elements, warnings);
  return warnings;
}

std::string otherValue(const UnreadField& field) {
  return field.defaultText == "true" ? "FALSE" : field.defaultText == "false" ? "TRUE" : "7";
}

TEST(UnreadFields, AreReportedWhereTheyHaveAnotherValueThanTheDefault) {
  for (const UnreadField& field : unreadFields()) {
    const auto withValue = [&](const std::string& value) {
      return warningsOf(fmt::format("<{} {}='{}'/>", field.node, field.field, value));
    };
    EXPECT_EQ(withValue(std::string(field.defaultText)), (std::vector<std::string>{})) << field.node << field.field;
    std::vector<std::string> expected;
    if (!field.reason.empty())
      expected.push_back(
          fmt::format("Fields without effect, since {}: {}.{} (1).", field.reason, field.node, field.field));
    EXPECT_EQ(withValue(otherValue(field)), expected);
  }
}

TEST(UnreadFields, AreSortedByNode) {
  EXPECT_TRUE(std::ranges::is_sorted(unreadFields(), {}, &UnreadField::node));
}

TEST(UnreadFields, IncludeNodesAsValuesAndFurtherTextures) {
  EXPECT_EQ(
      warningsOf("<Shape><Appearance><Material/><Material containerField='backMaterial'/><MultiTexture mode='\"ADD\"'>"
                 "<ImageTexture/><PixelTexture/></MultiTexture></Appearance></Shape><MultiTexture><PixelTexture/>"
                 "</MultiTexture><Viewpoint nearDistance='-1.0' jump='True'/>"),
      (std::vector<std::string>{
          "Fields without effect, since of several textures the first is drawn: MultiTexture.mode (1), "
          "MultiTexture.texture (1).",
          "Fields without effect, since the back of a surface has the material of its front: "
          "Appearance.backMaterial (1)."}));
}

TEST(UnreadFields, AreReportedInTheSummaryOfEveryEncoding) {
  for (const auto& [name, text] :
       {std::pair{"a.x3dv", "#X3D V4.0 utf8\nShape { geometry Box { } } Viewpoint { viewAll TRUE }"},
        std::pair{"a.x3d", "<X3D version='4.0'><Scene><Shape><Box/></Shape><Viewpoint "
                           "viewAll='true'/></Scene></X3D>"}})
    EXPECT_EQ(importBytes(asBytes(std::string_view(text)), name).warnings,
              (std::vector<std::string>{
                  "Fields without effect, since viewpoints stand where they say: Viewpoint.viewAll (1)."}));
}

} // namespace
} // namespace imgeo::x3d
