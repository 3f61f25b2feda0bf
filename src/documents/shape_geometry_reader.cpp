#include "documents/shape_geometry_reader.h"

#include "containers/encodings.h"
#include "documents/geometry_reader.h"
#include "documents/patch_references.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace imgeo {

namespace {

bool drawsTriangles(const GeometryDescription& geometry) {
  if (geometry.levels)
    return geometry.levels->topology == Topology::triangles;
  return std::ranges::any_of(geometry.patches, [](const PatchDescription& patch) {
    return std::ranges::any_of(patch.draws,
                               [](const Draw& draw) { return topologyOf(draw.primitive) == Topology::triangles; });
  });
}

bool areEqualExceptPatches(GeometryDescription a, const GeometryDescription& b) {
  a.patches = b.patches;
  a.box = b.box;
  return a == b;
}

} // namespace

bool ShapeGeometryReader::isInFiles(const FieldReader& fields) {
  if (const std::string use = fields.text("USE"); !use.empty())
    return !notInFiles_.contains(use);
  const std::optional<std::string> reason = reasonGeometryIsNotInFiles(source_, fields.node());
  if (!reason)
    return true;
  FieldReader(source_, fields.node(), &warnings_).warnOrFail(*reason, "its Shape is left out");
  notInFiles_.insert(fields.text("DEF"));
  return false;
}

Shape ShapeGeometryReader::read(const FieldReader& shape, const FieldReader& fields) {
  if (const std::string use = fields.text("USE"); !use.empty()) {
    const auto found = defined_.find(use);
    if (found == defined_.end())
      fields.fail(ErrorKind::malformed, fmt::format("USE=\"{}\" names no DEF of this scene before it", use));
    return found->second;
  }
  Shape read;
  read.mesh = geometries_.size();
  read.solid = readSolid(fields);
  GeometryDescription geometry = readGeometry(source_, fields.node(), &warnings_);
  const Box3d own = fields.box(); // a Shape whose vertices move has another one
  geometry.box = own.empty() ? shape.box() : own;
  const bool hasPatches = geometry.levels || std::ranges::any_of(fields.node().children(), [](const auto& child) {
                            return equalIgnoringCase(child.name(), "GeometryPatch");
                          });
  if (!hasPatches && geometry.box.empty())
    geometry.box = geometry.patches[0].box;
  if (!hasPatches)
    geometry.patches[0].box = geometry.box;
  // In documents for X3DOM each patch is a Shape of its own.
  const bool isWhole = hasPatches || rowOf(geometry).storage == PatchStorage::packed;
  isUnlit_.push_back(!fields.boolean("lit", true) && drawsTriangles(geometry));
  geometries_.push_back(std::move(geometry));
  const std::string def = fields.text("DEF");
  isJoinable_.push_back(!isWhole && def.empty());
  if (!def.empty())
    defined_[def] = read;
  return read;
}

std::optional<ShapeGeometryReader::InDocument> ShapeGeometryReader::readInDocument(const FieldReader& fields) {
  pugi::xml_node node = fields.node();
  if (const std::string use = fields.text("USE"); !use.empty()) {
    const auto found = source_.defs.find(use);
    node = found == source_.defs.end() ? pugi::xml_node() : found->second;
  }
  if (!readNode_ || !node)
    return {};
  const std::size_t offset = source_.offsets.of(node);
  const auto [found, isNew] = inDocument_.try_emplace(offset);
  if (!isNew)
    return found->second;
  std::optional<NodeGeometry> read;
  try {
    read = readNode_(source_.text, source_.name, offset);
  } catch (const Error& error) {
    warnings_.add(fmt::format("{}; its Shape is left out.", error.what()));
  }
  if (!read)
    return {};
  if (!read->geometry)
    return found->second = InDocument{};
  Shape shape;
  shape.mesh = geometries_.size();
  shape.solid = read->solid;
  isUnlit_.push_back(!FieldReader(source_, node).boolean("lit", true) && drawsTriangles(*read->geometry));
  isJoinable_.push_back(false);
  geometries_.push_back(*std::move(read->geometry));
  return found->second = InDocument{shape};
}

void ShapeGeometryReader::readShared(const FieldReader& fields) {
  const std::string def = fields.text("DEF");
  if (def.empty())
    return;
  SharedGeometry shared{readGeometry(source_, fields.node(), &warnings_), readSolid(fields), {}};
  if (rowOf(shared.geometry).storage != PatchStorage::packed || shared.geometry.patches.size() != 1)
    fields.fail(ErrorKind::unsupported, "a geometry outside of a Shape is no patch of compact");
  shared.geometry.box = shared.geometry.patches[0].box;
  shared.geometry.isShared = true;
  shared_.insert_or_assign(def, std::move(shared));
}

Shape ShapeGeometryReader::sharedPatch(const FieldReader& shape, const std::string& patch) {
  const std::optional<PatchName> name = parsePatchName(patch);
  const auto found = name ? shared_.find(name->geometry) : shared_.end();
  if (found == shared_.end())
    shape.fail(ErrorKind::malformed, "patch names no patch of a geometry that stands before");
  SharedGeometry& shared = found->second;
  const auto [mesh, isNew] = shared.meshes.try_emplace(name->index, geometries_.size());
  if (isNew) {
    geometries_.push_back(shared.geometry);
    geometries_.back().patches[0].data->location = PatchLocation{name->index};
    isJoinable_.push_back(false);
    isUnlit_.push_back(false);
  }
  Shape read;
  read.mesh = mesh->second;
  read.solid = shared.solid;
  return read;
}

bool ShapeGeometryReader::isPatchLike(std::size_t mesh, std::size_t first) const {
  return isJoinable_[mesh] && areEqualExceptPatches(geometries_[mesh], geometries_[first]);
}

void ShapeGeometryReader::joinPatches(std::size_t first, const Box3d& box) {
  GeometryDescription& geometry = geometries_[first];
  for (std::size_t i = first + 1; i < geometries_.size(); ++i)
    for (PatchDescription& patch : geometries_[i].patches)
      geometry.patches.push_back(std::move(patch));
  geometry.box = box;
  geometries_.resize(first + 1);
  isJoinable_.resize(first + 1);
  isUnlit_.resize(first + 1);
}

} // namespace imgeo
