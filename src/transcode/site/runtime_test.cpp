#include "transcode/site/runtime.h"

#include "base/file.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(Runtime, IsLinkedIntoTheLibraryByteForByte) {
  const auto expectSame = [](std::string_view bundled, const char* path) {
    const Bytes module = readFile(path);
    EXPECT_FALSE(module.empty());
    EXPECT_EQ(bundled, asText(module)) << path;
  };
  const auto [page, shared, scene, animation, worker, decoder] = bundledRuntime();
  expectSame(page, IMGEO_PAGE_MODULE);
  expectSame(shared, IMGEO_SHARED_MODULE);
  expectSame(scene, IMGEO_SCENE_MODULE);
  expectSame(animation, IMGEO_ANIMATION_MODULE);
  expectSame(worker, IMGEO_WORKER_MODULE);
  expectSame(decoder, IMGEO_DECODER_MODULE);
}

TEST(Runtime, ModulesOfASiteAreNamedByTheirContentAndImportEachOtherByTheseNames) {
  const auto [page, shared, scene, animation, worker, decoder] = runtimeOfSite();
  const auto expectNamed = [](const RuntimeFile& file, const std::string& stem) {
    EXPECT_EQ(file.name, stem + "-" + contentName(asBytes(file.text)) + ".js");
  };
  expectNamed(page, "imgeo");
  expectNamed(shared, "imgeo-shared");
  expectNamed(scene, "imgeo-scene");
  expectNamed(animation, "imgeo-animation");
  expectNamed(worker, "imgeo-worker");
  EXPECT_EQ(decoder.name, "imgeo-decoder-" + contentName(asBytes(decoder.text)) + ".wasm");
  EXPECT_EQ(animation.text, bundledRuntime().animation);
  EXPECT_EQ(worker.text, bundledRuntime().worker);
  EXPECT_EQ(decoder.text, bundledRuntime().decoder);
  const auto names = [](const RuntimeFile& file, const RuntimeFile& other) {
    return file.text.find("\"./" + other.name + "\"") != std::string::npos;
  };
  EXPECT_TRUE(names(page, shared));
  EXPECT_TRUE(names(page, scene));
  EXPECT_TRUE(names(scene, shared));
  EXPECT_TRUE(names(scene, animation));
  EXPECT_TRUE(names(shared, worker));
  EXPECT_TRUE(names(shared, decoder));
  for (const RuntimeFile* file : {&page, &shared, &scene, &animation, &worker}) {
    for (const char* bundled : {"imgeo.js", "imgeo-shared.js", "imgeo-scene.js", "imgeo-animation.js",
                                "imgeo-worker.js", "imgeo-decoder.wasm"}) {
      EXPECT_EQ(file->text.find(bundled), std::string::npos) << file->name << " names " << bundled;
    }
  }
}

TEST(Runtime, TheModuleOfOtherPagesImportsThoseOfTheSite) {
  const Runtime runtime = runtimeOfSite();
  const std::string text = runtimeModuleText(runtime);
  for (const RuntimeFile* file : {&runtime.shared, &runtime.page})
    EXPECT_NE(text.find("import \"./" + file->name + "\";"), std::string::npos) << text;
}

} // namespace
} // namespace imgeo
