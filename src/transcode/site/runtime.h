#pragma once
// The browser's half of imgeo, carried inside the tool: every site gets a copy.

#include <string>
#include <string_view>

namespace imgeo {

/// ES modules.
template <typename Module> struct RuntimeModules {
  Module page;   ///< what a page loads first: draws what it can, and brings the rest
  Module shared; ///< what `page` and `scene` both need
  Module scene;  ///< the rest
  Module worker; ///< what workers run
};

/// The modules as they were bundled into web/dist when the tool was built.
RuntimeModules<std::string_view> bundledRuntime();

/// A file named by what it holds.
struct RuntimeFile {
  std::string name;
  std::string text;
};

/// The modules as a site has them, side by side: their texts name each other's files.
using Runtime = RuntimeModules<RuntimeFile>;
Runtime runtimeOfSite();

} // namespace imgeo
