#include "content/media_type.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace imgeo {

namespace {

struct Row {
  std::string_view extension;
  MediaType type;
};

constexpr Row rows[] = {
    {"html", {"text/html; charset=utf-8", true}},
    {"htm", {"text/html; charset=utf-8", true}},
    {"js", {"text/javascript; charset=utf-8", true}},
    {"mjs", {"text/javascript; charset=utf-8", true}},
    {"css", {"text/css; charset=utf-8", true}},
    {"txt", {"text/plain; charset=utf-8", true}},
    {"md", {"text/markdown; charset=utf-8", true}},
    {"csv", {"text/csv; charset=utf-8", true}},
    {"json", {"application/json", true}},
    {"map", {"application/json", true}},
    {"webmanifest", {"application/manifest+json", true}},
    {"xml", {"application/xml", true}},
    {"x3d", {"model/x3d+xml", true}},
    {"svg", {"image/svg+xml", true}},
    {"gltf", {"model/gltf+json", true}},
    {"glb", {"model/gltf-binary", true}},
    {"obj", {"model/obj", true}},
    {"mtl", {"model/mtl", true}},
    {"stl", {"model/stl", true}},
    {"bin", {"application/octet-stream", true}}, // typed arrays of BG
    {"png", {"image/png", false}},
    {"jpg", {"image/jpeg", false}},
    {"jpeg", {"image/jpeg", false}},
    {"webp", {"image/webp", false}},
    {"avif", {"image/avif", false}},
    {"gif", {"image/gif", false}},
    {"ico", {"image/x-icon", true}},
    {"ktx2", {"image/ktx2", false}},
    {"wasm", {"application/wasm", true}},
    {"woff2", {"font/woff2", false}},
    {"mp4", {"video/mp4", false}},
    {"webm", {"video/webm", false}},
    {"pdf", {"application/pdf", false}},
    {"gz", {"application/gzip", false}},
    {"zip", {"application/zip", false}},
};

} // namespace

MediaType mediaTypeOf(std::string_view fileName) {
  const std::size_t dot = fileName.rfind('.');
  if (dot != std::string_view::npos) {
    std::string extension(fileName.substr(dot + 1));
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const Row& row : rows) {
      if (row.extension == extension)
        return row.type;
    }
  }
  return {"application/octet-stream", false};
}

} // namespace imgeo
