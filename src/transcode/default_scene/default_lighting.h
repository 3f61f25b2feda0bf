#pragma once
// The lights and the material of scenes that have none of their own.

#include "scene/appearance.h"
#include "scene/lights.h"

namespace imgeo {

/// From above and to the right of a viewer in front, warmer than the headlight, so that relief has a bright side and a
/// dark one.
inline constexpr DirectionalLight keyLight{{-0.45, -0.8, -0.4}, {1.0f, 0.96f, 0.9f}, 0.4f};

/// From the opposite side, cooler, with ambient light: walls and ceilings of rooms are not black, wherever the viewer
/// looks.
inline constexpr DirectionalLight fillLight{{0.5, 0.7, 0.5}, {0.9f, 0.95f, 1.0f}, 0.3f};

/// What the fill light's ambient light adds, as a share of a surface's colour.
inline constexpr float ambientShare = 0.2f;

/// A warm stone whose shading shows the shape. It does not clip where all default lights meet:
/// (1 + 0.4) * (diffuse + specular) + 0.2 * diffuse is about 1.
inline constexpr Material stone{
    .diffuseColor{0.52f, 0.51f, 0.485f}, .specularColor{0.13f, 0.13f, 0.12f}, .shininess = 0.25f};

} // namespace imgeo
