#include "scene/operators.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

using Numbers = std::span<const double>;

constexpr std::string_view spaces = " \t\r\n", operatorSeparators = " \t\r\n,";
constexpr double largestNumber = 1e6;
/// How far each operator of a list may map points: farther ones would not be finite in a shader, and a later operator
/// that multiplies them by zero would make them no numbers.
constexpr double farthest = 1e9;
constexpr double largestLevels = 65536;
/// Stands for no lower limit.
constexpr double lowestLimit = -1e9;

/// An operator, or why its arguments make none.
struct Made {
  Operator value;
  const char* problem = nullptr;
};

Made refused(const char* problem) {
  return {{}, problem};
}

/// One number for all axes, or one for each; nothing for another count.
std::optional<Vec3d> vectorOf(Numbers numbers, std::string_view axes) {
  if (!axes.empty() || (numbers.size() != 1 && numbers.size() != 3))
    return {};
  return numbers.size() == 1 ? Vec3d{numbers[0], numbers[0], numbers[0]} : Vec3d{numbers[0], numbers[1], numbers[2]};
}

constexpr const char* needsVector = "takes one number, or one for each axis";

Made add(Numbers numbers, std::string_view axes) {
  const std::optional<Vec3d> vector = vectorOf(numbers, axes);
  return vector ? Made{{OperatorKind::affine, {1, 1, 1}, *vector}} : refused(needsVector);
}

/// Around the middle of the box.
Made stretch(Numbers numbers, std::string_view axes) {
  const std::optional<Vec3d> vector = vectorOf(numbers, axes);
  if (!vector)
    return refused(needsVector);
  return {{OperatorKind::affine, *vector, {(1 - vector->x) / 2, (1 - vector->y) / 2, (1 - vector->z) / 2}}};
}

Made gamma(Numbers numbers, std::string_view axes) {
  const std::optional<Vec3d> vector = vectorOf(numbers, axes);
  if (!vector)
    return refused(needsVector);
  if (std::min({vector->x, vector->y, vector->z}) <= 0)
    return refused("takes positive numbers");
  return {{OperatorKind::power, *vector, {}}};
}

/// Whether a text consists of different ones of the letters x, y and z.
bool areAxes(std::string_view axes) {
  return axes.find_first_not_of("xyz") == std::string_view::npos &&
         std::ranges::all_of(axes, [&](char axis) { return std::ranges::count(axes, axis) == 1; });
}

Made negate(Numbers numbers, std::string_view axes) {
  if (!numbers.empty() || !areAxes(axes))
    return refused("takes axes, such as xz, or nothing");
  Operator result{OperatorKind::affine, {1, 1, 1}, {}};
  for (int axis = 0; axis < 3; ++axis)
    if (axes.empty() || axes.find("xyz"[axis]) != std::string_view::npos) {
      result.a[axis] = -1;
      result.b[axis] = 1;
    }
  return {result};
}

Made swizzle(Numbers numbers, std::string_view axes) {
  if (!numbers.empty() || axes.size() != 3 || !areAxes(axes))
    return refused("takes the three axes in some order, such as yxz");
  Operator result{OperatorKind::permute, {}, {}};
  for (int axis = 0; axis < 3; ++axis)
    result.a[axis] = axes[static_cast<std::size_t>(axis)] - 'x';
  return {result};
}

Made solarize(Numbers numbers, std::string_view axes) {
  const std::optional<Vec3d> vector = vectorOf(numbers, axes);
  return vector ? Made{{OperatorKind::fold, *vector, {}}} : refused(needsVector);
}

Made threshold(Numbers numbers, std::string_view axes) {
  const bool isValid = axes.empty() && (numbers.size() == 1 || (numbers.size() == 2 && numbers[0] <= numbers[1]));
  if (!isValid)
    return refused("takes the largest coordinate, or the smallest and the largest");
  const double min = numbers.size() == 2 ? numbers[0] : lowestLimit, max = numbers.back();
  return {{OperatorKind::clamp, {min, min, min}, {max, max, max}}};
}

Made posterise(Numbers numbers, std::string_view axes) {
  const bool isValid = axes.empty() && numbers.size() == 1 && numbers[0] == std::floor(numbers[0]) && numbers[0] >= 2 &&
                       numbers[0] <= largestLevels;
  if (!isValid)
    return refused("takes a number of levels, 2 to 65536");
  const double steps = numbers[0] - 1;
  return {{OperatorKind::steps, {steps, steps, steps}, {}}};
}

Made blur(Numbers numbers, std::string_view axes) {
  const bool isValid = axes.empty() && numbers.size() == 1 && numbers[0] >= 0 && numbers[0] <= maxBlurRadius;
  return isValid ? Made{{OperatorKind::blur, {numbers[0], 0, 0}, {}}} : refused("takes a radius of 0 to 4 texels");
}

struct Maker {
  std::string_view name;
  Made (*make)(Numbers numbers, std::string_view axes);
};

constexpr Maker makers[] = {
    {"translate", add},     {"brightness", add},      {"scale", stretch},       {"contrast", stretch},
    {"gamma", gamma},       {"negate", negate},       {"negative", negate},     {"swizzle", swizzle},
    {"solarize", solarize}, {"threshold", threshold}, {"posterise", posterise}, {"posterize", posterise},
    {"blur", blur}};

std::string lowerCased(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return lower;
}

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// A text as sentences quote it: not longer than a line. The bytes 0x80 to 0xbf continue a character of UTF-8, at most
/// three of them; in a text that is no UTF-8 they may be all that there is.
std::string quoted(std::string_view text) {
  constexpr std::size_t maxCharacters = 60, maxCharacterBytes = 4;
  std::size_t characters = 0, begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool continues = at > 0 && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
    if (continues && at - begin < maxCharacterBytes)
      continue;
    begin = at;
    if (++characters > maxCharacters)
      return fmt::format("\"{}…\"", text.substr(0, at));
  }
  return fmt::format("\"{}\"", text);
}

/// A decimal number, with or without a sign and an exponent, that is not too large; nothing for another word.
std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-"))
    word.remove_prefix(1);
  if (word.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
    return {};
  double number = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (failure == std::errc::result_out_of_range && end == word.data() + word.size() &&
      (word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos))
    return 0; // smaller than any double
  if (failure != std::errc{} || end != word.data() + word.size() || !(std::abs(number) <= largestNumber))
    return {};
  return number;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(operatorSeparators), text.size()));
    if (text.empty())
      return words;
    words.push_back(text.substr(0, text.find_first_of(operatorSeparators)));
    text.remove_prefix(words.back().size());
  }
}

/// The next operator of a list, as "NAME(INSIDE)".
struct Call {
  std::string_view name, inside;
};

/// Takes the next operator from the front of `rest`; nothing where there is none.
std::optional<Call> takeCall(std::string_view& rest) {
  Call call;
  call.name = rest.substr(0, static_cast<std::size_t>(std::ranges::find_if_not(rest, isLetter) - rest.begin()));
  const std::size_t open = rest.find_first_not_of(spaces, call.name.size());
  if (call.name.empty() || open == std::string_view::npos || rest[open] != '(')
    return {};
  const std::size_t close = rest.find_first_of("()", open + 1);
  if (close == std::string_view::npos || rest[close] != ')')
    return {};
  call.inside = rest.substr(open + 1, close - open - 1);
  rest.remove_prefix(close + 1);
  rest.remove_prefix(std::min(rest.find_first_not_of(operatorSeparators), rest.size()));
  return call;
}

/// Whether no operator of a list maps points of the unit box farther than allowed.
bool stayInReach(std::span<const Operator> operators) {
  Box3d box{{0, 0, 0}, {1, 1, 1}};
  for (const Operator& op : operators) {
    box = operatedBox({&op, 1}, box);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(box.min[axis]) <= farthest && std::abs(box.max[axis]) <= farthest))
        return false;
  }
  return true;
}

} // namespace

OperatorList readOperators(std::string_view text, bool hasImages) {
  const auto refuse = [](std::string problem) { return OperatorList{{}, std::move(problem)}; };
  OperatorList list;
  std::string_view rest = text;
  rest.remove_prefix(std::min(rest.find_first_not_of(operatorSeparators), rest.size()));
  rest = rest.substr(0, rest.find_last_not_of(operatorSeparators) + 1);
  while (!rest.empty()) {
    const std::string_view before = rest;
    const std::optional<Call> call = takeCall(rest);
    if (!call)
      return refuse(quoted(before) + " is no operator with arguments in parentheses");
    const auto* maker = std::ranges::find(makers, lowerCased(call->name), &Maker::name);
    if (maker == std::end(makers)) {
      std::vector<std::string_view> names;
      for (const Maker& known : makers)
        names.push_back(known.name);
      return refuse(fmt::format("{} is none of {}", quoted(call->name), fmt::join(names, ", ")));
    }
    const std::vector<std::string_view> words = wordsOf(call->inside);
    const bool isAxes = words.size() == 1 && std::ranges::all_of(words[0], isLetter);
    std::vector<double> numbers;
    for (const std::string_view word : isAxes ? std::vector<std::string_view>{} : words) {
      const std::optional<double> number = numberOf(word);
      if (!number)
        return refuse(fmt::format("{} of {} has something that is no number from -1000000 to 1000000",
                                  quoted(call->inside), call->name));
      numbers.push_back(*number);
    }
    const auto [value, problem] = maker->make(numbers, isAxes ? lowerCased(words[0]) : std::string());
    if (problem)
      return refuse(fmt::format("{} {}", call->name, problem));
    if (list.operators.size() >= maxOperators)
      return refuse(fmt::format("it has more than {} operators", maxOperators));
    if (value.kind == OperatorKind::blur && !list.operators.empty())
      return refuse("blur is not the first operator");
    list.operators.push_back(value);
  }
  if (!stayInReach(list.operators))
    return refuse("it maps points farther than 1e9 edges of their box");
  if (!hasImages && blurRadiusOf(list.operators) > 0)
    return refuse("blur filters images of coordinates, and this geometry has none");
  return list;
}

std::string refusalOf(std::string_view text, const std::string& problem) {
  return fmt::format("operators={}: {}", quoted(text), problem);
}

} // namespace imgeo
