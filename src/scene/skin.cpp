#include "scene/skin.h"

#include "scene/mesh.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr std::string_view skinPrefix = "skin.", displacerPrefix = "displacer.";

std::size_t countOf(const Mesh& mesh, std::string (*nameOf)(std::size_t)) {
  std::size_t count = 0;
  while (std::ranges::find(mesh.namedAttributes, nameOf(count), &NamedAttribute::name) != mesh.namedAttributes.end())
    ++count;
  return count;
}

} // namespace

std::string jointsName(std::size_t set) {
  return std::string(skinPrefix) + "joints" + std::to_string(set);
}

std::string jointWeightsName(std::size_t set) {
  return std::string(skinPrefix) + "weights" + std::to_string(set);
}

std::string displacementName(std::size_t displacer) {
  return std::string(displacerPrefix) + std::to_string(displacer);
}

std::string normalDisplacementName(std::size_t displacer) {
  return displacementName(displacer) + ".normal";
}

bool isOfDeformation(std::string_view attributeName) {
  return attributeName.starts_with(skinPrefix) || attributeName.starts_with(displacerPrefix);
}

std::size_t jointSetCount(const Mesh& mesh) {
  return countOf(mesh, jointsName);
}

std::size_t displacementCount(const Mesh& mesh) {
  return countOf(mesh, displacementName);
}

} // namespace imgeo
