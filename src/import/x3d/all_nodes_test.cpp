// Reads each node of the table in each encoding, and compares the summary with the table.

#include "import/testing.h"
#include "import/x3d/testing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace imgeo::x3d::testing {
namespace {

/// A part of the warning that the summary must have for one node of a row; "" where no warning may name the node.
std::string expectedWarning(const NodeRow& row) {
  switch (row.treatment) {
  case NodeTreatment::drawn:
    return "";
  case NodeTreatment::converted:
    return fmt::format("Written as other nodes: {} as ", row.name);
  case NodeTreatment::kept:
    return row.note.empty() ? "" : fmt::format("Without effect, since {}: {} (1)", row.note, row.name);
  case NodeTreatment::dropped:
    return fmt::format("{} (1) left out, since {}; it is at {}:", row.name, row.note, "all");
  }
  return "";
}

TEST(AllNodes, AreTreatedAsTheTableSaysInEveryEncoding) {
  for (const NodeRow& row : nodeTable()) {
    if (row.component == "statement" || row.component == "imgeo" || row.name == "SurfaceShaderTexture" ||
        row.name == "ExternalShape") // the sample names no file
      continue;
    for (const DocumentEncoding encoding : encodings) {
      const std::string text = documentOf({sampleOf(row)}, encoding), file = fileNameOf(encoding);
      SCOPED_TRACE(text);
      const Imported imported = importBytes(asBytes(text), file);
      const std::string all = fmt::format("{}", fmt::join(imported.warnings, "\n"));
      std::string expected = expectedWarning(row);
      if (const std::size_t at = expected.find("it is at all:"); at != expected.npos)
        expected.replace(at + 9, 3, file);
      if (expected.empty())
        for (const std::string& warning : imported.warnings)
          EXPECT_FALSE(warning.find(std::string(row.name) + " (") != warning.npos &&
                       (warning.find("left out") != warning.npos || warning.starts_with("Without effect")))
              << warning;
      else
        EXPECT_NE(all.find(expected), std::string::npos) << all << "\n" << expected;
      const bool isWritten = std::ranges::any_of(imported.scene.graph.nodes, [&](const Node& node) {
        const GenericNode* generic = std::get_if<GenericNode>(&node.content);
        return generic && generic->element == row.name;
      });
      EXPECT_FALSE(isWritten && (row.treatment == NodeTreatment::dropped || row.treatment == NodeTreatment::converted));
    }
  }
}

} // namespace
} // namespace imgeo::x3d::testing
