#include "transcode/runtime.h"

#include "base/file.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(Runtime, TheToolCarriesTheBundlesByteForByte) {
  const Bytes module = readFile(IMGEO_RUNTIME_MODULE);
  EXPECT_FALSE(module.empty());
  EXPECT_EQ(bundledRuntime(), asText(module));
  const Bytes worker = readFile(IMGEO_WORKER_MODULE);
  EXPECT_FALSE(worker.empty());
  EXPECT_EQ(bundledWorker(), asText(worker));
}

TEST(Runtime, InASiteNamesTheWorkersFileAndBothAreNamedByTheirContent) {
  const auto [module, worker] = runtimeOfSite();
  EXPECT_EQ(worker.text, bundledWorker());
  EXPECT_EQ(worker.name, "imgeo-worker-" + contentName(asBytes(worker.text)) + ".js");
  EXPECT_EQ(module.name, "imgeo-" + contentName(asBytes(module.text)) + ".js");
  const std::size_t grown = worker.name.size() - std::string("imgeo-worker.js").size();
  EXPECT_EQ(module.text.size(), bundledRuntime().size() + grown);
  EXPECT_NE(module.text.find("\"./" + worker.name + "\""), std::string::npos);
}

} // namespace
} // namespace imgeo
