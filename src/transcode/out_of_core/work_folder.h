#pragma once
// The folder of a conversion that memory does not hold: intermediate files, each of which is there whole or not at all,
// so that a run that was ended in any moment can be resumed.

#include "base/file.h"

#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace imgeo {

/// Appends values to the content of a work file. Work files are read by the machine type that wrote them.
class WorkWriter {
public:
  template <typename T> void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof(T));
  }
  template <typename T> void addAll(std::span<const T> values) {
    add(std::uint64_t{values.size()});
    const auto* from = reinterpret_cast<const std::uint8_t*>(values.data());
    bytes.insert(bytes.end(), from, from + values.size_bytes());
  }
  void addText(std::string_view text) { addAll(asBytes(text)); }
  void addTexts(std::span<const std::string> texts) {
    add(std::uint64_t{texts.size()});
    for (const std::string& text : texts)
      addText(text);
  }

  Bytes bytes;
};

/// Reads what WorkWriter wrote. Throws Error{malformed} where the file is shorter.
class WorkReader {
public:
  WorkReader(ByteSpan bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  template <typename T> T take() {
    T value;
    std::memcpy(&value, takeBytes(sizeof(T)).data(), sizeof(T));
    return value;
  }
  template <typename T> std::vector<T> takeAll() {
    const auto count = take<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T))
      failShort();
    std::vector<T> values(count);
    if (count > 0)
      std::memcpy(values.data(), takeBytes(count * sizeof(T)).data(), count * sizeof(T));
    return values;
  }
  std::string takeText() {
    const std::vector<std::uint8_t> text = takeAll<std::uint8_t>();
    return {text.begin(), text.end()};
  }
  std::vector<std::string> takeTexts() {
    std::vector<std::string> texts;
    for (auto count = take<std::uint64_t>(); count > 0; --count)
      texts.push_back(takeText());
    return texts;
  }
  ByteSpan takeBytes(std::size_t count) {
    if (count > bytes_.size())
      failShort();
    const ByteSpan taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  ByteSpan rest() const { return bytes_; }

private:
  [[noreturn]] void failShort() const;

  ByteSpan bytes_;
  std::string path_;
};

class WorkFolder {
public:
  /// Makes the folder, or with `resume` opens the one of an earlier run. `job` says what is converted and how: a folder
  /// of another job is refused. Without `resume`, an earlier run's folder is emptied first.
  /// Throws Error{usage} if there is nothing to resume, the job is another one, another run uses the folder or it is no
  /// work folder; Error{io} if it cannot be written.
  WorkFolder(std::filesystem::path folder, const std::string& job, bool resume);
  /// Opens the folder that rank 0 has made or opened. Throws Error{usage} if its job is another one.
  static WorkFolder ofOtherRank(std::filesystem::path folder, const std::string& job, std::uint32_t rank);
  WorkFolder(WorkFolder&& other) noexcept;
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// Makes a folder within the work folder, in which the files are from then on. Throws Error{io}.
  void enter(const std::string& subfolder);
  const std::string& subfolder() const { return subfolder_; }
  /// Removes that folder with its files, which are in the work folder from then on.
  void removeSubfolder();
  std::filesystem::path file(const std::string& name) const { return folder_ / subfolder_ / name; }
  bool has(const std::string& name) const;
  /// Writes a file under another name and renames it.
  void write(const std::string& name, ByteSpan bytes) const;
  /// Calls `guard` before each renaming. What it throws keeps the file from being there.
  void guardWrites(std::function<void()> guard) { guard_ = std::move(guard); }
  /// Throws Error{io} where the disk has less room than so many bytes.
  void requireDisk(std::uint64_t bytes) const;
  void remove(const std::string& name) const;
  /// Removes the folder with everything in it.
  void removeAll();

private:
  WorkFolder(std::filesystem::path folder, std::uint32_t rank);
  void requireJob(const std::string& job) const;

  std::filesystem::path folder_;
  std::string subfolder_;
  std::string partSuffix_ = ".part"; ///< another one for each rank
  std::function<void()> guard_;
  int lock_ = -1;
};

/// The file of a work folder that says what it is of.
inline constexpr const char* workJobName = "job.txt";

/// The files by which ranks work together: a folder in the work folder, which is empty when rank 0 begins.
inline constexpr const char* rankFolder = "ranks";

bool isWorkFolder(const std::filesystem::path& folder);

/// Keeps two processes from being the same rank.
class RankLock {
public:
  /// Throws Error{usage} if another process holds the lock.
  RankLock(const std::filesystem::path& workFolder, std::uint32_t rank);
  ~RankLock();
  RankLock(const RankLock&) = delete;
  RankLock& operator=(const RankLock&) = delete;

private:
  int lock_ = -1;
};

} // namespace imgeo
