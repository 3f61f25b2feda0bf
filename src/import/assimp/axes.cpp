#include "import/assimp/axes.h"

#include <algorithm>
#include <array>
#include <assimp/scene.h>
#include <cmath>
#include <optional>

namespace imgeo {

namespace {

/// A number of the file's metadata; nothing if the file has none of this name.
std::optional<double> metadataOf(const aiScene& scene, const char* name) {
  double number = 0;
  float single = 0;
  std::int32_t integer = 0;
  if (!scene.mMetaData)
    return std::nullopt;
  if (scene.mMetaData->Get(name, number))
    return number;
  if (scene.mMetaData->Get(name, single))
    return single;
  if (scene.mMetaData->Get(name, integer))
    return integer;
  return std::nullopt;
}

/// Formats without a convention, or whose files often disregard it. Assimp 5.2 passes their numbers on, except that it
/// takes 3DS files to be z up.
constexpr std::array<std::string_view, 7> formatsOfAnyAxis{"3ds", "amf", "cob", "nff", "raw", "smd", "stl"};

} // namespace

void addAssimpAxes(const aiScene& scene, std::string_view extension, Imported& imported) {
  imported.up = AxisDirection::y;
  if (extension == "blend" || extension == "3mf") {
    imported.up = AxisDirection::z;
    imported.metres = extension == "3mf" ? 0.001 : 1; // the default units of both
  } else if (extension == "fbx") {
    const bool isPositive = metadataOf(scene, "UpAxisSign").value_or(1) > 0;
    const double axis = metadataOf(scene, "UpAxis").value_or(1);
    imported.up = axis == 0   ? (isPositive ? AxisDirection::x : AxisDirection::minusX)
                  : axis == 2 ? (isPositive ? AxisDirection::z : AxisDirection::minusZ)
                              : (isPositive ? AxisDirection::y : AxisDirection::minusY);
    const double centimetres = metadataOf(scene, "UnitScaleFactor").value_or(1);
    if (centimetres > 0 && std::isfinite(centimetres))
      imported.metres = centimetres / 100;
  } else if (std::ranges::find(formatsOfAnyAxis, extension) != formatsOfAnyAxis.end()) {
    imported.up.reset();
  }
}

} // namespace imgeo
