#include "transcode/site/x3dom_release.h"

#include "containers/encodings.h"

#include <algorithm>
#include <string_view>

namespace imgeo {

namespace {

struct PublishedRelease {
  std::string_view version;
  const char *scriptIntegrity, *stylesheetIntegrity;
};

constexpr PublishedRelease releases[] = {
    {"1.7.2", "sha384-oQ9tNXncaw82KCZEOw04VVSHG3NtBhpBNgFO7k34hf/gtRbwB/a6f9w5swP8aFlx",
     "sha384-SxENDTJ8EH9KycoVNkxmZ/41CqFFDFc/hjL9GpNIN+Oe0dwqFf7Usel+IODWsBi9"},
    {"1.8.3", "sha384-w8ORWjdI7HWkA1nJ1+2+fC+tGuvNaL+vnbcMsCCG5HkvwKXgEgdGBx1uqh2wVuri",
     "sha384-rVRMZrgMA6SaDQGaoPcnpA+ILV3OYdc3yMT3eg08bxgtM9OowE4X8gd4AlKOYNl2"},
};

} // namespace

X3domRelease x3domReleaseFor(Encoding encoding, const std::string& folderUrl) {
  const std::string version = rowOf(encoding).x3domVersion;
  const PublishedRelease& published = *std::ranges::find(releases, version, &PublishedRelease::version);
  if (folderUrl.empty()) {
    const std::string folder = "https://cdn.jsdelivr.net/npm/x3dom@" + version + "/";
    return {version,
            {folder + "x3dom.js", published.scriptIntegrity, folder + "x3dom.css", published.stylesheetIntegrity}};
  }
  const std::string folder = folderUrl + (folderUrl.ends_with('/') ? "" : "/");
  return {version, {folder + "x3dom.js", "", folder + "x3dom.css", ""}};
}

} // namespace imgeo
