#pragma once
// X3D's light nodes (ISO/IEC 19775-1, 17), with X3D's defaults.

#include "base/vec.h"

namespace imgeo {

/// X3D DirectionalLight: parallel light along `direction`. Intensities of lights are 0 .. 1 in X3D and unbounded in
/// glTF.
struct DirectionalLight {
  Vec3d direction{0, 0, -1};
  Vec3f color{1, 1, 1};
  float intensity = 1;
  bool global = false;        ///< false: lights the descendants of the light's parent only
  float ambientIntensity = 0; ///< 0 .. 1; independent of the surface's orientation
  friend bool operator==(const DirectionalLight&, const DirectionalLight&) = default;
};

/// X3D PointLight: at distance d the light is divided by max(a + b d + c d^2, 1), where a, b, c are `attenuation`, and
/// ends at `radius`.
struct PointLight {
  Vec3d location;
  Vec3d attenuation{1, 0, 0};
  double radius = 100;
  Vec3f color{1, 1, 1};
  float intensity = 1;
  bool global = true;
  float ambientIntensity = 0;
  friend bool operator==(const PointLight&, const PointLight&) = default;
};

/// X3D SpotLight: a cone of light, constant up to `beamWidth` from its axis and falling to zero at `cutOffAngle`, both
/// in radians.
struct SpotLight {
  Vec3d location;
  Vec3d direction{0, 0, -1};
  double beamWidth = 0.7854, cutOffAngle = 1.5708;
  Vec3d attenuation{1, 0, 0};
  double radius = 100;
  Vec3f color{1, 1, 1};
  float intensity = 1;
  bool global = true;
  float ambientIntensity = 0;
  friend bool operator==(const SpotLight&, const SpotLight&) = default;
};

} // namespace imgeo
