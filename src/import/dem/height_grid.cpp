#include "import/dem/height_grid.h"

#include "base/error.h"
#include "import/dem/library.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>
#include <sys/resource.h>

namespace imgeo {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

/// GDAL's drivers of formats that hold heights in one file, perhaps with files of the same name beside it. None of
/// them opens files that its content names, or reaches for a network.
constexpr const char* drivers[] = {
    "AAIGrid", "ACE2",        "BAG",      "BT",      "BYN",      "DTED",    "EHdr", "ENVI", "GRASSASCIIGrid",
    "GS7BG",   "GSAG",        "GSBG",     "GTiff",   "GTX",      "GXF",     "HF2",  "HFA",  "ISG",
    "JDEM",    "JP2OpenJPEG", "Leveller", "netCDF",  "NGSGEOID", "NWT_GRD", "PNG",  "PNM",  "RMF",
    "RST",     "SAGA",        "SIGDEM",   "SRTMHGT", "Terragen", "USGSDEM", "XYZ",  "ZMap", nullptr};

/// Extensions of files beside a raster, which replace its own.
constexpr std::array companions{".prj"sv, ".hdr"sv, ".rdc"sv, ".ref"sv, ".sgrd"sv, ".wld"sv};

/// Files in GDAL's memory file system, as long as this object lives.
class MemoryFiles {
public:
  MemoryFiles() = default;
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  /// `bytes` must outlive the file.
  void add(const std::string& path, ByteSpan bytes) {
    // GDAL does not write to files that it opens for reading.
    auto* const data = const_cast<GByte*>(bytes.data()); // NOLINT(cppcoreguidelines-pro-type-const-cast)
    if (VSILFILE* file = gdal().fileFromMemory(path.c_str(), data, bytes.size(), FALSE))
      gdal().closeFile(file);
  }
  void add(const std::string& path, Bytes&& bytes) {
    own_.push_back(std::make_unique<Bytes>(std::move(bytes)));
    add(path, ByteSpan(*own_.back()));
  }

private:
  std::vector<std::unique_ptr<Bytes>> own_;
};

/// "w" after the first and last letter of an extension: the world file of .tif is .tfw.
std::string worldExtensionOf(const std::string& extension) {
  return extension.size() < 3 ? "" : std::string{'.', extension[1], extension.back(), 'w'};
}

/// Adds the files that may lie beside the raster. Those that are missing or may not be read are left out.
void addCompanions(MemoryFiles& files, const fs::path& path, const std::string& name, const References& references) {
  const fs::path source = fs::path(name).filename();
  std::vector<std::string> extensions(companions.begin(), companions.end());
  extensions.push_back(worldExtensionOf(source.extension()));
  extensions.push_back(source.extension().string() + "w");
  extensions.push_back(source.extension().string() + ".hdr"); // ENVI
  for (const std::string& extension : extensions) {
    if (extension.empty() || extension == source.extension())
      continue;
    const fs::path beside = fs::path(source).replace_extension(extension);
    try {
      std::error_code ignored;
      if (!fs::is_regular_file(references.fileOf(beside.string()), ignored))
        continue;
      files.add(fs::path(path).replace_extension(extension), references.fetch(beside.string()));
    } catch (const Error&) {
      continue; // a file of the same name that is none of the raster's
    }
  }
}

/// Opens PROJ's database, which georeferences are looked up in, and then no file any more: whatever a raster names
/// stays closed, and no network can be reached.
void closeFileSystem() {
  OGRSpatialReferenceH any = gdal().newSpatialReference(nullptr);
  gdal().importFromEpsg(any, 4326);
  gdal().destroySpatialReference(any);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_NOFILE, &none);
}

struct CloseDataset {
  void operator()(void* dataset) const { gdal().close(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

/// GDAL's last message as a part of a sentence, without the path of the memory file.
std::string lastMessage(const std::string& path) {
  std::string message = gdal().getLastErrorMsg();
  for (std::size_t at = message.find(path); at != message.npos; at = message.find(path))
    message.replace(at, path.size(), "the file");
  std::ranges::replace(message, '\n', ' ');
  while (!message.empty() && (message.back() == '.' || message.back() == ' '))
    message.pop_back();
  return message.empty() ? "it is none of the formats that hold one grid of heights" : message;
}

void readReferenceSystem(GDALDatasetH dataset, HeightGrid& grid) {
  OGRSpatialReferenceH system = gdal().getSpatialRef(dataset);
  if (!system)
    return;
  char* wkt = nullptr;
  if (gdal().exportToWkt(system, &wkt) == OGRERR_NONE && wkt)
    grid.wkt = wkt;
  gdal().free(wkt);
  const auto text = [](const char* known) { return known ? std::string(known) : std::string(); };
  grid.crsName = text(gdal().getName(system));
  if (const char* code = gdal().getAuthorityCode(system, nullptr))
    grid.crsCode = text(gdal().getAuthorityName(system, nullptr)) + ":" + code;
  grid.isGeographic = gdal().isGeographic(system) != 0;
  grid.unit = grid.isGeographic ? gdal().getAngularUnits(system, nullptr) : gdal().getLinearUnits(system, nullptr);
  OGRErr fault = OGRERR_NONE;
  const double semiMajor = gdal().getSemiMajor(system, &fault);
  if (fault == OGRERR_NONE && semiMajor > 0) {
    grid.semiMajor = semiMajor;
    grid.inverseFlattening = gdal().getInvFlattening(system, nullptr);
  }
  if (!(grid.unit > 0) || !std::isfinite(grid.unit))
    grid.unit = grid.isGeographic ? std::numbers::pi / 180 : 1;
}

class GdalRaster {
public:
  GdalRaster(GDALDatasetH dataset, const std::string& name, const std::string& path)
      : dataset_(dataset), name_(name), path_(path) {}

  HeightGrid read() {
    HeightGrid grid;
    grid.driver = gdal().getDriverShortName(gdal().getDatasetDriver(dataset_));
    readSize(grid);
    bands_ = gdal().getRasterCount(dataset_);
    if (bands_ == 0)
      throw Error(ErrorKind::unsupported, name_, "holds several rasters, or none, and not one grid of heights");
    readGeoreference(grid);
    requireOneChannel(grid);
    readHeights(grid);
    return grid;
  }

private:
  GDALRasterBandH band(int number) const { return gdal().getRasterBand(dataset_, number); }

  void readSize(HeightGrid& grid) const {
    const int columns = gdal().getRasterXSize(dataset_), rows = gdal().getRasterYSize(dataset_);
    if (columns < 2 || rows < 2)
      throw Error(ErrorKind::malformed, name_, fmt::format("a grid of {} x {} heights has no surface", columns, rows));
    if (static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows) > maxHeightCells) {
      const double scale = std::sqrt(static_cast<double>(maxHeightCells) / columns / rows);
      throw Error(ErrorKind::limit, name_,
                  fmt::format("has {} x {} heights, more than the {} that are read; gdal_translate -outsize {:.0f} "
                              "{:.0f} -r average makes it coarser",
                              columns, rows, maxHeightCells, std::floor(scale * columns), std::floor(scale * rows)));
    }
    grid.columns = static_cast<std::uint32_t>(columns);
    grid.rows = static_cast<std::uint32_t>(rows);
  }

  void readGeoreference(HeightGrid& grid) const {
    std::array<double, 6> transform{};
    if (gdal().getGeoTransform(dataset_, transform.data()) == CE_None) {
      const bool isFinite = std::ranges::all_of(transform, [](double number) { return std::isfinite(number); });
      if (!isFinite || transform[1] * transform[5] == transform[2] * transform[4])
        throw Error(ErrorKind::malformed, name_, "its georeference maps all cells to a line");
      grid.transform = transform;
    }
    readReferenceSystem(dataset_, grid);
    if (const char* unit = gdal().getRasterUnitType(band(1)))
      grid.heightUnit = unit;
    int hasNoData = 0;
    const double noData = gdal().getNoDataValue(band(1), &hasNoData);
    if (hasNoData)
      grid.noData = noData;
  }

  /// Refuses pictures: their colours are no heights. Grey ones may be stored as colours.
  void requireOneChannel(HeightGrid& grid) {
    if (gdal().dataTypeIsComplex(gdal().getRasterDataType(band(1))))
      throw Error(ErrorKind::unsupported, name_, "holds complex numbers and no heights");
    const auto meaningOf = [&](int number) { return gdal().getColorInterpretation(band(number)); };
    palette_ = meaningOf(1) == GCI_PaletteIndex ? gdal().getColorTable(band(1)) : nullptr;
    isColored_ =
        bands_ >= 3 && meaningOf(1) == GCI_RedBand && meaningOf(2) == GCI_GreenBand && meaningOf(3) == GCI_BlueBand;
    const int heightBands = isColored_ ? 3 : 1;
    int furtherBands = 0;
    for (int number = heightBands + 1; number <= bands_; ++number)
      furtherBands += meaningOf(number) != GCI_AlphaBand;
    if (furtherBands > 0)
      grid.warnings.push_back(
          fmt::format("The first of {} bands is taken as heights, the others are left out.", bands_));
  }

  [[noreturn]] void refusePicture() const {
    throw Error(ErrorKind::unsupported, name_, "is a picture in colours; heights are a grey image, or one band");
  }

  [[noreturn]] void failToRead() const {
    throw Error(ErrorKind::malformed, name_,
                fmt::format("is damaged; GDAL, which reads the format, says: {}", lastMessage(path_)));
  }

  template <typename T> void readRow(GDALRasterBandH from, std::uint32_t row, std::vector<T>& numbers) const {
    const auto columns = static_cast<int>(numbers.size());
    constexpr GDALDataType type = sizeof(T) == 1 ? GDT_Byte : GDT_Float64;
    if (gdal().rasterIO(from, GF_Read, 0, static_cast<int>(row), columns, 1, numbers.data(), columns, 1, type, 0, 0) !=
        CE_None)
      failToRead();
  }

  /// The grey value of a palette's colour.
  double greyOf(double index) const {
    GDALColorEntry color{};
    gdal().getColorEntry(palette_, static_cast<int>(index), &color);
    if (color.c1 != color.c2 || color.c2 != color.c3)
      refusePicture();
    return color.c1;
  }

  void readHeights(HeightGrid& grid) const {
    const double stated = numberOr(gdal().getRasterScale, 1), offset = numberOr(gdal().getRasterOffset, 0);
    const double scale = stated != 0 ? stated : 1; // GDAL states 0 for BYN files without a scale
    grid.heights.resize(std::size_t{grid.columns} * grid.rows);
    std::vector<double> numbers(grid.columns), others(grid.columns);
    std::vector<std::uint8_t> isValid(grid.columns);
    GDALRasterBandH const mask = gdal().getMaskBand(band(1));
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
      readRow(band(1), row, numbers);
      for (const int further : {2, 3})
        if (isColored_) {
          readRow(band(further), row, others);
          if (others != numbers)
            refusePicture();
        }
      readRow(mask, row, isValid);
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        const double number = palette_ ? greyOf(numbers[column]) : numbers[column];
        const auto height = static_cast<float>(number * scale + offset);
        grid.heights[std::size_t{row} * grid.columns + column] =
            isValid[column] != 0 && std::isfinite(height) ? height : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }

  double numberOr(double (*get)(GDALRasterBandH, int*), double fallback) const {
    int isStated = 0;
    const double number = get(band(1), &isStated);
    return isStated && std::isfinite(number) ? number : fallback;
  }

  GDALDatasetH dataset_;
  const std::string &name_, &path_;
  int bands_ = 0;
  GDALColorTableH palette_ = nullptr;
  bool isColored_ = false; ///< the first three bands are red, green and blue
};

} // namespace

bool hasRasterSignature(ByteSpan bytes) {
  const std::string_view text = asText(bytes);
  const auto isAsciiGrid = [&] {
    constexpr std::string_view first = "ncols";
    return text.size() > first.size() && std::ranges::equal(first, text.substr(0, first.size()), [](char a, char b) {
             return a == (b >= 'A' && b <= 'Z' ? b + 32 : b);
           });
  };
  constexpr std::array signatures{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv, "\x89PNG\r\n\x1a\n"sv};
  return std::ranges::any_of(signatures, [&](std::string_view mark) { return text.starts_with(mark); }) ||
         isAsciiGrid();
}

HeightGrid readHeightGrid(ByteSpan bytes, const std::string& name, const References& references) {
  const fs::path fileName = fs::path(name).extension() == ".gz" ? fs::path(name).stem() : fs::path(name).filename();
  const std::string path = "/vsimem/imgeo/" + fileName.string();
  MemoryFiles files;
  files.add(path, bytes);
  addCompanions(files, path, fileName, references);
  closeFileSystem();
  gdal().errorReset();
  // Northwood's grids have bands of colours before that of heights, unless one band is asked for.
  constexpr const char* openOptions[] = {"BAND_COUNT=1", nullptr};
  const Dataset dataset(gdal().openEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, openOptions, nullptr));
  if (!dataset)
    throw Error(
        ErrorKind::malformed, name,
        fmt::format("is damaged or no grid of heights; GDAL, which reads these formats, says: {}", lastMessage(path)));
  return GdalRaster(dataset.get(), name, path).read();
}

} // namespace imgeo
