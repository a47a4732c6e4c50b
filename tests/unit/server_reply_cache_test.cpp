#include "reply_cache.hpp"

#include <gtest/gtest.h>

#include "server_fakes.hpp"

namespace graspd::server {
namespace {

using test::FakeRequest;

RequestPtr sent(std::uint8_t writer, const std::string& id, std::uint64_t hash = 7) {
    return std::make_shared<const FakeRequest>(writer, id, hash);
}

PlanReply reply_of(PlanStatus status, std::string message = "") {
    PlanReply reply;
    reply.status = status;
    reply.message = std::move(message);
    return reply;
}

/// Admits a request that must be new, and completes it.
void plan(ReplyCache& cache, const RequestPtr& request, const PlanReply& reply) {
    ASSERT_EQ(cache.admit(request).admission, Admission::kPlan);
    const auto answered = cache.complete(request, reply);
    ASSERT_EQ(answered.size(), 1u);
    EXPECT_EQ(answered[0].request, request);
}

TEST(ReplyCache, ARetryGetsTheReplyAndTheNextNumber) {
    ReplyCache cache({});
    plan(cache, sent(1, "mug"), reply_of(PlanStatus::kNoGrasp, "too wide"));
    for (std::uint32_t attempt = 2; attempt < 5; ++attempt) {
        const auto again = cache.admit(sent(1, "mug"));
        EXPECT_EQ(again.admission, Admission::kAnswered);
        EXPECT_EQ(again.attempt, attempt);
        ASSERT_NE(again.reply, nullptr);
        EXPECT_EQ(again.reply->message, "too wide");
    }
}

TEST(ReplyCache, RetriesOfOneBeingPlannedAreAnsweredTogetherInOrder) {
    ReplyCache cache({});
    const RequestPtr first = sent(1, "mug");
    const RequestPtr second = sent(1, "mug");
    const RequestPtr third = sent(1, "mug");
    EXPECT_EQ(cache.admit(first).admission, Admission::kPlan);
    EXPECT_EQ(cache.admit(second).admission, Admission::kWait);
    EXPECT_EQ(cache.admit(third).admission, Admission::kWait);
    const auto answered = cache.complete(first, reply_of(PlanStatus::kOk));
    ASSERT_EQ(answered.size(), 3u);
    const RequestPtr expected[] = {first, second, third};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(answered[i].request, expected[i]);
        EXPECT_EQ(answered[i].attempt, i + 1);
    }
    EXPECT_EQ(cache.admit(sent(1, "mug")).attempt, 4u);
}

TEST(ReplyCache, OtherBytesUnderTheSameIdClash) {
    ReplyCache cache({});
    const RequestPtr first = sent(1, "mug", 7);
    ASSERT_EQ(cache.admit(first).admission, Admission::kPlan);
    EXPECT_EQ(cache.admit(sent(1, "mug", 8)).admission, Admission::kClash);  // still planning
    cache.complete(first, reply_of(PlanStatus::kOk));
    EXPECT_EQ(cache.admit(sent(1, "mug", 8)).admission, Admission::kClash);  // and afterwards
    EXPECT_EQ(cache.admit(sent(1, "mug", 7)).admission, Admission::kAnswered);
}

TEST(ReplyCache, TwoWritersMayUseTheSameId) {
    ReplyCache cache({});
    plan(cache, sent(1, "mug", 7), reply_of(PlanStatus::kOk));
    EXPECT_EQ(cache.admit(sent(2, "mug", 8)).admission, Admission::kPlan);
}

TEST(ReplyCache, ARefusalIsNotRepeatedButCounts) {
    for (const PlanStatus status :
         {PlanStatus::kOverloaded, PlanStatus::kCancelled, PlanStatus::kUnknownObject}) {
        ReplyCache cache({});
        plan(cache, sent(1, "mug"), reply_of(status));
        const RequestPtr again = sent(1, "mug");
        ASSERT_EQ(cache.admit(again).admission, Admission::kPlan) << to_string(status);
        const auto answered = cache.complete(again, reply_of(PlanStatus::kOk));
        ASSERT_EQ(answered.size(), 1u);
        EXPECT_EQ(answered[0].attempt, 2u);
        EXPECT_EQ(cache.admit(sent(1, "mug")).admission, Admission::kAnswered);
    }
}

TEST(ReplyCache, EveryOtherVerdictIsRepeated) {
    for (const PlanStatus status :
         {PlanStatus::kOk, PlanStatus::kNoGrasp, PlanStatus::kPartial, PlanStatus::kInvalidRequest,
          PlanStatus::kUnknownGripper, PlanStatus::kInternalError}) {
        ReplyCache cache({});
        plan(cache, sent(1, "mug"), reply_of(status));
        EXPECT_EQ(cache.admit(sent(1, "mug")).admission, Admission::kAnswered) << to_string(status);
    }
}

TEST(ReplyCache, RequestsWithoutAnIdAreAllNew) {
    ReplyCache cache({});
    const RequestPtr first = sent(1, "", 7);
    const RequestPtr second = sent(1, "", 8);
    EXPECT_EQ(cache.admit(first).admission, Admission::kPlan);
    EXPECT_EQ(cache.admit(second).admission, Admission::kPlan);
    const auto answered = cache.complete(second, reply_of(PlanStatus::kInvalidRequest));
    ASSERT_EQ(answered.size(), 1u);
    EXPECT_EQ(answered[0].request, second);
    EXPECT_EQ(answered[0].attempt, 1u);
    EXPECT_EQ(cache.entries(), 0u);
}

TEST(ReplyCache, TooManyEntriesDropTheOldest) {
    ReplyCache cache({.entries = 3, .bytes = 1u << 30, .waiting_retries = 8});
    for (const char* id : {"a", "b", "c", "d"}) {
        plan(cache, sent(1, id), reply_of(PlanStatus::kOk));
    }
    EXPECT_EQ(cache.entries(), 3u);
    EXPECT_EQ(cache.admit(sent(1, "b")).admission, Admission::kAnswered);
    EXPECT_EQ(cache.admit(sent(1, "d")).admission, Admission::kAnswered);
    EXPECT_EQ(cache.admit(sent(1, "a")).admission, Admission::kPlan);  // forgotten
}

// Replies of about 1000 bytes each, room for 2500: two stay. The newest stays even if it alone is
// larger, or its retries would be planned again and again.
TEST(ReplyCache, TooManyBytesDropTheOldestButNeverTheNewest) {
    const PlanReply empty = reply_of(PlanStatus::kNoGrasp);
    const std::uint64_t own = reply_bytes(empty);
    const PlanReply large = reply_of(PlanStatus::kNoGrasp, std::string(1000, 'x'));
    EXPECT_EQ(reply_bytes(large), own + 1000);
    ReplyCache cache({.entries = 100, .bytes = 2 * own + 2500, .waiting_retries = 8});
    for (const char* id : {"a", "b", "c"}) plan(cache, sent(1, id), large);
    EXPECT_EQ(cache.entries(), 2u);
    EXPECT_EQ(cache.bytes(), 2 * (own + 1000));
    plan(cache, sent(1, "huge"), reply_of(PlanStatus::kNoGrasp, std::string(9000, 'x')));
    EXPECT_EQ(cache.entries(), 1u);
    EXPECT_EQ(cache.admit(sent(1, "huge")).admission, Admission::kAnswered);
}

TEST(ReplyCache, WhatIsBeingPlannedIsNeverDropped) {
    ReplyCache cache({.entries = 1, .bytes = 1, .waiting_retries = 8});
    const RequestPtr slow = sent(1, "slow");
    ASSERT_EQ(cache.admit(slow).admission, Admission::kPlan);
    for (const char* id : {"a", "b", "c"}) {
        plan(cache, sent(1, id), reply_of(PlanStatus::kOk));
    }
    EXPECT_EQ(cache.admit(sent(1, "slow")).admission, Admission::kWait);
    EXPECT_EQ(cache.complete(slow, reply_of(PlanStatus::kOk)).size(), 2u);
}

TEST(ReplyCache, AFloodOfRetriesIsRefusedBeyondItsLimit) {
    ReplyCache cache({.entries = 10, .bytes = 1u << 20, .waiting_retries = 2});
    const RequestPtr first = sent(1, "mug");
    ASSERT_EQ(cache.admit(first).admission, Admission::kPlan);
    EXPECT_EQ(cache.admit(sent(1, "mug")).admission, Admission::kWait);
    EXPECT_EQ(cache.admit(sent(1, "mug")).admission, Admission::kWait);
    const auto refused = cache.admit(sent(1, "mug"));
    EXPECT_EQ(refused.admission, Admission::kOverloaded);
    EXPECT_EQ(refused.attempt, 1u);  // it is the first that is answered
    const auto answered = cache.complete(first, reply_of(PlanStatus::kOk));
    ASSERT_EQ(answered.size(), 3u);
    EXPECT_EQ(answered[0].attempt, 2u);
    ASSERT_EQ(cache.admit(sent(1, "pan")).admission, Admission::kPlan);
    EXPECT_EQ(cache.admit(sent(1, "pan")).admission, Admission::kWait);  // there is room again
}

}  // namespace
}  // namespace graspd::server
