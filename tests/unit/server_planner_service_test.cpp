#include "planner_service.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "server_served.hpp"
#include "write_json.hpp"

namespace graspd::server {
namespace {

using namespace std::chrono_literals;
using test::FakeRequest;
using test::plan_at_once;
using test::reply_to;
using test::request;
using test::Served;
using test::SlowPlanner;
using test::Watched;
using test::without_objects;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(PlannerService, AnswersWithWhatThePlannerSays) {
    Served served(plan_at_once);
    served.service.handle(request(1, "mug"));
    ASSERT_TRUE(served.wait_for(1));
    const OutgoingReply out = served.written.copy()[0];
    EXPECT_EQ(out.reply.status, PlanStatus::kOk);
    EXPECT_EQ(out.reply.request_id, "mug");
    EXPECT_EQ(out.attempt, 1u);
    EXPECT_EQ(out.to->identity().writer[0], 1);
}

TEST(PlannerService, WhatIsThrownBecomesInternalErrorAndHarmsNoOther) {
    Served served([](const PlanRequest& problem, const StopQuery& stop) {
        if (problem.request_id == "bad") throw std::runtime_error("index 7 of 3");
        if (problem.request_id == "worse") throw 42;  // NOLINT: no std::exception on purpose
        return plan_at_once(problem, stop);
    });
    for (const char* id : {"bad", "worse", "good"}) served.service.handle(request(1, id));
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kInternalError,
                                               PlanStatus::kInternalError, PlanStatus::kOk));
    EXPECT_THAT(served.written.copy()[0].reply.message, HasSubstr("index 7 of 3"));
    EXPECT_EQ(served.written.copy()[0].reply.request_id, "bad");
    EXPECT_EQ(served.written.copy()[0].reply.frame_id, "table");
}

TEST(PlannerService, ARequestThatCannotBeConvertedIsRefusedByItsCode) {
    const std::pair<PlanErrorCode, PlanStatus> expected[] = {
        {PlanErrorCode::kInvalidInput, PlanStatus::kInvalidRequest},
        {PlanErrorCode::kDegenerate, PlanStatus::kInvalidRequest},
        {PlanErrorCode::kTooLarge, PlanStatus::kInvalidRequest},
        {PlanErrorCode::kUnsupported, PlanStatus::kInvalidRequest},
        {PlanErrorCode::kUnknownGripper, PlanStatus::kUnknownGripper},
        {PlanErrorCode::kUnknownObject, PlanStatus::kUnknownObject},
        {PlanErrorCode::kInternal, PlanStatus::kInternalError},
    };
    SlowPlanner planner;
    Served served(std::ref(planner), Served::one_worker(16));
    for (const auto& [code, status] : expected) {
        auto bad = request(1, to_string(code));
        bad->error = PlanError{code, "friction = -1 must be > 0"};
        served.service.handle(std::move(bad));
    }
    ASSERT_TRUE(served.wait_for(std::size(expected)));
    for (std::size_t i = 0; i < std::size(expected); ++i) {
        const PlanReply reply = served.written.copy()[i].reply;
        EXPECT_EQ(reply.status, expected[i].second) << to_string(expected[i].first);
        EXPECT_EQ(reply.message, "friction = -1 must be > 0");
    }
    EXPECT_EQ(planner.calls(), 0);
}

// One is being planned, two wait, so the next three are refused while the planner still works.
TEST(PlannerService, AFullQueueAnswersOverloadedAtOnce) {
    SlowPlanner planner;
    Served served(std::ref(planner), Served::one_worker(2));
    served.service.handle(request(1, "planned"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    for (const char* id : {"waits", "waits too", "x", "y", "z"}) {
        served.service.handle(request(1, id));
    }
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_THAT(served.statuses(), testing::Each(PlanStatus::kOverloaded));
    EXPECT_EQ(served.service.counters().queued, 2u);
    EXPECT_EQ(served.service.counters().open, 3u);
    served.service.handle(request(1, "x"));  // a retry too early: refused again
    ASSERT_TRUE(served.wait_for(4));
    EXPECT_EQ(served.written.copy()[3].attempt, 2u);
    planner.release();
    ASSERT_TRUE(served.wait_for(7));
    served.service.handle(request(1, "x"));  // now there is room
    ASSERT_TRUE(served.wait_for(8));
    EXPECT_EQ(served.written.copy()[7].reply.status, PlanStatus::kOk);
    EXPECT_EQ(served.written.copy()[7].attempt, 3u);
    EXPECT_EQ(served.service.counters().answers[static_cast<int>(PlanStatus::kOverloaded)], 4u);
}

TEST(PlannerService, ARetryIsPlannedOnceAndAnsweredEachTime) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request(1, "mug"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    served.service.handle(request(1, "mug"));  // while the first is being planned
    planner.release();
    ASSERT_TRUE(served.wait_for(2));
    served.service.handle(request(1, "mug"));  // and after it
    ASSERT_TRUE(served.wait_for(3));
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(served.written.copy()[i].attempt, i + 1);
        EXPECT_EQ(served.written.copy()[i].reply.status, PlanStatus::kOk);
    }
    EXPECT_EQ(planner.calls(), 1);
    EXPECT_EQ(served.service.counters().repeated, 2u);
}

TEST(PlannerService, TheSameIdWithOtherBytesIsInvalid) {
    Served served(plan_at_once);
    served.service.handle(request(1, "mug", 7));
    ASSERT_TRUE(served.wait_for(1));
    served.service.handle(request(1, "mug", 8));
    served.service.handle(request(2, "mug", 8));  // another writer may
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_THAT(served.statuses(),
                ElementsAre(PlanStatus::kOk, PlanStatus::kInvalidRequest, PlanStatus::kOk));
    EXPECT_THAT(served.written.copy()[1].reply.message, HasSubstr("request_id = mug"));
}

// The planner works until it is told to stop; nobody but the clock tells it.
TEST(PlannerService, TheTimeBudgetStopsThePlanner) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    auto hasty = request(1, "hasty");
    hasty->problem.options.time_budget_s = 0.03;
    const auto sent = hasty->at;
    served.service.handle(std::move(hasty));
    ASSERT_TRUE(served.wait_for(1));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kPartial));
    EXPECT_GE(std::chrono::steady_clock::now() - sent, 30ms);
}

// Received 10 s ago: 5 s are over, 3600 s are not.
TEST(PlannerService, TheTimeBudgetCountsFromReceipt) {
    int planned = 0;
    Served served([&](const PlanRequest& problem, const StopQuery& stop) {
        ++planned;
        EXPECT_FALSE(stop());
        return plan_at_once(problem, stop);
    });
    for (const double budget_s : {5.0, 3600.0, 1e300}) {
        auto old = request(1, std::to_string(budget_s).substr(0, 5));
        old->at -= 10s;
        old->problem.options.time_budget_s = budget_s;
        served.service.handle(std::move(old));
    }
    ASSERT_TRUE(served.wait_for(3));
    EXPECT_THAT(served.statuses(),
                ElementsAre(PlanStatus::kPartial, PlanStatus::kOk, PlanStatus::kOk));
    EXPECT_EQ(planned, 2);
    const PlanReply late = served.written.copy()[0].reply;
    EXPECT_TRUE(late.grasps.empty());
    EXPECT_EQ(late.message, "time_budget = 5 s was over before planning began");
}

TEST(PlannerService, StopCancelsWhatWaitsAndStopsWhatIsPlanned) {
    SlowPlanner planner;
    Served served(std::ref(planner));
    served.service.handle(request(1, "planned"));
    ASSERT_TRUE(planner.wait_for_calls(1));
    served.service.handle(request(1, "waits"));
    served.service.handle(request(1, "planned"));  // a retry that waits for its first
    EXPECT_TRUE(served.service.stop(10s));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kCancelled, PlanStatus::kCancelled,
                                               PlanStatus::kCancelled));
    std::multiset<std::string> answers;  // the planner that stops and the queue do not take turns
    for (const OutgoingReply& out : served.written.copy()) {
        answers.insert(out.reply.request_id + "/" + std::to_string(out.attempt));
    }
    EXPECT_THAT(answers, ElementsAre("planned/1", "planned/2", "waits/1"));
    EXPECT_EQ(planner.calls(), 1);
    EXPECT_EQ(served.service.counters().open, 0u);
}

TEST(PlannerService, APartialResultThatHoldsGraspsSurvivesTheStop) {
    Watched<bool> started;
    Served served([&](const PlanRequest& problem, const StopQuery& stop) {
        started.change([](bool& value) { value = true; });
        while (!stop()) std::this_thread::yield();
        PlanReply reply = reply_to(problem, PlanStatus::kPartial);
        reply.grasps.resize(2);
        return reply;
    });
    served.service.handle(request(1, "mug"));
    ASSERT_TRUE(started.wait([](bool value) { return value; }));
    EXPECT_TRUE(served.service.stop(10s));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kPartial));
    EXPECT_EQ(served.written.copy()[0].reply.grasps.size(), 2u);
}

// A planner that never looks at its StopQuery: its request is answered for it, and what it says
// afterwards is dropped.
TEST(PlannerService, StopDoesNotWaitForAPlannerThatIsDeaf) {
    Watched<bool> started;
    Watched<bool> released;
    Served served([&](const PlanRequest& problem, const StopQuery& stop) {
        started.change([](bool& value) { value = true; });
        EXPECT_TRUE(released.wait([](bool value) { return value; }));
        return plan_at_once(problem, stop);
    });
    served.service.handle(request(1, "mug"));
    ASSERT_TRUE(started.wait([](bool value) { return value; }));
    EXPECT_FALSE(served.service.stop(20ms));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kCancelled));
    released.change([](bool& value) { value = true; });
    EXPECT_TRUE(served.service.stop(10s));
    EXPECT_EQ(served.statuses().size(), 1u);
}

TEST(PlannerService, WhatComesWhileItStopsIsCancelled) {
    Watched<bool> started;
    Watched<bool> told_to_stop;
    Watched<bool> released;
    const auto set = [](bool& value) { value = true; };
    const auto is_set = [](bool value) { return value; };
    Served served([&](const PlanRequest& problem, const StopQuery& stop) {
        started.change(set);
        while (!stop()) std::this_thread::yield();
        told_to_stop.change(set);
        EXPECT_TRUE(released.wait(is_set));
        return plan_at_once(problem, stop);
    });
    served.service.handle(request(1, "planned"));
    ASSERT_TRUE(started.wait(is_set));
    std::jthread stopping([&] { EXPECT_TRUE(served.service.stop(10s)); });
    ASSERT_TRUE(told_to_stop.wait(is_set));
    served.service.handle(request(1, "late"));
    EXPECT_TRUE(served.wait_for(1));
    released.change(set);
    stopping.join();
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kCancelled, PlanStatus::kOk));
    EXPECT_EQ(served.written.copy()[0].reply.request_id, "late");
}

TEST(PlannerService, AnObjectIsKnownByItsKeyAfterItsFirstRequest) {
    Served served([](const PlanRequest& problem, const StopQuery&) {
        PlanReply reply = reply_to(problem, PlanStatus::kOk);
        reply.object_key = "00ff";
        reply.message = std::to_string(std::get<TriangleMesh>(problem.object_O).vertices.size());
        return reply;
    });
    const auto by_key = [](const std::string& id, const std::string& key) {
        auto with_key = request(1, id);
        with_key->key = key;
        with_key->problem.object_O = TriangleMesh{};
        return with_key;
    };
    served.service.handle(by_key("before", "00ff"));
    served.service.handle(request(1, "with geometry"));
    served.service.handle(by_key("after", "00ff"));
    served.service.handle(by_key("other", "00fe"));
    ASSERT_TRUE(served.wait_for(4));
    EXPECT_THAT(served.statuses(), ElementsAre(PlanStatus::kUnknownObject, PlanStatus::kOk,
                                               PlanStatus::kOk, PlanStatus::kUnknownObject));
    EXPECT_EQ(served.written.copy()[2].reply.message, "3");  // the vertices of the first request
    EXPECT_THAT(served.written.copy()[3].reply.message, HasSubstr("object_key = 00fe"));
    served.service.handle(by_key("before", "00ff"));  // a retry is tried anew
    ASSERT_TRUE(served.wait_for(5));
    EXPECT_EQ(served.statuses()[4], PlanStatus::kOk);
}

TEST(PlannerService, CountsWhatCouldNotBeWritten) {
    Watched<int> writes;
    PlannerService service(Served::one_worker(4), {{},
                                                   without_objects(plan_at_once),
                                                   [&](const auto& out) -> bool {
                                                       writes.change([](int& count) { ++count; });
                                                       if (out.reply.request_id == "thrown")
                                                           throw std::bad_alloc();
                                                       return out.reply.request_id != "refused";
                                                   },
                                                   {}});
    service.start();
    for (const char* id : {"thrown", "refused", "fine"}) service.handle(request(1, id));
    ASSERT_TRUE(writes.wait([](int count) { return count == 3; }));
    EXPECT_TRUE(service.stop(10s));
    EXPECT_EQ(service.counters().lost, 2u);
    EXPECT_EQ(service.counters().answers[static_cast<int>(PlanStatus::kOk)], 3u);
}

/// Every reply to 200 different requests as JSON, by request id.
std::map<std::string, std::string> replies_with(std::uint32_t workers) {
    ServerConfig config;
    config.workers = workers;
    config.queue_capacity = 1000;
    Served served(
        [](const PlanRequest& problem, const StopQuery&) {
            PlanReply reply = reply_to(problem, PlanStatus::kOk);
            const double x = std::stod(problem.request_id);
            for (int i = 1; i < 100; ++i) {
                Grasp grasp;
                grasp.score = std::sin(x * i);
                reply.grasps.push_back(grasp);
            }
            return reply;
        },
        config);
    for (int i = 0; i < 200; ++i) served.service.handle(request(1, std::to_string(i)));
    EXPECT_TRUE(served.wait_for(200));
    std::map<std::string, std::string> texts;
    for (const OutgoingReply& out : served.written.copy()) {
        texts[out.reply.request_id] = cli::write_json(out.reply, {}, {"", "", 0.0});
    }
    return texts;
}

TEST(PlannerService, OneAndManyWorkersGiveTheSameBytes) {
    const auto one = replies_with(1);
    EXPECT_EQ(one.size(), 200u);
    EXPECT_EQ(one, replies_with(4));
}

// Four threads send 4 x 500 requests, many of them retries, while the service is being stopped:
// whatever was received is answered or counted as lost, and nothing twice.
TEST(PlannerService, ExactlyOneAnswerForEachRequestWhateverHappens) {
    ServerConfig config;
    config.workers = 3;
    config.queue_capacity = 8;
    Served served(plan_at_once, config);
    {
        std::vector<std::jthread> senders;
        for (std::uint8_t writer = 0; writer < 4; ++writer) {
            senders.emplace_back([&served, writer] {
                for (int i = 0; i < 500; ++i) {
                    served.service.handle(request(writer, std::to_string(i % 50), i % 3 == 0));
                }
            });
        }
        ASSERT_TRUE(served.wait_for(200));
        EXPECT_TRUE(served.service.stop(10s));
    }
    const ServiceCounters end = served.service.counters();
    EXPECT_EQ(end.received, 2000u);
    EXPECT_EQ(end.open, 0u);
    EXPECT_EQ(served.statuses().size() + end.lost, 2000u);
    std::set<const IncomingRequest*> answered;
    for (const OutgoingReply& out : served.written.copy()) {
        EXPECT_TRUE(answered.insert(out.to.get()).second);
    }
}

}  // namespace
}  // namespace graspd::server
