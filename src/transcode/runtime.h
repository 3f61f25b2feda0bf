#pragma once
// The browser's half of imgeo, carried inside the tool: every site gets a copy.

#include <string>
#include <string_view>

namespace imgeo {

/// The bundled ES modules as they were when the tool was built: the page's
/// (web/dist/imgeo.js), and the one that its workers run (imgeo-worker.js).
std::string_view bundledRuntime();
std::string_view bundledWorker();

/// A file named by what it holds.
struct RuntimeFile {
  std::string name;
  std::string text;
};

/// The two as a site has them, side by side: the runtime's text names the worker's file.
struct Runtime {
  RuntimeFile module;
  RuntimeFile worker;
};
Runtime runtimeOfSite();

} // namespace imgeo
