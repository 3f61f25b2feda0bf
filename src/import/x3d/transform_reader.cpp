#include "import/x3d/transform_reader.h"

#include <fmt/format.h>

namespace imgeo::x3d {

Transform readTransform(const Source& source, pugi::xml_node element, Faults& faults, std::vector<FieldText>& fields) {
  const auto numbers = [&](const char* field, std::size_t count) {
    std::vector<double> values = faults.attempt("A field is left out", [&] {
      std::vector<double> read = source.reals(element, field);
      if (element.attribute(field) && read.size() < count)
        source.fail(element, ErrorKind::malformed, fmt::format("{} has {} numbers of {}", field, read.size(), count));
      return read;
    });
    if (values.empty())
      std::erase_if(fields, [&](const FieldText& of) { return of.name == field; });
    return values;
  };
  const auto vector = [&](const char* field, Vec3d fallback) {
    const std::vector<double> v = numbers(field, 3);
    return v.empty() ? fallback : Vec3d{v[0], v[1], v[2]};
  };
  const auto rotation = [&](const char* field) {
    const std::vector<double> v = numbers(field, 4);
    return v.empty() ? Rotation{} : Rotation{{v[0], v[1], v[2]}, v[3]};
  };
  Transform transform;
  transform.translation = vector("translation", {});
  transform.rotation = rotation("rotation");
  transform.scale = vector("scale", {1, 1, 1});
  transform.scaleOrientation = rotation("scaleOrientation");
  transform.center = vector("center", {});
  return transform;
}

} // namespace imgeo::x3d
