#pragma once
// Checked integer conversion.

#include <cassert>
#include <type_traits>

namespace imgeo {

/// Converts between integer types and asserts that the value is unchanged. The caller has bounded the value: readers
/// check values of untrusted bytes and throw an Error first.
template <typename To, typename From> constexpr To narrow(From value) {
  static_assert(std::is_integral_v<To> && std::is_integral_v<From>);
  const To result = static_cast<To>(value);
  assert(static_cast<From>(result) == value && (result < To{}) == (value < From{}));
  return result;
}

} // namespace imgeo
