#pragma once
// The patches that share one file of compact, within the limits of the format.

#include "containers/compact/compact.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace imgeo {

/// Collects the patches of one file of compact.
class FileContents {
public:
  /// Whether the file can hold one more patch and then has at most `maxWedges` wedges. Any patch fits into an empty
  /// file.
  bool fits(const compact::CompactPatch& patch, std::size_t maxWedges) const;
  void add(compact::CompactPatch patch);
  const std::vector<compact::CompactPatch>& patches() const { return patches_; }

private:
  /// Properties that the header of a file stores once for all patches that share them.
  struct Kind {
    Topology topology = Topology::triangles;
    std::uint32_t positionBits = 16;
    std::vector<compact::AttributeType> attributes;
    friend bool operator==(const Kind&, const Kind&) = default;
  };
  static Kind kindOf(const compact::CompactPatch& patch);

  std::vector<compact::CompactPatch> patches_;
  std::vector<Kind> kinds_;
  std::size_t wedges_ = 0, elements_ = 0;
};

} // namespace imgeo
