#include "import/source_name.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace imgeo {

namespace {

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// "bunny.ply" of "models/bunny.ply.gz".
std::filesystem::path withoutGz(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(name).filename();
  return lowerCase(file.extension()) == ".gz" ? file.stem() : file;
}

} // namespace

std::string stemOf(const std::string& name) {
  return withoutGz(name).stem();
}

std::string extensionOf(const std::string& name) {
  return lowerCase(withoutGz(name).extension());
}

std::string byteLocation(const std::string& name, std::size_t byte) {
  return fmt::format("{}, byte {}", name, byte);
}

} // namespace imgeo
