#pragma once
// The transform that nodes of VRML 1.0 accumulate within a Separator.

#include "import/vrml1/tree.h"
#include "scene/transform.h"

#include <optional>

namespace imgeo::vrml1 {

/// Whether a node of this type changes the current transform.
bool isTransform(std::string_view type);

class AccumulatedTransform {
public:
  /// Applies a Translation, Rotation, Scale, Transform or MatrixTransform to what follows. Returns false where a
  /// MatrixTransform is not affine: only its affine part counts.
  bool apply(const Node& node);

  const Affine3d& matrix() const { return matrix_; }
  bool isIdentity() const { return matrix_ == Affine3d{}; }
  /// Has the numbers of the source where one Transform node can hold them; otherwise the decomposed matrix, rounded.
  Transform transform() const;

private:
  Affine3d matrix_;
  std::optional<Transform> exact_ = Transform{}; ///< equals the matrix; empty where only the matrix is known
};

} // namespace imgeo::vrml1
