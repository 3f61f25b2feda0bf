#include "import/archive/gzip.h"

#include "import/testing.h"

#include <libdeflate.h>

namespace imgeo::testing {
namespace {

Bytes gzip(ByteSpan bytes) {
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(6);
  Bytes packed(libdeflate_gzip_compress_bound(compressor, bytes.size()));
  packed.resize(libdeflate_gzip_compress(compressor, bytes.data(), bytes.size(), packed.data(), packed.size()));
  libdeflate_free_compressor(compressor);
  return packed;
}

Bytes joined(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes sampleBytes(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(i * i >> 7);
  return bytes;
}

TEST(Gzip, UnpacksWhatWasPacked) {
  for (const std::size_t size : {0u, 1u, 1000u, 300000u})
    EXPECT_EQ(gunzip(gzip(sampleBytes(size)), "m.gz"), sampleBytes(size));
}

TEST(Gzip, UnpacksAllMembersAndIgnoresPadding) {
  const Bytes a = sampleBytes(100000), b = sampleBytes(5), none;
  Bytes packed = joined(joined(gzip(a), gzip(none)), gzip(b));
  EXPECT_EQ(gunzip(packed, "m.gz"), joined(a, b));
  packed.resize(packed.size() + 500, 0);
  EXPECT_EQ(gunzip(packed, "m.gz"), joined(a, b));
}

TEST(Gzip, EveryProperPrefixIsRefused) {
  const Bytes packed = gzip(sampleBytes(3000));
  for (std::size_t size = 1; size < packed.size(); ++size)
    EXPECT_THROW(gunzip(ByteSpan(packed).first(size), "m.gz"), Error) << size;
}

TEST(Gzip, NamesTheByteOfDamageAndOfTrailingData) {
  Bytes damaged = gzip(sampleBytes(3000));
  damaged[damaged.size() - 6] ^= 1; // its checksum
  EXPECT_EQ(errorOf(damaged, "m.ply.gz").kind(), ErrorKind::malformed);
  EXPECT_EQ(errorOf(damaged, "m.ply.gz").location(), "m.ply.gz, byte 0");
  const Bytes packed = gzip(sampleBytes(3000));
  EXPECT_EQ(errorOf(joined(packed, {'P', 'K'}), "m.ply.gz").location(),
            "m.ply.gz, byte " + std::to_string(packed.size()));
}

TEST(Gzip, RefusesABomb) {
  const Bytes bomb = gzip(Bytes(unlimitedRatioBytes + 1));
  EXPECT_EQ(errorOf(bomb, "bomb.ply.gz").kind(), ErrorKind::limit);
  Bytes lie = gzip(sampleBytes(1000)); // its last field states 4 GiB
  std::fill(lie.end() - 4, lie.end(), std::uint8_t{0xff});
  EXPECT_EQ(errorOf(lie, "lie.ply.gz").kind(), ErrorKind::malformed);
}

} // namespace
} // namespace imgeo::testing
