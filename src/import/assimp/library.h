#pragma once
// Assimp's C functions, loaded at first use: linking the library would add two milliseconds to every start.

#include "base/dynamic_library.h"

#include <assimp/cimport.h>
#include <assimp/material.h>

namespace imgeo {

struct AssimpLibrary : DynamicLibrary {
  AssimpLibrary() : DynamicLibrary(IMGEO_ASSIMP) {}

  decltype(&::aiApplyPostProcessing) applyPostProcessing = find("aiApplyPostProcessing");
  decltype(&::aiAttachLogStream) attachLogStream = find("aiAttachLogStream");
  decltype(&::aiCreatePropertyStore) createPropertyStore = find("aiCreatePropertyStore");
  decltype(&::aiDetachLogStream) detachLogStream = find("aiDetachLogStream");
  decltype(&::aiGetErrorString) getErrorString = find("aiGetErrorString");
  decltype(&::aiGetMaterialColor) getMaterialColor = find("aiGetMaterialColor");
  decltype(&::aiGetMaterialFloatArray) getMaterialFloats = find("aiGetMaterialFloatArray");
  decltype(&::aiGetMaterialIntegerArray) getMaterialIntegers = find("aiGetMaterialIntegerArray");
  decltype(&::aiGetMaterialString) getMaterialString = find("aiGetMaterialString");
  decltype(&::aiGetMaterialTexture) getMaterialTexture = find("aiGetMaterialTexture");
  decltype(&::aiGetMaterialTextureCount) getMaterialTextureCount = find("aiGetMaterialTextureCount");
  decltype(&::aiImportFileExWithProperties) importFile = find("aiImportFileExWithProperties");
  decltype(&::aiIsExtensionSupported) isExtensionSupported = find("aiIsExtensionSupported");
  decltype(&::aiReleaseImport) releaseImport = find("aiReleaseImport");
  decltype(&::aiReleasePropertyStore) releasePropertyStore = find("aiReleasePropertyStore");
  decltype(&::aiSetImportPropertyInteger) setImportPropertyInteger = find("aiSetImportPropertyInteger");
  decltype(&::aiTextureTypeToString) textureTypeToString = find("aiTextureTypeToString");
};

/// Loads the library at the first call.
inline const AssimpLibrary& assimp() {
  static const AssimpLibrary library;
  return library;
}

} // namespace imgeo
