#pragma once
// For tests: a temporary directory, and bytes as text in base 16.

#include "base/bytes.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace imgeo::testing {

/// A new empty directory, removed with its content at the end of its scope.
class TemporaryDirectory {
public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "imgeo-test-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw std::system_error(errno, std::generic_category(), name);
    path_ = std::filesystem::canonical(name);
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

inline std::string base16Of(const Bytes& bytes) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes)
    text.append({digits[byte >> 4], digits[byte & 15]});
  return text;
}

/// The inverse of base16Of(). Throws std::invalid_argument for other characters.
inline Bytes bytesOfBase16(const std::string& text) {
  Bytes bytes;
  for (std::size_t i = 0; i < text.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

} // namespace imgeo::testing
