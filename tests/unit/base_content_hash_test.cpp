#include "graspd/base/content_hash.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

#include "graspd/base/heap_bytes.hpp"

namespace graspd {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

// Hashes are compared between machines and kept by clients, so they must not change with the
// library's version. Of nothing XXH3 publishes 2d06800538d394c2 (its own test vectors, seed 0).
TEST(ContentHash, IsTheOneThatXxh3Publishes) {
    EXPECT_EQ(content_hash({}), 0x2d06800538d394c2u);
}

// Every length around those where XXH3 changes its way (16, 128, 240), and a bit flipped anywhere.
TEST(ContentHash, ChangesWithEveryByteAndWithTheLength) {
    for (const std::size_t size : {1u, 3u, 8u, 16u, 17u, 128u, 129u, 240u, 241u, 1000u}) {
        std::vector<std::byte> bytes(size);
        std::set<std::uint64_t> seen{content_hash(bytes)};
        for (std::byte& byte : bytes) {
            byte = std::byte{1};
            seen.insert(content_hash(bytes));
            byte = std::byte{0};
        }
        bytes.push_back(std::byte{0});
        seen.insert(content_hash(bytes));
        EXPECT_EQ(seen.size(), size + 2);
    }
}

TEST(ContentKey, IsOfTheBlocksAndOfWhereTheyEnd) {
    const std::set<std::string> keys = {
        content_key({}),
        content_key({bytes_of("")}),
        content_key({bytes_of("ab"), bytes_of("c")}),
        content_key({bytes_of("a"), bytes_of("bc")}),
        content_key({bytes_of("abc")}),
        content_key({bytes_of("abc"), bytes_of("")}),
    };
    EXPECT_EQ(keys.size(), 6u);
    for (const std::string& key : keys) EXPECT_EQ(key.size(), 32u);
    EXPECT_EQ(content_key({bytes_of("a"), bytes_of("bc")}),
              content_key({bytes_of("a"), bytes_of("bc")}));
}

TEST(HeapBytes, OfAShortTextThereAreNone) {
    EXPECT_EQ(heap_bytes(std::string("fits in")), 0u);
    std::string text;
    text.reserve(100);
    EXPECT_EQ(heap_bytes(text), 101u);
    std::vector<double> numbers;
    numbers.reserve(3);
    EXPECT_EQ(heap_bytes(numbers), 24u);
}

}  // namespace
}  // namespace graspd
