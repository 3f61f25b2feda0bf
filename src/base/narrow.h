#pragma once
// Integer conversions that must not lose anything.

#include <cassert>
#include <type_traits>

namespace imgeo {

/// Converts between integer types; asserts that the value survives. For values
/// that the program has already bounded; bytes from outside are checked and
/// refused with an Error before they come here.
template <typename To, typename From> constexpr To narrow(From value) {
  static_assert(std::is_integral_v<To> && std::is_integral_v<From>);
  const To result = static_cast<To>(value);
  assert(static_cast<From>(result) == value && (result < To{}) == (value < From{}));
  return result;
}

} // namespace imgeo
