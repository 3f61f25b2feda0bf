#pragma once
// The TypeScript runtime, which is linked into the library. Every site gets a copy.

#include <string>
#include <string_view>

namespace imgeo {

/// One value for each module of the runtime: JavaScript except for the last.
template <typename Module> struct RuntimeModules {
  Module page;      ///< the page loads it first: draws the preview and loads the others
  Module shared;    ///< used by `page` and `scene`
  Module scene;     ///< three.js and all else
  Module animation; ///< loaded by `scene` where the document has nodes that send events
  Module worker;    ///< runs in workers
  Module decoder;   ///< WebAssembly that workers decode compact with (src/wasm)
};

/// The modules as they were bundled into web/dist when the tool was built.
RuntimeModules<std::string_view> bundledRuntime();

/// A file whose name contains the hash of its content.
struct RuntimeFile {
  std::string name;
  std::string text;
};

/// The modules as files of one folder of a site; they import each other by these names.
using Runtime = RuntimeModules<RuntimeFile>;
Runtime runtimeOfSite();

/// The text of the module that other people's pages load, `runtimeModuleName` (site_files.h). Its name never changes,
/// so no page has to be edited after an upgrade; it imports the modules of `runtime`, which lie in the same folder.
std::string runtimeModuleText(const Runtime& runtime);

} // namespace imgeo
