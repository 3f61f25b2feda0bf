#include "transcode/sample/live_page.h"

#include "base/file.h"
#include "documents/documents.h"
#include "transcode/site/site_files.h"
#include "transcode/site/site_pages.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

/// The token as it stands in the query of a URL in an attribute.
std::string queryOf(const std::string& token) {
  if (token.empty())
    return "";
  std::string query = "?token=";
  for (const char c : token)
    query += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return query;
}

} // namespace

void writeLivePage(const std::filesystem::path& folder, const std::string& name, const Box3d& box,
                   const std::string& viewToken) {
  writeRuntime(folder);
  writeFile(folder / stylesheetName, asBytes(pageStylesheet()));
  const Vec3d center = box.center();
  const double distance = 1.1 * box.longestEdge();
  // From above and from the front, 25 degrees below the horizon.
  const std::string page = fmt::format(
      R"(<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8">
    <meta name="viewport" content="width=device-width, initial-scale=1">
    <title>{0}, live</title>
    <link rel="stylesheet" href="{1}">
    <script type="module" src="{2}/{3}"></script>
  </head>
  <body>
    <x3d alt="A live stream of vertices: {0}">
      <scene>
        <background skyColor="0.93 0.94 0.95"></background>
        <viewpoint position="{4} {5} {6}" orientation="-1 0 0 0.436" centerOfRotation="{7} {8} {9}"></viewpoint>
        <shape colorBy="value">
          <appearance><material></material></appearance>
          <imagegeometry coord="live/{0}{10}" solid="false"></imagegeometry>
        </shape>
      </scene>
    </x3d>
  </body>
</html>
)",
      name, stylesheetName, runtimeFolder, runtimeModuleName, center.x, center.y + 0.42 * distance,
      center.z + 0.91 * distance, center.x, center.y, center.z, queryOf(viewToken));
  writeFile(folder / pageName, asBytes(page));
}

} // namespace imgeo
