// Compares docs/formats/x3d-nodes.md with the table of nodes. IMGEO_REWRITE_GOLDEN=1 rewrites the page.

#include "import/x3d/node_table.h"
#include "import/x3d/unread_fields.h"

#include "base/file.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace imgeo::x3d {
namespace {

enum class Origin { x3d, others, statements };

Origin originOf(const NodeRow& row) {
  return row.level > 0 ? Origin::x3d : row.component == "statement" ? Origin::statements : Origin::others;
}

std::string rowsOf(Origin origin) {
  std::string text;
  for (const NodeRow& row : nodeTable())
    if (originOf(row) == origin) {
      text += fmt::format("| `{}` ", row.name);
      if (origin == Origin::x3d)
        text += fmt::format("| {} {} ", row.component, row.level);
      if (origin == Origin::others)
        text += fmt::format("| {} ", row.component);
      text += fmt::format("| {} | {} |\n", nameOf(row.treatment), row.note);
    }
  return text;
}

std::string rowsOfUnreadFields() {
  std::string text;
  for (const UnreadField& row : unreadFields())
    text += fmt::format("| `{}` | `{}` | {} | {} |\n", row.node, row.field, row.defaultText, row.reason);
  return text;
}

std::string page() {
  std::map<NodeTreatment, std::size_t> counts;
  for (const NodeRow& row : nodeTable())
    counts[row.treatment] += originOf(row) == Origin::x3d;
  using enum NodeTreatment;
  return fmt::format(
      "# All nodes of X3D\n\n"
      "What `imgeo convert` makes of each node of X3D 4.0 (ISO/IEC 19775-1:2023), in every encoding: XML, classic VRML "
      "and JSON. The page is made from the converter's own table, `src/import/x3d/node_table.cpp`. "
      "[nodes.md](nodes.md) "
      "describes the fields of the nodes that pages read.\n\n"
      "| treatment | nodes of X3D 4.0 | meaning |\n|---|--:|---|\n"
      "| drawn | {} | pages draw or play it, or it is a part of what they draw; a note says of what it is not all |\n"
      "| converted | {} | `convert` writes what the note says, which pages draw; the summary has a line |\n"
      "| kept | {} | stays in the document, but in geometry that becomes images or arrays, without effect; where there "
      "is a note, the summary has a line with it |\n"
      "| dropped | {} | is left out with its children; the summary has a line with the reason, the number of such "
      "nodes "
      "and the location of the first; `--strict` refuses the file |\n\n"
      "An element of no row is dropped as well. A USE of a dropped node is left out too; a USE of one of its "
      "descendants "
      "is not.\n\n"
      "## Nodes of X3D 4.0\n\n| node | component, level | treatment | note |\n|---|---|---|---|\n{}\n"
      "## Nodes of other programs\n\n| node | of | treatment | note |\n|---|---|---|---|\n{}\n"
      "## Statements\n\n| statement | treatment | note |\n|---|---|---|\n{}\n"
      "## Fields without effect\n\nOf nodes that are drawn or converted. All their other fields are in "
      "[nodes.md](nodes.md). Where there is a reason, the summary has a line for values other than the default; the "
      "rest are hints, or change nothing in a still picture.\n\n"
      "| node | field | default | reason |\n|---|---|---|---|\n{}",
      counts[drawn], counts[converted], counts[kept], counts[dropped], rowsOf(Origin::x3d), rowsOf(Origin::others),
      rowsOf(Origin::statements), rowsOfUnreadFields());
}

TEST(NodeTable, IsThePageOfTheDocumentation) {
  const std::filesystem::path file = IMGEO_DOCS "/formats/x3d-nodes.md";
  if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
    writeFile(file, asBytes(page()));
  EXPECT_EQ(asText(readFile(file)), page());
}

TEST(NodeTable, GivesAReasonForWhatIsNotDrawn) {
  for (const NodeRow& row : nodeTable()) {
    EXPECT_FALSE(row.component.empty()) << row.name;
    EXPECT_FALSE(row.containerField.empty()) << row.name;
    const bool needsNote = row.treatment == NodeTreatment::dropped || row.treatment == NodeTreatment::converted;
    EXPECT_FALSE(needsNote && row.note.empty()) << row.name;
    ASSERT_NE(nodeRow(row.name), nullptr) << row.name;
    EXPECT_EQ(nodeRow(row.name)->component, row.component) << row.name;
  }
  EXPECT_EQ(nodeRow("Sphere")->component, "Geometry3D");
  EXPECT_EQ(nodeRow("sphere"), nullptr);
}

} // namespace
} // namespace imgeo::x3d
