// Instances by content in scenes of glTF, Collada and X3D: several meshes below transforms, with materials, and what
// moves or names its vertices.

#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "import/gltf/testing.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

using Json = GltfText::Json;

constexpr std::uint32_t sides = 12, rings = 6;
constexpr int columnCount = 6;

/// A twisted column, which no rotation maps to itself, turned and moved in its own vertices.
struct Column {
  std::vector<float> positions; ///< three numbers a vertex
  std::vector<std::uint32_t> corners;
};

/// Odd columns have their vertices in another order.
Column column(int n, bool isMirrored = false) {
  const double turn = 0.7 * n, c = std::cos(turn), s = std::sin(turn);
  const std::uint32_t count = sides * rings;
  const auto number = [&](std::uint32_t ring, std::uint32_t side) {
    const std::uint32_t vertex = ring * sides + side % sides;
    return n % 2 == 0 ? vertex : count - 1 - vertex;
  };
  Column result;
  result.positions.resize(std::size_t{3} * count);
  for (std::uint32_t ring = 0; ring < rings; ++ring)
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double angle = 6.283185307179586 * side / sides,
                   r = 0.3 + 0.05 * std::sin(angle + 1.7 * ring) + 0.01 * side;
      const double x = r * std::cos(angle), y = (isMirrored ? -1 : 1) * r * std::sin(angle);
      float* at = &result.positions[std::size_t{3} * number(ring, side)];
      at[0] = static_cast<float>(c * x - s * y + 3 * n);
      at[1] = static_cast<float>(s * x + c * y + 2);
      at[2] = 0.5f * static_cast<float>(ring);
      if (ring + 1 < rings)
        for (const std::uint32_t corner : {number(ring, side), number(ring, side + 1), number(ring + 1, side),
                                           number(ring, side + 1), number(ring + 1, side + 1), number(ring + 1, side)})
          result.corners.push_back(corner);
    }
  return result;
}

template <typename T> std::string listed(const std::vector<T>& values) {
  return fmt::format("{}", fmt::join(values, " "));
}

/// Text for each column.
using OfColumn = std::function<std::string(int column)>;

class InstancesOfFormats : public ::testing::Test {
protected:
  ConvertReport convertFile(const std::string& name, ByteSpan bytes) {
    input_ = directory_ / name;
    writeFile(input_, bytes);
    ConvertOptions options;
    options.pictures = false;
    options.force = true;
    return convert(input_, directory_ / "site", options);
  }

  /// Converts, expects that the site equals its input, and returns how many shapes show another's mesh.
  std::size_t instancesIn(const std::string& name, ByteSpan bytes) {
    const ConvertReport report = convertFile(name, bytes);
    const VerifyReport compared = verify(directory_ / "site", input_);
    EXPECT_TRUE(compared.equal) << (compared.findings.empty() ? "" : compared.findings.front());
    EXPECT_GE(compared.instances, report.instances.shapes); // a USE counts, too
    EXPECT_LE(report.instances.largestDistance, report.maxStep);
    return report.instances.shapes;
  }

  static std::size_t addColumn(GltfText& gltf, const Column& column, std::optional<std::size_t> material = {}) {
    Json primitive{{"attributes", {{"POSITION", gltf.addAccessor(column.positions, "VEC3", 5126)}}},
                   {"indices", gltf.addAccessor(column.corners, "SCALAR", 5125)}};
    if (material)
      primitive["material"] = *material;
    return gltf.addMesh({primitive});
  }

  /// Columns in nodes, with the fields that `fields` gives them.
  static GltfText columns(const std::function<Json(int column)>& fields) {
    GltfText gltf;
    for (int n = 0; n < columnCount; ++n) {
      Json node = fields(n);
      node["mesh"] = addColumn(gltf, column(n));
      node["name"] = fmt::format("column{}", n);
      gltf.addNode(node);
    }
    return gltf;
  }

  static std::string x3d(const OfColumn& before, const OfColumn& after, const std::string& more = "") {
    std::string text = "<X3D profile='Full' version='4.0'><Scene>";
    for (int n = 0; n < columnCount; ++n) {
      const Column mesh = column(n);
      text += fmt::format("{}<Shape DEF='column{}'><Appearance><Material diffuseColor='{} 0.5 0.5'/></Appearance>"
                          "<IndexedTriangleSet index='{}'><Coordinate DEF='points{}' point='{}'/></IndexedTriangleSet>"
                          "</Shape>{}",
                          before(n), n, 0.1 * n, listed(mesh.corners), n, listed(mesh.positions), after(n));
    }
    return text + more + "</Scene></X3D>";
  }

  static std::string collada(const OfColumn& transform) {
    std::string effects, materials, geometries, nodes;
    for (int n = 0; n < columnCount; ++n) {
      const Column mesh = column(n);
      effects +=
          fmt::format("<effect id='fx{0}'><profile_COMMON><technique sid='c'><lambert><diffuse><color>{1} 0.5 0.5 "
                      "1</color></diffuse></lambert></technique></profile_COMMON></effect>",
                      n, 0.1 * n);
      materials += fmt::format("<material id='m{0}'><instance_effect url='#fx{0}'/></material>", n);
      geometries += fmt::format(
          "<geometry id='g{0}'><mesh><source id='p{0}'><float_array id='a{0}' count='{1}'>{2}</float_array>"
          "<technique_common><accessor source='#a{0}' count='{3}' stride='3'><param name='X' type='float'/>"
          "<param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common></source>"
          "<vertices id='v{0}'><input semantic='POSITION' source='#p{0}'/></vertices><triangles material='m' "
          "count='{4}'><input semantic='VERTEX' source='#v{0}' offset='0'/><p>{5}</p></triangles></mesh></geometry>",
          n, mesh.positions.size(), listed(mesh.positions), mesh.positions.size() / 3, mesh.corners.size() / 3,
          listed(mesh.corners));
      nodes += fmt::format("<node id='n{0}' name='column{0}'>{1}<instance_geometry url='#g{0}'><bind_material>"
                           "<technique_common><instance_material symbol='m' target='#m{0}'/></technique_common>"
                           "</bind_material></instance_geometry></node>",
                           n, transform(n));
    }
    return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
           "<asset><up_axis>Z_UP</up_axis></asset><library_effects>" +
           effects + "</library_effects><library_materials>" + materials + "</library_materials><library_geometries>" +
           geometries + "</library_geometries><library_visual_scenes><visual_scene id='s'>" + nodes +
           "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
  }

  TemporaryDirectory directory_;
  std::filesystem::path input_;
};

constexpr std::size_t allButTheFirst = columnCount - 1;

TEST_F(InstancesOfFormats, AreFoundInGltfBelowTransforms) {
  const Json plain = Json::object(), scaled{{"translation", {1, 2, 3}}, {"scale", {1, 2, 0.5}}},
             mirrored{{"scale", {-1, 1, 1}}}, sheared{{"matrix", {1, 0, 0, 0, 0.3, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}};
  EXPECT_EQ(instancesIn("a.glb", columns([&](int) { return plain; }).glb()), allButTheFirst);
  const std::array fields{plain, scaled, mirrored, sheared};
  EXPECT_EQ(instancesIn("a.glb", columns([&](int n) { return fields[n % fields.size()]; }).glb()), allButTheFirst);
}

TEST_F(InstancesOfFormats, KeepTheMaterialsOfGltf) {
  GltfText gltf;
  gltf.json["materials"] = Json::array();
  for (int n = 0; n < columnCount; ++n) {
    gltf.json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorFactor", {0.1 * n, 0.5, 0.5, 1}}}}});
    gltf.show(addColumn(gltf, column(n), n));
  }
  EXPECT_EQ(instancesIn("a.glb", gltf.glb()), allButTheFirst);
  // A mesh that shows its back sides, too, is not one that does not.
  gltf.json["materials"][3]["doubleSided"] = true;
  EXPECT_EQ(instancesIn("a.glb", gltf.glb()), allButTheFirst - 1);
}

TEST_F(InstancesOfFormats, AreNotMirrorImagesInGltf) {
  GltfText gltf;
  for (int n = 0; n < columnCount; ++n)
    gltf.show(addColumn(gltf, column(n, n == 2)));
  EXPECT_EQ(instancesIn("a.glb", gltf.glb()), allButTheFirst - 1);
}

TEST_F(InstancesOfFormats, MoveWithTheAnimatedNodesOfGltf) {
  GltfText gltf = columns([](int) { return Json{{"translation", {0, 0, 1}}}; });
  const std::size_t times = gltf.addAccessor<float>({0, 1}, "SCALAR", 5126),
                    values = gltf.addAccessor<float>({0, 0, 1, 0, 0, 3}, "VEC3", 5126);
  gltf.json["accessors"][times]["min"] = {0};
  gltf.json["accessors"][times]["max"] = {1};
  gltf.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", values}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}}}});
  EXPECT_EQ(instancesIn("a.glb", gltf.glb()), allButTheFirst);
}

TEST_F(InstancesOfFormats, AreNoMeshesOfGltfWhoseVerticesMove) {
  GltfText gltf = columns([](int) { return Json::object(); });
  for (const int n : {1, 2}) { // equal to one another, too
    Json& primitive = gltf.json["meshes"][static_cast<std::size_t>(n)]["primitives"][0];
    std::vector<float> offsets(std::size_t{3} * sides * rings, 0.1f);
    primitive["targets"] = Json::array({{{"POSITION", gltf.addAccessor(offsets, "VEC3", 5126)}}});
  }
  const std::size_t times = gltf.addAccessor<float>({0, 1}, "SCALAR", 5126),
                    weights = gltf.addAccessor<float>({0, 1}, "SCALAR", 5126);
  gltf.json["accessors"][times]["min"] = {0};
  gltf.json["accessors"][times]["max"] = {1};
  gltf.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", weights}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "weights"}}}}}}}});
  EXPECT_EQ(instancesIn("morphs.glb", gltf.glb()), allButTheFirst - 2);

  GltfText skinned = columns([](int n) { return n < 2 ? Json{{"skin", 0}} : Json::object(); });
  const std::size_t joint = skinned.addNode({{"name", "hip"}});
  skinned.json["skins"] = Json::array({{{"joints", {joint}}}});
  for (const std::size_t n : {0, 1}) {
    std::vector<std::uint8_t> joints(std::size_t{4} * sides * rings);
    std::vector<float> ones;
    for (std::uint32_t i = 0; i < sides * rings; ++i)
      ones.insert(ones.end(), {1, 0, 0, 0});
    Json& attributes = skinned.json["meshes"][n]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = skinned.addAccessor(joints, "VEC4", 5121);
    attributes["WEIGHTS_0"] = skinned.addAccessor(ones, "VEC4", 5126);
  }
  EXPECT_EQ(instancesIn("skins.glb", skinned.glb()), allButTheFirst - 2);
}

TEST_F(InstancesOfFormats, OfGltfAreComparedWithWhatTheInputHas) {
  convertFile("a.gltf", asBytes(columns([](int) { return Json::object(); }).text()));
  GltfText gltf;
  for (int n = 0; n < columnCount; ++n) {
    Column mesh = column(n);
    if (n == 4)
      mesh.positions[7] += 0.01f;
    gltf.addNode({{"mesh", addColumn(gltf, mesh)}, {"name", fmt::format("column{}", n)}});
  }
  writeFile(input_, asBytes(gltf.text()));
  EXPECT_FALSE(verify(directory_ / "site", input_).equal);
}

/// The meshes of boxes of three sizes, each of its own accessors, of a scene in which small meshes share files.
TEST_F(InstancesOfFormats, AreSmallMeshesOfLargeScenesOfWhichManyAreEqual) {
  constexpr int boxCount = 2100;
  const std::vector<std::uint32_t> corners{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  const auto boxes = [&](bool isMoved) {
    GltfText gltf;
    for (int n = 0; n < boxCount; ++n) {
      Column box{{}, corners};
      for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis)
          box.positions.push_back(((i >> axis & 1) != 0 ? 1 + 0.25f * static_cast<float>(n % 3) : 0.f) +
                                  (isMoved ? 0.5f * static_cast<float>(n) : 0.f));
      gltf.addNode({{"mesh", addColumn(gltf, box)},
                    {"translation", {3 * (n % 50), 0, 3 * (n / 50)}},
                    {"scale", {1, 1 + 0.1 * (n % 7), 1}}});
    }
    return gltf.glb();
  };
  EXPECT_EQ(instancesIn("a.glb", boxes(false)), std::size_t{boxCount - 3});
  std::size_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(directory_ / "site" / "geometry"))
    bytes += file.file_size();
  EXPECT_LT(bytes, 1000u);
  EXPECT_EQ(instancesIn("a.glb", boxes(true)), std::size_t{boxCount - 3});
}

TEST_F(InstancesOfFormats, AreFoundInColladaBelowTransforms) {
  const auto nothing = [](int) { return std::string(); };
  EXPECT_EQ(instancesIn("a.dae", asBytes(collada(nothing))), allButTheFirst);
  const auto transform = [](int n) {
    return fmt::format("<translate>0 {0} 1</translate><rotate>0 0 1 {1}</rotate><scale>1 2 {2}</scale>", n, 20 * n,
                       1 + 0.5 * n);
  };
  EXPECT_EQ(instancesIn("a.dae", asBytes(collada(transform))), allButTheFirst);
}

TEST_F(InstancesOfFormats, AreFoundInX3dBelowTransformsAndOtherGroups) {
  const auto nothing = [](int) { return std::string(); };
  EXPECT_EQ(instancesIn("a.x3d", asBytes(x3d(nothing, nothing))), allButTheFirst);
  const auto before = [](int n) {
    const std::array<std::string, 4> opening{"<Group>", "<Switch whichChoice='0'>", "<LOD range='50'>",
                                             "<Transform rotation='0 0 1 0.4' scale='1 2 3' center='1 0 0'>"};
    return opening[static_cast<std::size_t>(n) % 4];
  };
  const auto after = [](int n) {
    const std::array<std::string, 4> closing{"</Group>", "</Switch>", "<Group/></LOD>", "</Transform>"};
    return closing[static_cast<std::size_t>(n) % 4];
  };
  EXPECT_EQ(instancesIn("a.x3d", asBytes(x3d(before, after))), allButTheFirst);
  const std::string uses = "<Transform translation='0 9 0'><Shape USE='column2'/><Shape USE='column3'/></Transform>";
  EXPECT_EQ(instancesIn("a.x3d", asBytes(x3d(before, after, uses))), allButTheFirst);
}

TEST_F(InstancesOfFormats, AreNoMeshesOfX3dWhoseVerticesMove) {
  const auto nothing = [](int) { return std::string(); };
  const std::string first = listed(column(1).positions);
  const std::string moving =
      fmt::format("<TimeSensor DEF='clock'/><CoordinateInterpolator DEF='way' key='0 1' keyValue='{0} {0}'/>"
                  "<ROUTE fromNode='clock' fromField='fraction_changed' toNode='way' toField='set_fraction'/>"
                  "<ROUTE fromNode='way' fromField='value_changed' toNode='points1' toField='point'/>",
                  first);
  EXPECT_EQ(instancesIn("a.x3d", asBytes(x3d(nothing, nothing, moving))), allButTheFirst - 1);
}

TEST_F(InstancesOfFormats, MoveWithTheAnimatedTransformsOfX3d) {
  const auto before = [](int n) { return fmt::format("<Transform DEF='place{}'>", n); };
  const auto after = [](int) { return std::string("</Transform>"); };
  const std::string moving =
      "<TimeSensor DEF='clock' loop='true'/><PositionInterpolator DEF='way' key='0 1' keyValue='0 0 0 0 0 9'/>"
      "<ROUTE fromNode='clock' fromField='fraction_changed' toNode='way' toField='set_fraction'/>"
      "<ROUTE fromNode='way' fromField='value_changed' toNode='place3' toField='translation'/>";
  EXPECT_EQ(instancesIn("a.x3d", asBytes(x3d(before, after, moving))), allButTheFirst);
}

} // namespace
} // namespace imgeo::testing
