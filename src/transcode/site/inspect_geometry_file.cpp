#include "transcode/site/inspect_geometry_file.h"

#include "base/file.h"
#include "containers/png/png.h"

namespace imgeo {

GeometryFileInfo inspectGeometryFile(const std::filesystem::path& file) {
  GeometryFileInfo info;
  const Bytes bytes = readFile(file);
  info.bytes = bytes.size();
  info.namedByContent = file.stem() == contentName(bytes);
  info.kind = "typed array";
  if (file.extension() == ".png") {
    const Image image = decodePng(bytes, file.string());
    info.kind = "PNG image";
    info.width = image.width;
    info.height = image.height;
    info.channels = image.channels;
  }
  return info;
}

} // namespace imgeo
