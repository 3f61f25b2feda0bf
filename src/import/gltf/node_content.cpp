#include "import/gltf/node_content.h"

#include "import/text/rounded_decimal.h"

namespace imgeo::gltf {

std::string extrasOf(const Value& value) {
  const Value extras = value["extras"];
  return extras.isAbsent() ? "" : extras.json().dump(-1, ' ', false, Json::error_handler_t::replace);
}

Transform transformOfTrs(Vec3d translation, const std::vector<double>& rotation, Vec3d scale) {
  Transform transform;
  transform.translation = translation;
  transform.rotation = rotationOfQuaternion(rotation[0], rotation[1], rotation[2], rotation[3]);
  transform.scale = scale;
  return transform;
}

NodeContent transformOrGroup(Transform transform) {
  transform = rounded(transform);
  return transform == Transform{} ? NodeContent(Group{}) : NodeContent(transform);
}

} // namespace imgeo::gltf
