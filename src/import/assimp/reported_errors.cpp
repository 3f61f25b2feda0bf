#include "import/assimp/reported_errors.h"

#include "import/assimp/library.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace imgeo {

ReportedErrors::ReportedErrors() : stream_{&ReportedErrors::add, reinterpret_cast<char*>(this)} {
  assimp().attachLogStream(&stream_);
}

ReportedErrors::~ReportedErrors() {
  assimp().detachLogStream(&stream_);
}

/// Called for each line of the log: "Error, T0: OFF: Vertex index is out of range\n".
void ReportedErrors::add(const char* line, char* self) {
  std::string_view text = line;
  if (!text.starts_with("Error"))
    return;
  if (const std::size_t colon = text.find(": "); colon != text.npos)
    text.remove_prefix(colon + 2);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ' || text.back() == '.'))
    text.remove_suffix(1);
  auto& errors = *reinterpret_cast<ReportedErrors*>(self);
  const auto found = std::ranges::find(errors.entries_, text, &Entry::message);
  if (found != errors.entries_.end())
    ++found->count;
  else if (errors.entries_.size() < maxErrors)
    errors.entries_.push_back({std::string(text), 1});
  else
    ++errors.otherCount_;
}

void ReportedErrors::clear() {
  entries_.clear();
  otherCount_ = 0;
}

std::vector<std::string> ReportedErrors::sentences() const {
  std::vector<std::string> sentences;
  for (const auto& [message, count] : entries_)
    sentences.push_back(count == 1
                            ? fmt::format("Assimp, which reads the format, reports: {}.", message)
                            : fmt::format("Assimp, which reads the format, reports {} times: {}.", count, message));
  if (otherCount_ > 0)
    sentences.push_back(fmt::format("Assimp reports {} more errors.", otherCount_));
  return sentences;
}

} // namespace imgeo
