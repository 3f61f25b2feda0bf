#include "import/unread_formats.h"

#include <algorithm>
#include <array>

namespace imgeo {
namespace {

using namespace std::string_view_literals;

/// Boundary representations, and projects of CAD programs.
constexpr std::array curvedSurfaces = {
    ".3dm"sv, ".brep"sv, ".brp"sv, ".catpart"sv, ".catproduct"sv, ".f3d"sv,    ".fcstd"sv,  ".iam"sv, ".iges"sv,
    ".igs"sv, ".ipt"sv,  ".jt"sv,  ".prt"sv,     ".sat"sv,        ".sldasm"sv, ".sldprt"sv, ".x_b"sv, ".x_t"sv,
};

/// Scenes of programs that export glTF, and USD.
constexpr std::array scenes = {
    ".c4d"sv, ".dwg"sv, ".ma"sv, ".max"sv, ".mb"sv, ".rvt"sv, ".skp"sv, ".usd"sv, ".usda"sv, ".usdc"sv, ".usdz"sv,
};

} // namespace

std::string_view adviceForUnread(std::string_view extension) {
  if (std::ranges::find(curvedSurfaces, extension) != curvedSurfaces.end())
    return adviceForCurvedSurfaces;
  if (std::ranges::find(scenes, extension) != scenes.end())
    return "; export the scene as glTF, which imgeo reads";
  return "";
}

} // namespace imgeo
