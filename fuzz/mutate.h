#pragma once
// Makes inputs by small changes to inputs of a corpus. The sequence is the same on every machine.

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace imgeo::fuzz {

using Input = std::vector<std::uint8_t>;

class Mutator {
public:
  /// `corpus` is not empty and outlives the mutator.
  explicit Mutator(const std::vector<Input>& corpus) : corpus_(corpus) {}

  Input next() {
    Input input = corpus_[below(corpus_.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes)
      mutate(input);
    return input;
  }

private:
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : engine_() % bound; }
  static auto at(Input& input, std::size_t offset) { return input.begin() + static_cast<std::ptrdiff_t>(offset); }

  void mutate(Input& input) {
    const std::size_t offset = below(input.size() + 1),
                      length = below(std::min<std::size_t>(input.size() - offset, 64) + 1);
    switch (below(8)) {
    case 0: // one bit
      if (offset < input.size())
        input[offset] ^= static_cast<std::uint8_t>(1u << below(8));
      break;
    case 1: // a byte at the edge of its range
      if (offset < input.size())
        input[offset] = std::array<std::uint8_t, 5>{0, 1, 0x7f, 0x80, 0xff}[below(5)];
      break;
    case 2: // cut short
      input.resize(offset);
      break;
    case 3: // a range removed
      input.erase(at(input, offset), at(input, offset + length));
      break;
    case 4: { // a range copied to another offset
      const Input range(at(input, offset), at(input, offset + length));
      input.insert(at(input, below(input.size() + 1)), range.begin(), range.end());
      break;
    }
    case 5: { // the end of another input
      const Input& other = corpus_[below(corpus_.size())];
      input.resize(offset);
      input.insert(input.end(), other.begin() + static_cast<std::ptrdiff_t>(below(other.size() + 1)), other.end());
      break;
    }
    case 6: // four random bytes, such as a huge count
      for (std::size_t i = offset; i < std::min(input.size(), offset + 4); ++i)
        input[i] = static_cast<std::uint8_t>(engine_());
      break;
    case 7: { // text that number parsers may mishandle
      static constexpr std::array<std::string_view, 8> numbers{
          "-1", "4294967296", "nan", "1e999", "99999999999999999999", " ", "\n", "0"};
      const std::string_view number = numbers[below(numbers.size())];
      input.insert(at(input, offset), number.begin(), number.end());
      break;
    }
    }
  }

  const std::vector<Input>& corpus_;
  std::mt19937 engine_{20120804};
};

} // namespace imgeo::fuzz
