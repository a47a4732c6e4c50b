#include "rendezvous.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace graspd::server {
namespace {

GuidBytes planner(std::uint8_t number) {
    GuidBytes guid{};
    guid[0] = 1;
    guid[11] = number;  // as GUIDs of one host differ: late
    return guid;
}

std::vector<GuidBytes> planners(std::uint8_t count) {
    std::vector<GuidBytes> out;
    for (std::uint8_t i = 0; i < count; ++i) out.push_back(planner(i));
    return out;
}

std::string key(int number) {
    return "client/request-" + std::to_string(number);
}

TEST(Rendezvous, NobodyOwnsWhereNobodyIs) {
    EXPECT_EQ(rendezvous_owner("key", {}), nullptr);
}

TEST(Rendezvous, TheOrderDoesNotMatter) {
    auto forward = planners(7);
    auto backward = forward;
    std::ranges::reverse(backward);
    for (int i = 0; i < 200; ++i) {
        EXPECT_EQ(*rendezvous_owner(key(i), forward), *rendezvous_owner(key(i), backward));
    }
}

// 30,000 keys over 5: 6000 each, with a standard deviation of sqrt(30000 * 0.2 * 0.8) = 69.
TEST(Rendezvous, EachGetsAnEqualShare) {
    const auto all = planners(5);
    std::map<GuidBytes, int> shares;
    for (int i = 0; i < 30000; ++i) ++shares[*rendezvous_owner(key(i), all)];
    ASSERT_EQ(shares.size(), 5u);
    for (const auto& [guid, share] : shares) EXPECT_NEAR(share, 6000, 5 * 69);
}

// Those of the planner that leaves go to all others alike; nobody else's move.
TEST(Rendezvous, OnlyTheRequestsOfTheLostOneMove) {
    const auto all = planners(4);
    auto rest = all;
    const GuidBytes lost = rest[1];
    std::erase(rest, lost);
    std::map<GuidBytes, int> heirs;
    for (int i = 0; i < 4000; ++i) {
        const GuidBytes before = *rendezvous_owner(key(i), all);
        const GuidBytes after = *rendezvous_owner(key(i), rest);
        if (before == lost) {
            ++heirs[after];
        } else {
            EXPECT_EQ(before, after);
        }
    }
    ASSERT_EQ(heirs.size(), 3u);
    for (const auto& [guid, count] : heirs) EXPECT_NEAR(count, 333, 5 * 17);  // sqrt(1000 * 2 / 9)
}

TEST(Rendezvous, ARetryFallsToTheSameAndAnotherWriterNotAlways) {
    RequestIdentity first;
    first.request_id = "pick-1";
    RequestIdentity retry = first;
    retry.payload_hash = 5;
    EXPECT_EQ(rendezvous_key(first), rendezvous_key(retry));
    retry.writer[3] = 1;
    EXPECT_NE(rendezvous_key(first), rendezvous_key(retry));
    retry = first;
    retry.request_id = "pick-2";
    EXPECT_NE(rendezvous_key(first), rendezvous_key(retry));
}

}  // namespace
}  // namespace graspd::server
