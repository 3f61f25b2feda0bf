#include "cli/input_files.h"

#include "base/error.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fnmatch.h>
#include <optional>

namespace imgeo::cli {

namespace {

namespace fs = std::filesystem;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// "frame-%04d.ply" as the pattern "frame-*.ply"; the word itself where it has no such number.
std::string withoutPrintf(const std::string& word) {
  const std::size_t percent = word.find('%');
  if (percent == word.npos)
    return word;
  std::size_t end = percent + 1;
  while (end < word.size() && isDigit(word[end]))
    ++end;
  return end < word.size() && word[end] == 'd' ? word.substr(0, percent) + "*" + word.substr(end + 1) : word;
}

void addMatching(const std::string& word, std::vector<fs::path>& files) {
  std::error_code ignored;
  const fs::path path = word;
  const fs::path pattern = withoutPrintf(word);
  if (word == "-" || fs::exists(path, ignored) ||
      pattern.filename().string().find_first_of("*?") == std::string::npos) {
    files.push_back(path);
    return;
  }
  const std::size_t before = files.size();
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (fnmatch(pattern.filename().c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0)
      files.push_back(pattern.has_parent_path() ? entry.path() : entry.path().filename());
  if (files.size() == before)
    throw Error(ErrorKind::usage, word, "names no file");
}

/// The last number in a file's name, and what stands around it.
struct NumberedName {
  std::string around;
  std::uint64_t number = 0;
};

std::optional<NumberedName> numberedName(const fs::path& file) {
  const std::string text = file.string();
  const std::size_t name = text.size() - file.filename().string().size();
  std::size_t end = text.size();
  while (end > name && !isDigit(text[end - 1]))
    --end;
  std::size_t begin = end;
  while (begin > name && isDigit(text[begin - 1]))
    --begin;
  NumberedName numbered{text.substr(0, begin) + "#" + text.substr(end)};
  const auto [last, fault] = std::from_chars(text.data() + begin, text.data() + end, numbered.number);
  if (begin == end || fault != std::errc{} || last != text.data() + end)
    return {};
  return numbered;
}

/// Frames that are numbered, all by the same step but for a gap, lack one.
void requireNoGap(const std::vector<fs::path>& files) {
  std::vector<NumberedName> names;
  for (const fs::path& file : files)
    if (const std::optional<NumberedName> name = numberedName(file);
        name && (names.empty() || names.front().around == name->around))
      names.push_back(*name);
  if (names.size() != files.size() || files.size() < 3)
    return;
  std::uint64_t step = UINT64_MAX;
  for (std::size_t i = 1; i < names.size(); ++i)
    step = std::min(step, names[i].number - names[i - 1].number);
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i].number - names[i - 1].number > step)
      throw Error(ErrorKind::io, files[i - 1].string(),
                  fmt::format("the frame after this one is missing: {} comes next", files[i].string()));
}

} // namespace

bool isBeforeInNaturalOrder(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j])
        return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto numberAt = [](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0')
        ++at;
      const std::size_t begin = at;
      while (at < text.size() && isDigit(text[at]))
        ++at;
      return std::string_view(text).substr(begin, at - begin);
    };
    const std::string_view left = numberAt(a, i), right = numberAt(b, j);
    if (left.size() != right.size())
      return left.size() < right.size();
    if (left != right)
      return left < right;
  }
  return a.size() - i < b.size() - j || (a.size() - i == b.size() - j && a < b);
}

std::vector<fs::path> inputFiles(const std::vector<std::string>& words) {
  std::vector<fs::path> files;
  for (const std::string& word : words)
    addMatching(word, files);
  if (files.size() < 2)
    return files;
  std::ranges::sort(
      files, [](const fs::path& a, const fs::path& b) { return isBeforeInNaturalOrder(a.string(), b.string()); });
  for (std::size_t i = 1; i < files.size(); ++i)
    if (files[i] == files[i - 1])
      throw Error(ErrorKind::usage, files[i].string(), "is named twice");
  requireNoGap(files);
  return files;
}

} // namespace imgeo::cli
