#pragma once
// A scene: what import makes and documents write. Plain data; X3D's defaults.

#include "base/vec.h"
#include "scene/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// X3D Material: colours 0..1, shininess 0..1 (times 128 is the exponent).
struct Material {
  Vec3f diffuseColor{0.8f, 0.8f, 0.8f};
  Vec3f specularColor{0, 0, 0};
  Vec3f emissiveColor{0, 0, 0};
  float ambientIntensity = 0.2f;
  float shininess = 0.2f;
  float transparency = 0;
  friend bool operator==(const Material&, const Material&) = default;
};

/// X3D Viewpoint: looks along -z of `orientation` (unit axis, angle in radians).
struct Viewpoint {
  std::string description;
  Vec3d position{0, 0, 10};
  Vec3d orientationAxis{0, 0, 1};
  double orientationAngle = 0;
  double fieldOfView = 0.7854; ///< radians, along the shorter side
  Vec3d centerOfRotation{0, 0, 0};
};

/// X3D DirectionalLight: shines along `direction`.
struct DirectionalLight {
  Vec3d direction{0, 0, -1};
  Vec3f color{1, 1, 1};
  float intensity = 1;
};

/// One visible thing: a mesh and what it looks like.
struct Shape {
  std::string name;         ///< becomes its DEF; unique in the scene, may be empty
  std::size_t mesh = 0;     ///< index into Scene::meshes
  Material material;
};

struct Scene {
  std::string title;
  std::vector<Mesh> meshes;
  std::vector<Shape> shapes;
  std::vector<Viewpoint> viewpoints;
  std::vector<DirectionalLight> lights;
  bool headlight = true;
};

/// A viewpoint from which a box is seen whole, from slightly above and beside,
/// centred on the box; for pages whose source brings none.
Viewpoint viewpointFor(const Box3d& box);

} // namespace imgeo
