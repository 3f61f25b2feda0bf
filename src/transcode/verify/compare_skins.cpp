#include "transcode/verify/compare_skins.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace imgeo {

namespace {

/// The joints of a scene by their position among its joints.
std::map<std::size_t, std::size_t> numberedJoints(const SceneGraph& graph) {
  std::map<std::size_t, std::size_t> numbers;
  for (const std::size_t node : nodesInOrder(graph))
    if (const Transform* transform = std::get_if<Transform>(&graph.nodes[node].content);
        transform && transform->isJoint)
      numbers.try_emplace(node, numbers.size());
  return numbers;
}

/// Equal but for the rounding of decimals.
bool areNear(Vec3d a, Vec3d b) {
  const double size = std::max({1.0, length(a), length(b)});
  return length(a - b) <= 1e-6 * size;
}

bool areNear(const Affine3d& a, const Affine3d& b) {
  return areNear(a.x, b.x) && areNear(a.y, b.y) && areNear(a.z, b.z) && areNear(a.translation, b.translation);
}

template <typename Content> std::vector<const Content*> contentsOf(const SceneGraph& graph) {
  std::vector<const Content*> contents;
  for (const std::size_t node : nodesInOrder(graph))
    if (const Content* content = std::get_if<Content>(&graph.nodes[node].content))
      contents.push_back(content);
  return contents;
}

/// Calls isSame for the n-th of both.
template <typename Content, typename IsSame>
void compareInOrder(const SceneGraph& site, const SceneGraph& input, const char* plural, Findings& findings,
                    IsSame isSame) {
  const std::vector<const Content*> inSite = contentsOf<Content>(site), inInput = contentsOf<Content>(input);
  if (inSite.size() != inInput.size())
    return findings.add("The site has {} {}, the input {}.", inSite.size(), plural, inInput.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < inSite.size(); ++i)
    different += !isSame(*inSite[i], *inInput[i]);
  if (different > 0)
    findings.add("{} of {} {} differ from those of the input.", different, inSite.size(), plural);
}

} // namespace

void compareSkins(const SceneGraph& site, const SceneGraph& input, Findings& findings) {
  const std::map<std::size_t, std::size_t> inSite = numberedJoints(site), inInput = numberedJoints(input);
  compareInOrder<Humanoid>(site, input, "skins", findings, [&](const Humanoid& a, const Humanoid& b) {
    return std::ranges::equal(a.joints, b.joints,
                              [&](std::size_t x, std::size_t y) { return inSite.at(x) == inInput.at(y); }) &&
           std::ranges::equal(a.inverseBindings, b.inverseBindings,
                              [](const Affine3d& x, const Affine3d& y) { return areNear(x, y); });
  });
  compareInOrder<Displacer>(site, input, "displacers", findings, [](const Displacer& a, const Displacer& b) {
    return a.name == b.name && std::abs(a.weight - b.weight) <= 1e-6 * std::max(1.0, std::abs(b.weight));
  });
}

} // namespace imgeo
