#include "import/assimp/assimp.h"

#include "base/error.h"
#include "import/archive/zip.h"
#include "import/assimp/axes.h"
#include "import/assimp/files.h"
#include "import/assimp/library.h"
#include "import/assimp/repair.h"
#include "import/assimp/reported_errors.h"
#include "import/assimp/scene_reader.h"
#include "import/isolation/child_process.h"
#include "import/unread_formats.h"
#include "import/warnings.h"

#include <algorithm>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>
#include <memory>
#include <string_view>

namespace imgeo {

namespace {

/// The last extension in lower case, with its dot. Unlike for extensionOf, that may be ".gz": Assimp reads no gzipped
/// files.
std::string lastExtensionOf(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return extension;
}

struct Release {
  void operator()(const aiScene* scene) const { assimp().releaseImport(scene); }
  void operator()(aiPropertyStore* properties) const { assimp().releasePropertyStore(properties); }
};

using OwnedScene = std::unique_ptr<const aiScene, Release>;

/// Whether repair() mends what validation refuses. A second refusal ends this process: Assimp frees the scene twice.
bool isRepairable(std::string_view reason) {
  return reason.find("is larger than aiAnimation::mDuration") != std::string_view::npos ||
         reason.find("has the same name as aiScene::mNumLights") != std::string_view::npos;
}

/// The scene of a file after Assimp's validation, without which its indices could be out of range; null if it fails.
OwnedScene importValidated(const std::string& assimpName, SourceFiles& files, const aiPropertyStore& properties,
                           ReportedErrors& errors) {
  constexpr unsigned validation = aiProcess_ValidateDataStructure;
  OwnedScene scene(assimp().importFile(assimpName.c_str(), validation, &files.io(), &properties));
  if (scene || !isRepairable(assimp().getErrorString()))
    return scene;
  errors.clear(); // the file is read again
  scene.reset(assimp().importFile(assimpName.c_str(), 0, &files.io(), &properties));
  if (!scene)
    return scene;
  repair(const_cast<aiScene&>(*scene)); // ours: no one else has it
  return OwnedScene(assimp().applyPostProcessing(scene.release(), validation));
}

/// What else may be done about a file that Assimp refuses with `reason`.
std::string_view adviceFor(const std::string& format, const std::string& reason) {
  if ((format == "STEP" || format == "STP") && reason.find("Unrecognized file schema") != std::string::npos)
    return adviceForCurvedSurfaces; // of STEP files Assimp reads those of IFC
  if (format == "BLEND")
    return "; Blender exports glTF, which imgeo reads";
  return "";
}

/// `dottedExtension`, in lower case, is that of the bytes' format.
Imported readInThisProcess(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                           const std::string& dottedExtension) {
  const References references(options, name);
  const std::string assimpName = std::filesystem::path(name).replace_extension(dottedExtension);
  SourceFiles files(bytes, assimpName, references);
  const std::unique_ptr<aiPropertyStore, Release> properties(assimp().createPropertyStore());
  assimp().setImportPropertyInteger(properties.get(), AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS,
                                    false); // otherwise Assimp splits each node into several
  assimp().setImportPropertyInteger(properties.get(), AI_CONFIG_IMPORT_NO_SKELETON_MESHES,
                                    true); // otherwise Assimp draws the nodes of a scene without meshes as bones
  ReportedErrors errors;
  const OwnedScene scene = importValidated(assimpName, files, *properties, errors);
  const std::string extension = dottedExtension.substr(1);
  std::string format = extension;
  std::ranges::transform(format, format.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
  if (!scene) {
    std::string reason = assimp().getErrorString();
    if (reason.find("aiScene::mNumMeshes is 0") != std::string::npos) // the motion of a skeleton alone, in BVH
      throw Error(ErrorKind::malformed, name, "the file has no triangles, lines or points");
    std::ranges::replace(reason, '\n', ' ');
    throw Error(ErrorKind::malformed, name,
                fmt::format("is damaged or no {} file; Assimp, which reads the format, says: {}{}", format, reason,
                            adviceFor(format, reason)));
  }
  Imported imported = readAssimpScene(*scene, name, references, options, extension);
  imported.format = format;
  addAssimpAxes(*scene, extension, imported);
  std::vector<std::string> omissions = errors.sentences();
  for (const std::string& refused : files.refused())
    omissions.push_back(fmt::format("Not read: {}.", refused));
  addOmissions(imported.warnings, omissions, options.strict, name);
  return imported;
}

} // namespace

bool isReadByAssimp(const std::string& name) {
  const std::string extension = lastExtensionOf(name);
  return !extension.empty() && assimp().isExtensionSupported(extension.c_str()) == AI_TRUE;
}

Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  return readByAssimp(bytes, name, options, lastExtensionOf(name));
}

Imported readByAssimp(ByteSpan bytes, const std::string& name, const ImportOptions& options,
                      const std::string& extension) {
  refuseZipBomb(bytes, name);
  const auto read = [&] {
    if (extension != ".amf" || !isZip(bytes))
      return readInThisProcess(bytes, name, options, extension);
    return readInThisProcess(unpackZip(bytes, name), name, options, extension); // Assimp does not unpack AMF
  };
  return readInChildProcess(read, name);
}

} // namespace imgeo
