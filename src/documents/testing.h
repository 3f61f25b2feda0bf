#pragma once
// Helpers for unit tests that read documents.

#include "base/error.h"
#include "documents/documents.h"

#include <gtest/gtest.h>

namespace imgeo::testing {

/// The kind of the Error that reading a text as s.x3d throws, at `location` unless that is empty.
inline ErrorKind errorKindOf(const std::string& text, const std::string& location = "") {
  try {
    readScene(text, "s.x3d");
  } catch (const Error& error) {
    EXPECT_TRUE(location.empty() || location == error.location()) << error.what();
    return error.kind();
  }
  ADD_FAILURE() << "was read: " << text;
  return ErrorKind::usage;
}

/// The geometry of a document whose only Shape has a BinaryGeometry with these fields.
inline GeometryDescription readBinaryGeometry(const std::string& fields) {
  const SceneDocument document =
      readScene("<X3D><Scene><Shape><BinaryGeometry " + fields + "/></Shape></Scene></X3D>", "x");
  return document.geometries.at(0);
}

} // namespace imgeo::testing
