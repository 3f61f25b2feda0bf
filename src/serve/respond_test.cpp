#include "serve/respond.h"

#include "base/file.h"
#include "base/testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace imgeo {
namespace {

class Respond : public ::testing::Test {
protected:
  Respond() {
    std::filesystem::create_directories(root() / "sub");
    put("index.html", page);
    put("plane.bin", "0123456789");
    put("coord0-0123456789abcdef.png", "not really a picture");
    put("sub/index.html", "<p>sub</p>");
  }

  std::filesystem::path root() const { return directory_.path() / "site"; }
  void put(const std::string& name, std::string_view text) const { writeFile(root() / name, asBytes(text)); }

  Response get(std::string_view target, RequestHead head = {}) {
    if (head.method.empty())
      head.method = "GET";
    head.target = target;
    return respond({root(), codings_}, head);
  }

  static std::string bodyOf(const Response& response) {
    if (response.content)
      return std::string(asText(*response.content));
    if (!response.file)
      return {};
    Bytes bytes(response.fileCount);
    EXPECT_EQ(response.file->readAt(response.fileFirst, bytes), bytes.size());
    return std::string(asText(bytes));
  }

  testing::TemporaryDirectory directory_;
  CodingCache codings_{1 << 20};
  const std::string page = "<!doctype html>" + std::string(2000, 'x');
};

TEST_F(Respond, AFileComesWithItsTypeLengthTagAndPolicy) {
  const Response response = get("/plane.bin");
  EXPECT_EQ(response.status, 200u);
  EXPECT_EQ(bodyOf(response), "0123456789");
  EXPECT_EQ(response.field("Content-Type"), "application/octet-stream");
  EXPECT_EQ(response.field("Content-Length"), "10");
  EXPECT_EQ(response.field("Accept-Ranges"), "bytes");
  EXPECT_EQ(response.field("Content-Security-Policy"), "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'");
  EXPECT_EQ(response.field("X-Content-Type-Options"), "nosniff");
  EXPECT_TRUE(response.field("ETag").starts_with('"'));
}

TEST_F(Respond, ADirectoryAnswersWithItsIndex) {
  EXPECT_EQ(bodyOf(get("/")), page);
  EXPECT_EQ(bodyOf(get("/sub/")), "<p>sub</p>");
  EXPECT_EQ(get("/sub/").field("Content-Type"), "text/html; charset=utf-8");
}

TEST_F(Respond, ADirectoryWithoutItsSlashIsRedirectedWithinTheSite) {
  for (const char* target : {"/sub", "//sub", "/./sub?query"}) {
    const Response response = get(target);
    EXPECT_EQ(response.status, 301u) << target;
    EXPECT_EQ(response.field("Location"), "/sub/") << target;
  }
}

TEST_F(Respond, AMissingFileIsNotFound) {
  std::filesystem::create_directory(root() / "empty");
  for (const char* target : {"/missing", "/empty/", "/plane.bin/", "/plane.bin/x", "/index.html/"})
    EXPECT_EQ(get(target).status, 404u) << target;
}

TEST_F(Respond, AMissingIconIsNoError) {
  EXPECT_EQ(get("/favicon.ico").status, 204u);
  EXPECT_EQ(get("/sub/favicon.ico").status, 404u);
  writeFile(root() / "favicon.ico", asBytes("icon"));
  EXPECT_EQ(bodyOf(get("/favicon.ico")), "icon");
}

TEST_F(Respond, NothingOutsideTheSiteIsServed) {
  writeFile(directory_.path() / "secret", asBytes("secret"));
  std::filesystem::create_symlink(directory_.path() / "secret", root() / "link");
  std::filesystem::create_directory_symlink(directory_.path(), root() / "up");
  std::filesystem::create_directory(directory_.path() / "site2"); // shares the beginning of the name
  std::filesystem::create_directory_symlink(directory_.path() / "site2", root() / "beside");
  writeFile(directory_.path() / "site2/file", asBytes("secret"));
  EXPECT_EQ(get("/link").status, 404u);
  EXPECT_EQ(get("/up/secret").status, 404u);
  EXPECT_EQ(get("/up").status, 404u);
  EXPECT_EQ(get("/beside/file").status, 404u);
  EXPECT_EQ(get("/../secret").status, 400u);
  EXPECT_EQ(get("/%2e%2e/secret").status, 400u);
  EXPECT_EQ(get("/..%2fsecret").status, 400u);
}

TEST_F(Respond, ALinkWithinTheSiteIsServed) {
  std::filesystem::create_symlink("plane.bin", root() / "inside");
  EXPECT_EQ(bodyOf(get("/inside")), "0123456789");
}

TEST_F(Respond, HiddenFilesAndPipesAreNotServed) {
  put(".imgeo", "marker");
  ASSERT_EQ(mkfifo((root() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(get("/.imgeo").status, 404u);
  EXPECT_EQ(get("/pipe").status, 404u);
}

TEST_F(Respond, ContentNamedFilesAreImmutableAndOthersAreRevalidated) {
  EXPECT_EQ(get("/coord0-0123456789abcdef.png").field("Cache-Control"), "public, max-age=31536000, immutable");
  EXPECT_EQ(get("/plane.bin").field("Cache-Control"), "no-cache");
  put("imgeo.js", "the module that other people's pages name");
  EXPECT_EQ(get("/imgeo.js").field("Cache-Control"), "no-cache");
  EXPECT_EQ(get("/").field("Cache-Control"), "no-cache");
  EXPECT_EQ(get("/missing-0123456789abcdef.png").field("Cache-Control"), "no-cache");
}

TEST_F(Respond, FilesOfLevelsAreImmutableByTheirFolder) {
  std::filesystem::create_directories(root() / "geometry/0123456789abcdef/0");
  std::filesystem::create_directories(root() / "geometry/plain");
  std::filesystem::create_directories(root() / "other/0123456789abcdef");
  for (const char* name : {"geometry/0123456789abcdef/levels.png", "geometry/0123456789abcdef/0/7.png",
                           "geometry/plain/7.png", "other/0123456789abcdef/7.png"})
    put(name, "a file");
  for (const char* path : {"/geometry/0123456789abcdef/levels.png", "/geometry/0123456789abcdef/0/7.png"})
    EXPECT_EQ(get(path).field("Cache-Control"), "public, max-age=31536000, immutable") << path;
  for (const char* path : {"/geometry/plain/7.png", "/other/0123456789abcdef/7.png"})
    EXPECT_EQ(get(path).field("Cache-Control"), "no-cache") << path;
}

TEST_F(Respond, AMatchingTagIsAnsweredWithoutABody) {
  const std::string tag(get("/plane.bin").field("ETag"));
  for (const std::string& header : {tag, "W/" + tag, "\"other\", " + tag, std::string("*")}) {
    RequestHead head;
    head.ifNoneMatch = header;
    const Response response = get("/plane.bin", head);
    EXPECT_EQ(response.status, 304u) << header;
    EXPECT_EQ(response.field("ETag"), tag);
    EXPECT_EQ(bodyOf(response), "");
  }
  RequestHead head;
  head.ifNoneMatch = "\"other\"";
  EXPECT_EQ(get("/plane.bin", head).status, 200u);
}

TEST_F(Respond, AChangedFileHasAnotherTag) {
  const std::string tag(get("/plane.bin").field("ETag"));
  put("fresh", "9876543210");
  std::filesystem::rename(root() / "fresh", root() / "plane.bin");
  EXPECT_NE(get("/plane.bin").field("ETag"), tag);
}

TEST_F(Respond, ARangeOfAFileIsSentAlone) {
  RequestHead head;
  head.range = "bytes=2-4";
  const Response response = get("/plane.bin", head);
  EXPECT_EQ(response.status, 206u);
  EXPECT_EQ(response.field("Content-Range"), "bytes 2-4/10");
  EXPECT_EQ(response.field("Content-Length"), "3");
  EXPECT_EQ(bodyOf(response), "234");
}

TEST_F(Respond, ARangeBeyondTheEndIsRefusedWithTheSize) {
  RequestHead head;
  head.range = "bytes=10-";
  const Response response = get("/plane.bin", head);
  EXPECT_EQ(response.status, 416u);
  EXPECT_EQ(response.field("Content-Range"), "bytes */10");
}

TEST_F(Respond, IfRangeWithAnotherTagSendsTheWholeFile) {
  const std::string tag(get("/plane.bin").field("ETag"));
  RequestHead head;
  head.range = "bytes=2-4";
  head.ifRange = tag;
  EXPECT_EQ(get("/plane.bin", head).status, 206u);
  for (const char* other : {"\"other\"", "Sat, 21 Nov 2026 10:00:00 GMT"}) {
    head.ifRange = other;
    EXPECT_EQ(get("/plane.bin", head).status, 200u) << other;
    EXPECT_EQ(bodyOf(get("/plane.bin", head)), "0123456789");
  }
}

TEST_F(Respond, TextIsCompressedWhereTheClientAcceptsIt) {
  RequestHead head;
  head.acceptEncoding = "gzip, br";
  const Response packed = get("/", head), plain = get("/");
  EXPECT_EQ(packed.field("Content-Encoding"), "br");
  EXPECT_EQ(packed.field("Vary"), "Accept-Encoding");
  EXPECT_EQ(plain.field("Vary"), "Accept-Encoding");
  EXPECT_LT(bodyOf(packed).size(), 100u);
  EXPECT_EQ(packed.field("Content-Length"), std::to_string(bodyOf(packed).size()));
  // A strong tag identifies one sequence of bytes, so each coding needs its own.
  EXPECT_NE(packed.field("ETag"), plain.field("ETag"));
  head.ifNoneMatch = packed.field("ETag");
  EXPECT_EQ(get("/", head).status, 304u);
  head.ifNoneMatch = plain.field("ETag");
  EXPECT_EQ(get("/", head).status, 200u);
}

TEST_F(Respond, AFileCompressedInAdvanceIsSentInsteadOfCompressingAgain) {
  put("index.html.br", "made in advance");
  RequestHead head;
  head.acceptEncoding = "br, gzip;q=0.5";
  const Response packed = get("/", head);
  EXPECT_EQ(bodyOf(packed), "made in advance");
  EXPECT_EQ(packed.field("Content-Encoding"), "br");
  EXPECT_EQ(packed.field("Content-Length"), "15");
  EXPECT_EQ(packed.field("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(packed.field("Vary"), "Accept-Encoding");
  EXPECT_NE(packed.field("ETag"), get("/").field("ETag"));
  EXPECT_EQ(bodyOf(get("/")), page);
  head.acceptEncoding = "gzip";
  EXPECT_NE(bodyOf(get("/", head)), "made in advance");
}

TEST_F(Respond, AFileCompressedInAdvanceIsIgnoredWhereItIsOlderThanItsSource) {
  put("index.html.br", "made in advance");
  const auto written = std::filesystem::last_write_time(root() / "index.html");
  std::filesystem::last_write_time(root() / "index.html.br", written - std::chrono::seconds(1));
  RequestHead head;
  head.acceptEncoding = "br";
  EXPECT_NE(bodyOf(get("/", head)), "made in advance");
  EXPECT_EQ(get("/", head).field("Content-Encoding"), "br");
}

TEST_F(Respond, ImagesAndRangesOfTextAreNotCompressed) {
  put("large.png", std::string(5000, 'x'));
  RequestHead head;
  head.acceptEncoding = "br";
  EXPECT_EQ(get("/large.png", head).field("Content-Encoding"), "");
  EXPECT_EQ(get("/large.png", head).field("Vary"), "");
  head.range = "bytes=0-1";
  EXPECT_EQ(bodyOf(get("/", head)), "<!");
}

TEST_F(Respond, HeadIsGetWithoutTheBody) {
  RequestHead head;
  for (const char* encoding : {"", "br"}) {
    head.acceptEncoding = encoding;
    head.method = "GET";
    const Response whole = get("/", head);
    head.method = "HEAD";
    const Response bare = get("/", head);
    EXPECT_EQ(bare.status, whole.status);
    EXPECT_EQ(bare.fields, whole.fields);
    EXPECT_EQ(bodyOf(bare), "");
  }
}

TEST_F(Respond, OtherMethodsAreRefused) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "get", "TRACE"}) {
    RequestHead head;
    head.method = method;
    EXPECT_EQ(get("/", head).status, 405u) << method;
    EXPECT_EQ(get("/", head).field("Allow"), "GET, HEAD");
  }
}

TEST_F(Respond, NoResponseFieldContainsTextOfTheRequest) {
  // Otherwise a request could inject fields into its response.
  std::filesystem::create_directory(root() / "a\r\nSet-Cookie: b");
  const Response response = get("/a%0d%0aSet-Cookie:%20b");
  EXPECT_EQ(response.field("Location"), "/a%0D%0ASet-Cookie%3A%20b/");
  for (const auto& [name, value] : response.fields)
    EXPECT_EQ(value.find_first_of("\r\n"), std::string::npos) << name;
}

} // namespace
} // namespace imgeo
