#include "base/unfinished_files.h"

#include <ranges>
#include <set>
#include <utility>

namespace imgeo {

namespace {

std::mutex& registryMutex() {
  // Never destroyed: a signal may arrive while static objects are being destroyed.
  static auto* const mutex = new std::mutex;
  return *mutex;
}

using Entry = std::pair<std::filesystem::path, Removal>;

std::multiset<Entry>& registry() {
  static auto* const entries = new std::multiset<Entry>;
  return *entries;
}

} // namespace

UnfinishedFile::UnfinishedFile(std::filesystem::path path, Removal removal)
    : path_(std::move(path)), removal_(removal) {
  const std::lock_guard lock(registryMutex());
  registry().emplace(path_, removal_);
}

UnfinishedFile::~UnfinishedFile() {
  const std::lock_guard lock(registryMutex());
  registry().erase(registry().find({path_, removal_}));
}

void removeUnfinishedFiles() {
  registryMutex().lock(); // and never unlocked
  constexpr int maxAttempts = 1000;
  // In descending order the content of a directory comes before the directory.
  for (const auto& [path, removal] : std::ranges::reverse_view(registry())) {
    std::error_code failure;
    if (removal == Removal::ifEmpty) {
      std::filesystem::remove(path, failure);
      continue;
    }
    for (int attempt = 0; attempt < maxAttempts; ++attempt) {
      std::filesystem::remove_all(path, failure);
      if (!failure) // it fails while another thread adds files to the directory
        break;
    }
  }
}

std::unique_lock<std::mutex> holdUnfinishedFiles() {
  return std::unique_lock(registryMutex());
}

} // namespace imgeo
