#include "import/image_type.h"

namespace imgeo {

std::string imageType(ByteSpan bytes) {
  const std::string_view text = asText(bytes);
  if (text.starts_with("\x89PNG\r\n\x1a\n"))
    return ".png";
  if (text.starts_with("\xff\xd8\xff"))
    return ".jpg";
  const auto has = [&](std::size_t at, std::string_view what) {
    return text.size() >= at && text.substr(at).starts_with(what);
  };
  if (has(0, "RIFF") && has(8, "WEBP"))
    return ".webp";
  if (has(4, "ftypavif"))
    return ".avif";
  if (text.starts_with("GIF8"))
    return ".gif";
  return "";
}

} // namespace imgeo
