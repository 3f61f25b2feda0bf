// Converts models far from zero in memory and out of core.

#include "base/file.h"
#include "scene/testing.h"
#include "transcode/verify/out_of_core_testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>

namespace imgeo {
namespace {

TEST(FarModels, HaveTheFilesAndTheOriginOfConversionInMemory) {
  Mesh mesh = testing::torus(150, 80);
  testing::Random random(7);
  for (Vec3f& position : mesh.positions)
    position += random.point() * 0.004f;
  std::string ply = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                                "property double z\nelement face {}\nproperty list uchar int vertex_indices\n"
                                "end_header\n",
                                mesh.positions.size(), mesh.elementCount()),
              obj;
  for (const Vec3f& p : mesh.positions) {
    const Vec3d far = Vec3d(p) + Vec3d{450000.123, 5400000.456, 310.789};
    ply += fmt::format("{} {} {}\n", far.x, far.y, far.z);
    obj += fmt::format("v {} {} {}\n", far.x, far.y, far.z);
  }
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    const auto vertex = [&](std::size_t k) { return mesh.wedgePositions[mesh.corners[corner + k]]; };
    ply += fmt::format("3 {} {} {}\n", vertex(0), vertex(1), vertex(2));
    obj += fmt::format("f {} {} {}\n", vertex(0) + 1, vertex(1) + 1, vertex(2) + 1);
  }
  for (const auto& [name, text] : {std::pair("far.ply", ply), std::pair("far.obj", obj)}) {
    const testing::TemporaryDirectory directory;
    writeFile(directory / name, asBytes(text));
    testing::expectSameAsInMemory(directory, directory / name);
    for (const char* site : {"site", "memory"})
      EXPECT_NE(testing::documentOf(directory / site).find("\"450001 5400000 0\""), std::string::npos) << site;
  }
}

} // namespace
} // namespace imgeo
