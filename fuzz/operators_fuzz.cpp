// Reads a list of operators and applies it to a mesh. A list that is refused has no operators, and one that is read
// maps the points of a box into the mapped box.
#include "base/bytes.h"
#include "base/error.h"
#include "scene/operators.h"

#include <cmath>
#include <cstdlib>

namespace {

using namespace imgeo;

void require(bool condition) {
  if (!condition)
    std::abort();
}

void checkBox(const std::vector<Operator>& operators) {
  const Box3d box = operatedBox(operators, {{0.1, 0, 0.4}, {0.3, 1, 0.45}});
  for (const double t : {0.0, 0.3, 0.5, 0.9, 1.0}) {
    const Vec3d point = operatedPoint(operators, {0.1 + 0.2 * t, t, 0.4 + 0.05 * t});
    for (int axis = 0; axis < 3; ++axis) {
      const double slack = 1e-6 * (1 + std::abs(box.min[axis]) + std::abs(box.max[axis]));
      const bool isInside = point[axis] >= box.min[axis] - slack && point[axis] <= box.max[axis] + slack;
      require(isInside || !std::isfinite(slack));
    }
  }
}

void checkMesh(const std::vector<Operator>& operators) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0.5f, 0}, {0.25f, 1, 0.75f}};
  mesh.wedgePositions = mesh.corners = {0, 1, 2};
  mesh.normals.assign(3, {0, 0, 1});
  try {
    applyOperators(mesh, operators, OperatorFrame::of(boxOf(mesh)), "input");
  } catch (const Error& error) {
    return require(error.kind() == ErrorKind::limit);
  }
  require(isConsistent(mesh));
  for (const Vec3f& position : mesh.positions)
    require(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
  for (const Vec3f& normal : mesh.normals)
    require(std::abs(length(Vec3d(normal)) - 1) < 1e-5);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto [operators, problem] = readOperators(asText({data, size}), size % 2 == 0);
  require(problem.empty() || operators.empty());
  require(operators.size() <= maxOperators && problem.size() < 400);
  checkBox(operators);
  checkMesh(operators);
  return 0;
}
