#include "import/format.h"

#include "base/error.h"
#include "import/assimp/assimp.h"
#include "import/dem/dem.h"
#include "import/e57/e57.h"
#include "import/gltf/gltf.h"
#include "import/gltf/gltf1.h"
#include "import/las/las.h"
#include "import/obj/obj.h"
#include "import/off/off.h"
#include "import/ply/ply.h"
#include "import/pts/pts.h"
#include "import/source_name.h"
#include "import/stl/stl.h"
#include "import/unread_formats.h"
#include "import/vrml/vrml.h"
#include "import/x3d/page.h"
#include "import/x3d/x3d.h"
#include "import/x3d_json/x3d_json.h"
#include "import/xyz/xyz.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace imgeo {

namespace {

using namespace std::string_view_literals;

constexpr std::array pageExtensions{".html"sv, ".htm"sv, ".xhtml"sv, ".xht"sv};
constexpr std::array x3dExtensions{".x3d"sv, ".x3dz"sv};
constexpr std::array vrmlExtensions{".wrl"sv, ".wrz"sv, ".vrml"sv, ".x3dv"sv, ".x3dvz"sv};
constexpr std::array x3dJsonExtensions{".x3dj"sv, ".x3djz"sv, ".json"sv};
constexpr std::array gltfExtensions{".gltf"sv, ".glb"sv};
constexpr std::array plyExtensions{".ply"sv};
constexpr std::array objExtensions{".obj"sv};
constexpr std::array stlExtensions{".stl"sv};
constexpr std::array lasExtensions{".las"sv, ".laz"sv};
constexpr std::array e57Extensions{".e57"sv};

constexpr std::array<Format, 16> rows{{
    {.name = "X3D",
     .help = "X3D",
     .extensions = x3dExtensions,
     .sniff = isX3d,
     .isYUpInMetres = true,
     .isX3d = true,
     .read = readX3d},
    {.name = "HTML",
     .help = "HTML",
     .extensions = pageExtensions,
     .sniff = isPage,
     .isYUpInMetres = true,
     .isX3d = true,
     .read = readPage},
    {.name = "VRML",
     .help = "VRML",
     .extensions = vrmlExtensions,
     .sniff = isVrml,
     .isYUpInMetres = true,
     .isX3d = true,
     .read = readVrml},
    {.name = "X3D JSON",
     .extensions = x3dJsonExtensions,
     .sniff = isX3dJson,
     .isYUpInMetres = true,
     .isX3d = true,
     .read = readX3dJson},
    {.name = "glTF",
     .help = "glTF, GLB",
     .extensions = gltfExtensions,
     .sniff = isGltf,
     .isYUpInMetres = true,
     .read = readGltf},
    {.name = "glTF 1.0", .sniff = isGltf1, .isYUpInMetres = true, .read = readGltf1},
    {.name = "PLY", .help = "PLY", .extensions = plyExtensions, .sniff = isPly, .read = readPly},
    {.name = "OBJ",
     .help = "OBJ",
     .extensions = objExtensions,
     .sniff = resemblesObj,
     .sniffing = Sniffing::heuristic,
     .read = readObj},
    {.name = "STL", .help = "STL", .extensions = stlExtensions, .sniff = isStl, .read = readStl},
    {.name = "OFF", .help = "OFF", .extensions = offExtensions, .sniff = isOff, .read = readOff},
    {.name = "LAS", .help = "LAS", .extensions = lasExtensions, .sniff = isLas, .read = readLas},
    {.name = "E57", .help = "E57", .extensions = e57Extensions, .sniff = isE57, .read = readE57},
    {.name = "PTS", .help = "PTS", .extensions = ptsExtensions, .read = readPts},
    {.name = "GeoTIFF and other grids of heights",
     .help = "GeoTIFF",
     .extensions = demExtensions,
     .sniff = isDem,
     .isYUpInMetres = true,
     .read = readDem},
    {.name = "XYZ", // behind PTS and grids of heights, which have the extension where the bytes do not resemble XYZ
     .help = "XYZ",
     .extensions = xyzExtensions,
     .sniff = resemblesXyz,
     .sniffing = Sniffing::extension,
     .read = readXyz},
    {.name = "those of Assimp (Collada, FBX, 3DS ...)", .readsExtension = isReadByAssimp, .read = readByAssimp},
}};

const Format* sniffed(ByteSpan bytes, Sniffing sniffing) {
  const auto row = std::ranges::find_if(
      rows, [&](const Format& format) { return format.sniff && format.sniffing == sniffing && format.sniff(bytes); });
  return row == rows.end() ? nullptr : &*row;
}

bool hasExtension(const Format& format, const std::string& name) {
  return std::ranges::find(format.extensions, extensionOf(name)) != format.extensions.end();
}

const Format* rowOfExtension(const std::string& name) {
  const auto row = std::ranges::find_if(rows, [&](const Format& format) { return hasExtension(format, name); });
  return row == rows.end() ? nullptr : &*row;
}

/// "a, b or c" of {"a", "b", "c"} and " or ".
std::string listed(const std::vector<std::string_view>& names, std::string_view beforeLast) {
  const std::span rest = std::span(names).first(names.size() - 1);
  return fmt::format("{}{}{}", fmt::join(rest, ", "), beforeLast, names.back());
}

} // namespace

std::span<const Format> formats() {
  return rows;
}

const Format& formatOf(ByteSpan bytes, const std::string& name) {
  if (const Format* row = sniffed(bytes, Sniffing::signature))
    return *row;
  for (const Format& row : rows)
    if (row.sniffing == Sniffing::extension && hasExtension(row, name) && row.sniff(bytes))
      return row;
  const Format* const byExtension = rowOfExtension(name);
  if (!byExtension) // before the heuristics: Assimp also reads text that resembles OBJ
    for (const Format& row : rows)
      if (row.readsExtension && row.readsExtension(name))
        return row;
  if (const Format* row = sniffed(bytes, Sniffing::heuristic))
    return *row;
  if (byExtension)
    return *byExtension;
  std::vector<std::string_view> names;
  std::ranges::transform(rows, std::back_inserter(names), &Format::name);
  throw Error(ErrorKind::unsupported, name,
              fmt::format("is in no format that imgeo reads, which are {}{}", listed(names, " and "),
                          adviceForUnread(extensionOf(name))));
}

bool hasX3dExtension(const std::string& name) {
  const Format* row = rowOfExtension(name);
  return row && row->isX3d;
}

std::string formatHelp() {
  std::vector<std::string_view> names;
  for (const Format& row : rows)
    if (!row.help.empty())
      names.push_back(row.help);
  return listed(names, " or ");
}

} // namespace imgeo
