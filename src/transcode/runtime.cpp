#include "transcode/runtime.h"

#include "base/file.h"

#include <fmt/format.h>

#include <cassert>

extern "C" {
// Placed by runtime_module.S around the bytes of the bundles.
extern const char imgeoRuntimeBegin[];
extern const char imgeoRuntimeEnd[];
extern const char imgeoWorkerBegin[];
extern const char imgeoWorkerEnd[];
}

namespace imgeo {

std::string_view bundledRuntime() {
  return {imgeoRuntimeBegin, imgeoRuntimeEnd};
}

std::string_view bundledWorker() {
  return {imgeoWorkerBegin, imgeoWorkerEnd};
}

Runtime runtimeOfSite() {
  constexpr std::string_view bundledName = "imgeo-worker.js"; // as in web/src/workers/pageWorkers.ts
  const auto named = [](const char* stem, std::string text) {
    std::string name = fmt::format("{}-{}.js", stem, contentName(asBytes(text)));
    return RuntimeFile{std::move(name), std::move(text)};
  };
  RuntimeFile worker = named("imgeo-worker", std::string(bundledWorker()));
  std::string module(bundledRuntime());
  const std::size_t place = module.find(bundledName);
  assert(place != module.npos && module.find(bundledName, place + 1) == module.npos);
  module.replace(place, bundledName.size(), worker.name);
  return {named("imgeo", std::move(module)), std::move(worker)};
}

} // namespace imgeo
