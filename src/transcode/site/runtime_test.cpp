#include "transcode/site/runtime.h"

#include "base/file.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// Names files of a site name by content.
bool names(const RuntimeFile& file, const RuntimeFile& other) {
  return file.text.find("./" + other.name) != std::string::npos;
}

const RuntimeFile& moduleOf(const Runtime& runtime, const std::string& stem) {
  for (const RuntimeFile& file : runtime.files)
    if (file.name.starts_with(stem + "-") && file.name.find('-', stem.size() + 1) == std::string::npos)
      return file;
  throw std::out_of_range(stem);
}

TEST(Runtime, IsLinkedIntoTheLibraryByteForByte) {
  const std::vector<BundledModule> modules = bundledRuntime();
  EXPECT_GE(modules.size(), 6u);
  for (const auto& [name, text] : modules) {
    const Bytes file = readFile(IMGEO_BUNDLES + std::string(name));
    EXPECT_FALSE(file.empty());
    EXPECT_EQ(text, asText(file)) << name;
  }
}

TEST(Runtime, ModulesOfASiteAreNamedByTheirContentAndImportEachOtherByTheseNames) {
  const std::vector<BundledModule> bundled = bundledRuntime();
  const Runtime runtime = runtimeOfSite();
  ASSERT_EQ(runtime.files.size(), bundled.size());
  for (std::size_t i = 0; i < bundled.size(); ++i) {
    const RuntimeFile& file = runtime.files[i];
    const std::string stem(bundled[i].name.substr(0, bundled[i].name.rfind('.')));
    const std::string_view extension = bundled[i].name.substr(stem.size());
    EXPECT_EQ(file.name, stem + "-" + contentName(asBytes(file.text)) + std::string(extension));
    for (const BundledModule& other : bundled)
      EXPECT_EQ(file.text.find(other.name), std::string::npos) << file.name << " names " << other.name;
  }
  EXPECT_TRUE(names(runtime.page(), runtime.shared()));
  EXPECT_TRUE(names(runtime.page(), runtime.scene()));
  EXPECT_TRUE(names(runtime.scene(), runtime.shared()));
  EXPECT_TRUE(names(runtime.shared(), moduleOf(runtime, "imgeo-worker")));
  EXPECT_NE(runtime.shared().text.find(moduleOf(runtime, "imgeo-decoder").name), std::string::npos);
}

TEST(Runtime, TheModuleOfOtherPagesImportsThoseOfTheSite) {
  const Runtime runtime = runtimeOfSite();
  const std::string text = runtimeModuleText(runtime);
  for (const RuntimeFile* file : {&runtime.shared(), &runtime.page()})
    EXPECT_NE(text.find("import \"./" + file->name + "\";"), std::string::npos) << text;
}

} // namespace
} // namespace imgeo
