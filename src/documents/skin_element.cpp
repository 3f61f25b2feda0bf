#include "documents/skin_element.h"

#include "markup/find_x3d.h"

namespace imgeo {

Element humanoidElement(const Humanoid& humanoid, const Attributes& names) {
  // Without "-0", and as short as single precision, from which the numbers come, allows.
  const auto column = [](Vec3d v) { return numbers(Vec3f(v + Vec3d{})); };
  std::string matrices;
  for (const Affine3d& map : humanoid.inverseBindings) {
    if (!matrices.empty())
      matrices += "  ";
    matrices += column(map.x) + " 0 " + column(map.y) + " 0 " + column(map.z) + " 0 " + column(map.translation) + " 1";
  }
  return {"HAnimHumanoid", {names, {{inverseBindingsField, matrices}}}};
}

Element jointElement(const std::string& name) {
  return {"HAnimJoint", {{{"USE", name}, {"containerField", "joints"}}}};
}

bool isJointElement(const FieldReader& fields) {
  return equalIgnoringCase(fields.node().name(), "HAnimJoint") && fields.text("containerField") == "joints" &&
         fields.has("USE");
}

std::vector<Affine3d> readInverseBindings(const FieldReader& fields, std::size_t jointCount) {
  const std::vector<double> m = fields.reals(inverseBindingsField);
  if (m.size() != 16 * jointCount)
    fields.fail(ErrorKind::malformed, std::string(inverseBindingsField) + " has " + std::to_string(m.size()) +
                                          " numbers for " + std::to_string(jointCount) + " joints");
  std::vector<Affine3d> maps;
  for (std::size_t i = 0; i < m.size(); i += 16)
    maps.push_back({{m[i], m[i + 1], m[i + 2]},
                    {m[i + 4], m[i + 5], m[i + 6]},
                    {m[i + 8], m[i + 9], m[i + 10]},
                    {m[i + 12], m[i + 13], m[i + 14]}});
  return maps;
}

} // namespace imgeo
