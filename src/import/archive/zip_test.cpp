#include "import/archive/zip.h"

#include "base/error.h"
#include "import/archive/gzip.h"
#include "import/testing.h"

#include <gtest/gtest.h>
#include <limits>

namespace imgeo::testing {
namespace {

void append(Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// An archive of `packed` bytes whose directory states these unpacked sizes.
Bytes archiveOf(const std::vector<std::uint32_t>& sizes, std::string_view comment = "", std::size_t packed = 0) {
  Bytes bytes;
  append(bytes, "PK\3\4 what it holds PK\1\2");
  bytes.resize(bytes.size() + packed);
  const auto directory = static_cast<std::uint32_t>(bytes.size());
  for (const std::uint32_t size : sizes) {
    append(bytes, "PK\1\2");
    bytes.resize(bytes.size() + 20);
    appendLittle(bytes, size);
    for (const int length : {5, 2, 1})
      appendLittle(bytes, static_cast<std::uint16_t>(length));
    bytes.resize(bytes.size() + 12);
    append(bytes, "a.xmlEXC");
  }
  append(bytes, "PK\5\6");
  bytes.resize(bytes.size() + 12);
  appendLittle(bytes, directory);
  appendLittle(bytes, static_cast<std::uint16_t>(comment.size()));
  append(bytes, comment);
  return bytes;
}

TEST(Zip, SumsTheUnpackedSizesOfItsEntries) {
  EXPECT_EQ(unpackedZipBytes(archiveOf({})), 0u);
  EXPECT_EQ(unpackedZipBytes(archiveOf({1000, 20, 3})), 1023u);
  EXPECT_EQ(unpackedZipBytes(archiveOf({1000, 20}, "a comment")), 1020u);
}

TEST(Zip, ReadsSizesBeyond32BitsFromTheZip64Field) {
  Bytes archive;
  append(archive, "PK\3\4 what it holds ");
  const auto directory = static_cast<std::uint32_t>(archive.size());
  append(archive, "PK\1\2");
  archive.resize(archive.size() + 20);
  appendLittle(archive, std::uint32_t{0xffffffff});
  for (const int length : {5, 4 + 2 + 4 + 8, 0})
    appendLittle(archive, static_cast<std::uint16_t>(length));
  archive.resize(archive.size() + 12);
  append(archive, "a.xml");
  for (const int value : {0x7075, 2, 0}) // another extra field comes first
    appendLittle(archive, static_cast<std::uint16_t>(value));
  for (const int value : {1, 8})
    appendLittle(archive, static_cast<std::uint16_t>(value));
  appendLittle(archive, std::uint64_t{7} << 32);
  append(archive, "PK\5\6");
  archive.resize(archive.size() + 12);
  appendLittle(archive, directory);
  appendLittle(archive, std::uint16_t{0});
  EXPECT_EQ(unpackedZipBytes(archive), std::uint64_t{7} << 32);
  EXPECT_EQ(unpackedZipBytes(archiveOf({1000, 0xffffffff})), std::numeric_limits<std::uint64_t>::max())
      << "an entry without the field is beyond every limit";
}

TEST(Zip, ReadsEveryTruncationSafely) {
  const Bytes whole = archiveOf({7, 7, 7});
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_LE(unpackedZipBytes(ByteSpan(whole).first(size)), 21u) << size;
  EXPECT_EQ(unpackedZipBytes(ByteSpan(whole).first(whole.size() - 1)), 0u);
}

TEST(Zip, RefusesAnArchiveBeyondTheLimit) {
  const auto limit = static_cast<std::uint32_t>(unlimitedRatioBytes);
  EXPECT_NO_THROW(refuseZipBomb(archiveOf({limit}, "", limit / 500), "m.3mf"));
  EXPECT_NO_THROW(refuseZipBomb(Bytes(1000), "m.3mf")) << "not an archive";
  try {
    refuseZipBomb(archiveOf({limit, 0xfffffffe}), "m.3mf");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_EQ(error.location(), "m.3mf");
    EXPECT_NE(error.message().find("unpacks to 4362076158 bytes"), std::string::npos) << error.message();
  }
  EXPECT_EQ(errorOf(archiveOf({0xffffffff}), "m.3mf").kind(), ErrorKind::limit);
}

/// An archive of one file, as it is in it, with its method.
Bytes archiveWith(std::string_view packed, std::uint16_t method, std::size_t unpackedBytes) {
  const auto fields = [](Bytes& bytes, std::initializer_list<std::uint16_t> values) {
    for (const std::uint16_t value : values)
      appendLittle(bytes, value);
  };
  Bytes bytes;
  append(bytes, "PK\3\4");
  fields(bytes, {20, 0, method, 0, 0});
  for (const std::size_t number : {std::size_t{0}, packed.size(), unpackedBytes})
    appendLittle(bytes, static_cast<std::uint32_t>(number));
  fields(bytes, {5, 0});
  append(bytes, "a.xml");
  append(bytes, packed);
  const auto directory = static_cast<std::uint32_t>(bytes.size());
  append(bytes, "PK\1\2");
  fields(bytes, {20, 20, 0, method, 0, 0});
  for (const std::size_t number : {std::size_t{0}, packed.size(), unpackedBytes})
    appendLittle(bytes, static_cast<std::uint32_t>(number));
  fields(bytes, {5, 0, 0, 0, 0, 0, 0, 0, 0}); // lengths, disk, attributes, offset
  append(bytes, "a.xml");
  append(bytes, "PK\5\6");
  fields(bytes, {0, 0, 1, 1, 51, 0});
  appendLittle(bytes, directory);
  fields(bytes, {0});
  return bytes;
}

TEST(Zip, HasItsFirstFile) {
  const std::string stored = "<amf/>", deflated("\x4b\x4c\x4c\x4a\x4e\x49\x4c\x4a\x06\x00", 10); // "aabcdabc"
  EXPECT_EQ(asText(unpackZip(archiveWith(stored, 0, stored.size()), "a.amf")), stored);
  EXPECT_EQ(asText(unpackZip(archiveWith(deflated, 8, 8), "a.amf")), "aabcdabc");
}

TEST(Zip, IsRefusedWhereItsFileIsDamagedOrPackedOtherwise) {
  const auto kindOf = [](const Bytes& bytes) {
    try {
      unpackZip(bytes, "a.amf");
    } catch (const Error& error) {
      EXPECT_EQ(error.location(), "a.amf");
      return error.kind();
    }
    return ErrorKind::usage;
  };
  EXPECT_EQ(kindOf(archiveWith("damage", 8, 8)), ErrorKind::malformed);
  EXPECT_EQ(kindOf(archiveWith("packed", 14, 8)), ErrorKind::unsupported);
  EXPECT_EQ(kindOf(archiveWith("packed", 8, 0xffffffff)), ErrorKind::limit);
  const Bytes whole = archiveWith("<amf/>", 0, 6);
  EXPECT_EQ(kindOf(whole), ErrorKind::usage); // is read
  for (std::size_t size = 0; size + 1 < whole.size(); ++size)
    EXPECT_EQ(kindOf({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), ErrorKind::malformed) << size;
}

TEST(Zip, OfAmfIsRead) {
  const std::string amf = "<?xml version=\"1.0\"?><amf unit=\"millimeter\"><object id=\"0\"><mesh><vertices>"
                          "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"
                          "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"
                          "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></vertices>"
                          "<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object></amf>";
  EXPECT_EQ(onlyMesh(archiveWith(amf, 0, amf.size()), "a.amf").elementCount(), 1u);
}

} // namespace
} // namespace imgeo::testing
