#pragma once
// Where the elements of an array are in the text of a JSON object, so that a document of many need not be in memory.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// A member of a JSON object, in its text.
struct JsonMember {
  std::string name;
  std::string_view value; ///< without white space around it
};

/// The members of an object, in their order, and the elements of an array. `text` is well formed; other kinds of values
/// have none.
std::vector<JsonMember> membersOf(std::string_view text);
std::vector<std::string_view> elementsOf(std::string_view text);

/// The elements of an array, in 8 bytes each.
class JsonElements {
public:
  JsonElements() = default;
  /// `array`: the text of an array, which must outlive this and is shorter than 4 GiB, as in all GLB files.
  explicit JsonElements(std::string_view array);

  std::size_t size() const { return ranges_.size(); }
  std::string_view operator[](std::size_t index) const {
    return array_.substr(ranges_[index].offset, ranges_[index].length);
  }

private:
  struct Range {
    std::uint32_t offset = 0, length = 0;
  };

  std::string_view array_;
  std::vector<Range> ranges_;
};

} // namespace imgeo
