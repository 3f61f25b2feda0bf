#pragma once
// Files and directories that this process is writing: a signal that ends the process removes them first.

#include <filesystem>
#include <mutex>

namespace imgeo {

/// What a signal removes of a registered path.
enum class Removal { withContent, ifEmpty };

/// Registers a file or a directory as unfinished during the object's lifetime. The destructor does not remove it.
class UnfinishedFile {
public:
  explicit UnfinishedFile(std::filesystem::path path, Removal removal = Removal::withContent);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

private:
  std::filesystem::path path_;
  Removal removal_;
};

/// Removes every registered file and directory, although other threads may still be writing there. Other threads that
/// register, finish or publish files then wait forever: call it only when the process ends at once.
void removeUnfinishedFiles();

/// Held while files are put in their final location: removeUnfinishedFiles() waits for it.
[[nodiscard]] std::unique_lock<std::mutex> holdUnfinishedFiles();

} // namespace imgeo
