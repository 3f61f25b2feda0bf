#include "transcode/site/runtime.h"

#include "base/file.h"

#include <fmt/format.h>

#include <cassert>
#include <initializer_list>

extern "C" {
// The first byte of each bundle and the byte after its last one, defined by runtime_module.S.
extern const char imgeoPageBegin[], imgeoPageEnd[];
extern const char imgeoSharedBegin[], imgeoSharedEnd[];
extern const char imgeoSceneBegin[], imgeoSceneEnd[];
extern const char imgeoAnimationBegin[], imgeoAnimationEnd[];
extern const char imgeoWorkerBegin[], imgeoWorkerEnd[];
extern const char imgeoDecoderBegin[], imgeoDecoderEnd[];
}

namespace imgeo {

namespace {

/// A bundle as a file of a site. Replaces the bundle names of the modules that it imports by their file names.
RuntimeFile siteFile(const std::string& stem, std::string_view bundle,
                     std::initializer_list<std::pair<const char*, const RuntimeFile*>> imports,
                     const char* extension = "js") {
  std::string text(bundle);
  for (const auto& [bundledName, file] : imports) {
    std::size_t position = text.find(bundledName);
    assert(position != text.npos);
    for (; position != text.npos; position = text.find(bundledName, position + file->name.size())) {
      text.replace(position, std::string_view(bundledName).size(), file->name);
    }
  }
  std::string name = fmt::format("{}-{}.{}", stem, contentName(asBytes(text)), extension);
  return {std::move(name), std::move(text)};
}

} // namespace

RuntimeModules<std::string_view> bundledRuntime() {
  return {{imgeoPageBegin, imgeoPageEnd},     {imgeoSharedBegin, imgeoSharedEnd},
          {imgeoSceneBegin, imgeoSceneEnd},   {imgeoAnimationBegin, imgeoAnimationEnd},
          {imgeoWorkerBegin, imgeoWorkerEnd}, {imgeoDecoderBegin, imgeoDecoderEnd}};
}

Runtime runtimeOfSite() {
  // The names are those of web/bundle.ts and of web/src/workers/pageWorkers.ts.
  const auto [page, shared, scene, animation, worker, decoder] = bundledRuntime();
  Runtime site;
  site.worker = siteFile("imgeo-worker", worker, {});
  site.decoder = siteFile("imgeo-decoder", decoder, {}, "wasm");
  site.shared =
      siteFile("imgeo-shared", shared, {{"imgeo-worker.js", &site.worker}, {"imgeo-decoder.wasm", &site.decoder}});
  site.animation = siteFile("imgeo-animation", animation, {});
  site.scene =
      siteFile("imgeo-scene", scene, {{"imgeo-shared.js", &site.shared}, {"imgeo-animation.js", &site.animation}});
  site.page = siteFile("imgeo", page, {{"imgeo-shared.js", &site.shared}, {"imgeo-scene.js", &site.scene}});
  return site;
}

std::string runtimeModuleText(const Runtime& runtime) {
  // The page's module imports the shared one itself; named here too, both are requested at once.
  return fmt::format(
      "// The runtime of imgeo. Servers should have this file revalidated (Cache-Control: no-cache), and may "
      "keep the files\n// that it names forever.\nimport \"./{}\";\nimport \"./{}\";\n",
      runtime.shared.name, runtime.page.name);
}

} // namespace imgeo
