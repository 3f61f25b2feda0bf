#pragma once
// A generated scene: a hall with a stage, rising rows of seats, stairs, columns, trusses, a doorway and textured signs.

#include "scene/scene.h"

namespace imgeo {

/// A scene in metres, y up, with the stage at the origin. All seats are instances of one mesh. `seats` is at least 1.
/// Deterministic.
Scene hallScene(std::uint32_t seats);

} // namespace imgeo
