#pragma once
// Image operators as geometry operators (paper, section 7.4): the field `operators` of geometry nodes, and `imgeo
// transform`. They map points of a geometry's box, whose coordinates are 0 .. 1 as those of an image's channels.
// web/src/document/operators.ts is the same in pages; vectors/operators.json binds both.

#include "base/vec.h"
#include "scene/mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// What happens to a coordinate c of each axis.
enum class OperatorKind : std::uint8_t {
  affine,  ///< a c + b
  power,   ///< max(c, 0)^a
  fold,    ///< c beyond a is mirrored at a
  clamp,   ///< the nearest of a .. b
  steps,   ///< the nearest multiple of 1 / a
  permute, ///< axis n gets the coordinate of axis a[n]
  blur ///< a.x is its radius in texels; it filters the image of the points (containers/blur.h), and a point alone stays
};

/// "affine", "power" ...
const char* nameOf(OperatorKind kind);

struct Operator {
  OperatorKind kind = OperatorKind::affine;
  Vec3d a, b;
  friend bool operator==(const Operator&, const Operator&) = default;
};

inline constexpr std::size_t maxOperators = 16;
/// In texels: a vertex of a page is the mean of at most 9 x 9.
inline constexpr double maxBlurRadius = 4;

struct OperatorList {
  std::vector<Operator> operators;
  std::string problem; ///< of the first part that cannot be read; there are then no operators. Else empty
};

/// Reads the text of `operators`: "scale(0.8) negate(x)". Safe for untrusted text. `hasImages`: whether the geometry
/// has images of coordinates, as SIG classic has them; a blur of other geometry is refused.
OperatorList readOperators(std::string_view text, bool hasImages);

/// The sentence about a list that cannot be read; with "; none is applied" that of pages.
std::string refusalOf(std::string_view text, const std::string& problem);

/// The radius of a list's blur, which is its first operator; 0 without one.
double blurRadiusOf(std::span<const Operator> operators);

/// What a list of operators does to the front side of triangles.
enum class Orientation : std::uint8_t {
  kept,
  flipped,
  folded ///< triangles keep or lose it depending on where they lie: they are visible from both sides
};

/// "kept", "flipped", "folded".
const char* nameOf(Orientation orientation);

Orientation orientationOf(std::span<const Operator> operators);

/// Maps a point of the unit box.
Vec3d operatedPoint(std::span<const Operator> operators, Vec3d point);

/// A box around the images of all points of a box.
Box3d operatedBox(std::span<const Operator> operators, const Box3d& box);

/// The box in which operators map points: its sides are the unit box.
struct OperatorFrame {
  Vec3d min, size;

  /// A flat box has a thickness, too: that of its longest side.
  static OperatorFrame of(const Box3d& box);
  Vec3d toUnit(Vec3d point) const;
  Vec3d fromUnit(Vec3d point) const;
};

/// Maps the positions of a mesh, with its normals: they follow the mapped surface, and where operators mirror it, the
/// front of its triangles stays outside. Leaves out a blur. Throws Error{limit} with `location` for a position that
/// becomes infinite.
void applyOperators(Mesh& mesh, std::span<const Operator> operators, const OperatorFrame& frame,
                    const std::string& location);

} // namespace imgeo
