#include "transcode/site/site_files.h"
#include "transcode/site/staged_site.h"

#include "base/error.h"
#include "base/file.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using testing::contentsOf;
using testing::namesIn;
using testing::TemporaryDirectory;

std::string geometryName(const std::string& version, const std::string& part) {
  return contentName(asBytes(version + part)) + ".png";
}

std::string runtimeName(const std::string& version) {
  return "imgeo-" + contentName(asBytes(version)) + ".js";
}

std::string inlinedName(const std::string& version) {
  return contentName(asBytes(version)) + ".x3d";
}

std::vector<std::string> geometryNames(const std::string& version) {
  std::vector<std::string> names{geometryName(version, "a"), geometryName(version, "b")};
  std::ranges::sort(names);
  return names;
}

/// A site of one version: its containers and its document say which.
void fill(const fs::path& site, const std::string& version) {
  fs::create_directories(site / geometryFolder);
  fs::create_directories(site / runtimeFolder);
  for (const std::string part : {"a", "b"})
    writeFile(site / geometryFolder / geometryName(version, part), asBytes(version));
  writeFile(site / runtimeFolder / runtimeName(version), asBytes(version));
  writeFile(site / inlinedName(version), asBytes(version));
  writeFile(site / stylesheetName, asBytes("style"));
  writeFile(site / sceneName, asBytes(version));
  writeFile(site / manifestName, asBytes("{}"));
  writeFile(site / pageName, asBytes(version));
}

void publish(const fs::path& target, const std::string& version, bool force = false,
             const Rename& rename = renameBySystem) {
  StagedSite site(target, force);
  fill(site.path(), version);
  site.publish(rename);
}

/// The page's version, if everything that this version needs is there.
std::string wholeVersionAt(const fs::path& site) {
  const std::string version(asText(readFile(site / pageName)));
  for (const std::string part : {"a", "b"})
    if (!fs::exists(site / geometryFolder / geometryName(version, part)))
      return version + " without its containers";
  return fs::exists(site / runtimeFolder / runtimeName(version)) ? version : version + " without runtime";
}

int withoutExchange(const fs::path& from, const fs::path& to, unsigned flags) {
  return flags != 0 ? ENOSYS : renameBySystem(from, to, 0);
}

ErrorKind kindOfRefusal(const fs::path& target, bool force = false) {
  try {
    const StagedSite site(target, force);
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << target << " was not refused";
  return ErrorKind::limit;
}

TEST(StagedSite, IsPublishedAsANewDirectoryAndReplacesAnOldSite) {
  const TemporaryDirectory directory;
  const fs::path target = directory / "site";
  publish(target, "old");
  EXPECT_EQ(wholeVersionAt(target), "old");
  publish(target, "new");
  EXPECT_EQ(wholeVersionAt(target), "new");
  EXPECT_EQ(namesIn(target / geometryFolder), geometryNames("new"));
  EXPECT_EQ(namesIn(directory.path()), std::vector<std::string>{"site"});
}

TEST(StagedSite, IsPublishedWithoutRenameat2) {
  const TemporaryDirectory directory;
  const fs::path target = directory / "site", other = directory / "other";
  for (const std::string version : {"old", "new"}) {
    publish(target, version);
    publish(other, version, false, withoutExchange);
    EXPECT_EQ(contentsOf(target), contentsOf(other)) << version;
  }
  EXPECT_EQ(namesIn(directory.path()), (std::vector<std::string>{"other", "site"}));
}

TEST(StagedSite, IsOldOrNewWhereverTheFallbackIsKilled) {
  for (int renamesBeforeKill = 0; renamesBeforeKill < 9; ++renamesBeforeKill) {
    const TemporaryDirectory directory;
    const fs::path target = directory / "site";
    publish(target, "old");
    const pid_t child = fork();
    if (child == 0) {
      int renamesLeft = renamesBeforeKill;
      publish(target, "new", false, [&](const fs::path& from, const fs::path& to, unsigned flags) {
        if (flags != 0)
          return ENOSYS;
        if (renamesLeft-- == 0)
          _exit(9); // as abrupt as a kill: nothing is unwound
        return renameBySystem(from, to, 0);
      });
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(wholeVersionAt(target), WEXITSTATUS(status) == 0 ? "new" : "old");
    EXPECT_EQ(WEXITSTATUS(status), renamesBeforeKill < 8 ? 9 : 0) << "eight files are renamed";

    publish(target, "last");
    EXPECT_EQ(wholeVersionAt(target), "last");
    EXPECT_EQ(namesIn(directory.path()), std::vector<std::string>{"site"}) << "what the killed run left is gone";
  }
}

TEST(StagedSite, IsRemovedUnlessItIsPublished) {
  const TemporaryDirectory directory;
  {
    StagedSite site(directory / "made/for/it/site", false);
    fill(site.path(), "never");
  }
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(StagedSite, ReplacesAnEmptyDirectoryAndKeepsItsPermissions) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "site");
  fs::permissions(directory / "site", fs::perms(0711));
  publish(directory / "site", "new");
  EXPECT_EQ(wholeVersionAt(directory / "site"), "new");
  EXPECT_EQ(fs::status(directory / "site").permissions(), fs::perms(0711));
}

TEST(StagedSite, DoesNotReplaceADirectoryThatIsNotASite) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "photos");
  writeFile(directory / "photos/cat.jpg", asBytes("cat"));
  writeFile(directory / "file", asBytes("file"));
  EXPECT_EQ(kindOfRefusal(directory / "photos"), ErrorKind::usage);
  EXPECT_EQ(kindOfRefusal(directory / "file", true), ErrorKind::io);
  EXPECT_EQ(kindOfRefusal(directory / "file/site", true), ErrorKind::io);
  EXPECT_EQ(kindOfRefusal("/proc/site"), ErrorKind::io);
  EXPECT_EQ(namesIn(directory.path()), (std::vector<std::string>{"file", "photos"}));

  publish(directory / "photos", "new", true);
  EXPECT_EQ(wholeVersionAt(directory / "photos"), "new");
  EXPECT_FALSE(fs::exists(directory / "photos/cat.jpg"));
}

TEST(StagedSite, DoesNotReplaceASiteWithAFileOfSomebodyElse) {
  for (const std::string name : {"CNAME", "geometry/notes.txt", "photos/cat.jpg"}) {
    const TemporaryDirectory directory;
    const fs::path target = directory / "site", file = target / name;
    publish(target, "old");
    fs::create_directories(file.parent_path());
    writeFile(file, asBytes("mine"));
    try {
      const StagedSite site(target, false);
      ADD_FAILURE() << name << " was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_EQ(error.location(), file.string());
    }
    EXPECT_EQ(wholeVersionAt(target), "old");
    EXPECT_TRUE(fs::exists(file));
    publish(target, "new", true);
    EXPECT_EQ(wholeVersionAt(target), "new");
    EXPECT_FALSE(fs::exists(file));
  }
}

TEST(StagedSite, RemovesEveryFileOfTheOldSiteWithoutRenameat2) {
  const TemporaryDirectory directory;
  const fs::path target = directory / "site";
  publish(target, "old", false, withoutExchange);
  publish(target, "new", false, withoutExchange);
  EXPECT_FALSE(fs::exists(target / inlinedName("old")));
  EXPECT_TRUE(fs::exists(target / inlinedName("new")));
}

TEST(StagedSite, FollowsASymbolicLink) {
  const TemporaryDirectory directory;
  publish(directory / "releases/one", "old");
  fs::create_directory_symlink(directory / "releases/one", directory / "current");
  publish(directory / "current", "new");
  EXPECT_TRUE(fs::is_symlink(directory / "current"));
  EXPECT_EQ(wholeVersionAt(directory / "releases/one"), "new");
}

TEST(StagedSite, IsPublishedFileByFileIfTheTargetIsTheWorkingDirectory) {
  const TemporaryDirectory directory;
  publish(directory / "site", "old");
  const fs::path before = fs::current_path();
  fs::current_path(directory / "site");
  publish(".", "new");
  EXPECT_EQ(wholeVersionAt("."), "new") << "seen through the directory that was entered before";
  EXPECT_EQ(wholeVersionAt(directory / "site"), "new");
  EXPECT_EQ(namesIn("./geometry"), geometryNames("new"));
  for (const std::string& name : namesIn("."))
    EXPECT_FALSE(name.starts_with(".")) << name;
  fs::current_path(before);
}

TEST(StagedSite, RemovesWhatKilledRunsLeftAndNothingElse) {
  const TemporaryDirectory directory;
  fs::create_directories(directory / ".site.imgeo-killed/geometry");
  fs::create_directories(directory / ".site.imgeo-living");
  fs::create_directories(directory / ".other.imgeo-killed");
  fs::create_directories(directory / ".site.imgeo-notours");
  const int living = open((directory / ".site.imgeo-living").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(living, LOCK_EX), 0);
  publish(directory / "site", "new");
  EXPECT_EQ(namesIn(directory.path()),
            (std::vector<std::string>{".other.imgeo-killed", ".site.imgeo-living", ".site.imgeo-notours", "site"}));
  close(living);
}

TEST(StagedSite, LastOfTwoRunsWins) {
  const TemporaryDirectory directory;
  StagedSite first(directory / "site", false), second(directory / "site", false);
  fill(first.path(), "first");
  fill(second.path(), "second");
  first.publish();
  second.publish();
  EXPECT_EQ(wholeVersionAt(directory / "site"), "second");
}

TEST(StagedSite, DoesNotReplaceADirectoryThatHasBeenFilledMeanwhile) {
  const TemporaryDirectory directory;
  StagedSite site(directory / "site", false);
  fill(site.path(), "new");
  fs::create_directory(directory / "site");
  writeFile(directory / "site/cat.jpg", asBytes("cat"));
  EXPECT_THROW(site.publish(), Error);
  EXPECT_EQ(namesIn(directory / "site"), std::vector<std::string>{"cat.jpg"});
}

} // namespace
} // namespace imgeo
