#pragma once
// The differences that verify reports.

#include "imgeo/verify.h"

#include <fmt/format.h>
#include <string>
#include <utility>

namespace imgeo {

/// Adds sentences to the report's findings.
class Findings {
public:
  explicit Findings(VerifyReport& report) : report_(report) {}
  template <typename... Arguments> void add(fmt::format_string<Arguments...> sentence, Arguments&&... arguments) {
    report_.findings.push_back(subject_ + fmt::format(sentence, std::forward<Arguments>(arguments)...));
  }
  /// What the sentences are about that follow: they begin with it. Empty: with nothing.
  void setSubject(const std::string& subject) { subject_ = subject.empty() ? "" : subject + ": "; }

private:
  VerifyReport& report_;
  std::string subject_;
};

} // namespace imgeo
