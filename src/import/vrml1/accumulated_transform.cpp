#include "import/vrml1/accumulated_transform.h"

#include "import/text/rounded_decimal.h"

namespace imgeo::vrml1 {

namespace {

Rotation rotationOf(const Node& node, std::string_view field) {
  const std::vector<double>& v = node.numbers(field);
  return v.size() < 4 ? Rotation{} : Rotation{{v[0], v[1], v[2]}, v[3]};
}

/// The fields of a node that is a Transform or a part of one.
Transform transformOfNode(const Node& node) {
  Transform transform;
  transform.translation = node.vector("translation", {});
  transform.rotation = rotationOf(node, "rotation");
  transform.scale = node.vector("scaleFactor", {1, 1, 1});
  transform.scaleOrientation = rotationOf(node, "scaleOrientation");
  transform.center = node.vector("center", {});
  return transform;
}

/// The Transform that applies `b` and then `a`, where its fields are numbers of these two; otherwise empty.
std::optional<Transform> combined(const Transform& a, const Transform& b) {
  const auto isUnscaled = [](const Transform& t) { return t.scale == Vec3d{1, 1, 1}; };
  const Transform translationOfA{a.translation, {}, {1, 1, 1}, {}, {}};
  Transform result = b;
  if (a == translationOfA) {
    result.translation = a.translation + b.translation;
    return result;
  }
  if (b.translation != Vec3d{} || b.center != Vec3d{} || a.center != Vec3d{} || !isUnscaled(a))
    return {};
  if (b.rotation != Rotation{}) {
    if (a.rotation != Rotation{})
      return {};
  } else {
    result.rotation = a.rotation;
  }
  result.translation = a.translation;
  return result;
}

} // namespace

bool isTransform(std::string_view type) {
  return type == "Translation" || type == "Rotation" || type == "Scale" || type == "Transform" ||
         type == "MatrixTransform";
}

bool AccumulatedTransform::apply(const Node& node) {
  if (!node.is("MatrixTransform")) {
    const Transform next = transformOfNode(node);
    matrix_ = matrix_ * affineOf(next);
    exact_ = exact_ ? combined(*exact_, next) : std::nullopt;
    return true;
  }
  const std::vector<double>& m = node.numbers("matrix"); // for row vectors: the translation is in the last row
  if (m.size() < 16)
    return true;
  const double w = m[15] == 0 ? 1 : m[15];
  matrix_ = matrix_ * Affine3d{{m[0] / w, m[1] / w, m[2] / w},
                               {m[4] / w, m[5] / w, m[6] / w},
                               {m[8] / w, m[9] / w, m[10] / w},
                               {m[12] / w, m[13] / w, m[14] / w}};
  exact_.reset();
  return m[3] == 0 && m[7] == 0 && m[11] == 0 && m[15] != 0;
}

Transform AccumulatedTransform::transform() const {
  return exact_ ? *exact_ : rounded(transformOf(matrix_));
}

} // namespace imgeo::vrml1
