// The same request gives the same bytes: whatever threads plan, whatever was planned before, and
// whatever build plans.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "reply_digests.hpp"
#include "unit/server_served.hpp"

namespace graspd::test {
namespace {

using Digests = std::map<std::string, std::string>;

const Digests& first_digests() {
    static const Digests digests = cold_digests();
    return digests;
}

/// A service's replies to the digest_requests(), each sent `times` times by writers of their own.
std::map<std::string, std::set<std::string>> served_digests(std::uint32_t workers, int times) {
    using server::test::FakeRequest;
    server::ServerConfig config;
    config.workers = workers;
    config.queue_capacity = 1000;
    server::test::Served served(
        decltype(server::ServiceParts::plan)(
            [](const PlanRequest& problem, PreparedObjectPtr& object, const StopQuery& stop) {
                return plan(problem, object, {}, stop);
            }),
        config);
    std::size_t sent = 0;
    for (int writer = 0; writer < times; ++writer) {
        for (const auto& [name, problem] : digest_requests()) {
            auto asked = std::make_unique<FakeRequest>(static_cast<std::uint8_t>(writer), name);
            asked->problem = problem;
            served.service.handle(std::move(asked));
            ++sent;
        }
    }
    const auto all = [&](const auto& list) { return list.size() >= sent; };
    for (int patience = 20; patience > 0 && !served.written.wait(all);) --patience;
    EXPECT_TRUE(served.written.wait(all));
    std::map<std::string, std::set<std::string>> digests;
    for (const OutgoingReply& out : served.written.copy()) {
        digests[out.reply.request_id].insert(digest_of(out.reply));
    }
    return digests;
}

TEST(Determinism, TwoRunsGiveTheSameBytes) {
    EXPECT_EQ(first_digests(), cold_digests());
}

TEST(Determinism, DifferentRequestsGiveDifferentBytes) {
    std::set<std::string> different;
    for (const auto& [name, digest] : first_digests()) different.insert(digest);
    EXPECT_EQ(different.size(), first_digests().size());
}

TEST(Determinism, OneTwoAndFourThreadsGiveTheSameBytes) {
    for (const std::size_t threads : {1u, 2u, 4u}) {
        SCOPED_TRACE(threads);
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(first_digests(), cold_digests());
    }
}

// Every request comes three times, so that most find their object prepared.
TEST(Determinism, OneTwoAndFourWorkersGiveTheSameBytesWarmAndCold) {
    for (const std::uint32_t workers : {1u, 2u, 4u}) {
        SCOPED_TRACE(workers);
        const auto served = served_digests(workers, 3);
        ASSERT_EQ(served.size(), first_digests().size());
        for (const auto& [name, digest] : first_digests()) {
            EXPECT_EQ(served.at(name), std::set<std::string>{digest}) << name;
        }
    }
}

}  // namespace
}  // namespace graspd::test
