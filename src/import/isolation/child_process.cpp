#include "import/isolation/child_process.h"

#include "base/error.h"
#include "import/isolation/serialize.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <new>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace imgeo {

namespace {

/// The first byte of the child's answer.
enum class Outcome : std::uint8_t { read, refused, outOfMemory, failed };

std::uint64_t addressSpaceInUse() {
  std::ifstream pages("/proc/self/statm");
  std::uint64_t count = 0;
  pages >> count;
  return count * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Sanitizers reserve more address space than any useful limit.
constexpr bool isSanitized() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return true;
#elif defined(__has_feature)
  return __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
  return false;
#endif
}

void applyLimits(const ChildProcessLimits& limits) {
  // At the first limit the process gets SIGXCPU. The second is beyond it, so that SIGKILL has other causes.
  const rlimit noCore{0, 0}, seconds{limits.seconds, limits.seconds + 10};
  setrlimit(RLIMIT_CORE, &noCore);
  setrlimit(RLIMIT_CPU, &seconds);
  const rlim_t maxBytes = addressSpaceInUse() + limits.memoryBytes;
  const rlimit memory{maxBytes, maxBytes};
  if (!isSanitized())
    setrlimit(RLIMIT_AS, &memory);
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGINT, SIGTERM, SIGXCPU})
    std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr); // the parent process may block signals
  prctl(PR_SET_PDEATHSIG, SIGKILL);         // an interrupted parent process does not wait for its child
}

bool writeAll(int descriptor, ByteSpan bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0)
      return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

Bytes readAll(int descriptor) {
  Bytes bytes;
  Bytes buffer(1 << 16);
  for (;;) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0)
      return bytes;
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + count);
  }
}

void append(Bytes& to, const std::string& text) {
  appendLittle(to, std::uint64_t{text.size()});
  to.insert(to.end(), text.begin(), text.end());
}

/// What the child sends: an Outcome, then the serialized result or the Error.
Bytes answerOf(const std::function<Imported()>& read) {
  Bytes answer;
  try {
    const Bytes imported = serialized(read());
    answer.push_back(static_cast<std::uint8_t>(Outcome::read));
    answer.insert(answer.end(), imported.begin(), imported.end());
  } catch (const Error& error) {
    answer = {static_cast<std::uint8_t>(Outcome::refused), static_cast<std::uint8_t>(error.kind())};
    append(answer, error.location());
    append(answer, error.message());
  } catch (const std::bad_alloc&) {
    answer = {static_cast<std::uint8_t>(Outcome::outOfMemory)};
  } catch (const std::exception&) {
    answer = {static_cast<std::uint8_t>(Outcome::failed)};
  }
  return answer;
}

[[noreturn]] void rethrow(ByteSpan answer) {
  const auto text = [&] {
    const auto size = loadLittle<std::uint64_t>(answer.data());
    std::string taken(asText(answer.subspan(8, size)));
    answer = answer.subspan(8 + size);
    return taken;
  };
  const auto kind = static_cast<ErrorKind>(answer[1]);
  answer = answer.subspan(2);
  const std::string location = text(), message = text();
  throw Error(kind, location, message);
}

} // namespace

Imported readInChildProcess(const std::function<Imported()>& read, const std::string& location,
                            const ChildProcessLimits& limits) {
  int ends[2];
  if (pipe(ends) != 0)
    throw Error(ErrorKind::io, location, fmt::format("no pipe to another process: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]), close(ends[1]);
    throw Error(ErrorKind::io, location, fmt::format("no other process to read it: {}", std::strerror(errno)));
  }
  if (child == 0) {
    close(ends[0]);
    applyLimits(limits);
    const Bytes answer = answerOf(read);
    _exit(writeAll(ends[1], answer) ? 0 : 1); // runs no destructors and flushes no buffers of the parent
  }
  close(ends[1]);
  const Bytes answer = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    throw Error(ErrorKind::limit, location, "the system ended the process that reads it, perhaps for lack of memory");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    throw Error(ErrorKind::limit, location, fmt::format("reading it took more than {} seconds", limits.seconds));
  if (WIFSIGNALED(status) || answer.empty())
    throw Error(ErrorKind::malformed, location, "the library that reads its format crashed or failed");
  switch (static_cast<Outcome>(answer[0])) {
  case Outcome::read:
    return deserialized(ByteSpan(answer).subspan(1));
  case Outcome::refused:
    rethrow(answer);
  case Outcome::outOfMemory:
    throw Error(ErrorKind::limit, location, "reading it takes more memory than the limit");
  case Outcome::failed:
    break;
  }
  throw Error(ErrorKind::malformed, location, "the library that reads its format crashed or failed");
}

} // namespace imgeo
