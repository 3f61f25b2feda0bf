#include "import/gltf/shapes.h"

#include "import/gltf/deformation.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo::gltf {

std::optional<std::size_t> ShapeReader::meshNode(std::size_t index, std::optional<std::size_t> user,
                                                 std::size_t jointCount) {
  if (jointCount > 0 || targetCountOf(index) > 0)
    return newMeshNode(index, user, jointCount);
  const auto found = meshNodes_.find(index);
  return found != meshNodes_.end() ? found->second : meshNodes_[index] = newMeshNode(index, user, 0);
}

std::optional<std::size_t> ShapeReader::newMeshNode(std::size_t index, std::optional<std::size_t> user,
                                                    std::size_t jointCount) {
  const Value value = document_.array("meshes")[index], primitives = value["primitives"];
  const std::string nodeName = user ? document_.array("nodes")[*user]["name"].text() : "";
  const std::string meshName = value["name"].text(), name = meshName == nodeName ? "" : meshName;
  const std::vector<std::size_t> displacers = displacerNodes(index, user);
  std::vector<std::size_t> shapes;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    damage_.attempt([&] {
      shapes.push_back(shapeNode(primitives[i], primitives.size() == 1 ? name : "", jointCount, displacers));
    });
  if (primitives.size() == 1 && !shapes.empty())
    return shapes[0];
  if (shapes.empty())
    return {};
  return addNode(scene_.graph, {name, Group{}, std::move(shapes), ""});
}

/// The morph targets of a mesh: all its primitives have as many.
std::size_t ShapeReader::targetCountOf(std::size_t mesh) const {
  const Value primitives = document_.array("meshes")[mesh]["primitives"];
  return primitives.size() > 0 ? primitives[std::size_t{0}]["targets"].size() : 0;
}

/// Adds the displacers of a mesh with morph targets, which all its shapes share.
std::vector<std::size_t> ShapeReader::displacerNodes(std::size_t mesh, std::optional<std::size_t> user) {
  const Value value = document_.array("meshes")[mesh];
  std::vector<Displacer> displacers(std::min(targetCountOf(mesh), maxDisplacers));
  const Json none;
  const Value node = user ? document_.array("nodes")[*user] : Value(none, "");
  damage_.attempt([&] { displacers = displacersOf(node, value, displacers.size()); });
  std::vector<std::size_t> nodes;
  for (Displacer& displacer : displacers) {
    const std::string name = displacer.name.empty() ? fmt::format("displacer{}", nodes.size()) : displacer.name;
    nodes.push_back(addNode(scene_.graph, {name, std::move(displacer), {}, ""}));
  }
  if (user && !nodes.empty())
    displacers_[*user] = nodes;
  return nodes;
}

std::size_t ShapeReader::shapeNode(const Value& primitive, const std::string& name, std::size_t jointCount,
                                   const std::vector<std::size_t>& displacers) {
  Shape shape;
  const std::optional<std::size_t> material = primitive.index("material", document_.array("materials"));
  const Value mappings = primitive["extensions"]["KHR_materials_variants"]["mappings"];
  shape.mesh = meshOf(primitive, texCoordSetsOf(material, mappings), jointCount);
  std::vector<std::size_t> own = displacers;
  own.resize(std::min(own.size(), displacementCount(scene_.meshes[shape.mesh])));
  if (mappings.size() > 0)
    return variantsNode(shape, material, mappings, name, own);
  return addNode(scene_.graph, {name, withMaterial(shape, material), std::move(own), ""});
}

/// The sets of texture coordinates that a primitive's material uses, or its material in any variant.
std::set<std::size_t> ShapeReader::texCoordSetsOf(std::optional<std::size_t> material, const Value& mappings) {
  std::set<std::size_t> sets;
  const auto add = [&](std::optional<std::size_t> of) {
    if (of)
      damage_.attempt([&] { sets.insert(materials_.texCoordSets(*of).begin(), materials_.texCoordSets(*of).end()); });
  };
  add(material);
  for (std::size_t i = 0; i < mappings.size(); ++i)
    add(mappings[i].index("material", document_.array("materials")));
  return sets;
}

Shape ShapeReader::withMaterial(Shape shape, std::optional<std::size_t> material) {
  if (material)
    damage_.attempt([&] {
      shape.appearance = materials_.appearance(*material);
      shape.solid = materials_.isSolid(*material);
    });
  return shape;
}

/// KHR_materials_variants: a Switch whose first child is the shape with the primitive's own material, and whose child
/// i + 1 is the shape with its material in variant i. Children with the same material are one node.
std::size_t ShapeReader::variantsNode(const Shape& shape, std::optional<std::size_t> material, const Value& mappings,
                                      const std::string& name, const std::vector<std::size_t>& displacers) {
  const Value names = document_.root()["extensions"]["KHR_materials_variants"]["variants"],
              materials = document_.array("materials");
  std::vector<std::optional<std::size_t>> materialOf(names.size() + 1, material);
  for (std::size_t i = 0; i < mappings.size(); ++i)
    for (std::size_t v = 0; v < mappings[i]["variants"].size(); ++v) {
      const std::uint64_t variant = mappings[i]["variants"][v].whole();
      if (variant >= names.size())
        mappings[i]["variants"].fail(ErrorKind::malformed,
                                     fmt::format("names variant {} of {}", variant, names.size()));
      materialOf[variant + 1] = mappings[i].index("material", materials);
    }
  document_.spend(mappings, materialOf.size() * 256); // the nodes
  Node node{name, GenericNode{"Switch", "", {}}, {}, "", {{"whichChoice", "0"}, {"class", "variants"}}};
  std::map<std::optional<std::size_t>, std::size_t> shapes;
  for (std::size_t i = 0; i < materialOf.size(); ++i) {
    const auto [found, isNew] = shapes.try_emplace(materialOf[i]);
    if (isNew)
      found->second = addNode(scene_.graph, {i == 0 ? "" : names[i - 1]["name"].text(),
                                             withMaterial(shape, materialOf[i]), displacers, ""});
    node.children.push_back(found->second);
  }
  return addNode(scene_.graph, std::move(node));
}

/// The mesh of a primitive whose textures use these sets of texture coordinates; primitives that otherwise differ only
/// in material and extras share one.
std::size_t ShapeReader::meshOf(const Value& primitive, const std::set<std::size_t>& texCoordSets,
                                std::size_t jointCount) {
  Json key = primitive.json();
  if (!key.is_object())
    primitive.fail(ErrorKind::malformed, "is no object");
  key.erase("material");
  key.erase("extras");
  const std::set<std::size_t>& sets = texCoordSets.empty() ? std::set<std::size_t>{0} : texCoordSets;
  const std::string text = fmt::format("{} {} {}", key.dump(-1, ' ', false, Json::error_handler_t::replace),
                                       fmt::join(sets, " "), jointCount);
  if (const auto found = meshes_.find(text); found != meshes_.end())
    return found->second;
  scene_.meshes.push_back(primitives_.read(primitive, texCoordSets, jointCount));
  return meshes_[text] = scene_.meshes.size() - 1;
}

} // namespace imgeo::gltf
