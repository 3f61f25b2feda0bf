#pragma once
// Helpers for tests of readers.

#include "base/error.h"
#include "import/import.h"

#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace imgeo::testing {

/// The Error that reading `bytes` throws; a test failure where it throws none.
inline Error errorOf(ByteSpan bytes, const std::string& name, const ImportOptions& options = {}) {
  try {
    importBytes(bytes, name, options);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << name << " was read";
  return {ErrorKind::usage, "", ""};
}
inline Error errorOf(std::string_view text, const std::string& name, const ImportOptions& options = {}) {
  return errorOf(asBytes(text), name, options);
}

/// The location and the sentence with which a text is refused.
inline std::string refusalOf(std::string_view text, const std::string& name) {
  const Error error = errorOf(text, name);
  return error.location() + ": " + error.message();
}

/// The mesh of a source that has exactly one.
inline Mesh onlyMesh(ByteSpan bytes, const std::string& name, const ImportOptions& options = {}) {
  const Imported imported = importBytes(bytes, name, options);
  EXPECT_EQ(imported.scene.meshes.size(), 1u);
  EXPECT_TRUE(isConsistent(imported.scene.meshes.at(0)));
  return imported.scene.meshes.at(0);
}
inline Mesh onlyMesh(std::string_view text, const std::string& name, const ImportOptions& options = {}) {
  return onlyMesh(asBytes(text), name, options);
}

} // namespace imgeo::testing
