#pragma once
// GDAL's C functions, loaded at first use: linking the library would load its hundred dependencies at every start.

#include "base/dynamic_library.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>

namespace imgeo {

struct GdalLibrary : DynamicLibrary {
  /// Registers GDAL's own drivers, without those of plug-ins.
  GdalLibrary() : DynamicLibrary(IMGEO_GDAL) {
    setConfigOption("GDAL_DRIVER_PATH", "disable");
    setConfigOption("GDAL_PAM_ENABLED", "NO"); // no .aux.xml files
    allRegister();
    pushErrorHandler(quietErrorHandler);
  }

  decltype(&::CPLErrorReset) errorReset = find("CPLErrorReset");
  decltype(&::CPLGetLastErrorMsg) getLastErrorMsg = find("CPLGetLastErrorMsg");
  decltype(&::CPLPushErrorHandler) pushErrorHandler = find("CPLPushErrorHandler");
  decltype(&::CPLQuietErrorHandler) quietErrorHandler = find("CPLQuietErrorHandler");
  decltype(&::CPLSetConfigOption) setConfigOption = find("CPLSetConfigOption");
  decltype(&::GDALAllRegister) allRegister = find("GDALAllRegister");
  decltype(&::GDALClose) close = find("GDALClose");
  decltype(&::GDALDataTypeIsComplex) dataTypeIsComplex = find("GDALDataTypeIsComplex");
  decltype(&::GDALGetColorEntryAsRGB) getColorEntry = find("GDALGetColorEntryAsRGB");
  decltype(&::GDALGetDatasetDriver) getDatasetDriver = find("GDALGetDatasetDriver");
  decltype(&::GDALGetDriverShortName) getDriverShortName = find("GDALGetDriverShortName");
  decltype(&::GDALGetGeoTransform) getGeoTransform = find("GDALGetGeoTransform");
  decltype(&::GDALGetMaskBand) getMaskBand = find("GDALGetMaskBand");
  decltype(&::GDALGetRasterBand) getRasterBand = find("GDALGetRasterBand");
  decltype(&::GDALGetRasterColorInterpretation) getColorInterpretation = find("GDALGetRasterColorInterpretation");
  decltype(&::GDALGetRasterColorTable) getColorTable = find("GDALGetRasterColorTable");
  decltype(&::GDALGetRasterCount) getRasterCount = find("GDALGetRasterCount");
  decltype(&::GDALGetRasterDataType) getRasterDataType = find("GDALGetRasterDataType");
  decltype(&::GDALGetRasterNoDataValue) getNoDataValue = find("GDALGetRasterNoDataValue");
  decltype(&::GDALGetRasterOffset) getRasterOffset = find("GDALGetRasterOffset");
  decltype(&::GDALGetRasterScale) getRasterScale = find("GDALGetRasterScale");
  decltype(&::GDALGetRasterUnitType) getRasterUnitType = find("GDALGetRasterUnitType");
  decltype(&::GDALGetRasterXSize) getRasterXSize = find("GDALGetRasterXSize");
  decltype(&::GDALGetRasterYSize) getRasterYSize = find("GDALGetRasterYSize");
  decltype(&::GDALGetSpatialRef) getSpatialRef = find("GDALGetSpatialRef");
  decltype(&::GDALOpenEx) openEx = find("GDALOpenEx");
  decltype(&::GDALRasterIO) rasterIO = find("GDALRasterIO");
  decltype(&::OSRDestroySpatialReference) destroySpatialReference = find("OSRDestroySpatialReference");
  decltype(&::OSRExportToWkt) exportToWkt = find("OSRExportToWkt");
  decltype(&::OSRGetAngularUnits) getAngularUnits = find("OSRGetAngularUnits");
  decltype(&::OSRGetAuthorityCode) getAuthorityCode = find("OSRGetAuthorityCode");
  decltype(&::OSRGetAuthorityName) getAuthorityName = find("OSRGetAuthorityName");
  decltype(&::OSRGetInvFlattening) getInvFlattening = find("OSRGetInvFlattening");
  decltype(&::OSRGetLinearUnits) getLinearUnits = find("OSRGetLinearUnits");
  decltype(&::OSRGetName) getName = find("OSRGetName");
  decltype(&::OSRGetSemiMajor) getSemiMajor = find("OSRGetSemiMajor");
  decltype(&::OSRImportFromEPSG) importFromEpsg = find("OSRImportFromEPSG");
  decltype(&::OSRIsGeographic) isGeographic = find("OSRIsGeographic");
  decltype(&::OSRNewSpatialReference) newSpatialReference = find("OSRNewSpatialReference");
  decltype(&::VSIFCloseL) closeFile = find("VSIFCloseL");
  decltype(&::VSIFileFromMemBuffer) fileFromMemory = find("VSIFileFromMemBuffer");
  decltype(&::VSIFree) free = find("VSIFree");
};

/// Loads the library at the first call.
inline const GdalLibrary& gdal() {
  static const GdalLibrary library;
  return library;
}

} // namespace imgeo
