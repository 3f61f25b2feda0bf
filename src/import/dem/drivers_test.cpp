// Reads a grid of heights in the formats that GDAL itself writes: two of them here, all with IMGEO_SOAK.

#include "base/file.h"
#include "base/testing.h"
#include "import/dem/library.h"
#include "import/testing.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <ostream>

namespace imgeo::testing {
namespace {

/// The functions of GDAL that write files.
struct WritingLibrary : DynamicLibrary {
  WritingLibrary() : DynamicLibrary(IMGEO_GDAL) {}

  decltype(&::GDALCreate) create = find("GDALCreate");
  decltype(&::GDALCreateCopy) createCopy = find("GDALCreateCopy");
  decltype(&::GDALGetDriverByName) getDriverByName = find("GDALGetDriverByName");
  decltype(&::GDALSetProjection) setProjection = find("GDALSetProjection");
  decltype(&::GDALSetGeoTransform) setGeoTransform = find("GDALSetGeoTransform");
};

struct DriverFormat {
  const char* driver;
  const char* extension;
  GDALDataType type = GDT_Float32;
  int columns = 31, rows = 21;
  double cell = 30;   ///< less than 1: degrees, else metres; 0: the format states none
  bool isLong = true; ///< only with IMGEO_SOAK
  const char* name = "hills";
  std::array<const char*, 3> options{};
  bool needsSystem = false; ///< it stores no grid without a reference system
  bool isCreated = false;   ///< the driver copies no other dataset
  bool isFromSouth = false; ///< the format states that the first row is the southern one
};

void PrintTo(const DriverFormat& format, std::ostream* out) {
  *out << format.driver << format.extension;
}

constexpr double second = 1.0 / 3600;

constexpr DriverFormat driverFormats[] = {
    {.driver = "HFA", .extension = ".img", .isLong = false},
    {.driver = "NWT_GRD", .extension = ".grd", .isLong = false},
    {.driver = "AAIGrid", .extension = ".asc"},
    {.driver = "BAG",
     .extension = ".bag",
     .options = {"VAR_DATE=2026-01-01", "VAR_PROCESS_STEP_DESCRIPTION=none"},
     .needsSystem = true},
    {.driver = "BT", .extension = ".bt"},
    {.driver = "BYN", .extension = ".byn", .type = GDT_Int16, .cell = 5 * second},
    {.driver = "DTED", .extension = ".dt0", .type = GDT_Int16, .columns = 121, .rows = 121, .cell = 30 * second},
    {.driver = "EHdr", .extension = ".bil"},
    {.driver = "EHdr", .extension = ".flt"},
    {.driver = "ENVI", .extension = ".dat"},
    {.driver = "ENVI", .extension = ".img"},
    {.driver = "GS7BG", .extension = ".grd", .type = GDT_Float64},
    {.driver = "GSAG", .extension = ".grd"},
    {.driver = "GSBG", .extension = ".grd"},
    {.driver = "GTX", .extension = ".gtx", .cell = 5 * second},
    {.driver = "GTiff", .extension = ".tif"},
    {.driver = "HF2", .extension = ".hf2"},
    {.driver = "JP2OpenJPEG", .extension = ".jp2", .type = GDT_Int16, .options = {"REVERSIBLE=YES", "QUALITY=100"}},
    {.driver = "netCDF", .extension = ".nc"},
    {.driver = "RMF", .extension = ".mtw", .type = GDT_Float64, .options = {"MTW=YES"}},
    {.driver = "RST", .extension = ".rst"},
    {.driver = "SAGA", .extension = ".sdat"},
    {.driver = "SIGDEM", .extension = ".sigdem", .type = GDT_Float64, .needsSystem = true},
    {.driver = "SRTMHGT",
     .extension = ".hgt",
     .type = GDT_Int16,
     .columns = 1201,
     .rows = 1201,
     .cell = 3 * second,
     .name = "N35W084"},
    {.driver = "Terragen",
     .extension = ".ter",
     .options = {"MINUSERPIXELVALUE=200", "MAXUSERPIXELVALUE=300"},
     .isCreated = true,
     .isFromSouth = true},
    {.driver = "USGSDEM", .extension = ".dem", .type = GDT_Int16, .cell = second},
    {.driver = "XYZ", .extension = ".xyz"},
    {.driver = "ZMap", .extension = ".dat"},
};

/// Whole heights of 200 to 300.
double heightAt(int column, int row) {
  return std::floor(250 + 50 * std::sin(column / 5.0 + row / 7.0));
}

const std::string nad83 =
    R"(GEOGCS["NAD83",DATUM["North_American_Datum_1983",SPHEROID["GRS 1980",6378137,298.257222101]],)"
    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]])";
const std::string utm = "PROJCS[\"NAD83 / UTM zone 16N\"," + nad83 +
                        R"(,PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],)"
                        R"(PARAMETER["central_meridian",-87],PARAMETER["scale_factor",0.9996],)"
                        R"(PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]])";

/// Writes the heights of the grid to a dataset, and where on earth it lies.
void fill(const WritingLibrary& library, GDALDatasetH dataset, const DriverFormat& format) {
  const bool isInDegrees = format.cell < 1;
  // The first height of a degree's south-western corner is in the centre of its cell, as SRTM and DTED have it.
  std::array<double, 6> transform{isInDegrees ? -84 - format.cell / 2 : 500000.0, format.cell, 0,
                                  isInDegrees ? 36 + format.cell / 2 : 4000000.0, 0,           -format.cell};
  library.setGeoTransform(dataset, transform.data());
  // Only where the format needs it: the process that reads the file could not open PROJ's database a second time.
  if (isInDegrees || format.needsSystem)
    library.setProjection(dataset, (isInDegrees ? nad83 : utm).c_str());
  std::vector<double> heights;
  for (int row = 0; row < format.rows; ++row)
    for (int column = 0; column < format.columns; ++column)
      heights.push_back(heightAt(column, row));
  ASSERT_EQ(gdal().rasterIO(gdal().getRasterBand(dataset, 1), GF_Write, 0, 0, format.columns, format.rows,
                            heights.data(), format.columns, format.rows, GDT_Float64, 0, 0),
            CE_None)
      << gdal().getLastErrorMsg();
}

void write(const std::filesystem::path& file, const DriverFormat& format) {
  gdal(); // registers the drivers
  const WritingLibrary library;
  GDALDriverH const driver = library.getDriverByName(format.driver);
  auto* const options = const_cast<char**>(format.options.data()); // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const auto make = [&](GDALDriverH maker, const char* name, char** with) {
    GDALDatasetH const made = library.create(maker, name, format.columns, format.rows, 1, format.type, with);
    if (made != nullptr)
      fill(library, made, format);
    return made;
  };
  if (format.isCreated) {
    GDALDatasetH const written = make(driver, file.c_str(), options);
    ASSERT_NE(written, nullptr) << gdal().getLastErrorMsg();
    gdal().close(written);
    return;
  }
  GDALDatasetH const source = make(library.getDriverByName("MEM"), "", nullptr);
  GDALDatasetH const written = library.createCopy(driver, file.c_str(), source, FALSE, options, nullptr, nullptr);
  ASSERT_NE(written, nullptr) << gdal().getLastErrorMsg();
  gdal().close(written);
  gdal().close(source);
}

class DemDriver : public ::testing::TestWithParam<DriverFormat> {};

TEST_P(DemDriver, IsReadWithItsHeightsAndCells) {
  const DriverFormat& format = GetParam();
  if (format.isLong && std::getenv("IMGEO_SOAK") == nullptr)
    GTEST_SKIP() << "only with IMGEO_SOAK";
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / (std::string(format.name) + format.extension);
  write(file, format);
  if (HasFatalFailure())
    return;
  const Imported imported = importFile(file);
  EXPECT_EQ(imported.format, format.driver == std::string("GTiff") ? "GeoTIFF" : format.driver);
  const Mesh& mesh = imported.scene.meshes.at(0);
  const auto columns = static_cast<std::size_t>(format.columns), rows = static_cast<std::size_t>(format.rows);
  ASSERT_EQ(mesh.positions.size(), columns * rows);
  EXPECT_EQ(mesh.elementCount(), 2 * (columns - 1) * (rows - 1));
  const Box3d box = boxOf(mesh);
  const Vec3d size = box.size();
  if (format.cell >= 1) {
    EXPECT_NEAR(size.x, format.cell * (format.columns - 1), 1e-3);
    EXPECT_NEAR(size.z, format.cell * (format.rows - 1), 1e-3);
  }
  for (const Vec3f& position : mesh.positions) { // whole numbers of cells from the corner in the north-west
    const Vec3d off = Vec3d(position) - box.min;
    const auto column = static_cast<int>(std::lround(off.x / size.x * (format.columns - 1))),
               southwards = static_cast<int>(std::lround(off.z / size.z * (format.rows - 1))),
               row = format.isFromSouth ? format.rows - 1 - southwards : southwards;
    ASSERT_NEAR(position.y, heightAt(column, row), 0.51) << column << " " << row;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DemDriver, ::testing::ValuesIn(driverFormats));

} // namespace
} // namespace imgeo::testing
