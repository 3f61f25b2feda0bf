#pragma once
// Files that have several URLs, of which the first that can be read counts (X3D's MFString fields of URLs).

#include "imgeo/error.h"

#include <cassert>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// The Error of several, at least one: its message has those of all. Kind and location are those of the first.
Error joined(std::span<const Error> errors);

/// read(url) of the first URL, of at least one, for which it throws no Error. Throws the joined Errors of all.
template <typename Read> auto firstReadable(const std::vector<std::string>& urls, const Read& read) {
  assert(!urls.empty());
  std::vector<Error> errors;
  for (const std::string& url : urls)
    try {
      return read(url);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  throw joined(errors);
}

} // namespace imgeo
