#include "scene/point_material.h"

namespace imgeo {

Material pointMaterialOf(const AnyMaterial& material) {
  Material unlit = phongOf(material);
  if (unlit.emissiveColor == Vec3f{})
    unlit.emissiveColor = unlit.diffuseColor;
  return unlit;
}

} // namespace imgeo
