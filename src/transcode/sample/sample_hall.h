#pragma once
// A hall to try things with: rows of seats that rise from a stage, stairs, columns,
// trusses, a doorway, and signs with textures.

#include "scene/scene.h"

namespace imgeo {

/// A scene in metres, y up, with the stage at its origin. Every seat is the same mesh.
/// `seats` is at least 1. Deterministic.
Scene hallScene(std::uint32_t seats);

} // namespace imgeo
