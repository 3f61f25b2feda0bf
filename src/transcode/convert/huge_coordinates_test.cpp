// Converts files whose coordinates are near the end of single precision.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

std::string objOf(const std::string& far) {
  return fmt::format("v -{0} -{0} -{0}\nv {0} 0 0\nv 0 {0} {0}\nf 1 2 3\n", far);
}

std::string plyOf(const std::string& far) {
  return fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "-{0} -{0} -{0}\n{0} 0 0\n0 {0} {0}\n3 0 1 2\n",
                     far);
}

class HugeCoordinates : public ::testing::Test {
protected:
  void write(const std::string& far) const {
    writeFile(directory / "m.obj", asBytes(objOf(far)));
    writeFile(directory / "m.ply", asBytes(plyOf(far)));
  }

  testing::TemporaryDirectory directory;
};

TEST_F(HugeCoordinates, AreRefusedWithoutASite) {
  for (const char* far : {"3e38", "1.1e15"}) {
    write(far);
    for (const char* name : {"m.obj", "m.ply"}) {
      try {
        convert(directory / name, directory / "site", {});
        ADD_FAILURE() << name << " " << far;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
        EXPECT_EQ(error.message(), fmt::format("its coordinates reach {}, and pages draw, in single precision, none "
                                               "beyond 1e+15; scale the source down",
                                               std::string_view(far) == "3e38" ? "3e+38" : "1.1e+15"));
      }
      EXPECT_FALSE(std::filesystem::exists(directory / "site"));
    }
  }
}

TEST_F(HugeCoordinates, WithinTheLimitAreConvertedAndVerifiedWithoutAWarning) {
  write("9e14");
  for (const char* name : {"m.obj", "m.ply"}) {
    EXPECT_TRUE(convert(directory / name, directory / "site", {}).warnings.empty());
    EXPECT_TRUE(verify(directory / "site", directory / name).equal);
    std::filesystem::remove_all(directory / "site");
  }
}

TEST_F(HugeCoordinates, MayBeScaledDown) {
  write("1e18");
  ConvertOptions options;
  options.axes.scale = 1e-6;
  EXPECT_TRUE(convert(directory / "m.ply", directory / "site", options).warnings.empty());
  EXPECT_TRUE(verify(directory / "site", directory / "m.ply").equal);
}

} // namespace
} // namespace imgeo
