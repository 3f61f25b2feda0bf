#include "transcode/site/runtime.h"

#include "base/file.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <functional>
#include <ranges>
#include <utility>

namespace imgeo {

namespace {

struct BundleEntry {
  const char* name;
  const char* begin;
  const char* end; ///< the byte after the last one
};

} // namespace

extern "C" {
/// The bundles, and after them an entry without a name: made by CMakeLists.txt.
extern const BundleEntry imgeoBundles[]; // NOLINT(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
}

namespace {

/// All names of modules begin with it.
constexpr std::string_view namePrefix = "imgeo";

/// The text with the site's names of the modules that it names, which are behind the first `first` modules. In one
/// pass: the runtime has almost a megabyte.
std::string withSiteNames(std::string_view text, const std::vector<BundledModule>& bundled,
                          const std::vector<RuntimeFile>& files, std::size_t first) {
  const std::boyer_moore_horspool_searcher searcher(namePrefix.begin(), namePrefix.end());
  std::string result;
  result.reserve(text.size() + 1024);
  for (;;) {
    const auto found = std::search(text.begin(), text.end(), searcher);
    result.append(text.begin(), found);
    text.remove_prefix(static_cast<std::size_t>(found - text.begin()));
    if (text.empty())
      return result;
    std::size_t named = first;
    while (named < bundled.size() && !text.starts_with(bundled[named].name))
      ++named;
    const bool isName = named < bundled.size();
    result.append(isName ? files[named].name : namePrefix);
    text.remove_prefix(isName ? bundled[named].name.size() : namePrefix.size());
  }
}

const RuntimeFile& moduleWithStem(const Runtime& runtime, std::string_view stem) {
  // The hash in a name has no dashes.
  const auto found = std::ranges::find_if(runtime.files, [&](const RuntimeFile& file) {
    return std::string_view(file.name).substr(0, file.name.rfind('-')) == stem;
  });
  assert(found != runtime.files.end());
  return *found;
}

} // namespace

std::vector<BundledModule> bundledRuntime() {
  std::vector<BundledModule> modules;
  for (const BundleEntry* entry = imgeoBundles; entry->name != nullptr; ++entry)
    modules.push_back({entry->name, {entry->begin, entry->end}});
  return modules;
}

Runtime runtimeOfSite() {
  const std::vector<BundledModule> bundled = bundledRuntime();
  Runtime runtime;
  runtime.files.resize(bundled.size());
  // A module names only modules after it, whose names are made first.
  for (std::size_t i = bundled.size(); i-- > 0;) {
    assert(bundled[i].name.starts_with(namePrefix));
    std::string text = withSiteNames(bundled[i].text, bundled, runtime.files, i + 1);
    const std::string_view name = bundled[i].name;
    const std::size_t dot = name.rfind('.');
    std::string siteName = fmt::format("{}-{}{}", name.substr(0, dot), contentName(asBytes(text)), name.substr(dot));
    runtime.files[i] = {std::move(siteName), std::move(text)};
  }
  return runtime;
}

const RuntimeFile& Runtime::page() const {
  return moduleWithStem(*this, "imgeo");
}

const RuntimeFile& Runtime::shared() const {
  return moduleWithStem(*this, "imgeo-shared");
}

const RuntimeFile& Runtime::scene() const {
  return moduleWithStem(*this, "imgeo-scene");
}

const RuntimeFile& Runtime::filesPart() const {
  return moduleWithStem(*this, "imgeo-files");
}

const RuntimeFile& Runtime::cutPart() const {
  return moduleWithStem(*this, "imgeo-cut");
}

std::string runtimeModuleText(const Runtime& runtime) {
  // The page's module imports the shared one itself; named here too, both are requested at once.
  return fmt::format(
      "// The runtime of imgeo. Servers should have this file revalidated (Cache-Control: no-cache), and may "
      "keep the files\n// that it names forever.\nimport \"./{}\";\nimport \"./{}\";\n",
      runtime.shared().name, runtime.page().name);
}

} // namespace imgeo
