#include "import/vrml1/report.h"

#include "import/warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo::vrml1 {

namespace {

std::string listed(const Report::Counts& counts) {
  std::vector<std::string> names;
  for (const auto& [name, count] : counts)
    names.push_back(fmt::format("{} ({})", name, count));
  return fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

std::vector<std::string> Report::warnings() const {
  std::vector<std::string> warnings;
  if (!unknownNodes.empty())
    warnings.push_back(fmt::format("Nodes that VRML 1.0 does not have, of which only the child nodes are read: {}.",
                                   listed(unknownNodes)));
  if (!unknownFields.empty())
    warnings.push_back(fmt::format("Fields that VRML 1.0 does not have are left out: {}.", listed(unknownFields)));
  if (mixedMaterials > 0)
    warnings.push_back(fmt::format("The materials of {} differ by vertex in more than diffuse colour and "
                                   "transparency; of the rest the first material counts.",
                                   counted(mixedMaterials, "shape", "shapes")));
  if (projections > 0)
    warnings.push_back(fmt::format("{} in perspective, and only the affine part is kept.",
                                   counted(projections, "MatrixTransform projects", "MatrixTransforms project")));
  if (shearedTextures > 0)
    warnings.push_back(fmt::format("{} a texture; the texture is rotated and scaled without shear.",
                                   counted(shearedTextures, "Texture2Transform shears", "Texture2Transforms shear")));
  if (pointMaps > 0)
    warnings.push_back(fmt::format("{} without the point of the click.",
                                   counted(pointMaps, "WWWAnchor requests its URL", "WWWAnchors request their URLs")));
  if (textMaterials > 0)
    warnings.push_back(
        fmt::format("{} the material of its first line.",
                    counted(textMaterials, "AsciiText has in all lines", "AsciiTexts have in all lines")));
  return warnings;
}

} // namespace imgeo::vrml1
