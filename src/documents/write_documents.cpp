#include "documents/documents.h"

#include "documents/text.h"
#include "documents/x3d_element.h"

#include <algorithm>

namespace imgeo {

namespace {

/// More hints than this compete with what they are to hasten.
constexpr std::size_t maxPreloads = 16;

/// What the runtime requests first, in its order: the most significant
/// coordinate bytes of all patches, then their indices.
std::vector<std::string> firstRequests(const SceneDocument& document) {
  std::vector<std::string> urls;
  const auto add = [&](const Reference& reference) {
    if (urls.size() < maxPreloads && std::ranges::find(urls, reference.url) == urls.end())
      urls.push_back(reference.url);
  };
  const auto forEachPatch = [&](auto visit) {
    for (const Shape& shape : document.shapes)
      for (const PatchDescription& patch : document.geometries.at(shape.mesh).patches)
        visit(patch);
  };
  forEachPatch([&](const PatchDescription& patch) {
    if (!patch.coord.empty())
      add(patch.coord[0]);
  });
  forEachPatch([&](const PatchDescription& patch) {
    if (patch.index)
      add(*patch.index);
  });
  return urls;
}

} // namespace

std::string writeX3d(const SceneDocument& document) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + x3dElement(document, 0);
}

std::string writeHtml(const SceneDocument& document, const PageOptions& options) {
  std::string html = "<!doctype html>\n"
                     "<html lang=\"en\">\n"
                     "  <head>\n"
                     "    <meta charset=\"utf-8\">\n"
                     "    <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "    <title>" +
                     escapeText(document.title.empty() ? "imgeo" : document.title) + "</title>\n";
  html += "    <link rel=\"stylesheet\" href=" + quoteAttribute(options.stylesheetUrl) + ">\n";
  html += "    <link rel=\"modulepreload\" href=" + quoteAttribute(options.runtimeUrl) + ">\n";
  for (const std::string& url : firstRequests(document))
    html += "    <link rel=\"preload\" as=\"fetch\" crossorigin=\"anonymous\" fetchpriority=\"high\" href=" +
            quoteAttribute(url) + ">\n";
  html += "    <script type=\"module\" src=" + quoteAttribute(options.runtimeUrl) +
          "></script>\n"
          "  </head>\n"
          "  <body>\n"
          "    <noscript>This page shows a 3D model and needs JavaScript to draw it.</noscript>\n";
  html += x3dElement(document, 2);
  html += "  </body>\n"
          "</html>\n";
  return html;
}

std::string_view pageStylesheet() {
  return R"css(html,
body {
  height: 100%;
  margin: 0;
  background: #edf0f2;
  color: #333;
  font: 1rem/1.5 system-ui, sans-serif;
}

x3d {
  display: block;
  width: 100%;
  height: 100%;
  overflow: hidden;
}

noscript {
  display: block;
  padding: 2rem;
  text-align: center;
}
)css";
}

} // namespace imgeo
