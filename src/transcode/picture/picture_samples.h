#pragma once
// Points on the surfaces of a scene, from which its picture is drawn after the meshes have been freed.

#include "scene/scene.h"
#include "scene/stored_meshes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace imgeo {

/// About how many samples of lines and points a picture is drawn from, and of triangles, of which it takes more up to
/// the maximum where their area is large for the scene's box.
inline constexpr std::size_t minPictureSamples = 200'000, maxPictureSamples = 600'000;

struct PictureSample {
  Vec3f position;                    ///< world coordinates
  Vec3f normal;                      ///< unit length; zero: unlit
  float size;                        ///< length, in world units, of the side of the square that the sample stands for
  std::array<std::uint8_t, 3> color; ///< sRGB
};

/// What a picture is drawn from.
struct PictureSamples {
  std::vector<PictureSample> samples;
  bool isWhole = true; ///< false: the scene has shapes that are not sampled (primitives and text of X3D sources)
};

/// Samples triangles by area, lines by length, and points, of all visible shapes: the first level of each LOD, the
/// chosen child of each Switch. At most about `maxSamples` of triangles, and of lines and points. Colours are those of
/// materials, vertices, and images of at most 2^26 pixels together; an image that cannot be decoded counts as white.
/// Deterministic. `stored`: meshes that are on the disk.
PictureSamples pictureSamplesOf(const Scene& scene, std::size_t maxSamples = maxPictureSamples,
                                const StoredMeshes* stored = nullptr);

} // namespace imgeo
