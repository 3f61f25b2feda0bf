#pragma once
// The TypeScript runtime, which is linked into the library. Every site gets a copy.

#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// A module as it was bundled into web/dist when the tool was built.
struct BundledModule {
  std::string_view name; ///< of the file in web/dist
  std::string_view text; ///< JavaScript; of imgeo-decoder.wasm, WebAssembly
};

/// All modules: those that web/modules.txt lists, in its order, and the decoder that workers use (src/wasm).
std::vector<BundledModule> bundledRuntime();

/// A file whose name contains the hash of its content.
struct RuntimeFile {
  std::string name;
  std::string text;
};

/// The modules as files of one folder of a site. They import each other by these names.
struct Runtime {
  std::vector<RuntimeFile> files; ///< in the order of bundledRuntime()

  const RuntimeFile& page() const;   ///< the page loads it first: draws the preview and loads the others
  const RuntimeFile& shared() const; ///< what both page() and scene() import
  const RuntimeFile& scene() const;  ///< three.js and all that every scene needs

  const RuntimeFile& filesPart() const; ///< what geometry of SIG classic and BG needs besides
  const RuntimeFile& cutPart() const;   ///< what meshes with levels of detail need first
};
Runtime runtimeOfSite();

/// The text of the module that other people's pages load, `runtimeModuleName` (site_files.h). Its name never changes,
/// so no page has to be edited after an upgrade; it imports the modules of `runtime`, which lie in the same folder.
std::string runtimeModuleText(const Runtime& runtime);

} // namespace imgeo
