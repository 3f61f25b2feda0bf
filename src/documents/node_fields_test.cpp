// Compares the fields of the nodes in node_fields.h with vectors/nodes.json, which tests/nodes.test.ts compares with
// the fields of the runtime and of the documentation. IMGEO_REWRITE_GOLDEN=1 rewrites the file.

#include "documents/node_fields.h"

#include "base/file.h"
#include "documents/node_fields_writer.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

const char* typeOf(const std::string&) {
  return "SFString";
}
const char* typeOf(bool) {
  return "SFBool";
}
const char* typeOf(float) {
  return "SFFloat";
}
const char* typeOf(double) {
  return "SFFloat";
}
const char* typeOf(Vec2f) {
  return "SFVec2f";
}
const char* typeOf(Vec3f) {
  return "SFColor"; // colours are the only members of this type
}
const char* typeOf(Vec3d) {
  return "SFVec3f";
}
const char* typeOf(const Rotation&) {
  return "SFRotation";
}

/// Collects a line of JSON for each field: its name, type and default.
struct FieldRows {
  std::string text;

  void operator()(const char* name, const auto& member, Written = Written::unlessDefault) {
    text += text.empty() ? "\n" : ",\n";
    text += std::string("    \"") + name + "\": [\"" + typeOf(member) + "\", \"" + fieldText(member) + "\"]";
  }
  void line() {}
};

template <typename Node> std::string rowsOf(const char* name) {
  FieldRows rows;
  visitFields(Node{}, rows);
  return std::string("  \"") + name + "\": {" + rows.text + "\n  }";
}

TEST(NodeFields, AreThoseOfTheSharedTable) {
  const std::string fields =
      "{\n" + rowsOf<Transform>("Transform") + ",\n" + rowsOf<Viewpoint>("Viewpoint") + ",\n" +
      rowsOf<OrthoViewpoint>("OrthoViewpoint") + ",\n" + rowsOf<DirectionalLight>("DirectionalLight") + ",\n" +
      rowsOf<PointLight>("PointLight") + ",\n" + rowsOf<SpotLight>("SpotLight") + ",\n" + rowsOf<Material>("Material") +
      ",\n" + rowsOf<PhysicalMaterial>("PhysicalMaterial") + ",\n" + rowsOf<UnlitMaterial>("UnlitMaterial") + ",\n" +
      rowsOf<AnisotropyMaterialExtension>("AnisotropyMaterialExtension") + ",\n" +
      rowsOf<ClearcoatMaterialExtension>("ClearcoatMaterialExtension") + ",\n" +
      rowsOf<DispersionMaterialExtension>("DispersionMaterialExtension") + ",\n" +
      rowsOf<EmissiveStrengthMaterialExtension>("EmissiveStrengthMaterialExtension") + ",\n" +
      rowsOf<IORMaterialExtension>("IORMaterialExtension") + ",\n" +
      rowsOf<IridescenceMaterialExtension>("IridescenceMaterialExtension") + ",\n" +
      rowsOf<SheenMaterialExtension>("SheenMaterialExtension") + ",\n" +
      rowsOf<SpecularMaterialExtension>("SpecularMaterialExtension") + ",\n" +
      rowsOf<TransmissionMaterialExtension>("TransmissionMaterialExtension") + ",\n" +
      rowsOf<VolumeMaterialExtension>("VolumeMaterialExtension") + ",\n" +
      rowsOf<TextureTransform>("TextureTransform") + "\n}\n";
  const std::filesystem::path table = IMGEO_VECTORS "/nodes.json";
  if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
    writeFile(table, asBytes(fields));
  EXPECT_EQ(asText(readFile(table)), fields);
}

} // namespace
} // namespace imgeo
