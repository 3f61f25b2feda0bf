#include "import/xyz/xyz_columns.h"

#include "base/error.h"
#include "import/mesh/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::size_t sampleLines = 1000;

using Triple = XyzColumns::Triple;

std::string lowered(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// The last line of a text that is not empty.
std::string_view lastLineOf(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  return text.substr(text.find_last_of('\n') + 1); // npos + 1 is 0
}

/// The words of a line of names, without the # or // before them.
std::vector<std::string_view> namesIn(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("#/ \t"), line.size()));
  return wordsOf(line);
}

/// The first points of a text: flat, `count` numbers each.
struct Sample {
  std::size_t count = 0;
  std::vector<double> numbers;

  template <typename Condition> bool all(const Triple& columns, Condition condition) const {
    for (std::size_t at = 0; at < numbers.size(); at += count)
      if (!condition(numbers[at + columns[0]], numbers[at + columns[1]], numbers[at + columns[2]]))
        return false;
    return true;
  }
  bool areNormals(const Triple& columns) const {
    return all(columns, [](double x, double y, double z) { return std::abs(std::hypot(x, y, z) - 1) < 0.01; });
  }
  bool areWithin(const Triple& columns, double largest) const {
    return all(columns, [&](double r, double g, double b) {
      return std::min({r, g, b}) >= 0 && std::max({r, g, b}) <= largest;
    });
  }
  bool areIntegers(const Triple& columns) const {
    const auto isInteger = [](double number) { return number == std::floor(number); };
    return all(columns, [&](double r, double g, double b) { return isInteger(r) && isInteger(g) && isInteger(b); });
  }
  bool areColors(const Triple& columns) const { return areWithin(columns, areIntegers(columns) ? 255 : 1); }
  double whiteOf(const Triple& columns) const {
    if (!areIntegers(columns) && areWithin(columns, 1))
      return 1;
    return areWithin(columns, 255) || !areWithin(columns, 65535) ? 255 : 65535;
  }
};

/// Reads the text's columns from its first lines.
class ColumnReader {
public:
  ColumnReader(ByteSpan text, const std::string& name) : text_(text), name_(name) {}

  XyzColumns read() {
    readSample();
    columns_.count = sample_.count;
    isTaken_.resize(sample_.count);
    if (names_.size() != sample_.count || !readNames())
      names_.clear();
    take(columns_.position);
    if (names_.empty())
      findTriples();
    if (columns_.color)
      columns_.white = sample_.whiteOf(*columns_.color);
    nameValues();
    return std::move(columns_);
  }

private:
  void readSample() {
    NumberLines lines(text_, name_, maxXyzNumbers);
    if (!lines.next())
      throw Error(ErrorKind::malformed, name_, "has no points");
    if (!lines.numbersIfAny() && !lines.next()) // a title, or names
      throw Error(ErrorKind::malformed, name_, "has no points");
    columns_.begin = lines.begin();
    const std::string_view before = lastLineOf(asText(text_).substr(0, columns_.begin));
    names_ = namesIn(before);
    isTable_ = !before.starts_with('#') && !before.starts_with("//") && before.find_first_of(",;") != before.npos;
    const std::optional<std::span<const double>> first = lines.numbersIfAny();
    sample_.count = first ? first->size() : 0;
    if (sample_.count < 3)
      lines.fail("a line of at least three numbers expected: x, y and z of a point");
    std::size_t count = 0;
    do {
      const std::span<const double> numbers = xyzNumbers(lines, sample_.count);
      sample_.numbers.insert(sample_.numbers.end(), numbers.begin(), numbers.end());
    } while (++count < sampleLines && lines.next());
  }

  /// Reads what the line before the first point says. False where it is a sentence: where it names no position, normal
  /// or colour and is not the first line of a table.
  bool readNames() {
    const std::optional<Triple> position = named({"x", "y", "z"});
    columns_.position = position.value_or(columns_.position);
    columns_.normal = named({"nx", "ny", "nz"});
    columns_.color = named({"r", "g", "b"});
    if (!columns_.color)
      columns_.color = named({"red", "green", "blue"});
    for (const std::optional<Triple>& triple : {columns_.normal, columns_.color})
      if (triple)
        take(*triple);
    return position || columns_.normal || columns_.color || isTable_;
  }

  std::optional<Triple> named(const std::array<std::string_view, 3>& words) const {
    Triple triple;
    for (std::size_t n = 0; n < 3; ++n) {
      const auto found = std::ranges::find(names_, words[n], lowered);
      if (found == names_.end())
        return std::nullopt;
      triple[n] = static_cast<std::size_t>(found - names_.begin());
    }
    return triple;
  }

  void findTriples() {
    for (std::size_t first = 3; !columns_.normal && freeFrom(first) >= 3; ++first)
      if (const Triple triple = from(first); sample_.areNormals(triple))
        take(columns_.normal.emplace(triple));
    for (std::size_t first = 3; !columns_.color && first < sample_.count; ++first) {
      const std::size_t free = freeFrom(first);
      const bool isIntensity = free == 4 && sample_.areColors(from(first + 1)); // x y z intensity r g b
      if (free >= 3 && !isIntensity && sample_.areColors(from(first)))
        take(columns_.color.emplace(from(first)));
    }
  }

  static Triple from(std::size_t first) { return {first, first + 1, first + 2}; }

  /// The columns from this one on that are not taken.
  std::size_t freeFrom(std::size_t first) const {
    std::size_t end = first;
    while (end < sample_.count && !isTaken_[end])
      ++end;
    return end - first;
  }

  void nameValues() {
    std::vector<std::string> taken;
    for (std::size_t column = 0; column < sample_.count; ++column) {
      if (isTaken_[column])
        continue;
      const bool isIntensity = names_.empty() && isSingle(column);
      const std::string stored = !names_.empty() ? std::string(names_[column])
                                 : isIntensity   ? "intensity"
                                                 : fmt::format("column{}", column + 1);
      columns_.values.push_back({column, pointValueName(stored, taken)});
      taken.push_back(columns_.values.back().name);
    }
  }

  /// Whether it is the only number that is neither of a position nor of a normal or a colour.
  bool isSingle(std::size_t column) const {
    const bool isAtAnEdge = column == 3 || column + 1 == sample_.count;
    return isAtAnEdge && std::ranges::count(isTaken_, false) == 1;
  }

  void take(const Triple& triple) {
    for (const std::size_t column : triple)
      isTaken_[column] = true;
  }

  ByteSpan text_;
  const std::string& name_;
  XyzColumns columns_;
  Sample sample_;
  std::vector<std::string_view> names_; ///< of all columns, or empty
  bool isTable_ = false;                ///< whether commas or semicolons are between the names, and it is no comment
  std::vector<bool> isTaken_;           ///< by column: whether it is of a position, a normal or a colour
};

} // namespace

std::span<const double> xyzNumbers(NumberLines& lines, std::size_t count) {
  const std::span<const double> numbers = lines.numbers();
  if (numbers.size() != count)
    lines.fail(fmt::format("a point has {} numbers, and those before have {}", numbers.size(), count));
  return numbers;
}

XyzColumns xyzColumnsOf(ByteSpan text, const std::string& name) {
  return ColumnReader(text, name).read();
}

} // namespace imgeo
