#include "transcode/sample/sample_hall.h"

#include "containers/png/png.h"
#include "transcode/sample/surface_builder.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::uint32_t seatsPerRow = 40;
// Lengths in metres. The stage is at z = 0, the first row at z = firstRowZ.
constexpr double seatWidth = 0.55, rowDepth = 0.95, rowRise = 0.16, aisleWidth = 1.6;
constexpr double firstRowZ = 5, bayLength = 4, halfWidth = 14, wallThickness = 0.3, landingDepth = 4;

Mesh seatMesh() {
  SurfaceBuilder seat;
  seat.mesh.name = "seat";
  seat.addCushion({0, 0.42, 0}, {0.24, 0.06, 0.23}, 40);
  seat.addCushion({0, 0.72, 0.25}, {0.24, 0.28, 0.05}, 40);
  for (const double x : {-0.23, 0.23})
    for (const double z : {-0.2, 0.22})
      seat.addBar({x, 0, z}, {x, 0.4, z}, 0.018, 12);
  for (const double x : {-0.25, 0.25})
    seat.addCushion({x, 0.62, 0.02}, {0.03, 0.02, 0.2}, 16);
  return std::move(seat.mesh);
}

Mesh columnMesh(double height) {
  SurfaceBuilder column;
  column.mesh.name = "column";
  column.addBox({-0.45, 0, -0.45}, {0.45, 0.3, 0.45});
  column.addBar({0, 0.3, 0}, {0, height - 0.3, 0}, 0.35, 160, 24, 20);
  column.addBox({-0.45, height - 0.3, -0.45}, {0.45, height, 0.45});
  return std::move(column.mesh);
}

/// A truss across the hall: three chords and their braces.
Mesh trussMesh() {
  SurfaceBuilder truss;
  truss.mesh.name = "truss";
  const double height = 1.2, halfDepth = 0.5;
  constexpr int bays = 14;
  const auto chord = [&](int which, double x) {
    return which == 0 ? Vec3d{x, 0, -halfDepth} : which == 1 ? Vec3d{x, 0, halfDepth} : Vec3d{x, height, 0};
  };
  for (int which = 0; which < 3; ++which)
    truss.addBar(chord(which, -halfWidth), chord(which, halfWidth), 0.08, 24, 14);
  for (int bay = 0; bay < bays; ++bay) {
    const double step = 2 * halfWidth / bays, x = -halfWidth + bay * step;
    for (int which = 0; which < 3; ++which) {
      truss.addBar(chord(which, x), chord((which + 1) % 3, x + step), 0.04, 12, 4);
      truss.addBar(chord(which, x), chord((which + 1) % 3, x), 0.04, 12, 4);
    }
  }
  return std::move(truss.mesh);
}

Mesh stairsMesh(std::uint32_t rows) {
  SurfaceBuilder stairs;
  stairs.mesh.name = "stairs";
  stairs.addBox({-halfWidth, -0.2, -4}, {halfWidth, 0, firstRowZ - rowDepth / 2});
  for (std::uint32_t row = 0; row < rows; ++row) {
    const double front = firstRowZ + (row - 0.5) * rowDepth;
    stairs.addBox({-halfWidth, -0.2, front}, {halfWidth, row * rowRise, front + rowDepth});
  }
  return std::move(stairs.mesh);
}

struct Size {
  double back, height, backFloor; ///< z of the end of the rows, y of the roof, y of the floor at the last row
};

/// Walls on all sides, a doorway in the back wall with a landing behind it, and a stage.
Mesh wallsMesh(const Size& size) {
  SurfaceBuilder walls;
  walls.mesh.name = "walls";
  for (const double side : {-1.0, 1.0}) {
    const double inner = side * halfWidth, outer = side * (halfWidth + wallThickness);
    walls.addBox({std::min(inner, outer), -0.2, -4}, {std::max(inner, outer), size.height, size.back});
  }
  walls.addBox({-halfWidth, -0.2, -4 - wallThickness}, {halfWidth, size.height, -4});
  const double door = 1.2, lintel = size.backFloor + 2.5;
  walls.addBox({-halfWidth, -0.2, size.back}, {-door, size.height, size.back + wallThickness});
  walls.addBox({door, -0.2, size.back}, {halfWidth, size.height, size.back + wallThickness});
  walls.addBox({-door, lintel, size.back}, {door, size.height, size.back + wallThickness});
  walls.addBox({-door, -0.2, size.back}, {door, size.backFloor, size.back + wallThickness});
  walls.addBox({-door - 1, size.backFloor - 0.2, size.back + wallThickness},
               {door + 1, size.backFloor, size.back + landingDepth});
  walls.addBox({-8, 0, -4}, {8, 0.9, 1.5});
  for (const int step : {1, 2, 3})
    walls.addBox({6, 0, 1.5 + 0.3 * (3 - step)}, {8, 0.225 * step, 1.5 + 0.3 * (4 - step)});
  return std::move(walls.mesh);
}

Mesh signMesh() {
  SurfaceBuilder sign;
  sign.mesh.name = "sign";
  sign.addGrid(1, 1, [](double u, double v) {
    return SurfaceBuilder::Point{{0.8 * (u - 0.5), 0.4 * (v - 0.5), 0}, {0, 0, 1}};
  });
  return std::move(sign.mesh);
}

/// An arrow on a plain background.
Bytes signImage(Rgba8 background) {
  Image image{128, 64, 3};
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const int fromMiddle = std::abs(static_cast<int>(y) - 32), alongHead = static_cast<int>(x) - 76;
      const bool isShaft = x >= 20 && x < 80 && fromMiddle < 7;
      const bool isHead = alongHead >= 0 && alongHead < 34 && fromMiddle < 24 - alongHead * 24 / 34;
      const bool isBorder = x < 3 || y < 3 || x >= image.width - 3 || y >= image.height - 3;
      const Rgba8 color = isShaft || isHead || isBorder ? Rgba8{250, 250, 245, 255} : background;
      image.pixels.insert(image.pixels.end(), {color.r, color.g, color.b});
    }
  return encodePng(image, 9);
}

class HallBuilder {
public:
  Scene build(std::uint32_t seats) {
    const std::uint32_t rows = (seats + seatsPerRow - 1) / seatsPerRow;
    const double backFloor = (rows - 1) * rowRise;
    const Size size{firstRowZ + (rows - 0.5) * rowDepth, backFloor + 6, backFloor};
    graph().title = fmt::format("A hall with {} seats", seats);
    addViewpoint("From the door", {0, backFloor + 1.7, size.back + 2.5}, {{1, 0, 0}, -0.1});
    addViewpoint("From the stage", {0, 2.6, -1}, {{0, 1, 0}, std::numbers::pi});
    addViewpoint("Beside a seat", {2.5, 3, firstRowZ + 2}, {{0, 1, 0}, 2.2});
    addLights();

    addRoot(graph(), {"stairs", shapeOf(stairsMesh(rows), {0.16f, 0.13f, 0.11f}, 0), {}, ""});
    addRoot(graph(), {"walls", shapeOf(wallsMesh(size), {0.36f, 0.34f, 0.3f}, 0), {}, ""});
    addSeats(seats);
    addAlong("columns", shapeOf(columnMesh(size.height), {0.45f, 0.43f, 0.39f}, 0), size.back,
             {-halfWidth + 0.6, halfWidth - 0.6}, 0);
    addAlong("trusses", shapeOf(trussMesh(), {0.35f, 0.36f, 0.38f}, 0.9f), size.back, {0}, size.height - 1.4);
    addSigns(rows);
    return std::move(scene_);
  }

private:
  SceneGraph& graph() { return scene_.graph; }

  Shape shapeOf(Mesh mesh, Vec3f baseColor, float metallic) {
    Appearance appearance;
    appearance.name = mesh.name + "Look";
    appearance.material =
        PhysicalMaterial{.baseColor = baseColor, .metallic = metallic, .roughness = metallic > 0 ? 0.4f : 0.8f};
    graph().appearances.push_back(std::move(appearance));
    scene_.meshes.push_back(std::move(mesh));
    return {scene_.meshes.size() - 1, graph().appearances.size() - 1, true};
  }

  std::size_t instanceAt(Vec3d at, std::size_t child, const std::string& name = "") {
    Transform transform;
    transform.translation = at;
    return addNode(graph(), {name, transform, {child}, ""});
  }

  void addViewpoint(const char* description, Vec3d position, Rotation orientation) {
    Viewpoint viewpoint;
    viewpoint.description = description;
    viewpoint.position = position;
    viewpoint.orientation = orientation;
    viewpoint.fieldOfView = 1;
    addRoot(graph(), {"", viewpoint, {}, ""});
  }

  /// Light from the ceiling, and light that floor and walls reflect, so that no surface is black.
  void addLights() {
    const auto add = [&](const char* name, Vec3d direction, Vec3f color, float intensity) {
      addRoot(graph(), {name, DirectionalLight{direction, color, intensity, true}, {}, ""});
    };
    add("ceilingLight", {-0.25, -1, -0.3}, {1, 0.95f, 0.86f}, 0.8f);
    add("floorLight", {0, 1, 0}, {1, 0.9f, 0.8f}, 0.25f);
    add("leftLight", {1, -0.2, 0.3}, {0.9f, 0.95f, 1}, 0.3f);
    add("rightLight", {-1, -0.2, 0.5}, {1, 0.95f, 0.9f}, 0.2f);
  }

  void addSeats(std::uint32_t seats) {
    const std::size_t seat = addNode(graph(), {"seat", shapeOf(seatMesh(), {0.3f, 0.03f, 0.035f}, 0), {}, ""});
    for (std::uint32_t first = 0; first < seats; first += seatsPerRow) {
      const std::uint32_t row = first / seatsPerRow;
      Transform transform;
      transform.translation = {0, row * rowRise, firstRowZ + row * rowDepth};
      Node node{fmt::format("row{}", row + 1), transform, {}, ""};
      for (std::uint32_t i = 0; i < std::min(seatsPerRow, seats - first); ++i) {
        const double side = i % 2 == 0 ? 1 : -1; // from the aisle outwards
        const std::uint32_t column = i / 2;
        const double x = side * (aisleWidth / 2 + (column + 0.5) * seatWidth);
        node.children.push_back(instanceAt({x, 0, 0}, seat));
      }
      addRoot(graph(), std::move(node));
    }
  }

  /// Adds instances of a shape at every bay and each x.
  void addAlong(const char* name, const Shape& shape, double back, std::initializer_list<double> xs, double y) {
    const std::size_t one = addNode(graph(), {"", shape, {}, ""});
    Node group{name, Group{}, {}, ""};
    const auto zOf = [](int bay) { return -2 + bay * bayLength; };
    for (int bay = 0; zOf(bay) < back; ++bay)
      for (const double x : xs)
        group.children.push_back(instanceAt({x, y, zOf(bay)}, one));
    addRoot(graph(), std::move(group));
  }

  /// Adds signs at every fourth row, beside the aisle, alternating between two colours.
  void addSigns(std::uint32_t rows) {
    scene_.meshes.push_back(signMesh());
    std::vector<std::size_t> signs;
    for (const Rgba8 background : {Rgba8{20, 90, 60, 255}, Rgba8{30, 60, 120, 255}}) {
      graph().images.push_back({"sign.png", signImage(background)});
      Texture texture;
      texture.image = graph().images.size() - 1;
      texture.boundaryS = texture.boundaryT = Boundary::clamp;
      graph().textures.push_back(texture);
      Appearance appearance;
      appearance.name = fmt::format("sign{}", signs.size() + 1);
      appearance.material = PhysicalMaterial{.metallic = 0, .roughness = 0.9f};
      appearance.textures = {{TextureRole::color, graph().textures.size() - 1, {}}};
      graph().appearances.push_back(std::move(appearance));
      signs.push_back(
          addNode(graph(), {"", Shape{scene_.meshes.size() - 1, graph().appearances.size() - 1, false}, {}, ""}));
    }
    Node group{"signs", Group{}, {}, ""};
    for (std::uint32_t row = 0; row < rows; row += 4)
      group.children.push_back(instanceAt({0, row * rowRise + 2.6, firstRowZ + row * rowDepth}, signs[row / 4 % 2]));
    addRoot(graph(), std::move(group));
  }

  Scene scene_;
};

} // namespace

Scene hallScene(std::uint32_t seats) {
  return HallBuilder().build(seats);
}

} // namespace imgeo
