#pragma once
// Generated motions: simulations whose vertices move from frame to frame while their number and their neighbours stay.
// They are deterministic: the same seed gives the same frames on every machine.

#include "base/vec.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// A simulation in metres, y up.
class Motion {
public:
  virtual ~Motion() = default;

  /// Advances the simulation by `seconds`, greater than 0 and at most 0.1.
  virtual void advance(double seconds) = 0;

  /// The vertices, row by row from the top left of the grid if there is one. Valid until the next advance().
  std::span<const Vec3f> positions() const { return positions_; }
  /// A number from 0 to 1 for each vertex, such as a speed or a reflectance; empty if the motion has none.
  std::span<const float> values() const { return values_; }
  /// Vertices in a row of the grid; 0: the vertices are no grid.
  std::uint32_t columns() const { return columns_; }
  /// Holds every position of every frame, but for gusts that no box should have to foresee.
  const Box3d& box() const { return box_; }

protected:
  std::vector<Vec3f> positions_;
  std::vector<float> values_;
  std::uint32_t columns_ = 0;
  Box3d box_;
};

/// Cloth of 2 m that hangs from its upper edge in a gusty wind: a square grid of `grid` x `grid` vertices, 2..2048,
/// moved by position based dynamics (Müller et al. 2007, "Position Based Dynamics"). The values are the speed of the
/// vertices in units of 4 m/s.
std::unique_ptr<Motion> makeCloth(std::uint32_t grid, std::uint32_t seed);

/// The surface of a basin of 4 m into which drops fall: a square grid of `grid` x `grid` vertices, 3..2048, moved by
/// the wave equation. The values are the heights: 0.5 is the level at rest, 0 and 1 are 0.25 m below and above it.
std::unique_ptr<Motion> makeWater(std::uint32_t grid, std::uint32_t seed);

/// A scanner with 64 lasers that turns ten times a second on a vehicle in a street: about `grid` * `grid` measured
/// points, in the order in which they are measured, each with its error. 8..2048. The values are the reflectances.
std::unique_ptr<Motion> makeTurntable(std::uint32_t grid, std::uint32_t seed);

/// A motion by its name: "cloth", "water" or "turntable"; nullptr if there is none of this name.
std::unique_ptr<Motion> makeMotion(const std::string& name, std::uint32_t grid, std::uint32_t seed);

} // namespace imgeo
