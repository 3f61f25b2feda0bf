// Compares docs/formats/gltf-extensions.md with the table of extensions (IMGEO_REWRITE_GOLDEN=1 rewrites the page), and
// the reader with the table.

#include "import/gltf/extensions.h"

#include "base/file.h"
#include "import/gltf/testing.h"
#include "import/testing.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace imgeo::testing {
namespace {

using namespace gltf;
using Json = GltfText::Json;

std::string page() {
  std::map<ExtensionTreatment, std::size_t> counts;
  std::string rows;
  for (const ExtensionRow& row : extensionTable()) {
    ++counts[row.treatment];
    rows += fmt::format("| `{}` | {} | {} | {} |\n", row.name, nameOf(row.status), nameOf(row.treatment), row.note);
  }
  using enum ExtensionTreatment;
  return fmt::format(
      "# Extensions of glTF\n\n"
      "What `imgeo convert` makes of each extension of glTF 2.0 in Khronos' registry, and of others that files in use "
      "name. The page is made from the converter's own table, `src/import/gltf/extensions.cpp`. [nodes.md](nodes.md) "
      "describes the nodes that it names.\n\n"
      "| treatment | extensions | meaning |\n|---|--:|---|\n"
      "| drawn | {} | the picture is that of the extension |\n"
      "| approximated | {} | the model is drawn without the extension, or with something similar; the summary of "
      "`convert` says so in one line |\n"
      "| refused | {} | a file that requires the extension is refused with the sentence of the note (exit code 3); one "
      "that only uses it is drawn without it, with that sentence as a warning |\n"
      "| metadata | {} | the picture is the same with and without it; its data is left out |\n\n"
      "An extension that is not in the table is refused where a file requires it, and otherwise left out with a "
      "warning.\n\n"
      "| extension | status | treatment | note |\n|---|---|---|---|\n{}",
      counts[drawn], counts[approximated], counts[refused], counts[metadata], rows);
}

/// A triangle in a document that names the extension in the given list.
GltfText naming(std::string_view extension, const char* list) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  gltf.json[list] = {std::string(extension)};
  return gltf;
}

TEST(GltfExtensions, AreThePageOfTheDocumentation) {
  const std::filesystem::path file = IMGEO_DOCS "/formats/gltf-extensions.md";
  if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
    writeFile(file, asBytes(page()));
  EXPECT_EQ(asText(readFile(file)), page());
}

TEST(GltfExtensions, HaveOneRowEachAndAReasonUnlessTheyAreDrawn) {
  std::set<std::string_view> names;
  for (const ExtensionRow& row : extensionTable()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    const bool needsNoWarning =
        row.treatment == ExtensionTreatment::drawn || row.treatment == ExtensionTreatment::metadata;
    EXPECT_TRUE(needsNoWarning || !row.note.empty()) << row.name;
  }
}

TEST(GltfExtensions, AreTreatedAsTheTableSays) {
  for (const ExtensionRow& row : extensionTable()) {
    const Imported used = read(naming(row.name, "extensionsUsed"));
    const bool needsNoWarning =
        row.treatment == ExtensionTreatment::drawn || row.treatment == ExtensionTreatment::metadata;
    EXPECT_EQ(used.warnings, needsNoWarning ? std::vector<std::string>{}
                                            : std::vector<std::string>{fmt::format("{}: {}.", row.name, row.note)});
    const GltfText requiring = naming(row.name, "extensionsRequired");
    if (row.treatment != ExtensionTreatment::refused) {
      EXPECT_EQ(read(requiring).scene.meshes.size(), 1u) << row.name;
      continue;
    }
    const Error error = errorOf(requiring.text(), "a.gltf");
    EXPECT_EQ(error.kind(), ErrorKind::unsupported) << row.name;
    EXPECT_EQ(std::string(error.what()), fmt::format("a.gltf, extensionsRequired[0]: is {}: {}", row.name, row.note));
  }
}

TEST(GltfExtensions, ThatTheTableLacksAreRefusedWhereRequired) {
  EXPECT_EQ(read(naming("ACME_x", "extensionsUsed")).warnings,
            std::vector<std::string>{"Extensions that imgeo does not know are left out: ACME_x."});
  EXPECT_EQ(std::string(errorOf(naming("ACME_x", "extensionsRequired").text(), "a.gltf").what()),
            "a.gltf, extensionsRequired[0]: is ACME_x, which imgeo does not know");
}

} // namespace
} // namespace imgeo::testing
