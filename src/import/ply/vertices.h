#pragma once
// Reads the `vertex` element of a PLY file.

#include "import/ply/content.h"
#include "import/ply/records.h"

#include <array>
#include <cmath>
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
    records.forEach(element_, [&] {
      for (std::size_t p = 0; p < semantics_.size(); ++p) {
        const PlyProperty& property = element_.properties[p];
        if (property.isList()) {
          records.skip(property);
          continue;
        }
        const double value = records.scalar(property.type);
        values_[static_cast<std::size_t>(semantics_[p])] = value;
        if (!named_.empty() && named_[p] != nullptr)
          named_[p]->values.push_back(static_cast<float>(value));
      }
      if (const char* fault = addVertex())
        records.fail(ErrorKind::malformed, fault);
    });
  }

private:
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
