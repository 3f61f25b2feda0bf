#pragma once
// What happens where content of an X3D document cannot be read, or is left out: warnings, or an Error if strict.

#include "base/error.h"
#include "import/references.h"
#include "import/x3d/source.h"
#include "import/x3d/summary.h"

#include <fmt/format.h>
#include <string>
#include <vector>

namespace imgeo::x3d {

class Faults {
public:
  /// Everything must outlive this.
  Faults(const Source& source, bool isStrict, std::vector<std::string>& warnings, Summary& summary)
      : source_(source), isStrict_(isStrict), warnings_(warnings), summary_(summary) {}

  bool isStrict() const { return isStrict_; }

  /// Calls `read` and turns its Error into a warning that begins with `consequence`. If strict, and for
  /// Error{limit}, rethrows it.
  template <typename Read> auto attempt(const char* consequence, const Read& read) -> decltype(read()) {
    try {
      return read();
    } catch (const Error& error) {
      if (isStrict_ || error.kind() == ErrorKind::limit)
        throw faultOfSource(error);
      warnings_.push_back(fmt::format("{}: {}.", consequence, error.what()));
      return {};
    }
  }

  /// Notes an element that is left out with its children (isLeftOut). If strict, throws Error{unsupported}.
  void leaveOut(pugi::xml_node element) {
    if (isStrict_)
      source_.fail(element, ErrorKind::unsupported,
                   fmt::format("left out, since {}", reasonToLeaveOut(element.name())));
    summary_.noteLeftOut(element.name(), source_.locationOf(element));
  }

private:
  const Source& source_;
  bool isStrict_;
  std::vector<std::string>& warnings_;
  Summary& summary_;
};

} // namespace imgeo::x3d
