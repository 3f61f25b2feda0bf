// KHR_draco_mesh_compression, decoded by the Draco library.

#include "import/gltf/primitive.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>
#include <memory>

namespace imgeo::gltf {

namespace {

/// The components of an attribute, vertex by vertex.
std::vector<float> valuesOf(const draco::PointCloud& cloud, const draco::PointAttribute& attribute,
                            const Value& location) {
  const auto components = static_cast<std::size_t>(attribute.num_components());
  std::vector<float> values(cloud.num_points() * components);
  for (draco::PointIndex point(0); point < cloud.num_points(); ++point)
    if (!attribute.ConvertValue<float>(attribute.mapped_index(point), static_cast<std::int8_t>(components),
                                       &values[point.value() * components]))
      location.fail(ErrorKind::malformed, "holds an attribute that is not numeric");
  return values;
}

} // namespace

PrimitiveData readDraco(Document& document, const Value& primitive, const Value& compression) {
  const std::optional<std::size_t> view = compression.index("bufferView", document.array("bufferViews"));
  if (!view)
    compression["bufferView"].fail(ErrorKind::malformed, "is missing");
  const ByteSpan packed = document.view(*view);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    compression.fail(ErrorKind::malformed,
                     fmt::format("Draco cannot unpack it: {}", decoded.status().error_msg_string()));
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  document.spend(primitive, std::uint64_t{mesh->num_faces()} * 12 + std::uint64_t{mesh->num_points()} * 16);

  PrimitiveData data;
  data.vertexCount = mesh->num_points();
  data.indexed = data.isTriangles = true;
  for (draco::FaceIndex face(0); face < mesh->num_faces(); ++face)
    for (const draco::PointIndex& corner : mesh->face(face)) {
      if (corner.value() >= data.vertexCount)
        compression.fail(ErrorKind::malformed, "names vertices that Draco's data lacks");
      data.indices.push_back(corner.value());
    }
  const Value names = compression["attributes"];
  if (!names.json().is_object())
    names.fail(ErrorKind::malformed, "is missing");
  for (const auto& [name, unused] : names.json().items()) {
    const std::uint64_t id = names[name.c_str()].whole();
    const draco::PointAttribute* attribute =
        id > UINT32_MAX ? nullptr : mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    if (!attribute || attribute->num_components() == 0)
      names[name.c_str()].fail(ErrorKind::malformed, "names no attribute of Draco's data");
    const auto components = static_cast<std::uint32_t>(attribute->num_components());
    const auto values = std::make_shared<std::vector<float>>(valuesOf(*mesh, *attribute, compression));
    data.attributes.push_back({name, components, [values, components](std::size_t vertex, std::uint32_t c) {
                                 return static_cast<double>((*values)[vertex * components + c]);
                               }});
  }
  return data;
}

} // namespace imgeo::gltf
