#pragma once
// The errors that Assimp logs while it reads on: it has repaired or left out what they name.

#include <assimp/cimport.h>
#include <cstddef>
#include <string>
#include <vector>

namespace imgeo {

/// Collects the logged errors during its lifetime. At most one object exists at a time.
class ReportedErrors {
public:
  ReportedErrors();
  ~ReportedErrors();
  ReportedErrors(const ReportedErrors&) = delete;
  ReportedErrors& operator=(const ReportedErrors&) = delete;

  /// One sentence for each different error with the number of its occurrences, in the order of the first ones; at most
  /// maxErrors, and one more sentence that counts the rest.
  std::vector<std::string> sentences() const;

  void clear();

  static constexpr std::size_t maxErrors = 10;

private:
  struct Entry {
    std::string message;
    std::size_t count = 0;
  };

  static void add(const char* line, char* self);

  aiLogStream stream_;
  std::vector<Entry> entries_;
  std::size_t otherCount_ = 0;
};

} // namespace imgeo
