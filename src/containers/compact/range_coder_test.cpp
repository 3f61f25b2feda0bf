#include "containers/compact/range_decoder.h"
#include "containers/compact/range_encoder.h"
#include "containers/compact/symbols.h"

#include <gtest/gtest.h>
#include <random>

namespace imgeo::compact {
namespace {

/// What a test codes: a bit of a model, a tree of such bits, or raw bits.
struct Item {
  enum class Kind { bit, tree, raw } kind;
  std::uint32_t size; ///< in bits; ignored for Kind::bit
  std::uint32_t value;
};

/// Random items. Among bits that a model predicts, one in `rarity` is 1.
std::vector<Item> randomItems(std::mt19937& random, std::size_t count, std::uint32_t rarity) {
  const auto rareBit = [&] { return std::uint32_t{random() % rarity == 0}; };
  std::vector<Item> items;
  for (std::size_t i = 0; i < count; ++i) {
    Item item{static_cast<Item::Kind>(random() % 3), 1 + std::uint32_t(random() % 4), 0};
    if (item.kind == Item::Kind::raw)
      item.size = static_cast<std::uint32_t>(random() % 31);
    for (std::uint32_t bit = 0; bit < item.size; ++bit)
      item.value = item.value << 1 | (item.kind == Item::Kind::raw ? random() & 1 : rareBit());
    if (item.kind == Item::Kind::bit)
      item.value &= 1;
    items.push_back(item);
  }
  return items;
}

template <typename Coder> std::uint32_t code(Coder& coder, const Item& item) {
  switch (item.kind) {
  case Item::Kind::bit:
    return coder.bit(0, item.value);
  case Item::Kind::tree:
    return codeTree(coder, 16, item.size, item.value);
  case Item::Kind::raw:
    return coder.raw(item.size, item.value);
  }
  return 0;
}

// A rare bit makes probabilities extreme: a carry then runs over many bytes, and one bit can move two bytes.
TEST(RangeCoder, DecodesWhatWasEncoded) {
  std::mt19937 random(1);
  const std::string location = "test";
  for (int round = 0; round < 300; ++round) {
    const std::uint32_t rarity = 1u << random() % 14;
    const std::vector<Item> items = randomItems(random, random() % 2000, rarity);
    RangeEncoder encoder(32);
    for (const Item& item : items)
      code(encoder, item);
    const Bytes bytes = encoder.finish();
    RangeDecoder decoder(bytes, 32, location);
    for (const Item& item : items)
      ASSERT_EQ(code(decoder, {item.kind, item.size, 0}), item.value) << "round " << round;
    EXPECT_NO_THROW(decoder.finish());
  }
}

TEST(RangeCoder, MeasuresATreeLikeItsBits) {
  std::mt19937 random(2);
  RangeEncoder encoder(32);
  for (int i = 0; i < 200; ++i) {
    const auto value = static_cast<std::uint32_t>(random() % 16);
    CostMeter treeMeter(encoder, UINT32_MAX), bitMeter(encoder, UINT32_MAX);
    codeTree(treeMeter, 16, 4, value);
    std::uint32_t node = 1;
    for (std::uint32_t level = 4; level-- > 0;)
      node = node << 1 | std::uint32_t{bitMeter.bit(16 + node, value >> level & 1)};
    EXPECT_EQ(treeMeter.cost(), bitMeter.cost());
    codeTree(encoder, 16, 4, i % 3 == 0 ? value : 0);
  }
}

} // namespace
} // namespace imgeo::compact
