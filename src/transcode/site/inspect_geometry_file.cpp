#include "transcode/site/inspect_geometry_file.h"

#include "base/file.h"
#include "containers/image_file.h"

namespace imgeo {

GeometryFileInfo inspectGeometryFile(const std::filesystem::path& file) {
  GeometryFileInfo info;
  const Bytes bytes = readFile(file);
  info.bytes = bytes.size();
  info.namedByContent = file.stem() == contentName(bytes);
  info.kind = "typed array";
  if (file.extension() == ".png" || file.extension() == ".webp") {
    const Image image = decodeImageFile(bytes, file.string());
    info.kind = file.extension() == ".webp" ? "WebP image" : "PNG image";
    info.width = image.width;
    info.height = image.height;
    info.channels = image.channels;
  }
  return info;
}

} // namespace imgeo
