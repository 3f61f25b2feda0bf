#pragma once
// Reads the `vertex` element of a PLY file.

#include "base/error.h"
#include "import/ply/content.h"
#include "import/ply/records.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

/// The meaning of a vertex property. Properties of `unknown` meaning are skipped or, where the options ask for them,
/// become named attributes.
enum class PlySemantic : std::uint8_t { x, y, z, nx, ny, nz, u, v, red, green, blue, alpha, unknown, count };

class PlyVertexReader {
public:
  /// Adds properties that are not read to content.ignored.
  PlyVertexReader(const PlyElement& element, const AttributeChoice& kept, PlyContent& content);

  bool hasPosition() const { return has(PlySemantic::x, PlySemantic::z); }

  template <typename Cursor> void read(PlyRecords<Cursor>& records) {
    records.checkCount(element_);
    reserve();
    const std::vector<Run> runs = runsOfProperties();
    std::vector<double> row(semantics_.size());
    records.forEach(element_, [&] {
      for (const Run& run : runs)
        if (run.isList)
          records.skip(element_.properties[run.first]);
        else
          records.values(run.type, std::span(row).subspan(run.first, run.count));
      for (std::size_t p = 0; p < row.size(); ++p)
        values_[static_cast<std::size_t>(semantics_[p])] = row[p];
      for (std::size_t p = 0; p < named_.size(); ++p)
        if (named_[p] != nullptr)
          named_[p]->values.push_back(static_cast<float>(row[p]));
      if (const char* fault = addVertex())
        records.fail(ErrorKind::malformed, fault);
    });
  }

  /// The position of the first record; nothing where it cannot be read.
  template <typename Cursor>
  static std::optional<Vec3d> firstPosition(PlyRecords<Cursor> records, const PlyElement& element) {
    if (element.count == 0)
      return std::nullopt;
    PlyElement first = element;
    first.count = 1;
    PlyContent content;
    PlyVertexReader reader(first, {}, content);
    if (!reader.hasPosition())
      return std::nullopt;
    try {
      reader.read(records);
    } catch (const Error&) { // which reading all records reports
      return std::nullopt;
    }
    return Vec3d{reader.value(PlySemantic::x), reader.value(PlySemantic::y), reader.value(PlySemantic::z)};
  }

private:
  /// Properties of one type that follow each other, or one list.
  struct Run {
    std::size_t first = 0, count = 1;
    PlyType type;
    bool isList;
  };

  std::vector<Run> runsOfProperties() const;
  void chooseNamed(const AttributeChoice& kept);
  /// Whether all semantics from `first` to `last` are present.
  bool has(PlySemantic first, PlySemantic last) const;
  double value(PlySemantic semantic) const { return values_[static_cast<std::size_t>(semantic)]; }
  bool isFinite(PlySemantic first, PlySemantic last) const;
  float channel(PlySemantic semantic);
  void noteRounding();
  void reserve();
  /// Appends a vertex of the current values; returns an error message, or null.
  const char* addVertex();
  bool namedAreFinite() const;

  const PlyElement& element_;
  PlyContent& content_;
  std::vector<PlySemantic> semantics_; ///< per property
  std::vector<NamedAttribute*> named_; ///< per property, null for properties of no attribute; empty without attributes
  std::array<double, static_cast<std::size_t>(PlySemantic::count)> values_{};
  std::array<PlyType, static_cast<std::size_t>(PlySemantic::count)> types_{};
  std::array<bool, static_cast<std::size_t>(PlySemantic::count)> present_{};
  bool hasNormal_ = false, hasTexCoord_ = false, hasColor_ = false, hasAlpha_ = false, isDouble_ = false;
};

} // namespace imgeo
