#pragma once
// The differences that verify reports.

#include "imgeo/verify.h"

#include <fmt/format.h>
#include <utility>

namespace imgeo {

/// Adds sentences to the report's findings.
class Findings {
public:
  explicit Findings(VerifyReport& report) : report_(report) {}
  template <typename... Arguments> void add(fmt::format_string<Arguments...> sentence, Arguments&&... arguments) {
    report_.findings.push_back(fmt::format(sentence, std::forward<Arguments>(arguments)...));
  }

private:
  VerifyReport& report_;
};

} // namespace imgeo
