#include "import/gltf/instances.h"

#include "import/gltf/node_content.h"

#include <cmath>
#include <fmt/format.h>

namespace imgeo::gltf {

std::optional<std::vector<Transform>> instanceTransforms(Document& document, const Value& node) {
  const Value instancing = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  if (instancing.isAbsent())
    return std::nullopt;
  std::optional<std::size_t> count;
  const auto accessor = [&](const char* name, std::uint32_t components) {
    const std::optional<std::size_t> index = instancing.index(name, document.array("accessors"));
    std::optional<Accessor> read;
    if (!index)
      return read;
    read = document.accessor(*index);
    if (read->components() != components || (count && *count != read->count()))
      instancing[name].fail(ErrorKind::malformed, "does not fit the other attributes of the instances");
    count = read->count();
    return read;
  };
  const std::optional<Accessor> translations = accessor("TRANSLATION", 3), rotations = accessor("ROTATION", 4),
                                scales = accessor("SCALE", 3);
  document.spend(instancing, count.value_or(0) * 512); // the nodes of the instances
  std::vector<Transform> transforms;
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    const auto number = [&](const std::optional<Accessor>& from, std::uint32_t component, double fallback) {
      const double value = from ? from->real(i, component) : fallback;
      if (!std::isfinite(value))
        instancing.fail(ErrorKind::malformed, fmt::format("the transform of instance {} is not finite", i));
      return value;
    };
    const auto vector = [&](const std::optional<Accessor>& from, double fallback) {
      return Vec3d{number(from, 0, fallback), number(from, 1, fallback), number(from, 2, fallback)};
    };
    transforms.push_back(transformOfTrs(
        vector(translations, 0),
        {number(rotations, 0, 0), number(rotations, 1, 0), number(rotations, 2, 0), number(rotations, 3, 1)},
        vector(scales, 1)));
  }
  return transforms;
}

} // namespace imgeo::gltf
