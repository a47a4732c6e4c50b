#include "work_share.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "make_reply.hpp"
#include "server_fakes.hpp"

// Two and three planners are played by objects that see each other as the wire would let them.

namespace graspd::server {
namespace {

using namespace std::chrono_literals;
using test::request;
using testing::ElementsAre;
using testing::IsEmpty;
using Clock = WorkShare::Clock;

const Clock::time_point kStart = Clock::now();
const Clock::time_point kReady = kStart + WorkShare::kSettle + WorkShare::kHeard;

ShareConfig shared() {
    ShareConfig config;
    config.enabled = true;
    return config;
}

GuidBytes guid(std::uint8_t number) {
    GuidBytes out{};
    out[0] = number;
    return out;
}

/// A planner that notes what it is to plan.
struct Planner {
    explicit Planner(std::uint8_t number, const ShareConfig& config = shared())
        : id(guid(number)),
          share(
              config,
              [this](auto given, bool late) {
                  (late ? taken_over : planned).push_back(given->identity().request_id);
                  last = std::move(given);
              },
              kStart) {
        share.set_self(id);
    }
    std::vector<std::string> all() const {
        auto out = planned;
        out.insert(out.end(), taken_over.begin(), taken_over.end());
        std::ranges::sort(out);
        return out;
    }

    GuidBytes id;
    std::vector<std::string> planned;
    std::vector<std::string> taken_over;
    std::unique_ptr<IncomingRequest> last;
    WorkShare share;
};

/// Planners that have settled and know each other.
struct Team {
    explicit Team(std::uint8_t count, const ShareConfig& config = shared()) {
        for (std::uint8_t i = 0; i < count; ++i) {
            planners.push_back(std::make_unique<Planner>(i, config));
        }
        for (auto& one : planners) {
            for (auto& other : planners) {
                if (one != other) one->share.see(other->id, true, kStart);
            }
            one->share.tick(kReady);
        }
    }
    Planner& operator[](std::size_t at) { return *planners[at]; }
    void send(const std::string& id) {
        for (auto& planner : planners) planner->share.receive(request(1, id), kReady);
    }
    /// Sends requests until one falls to the planner. @return its id
    std::string send_to(std::size_t at) {
        for (int i = 0; i < 1000; ++i) {
            const std::string id = "r" + std::to_string(sent++);
            send(id);
            if (!planners[at]->planned.empty() && planners[at]->planned.back() == id) return id;
        }
        return "none fell to it";
    }
    void lose(std::size_t at) {
        for (auto& planner : planners) {
            if (planner != planners[at]) planner->share.see(planners[at]->id, false, kReady);
        }
    }

    std::vector<std::unique_ptr<Planner>> planners;
    int sent = 0;
};

std::string key_of(const std::string& id) {
    return request(1, id)->reply_key();
}

TEST(WorkShare, SwitchedOffItLetsEverythingThroughAtOnce) {
    Planner alone(1, ShareConfig{});
    alone.share.receive(request(1, "a"), kStart);
    EXPECT_THAT(alone.planned, ElementsAre("a"));
    EXPECT_TRUE(alone.share.tick(kStart));
    EXPECT_EQ(alone.share.counters().held, 0u);
}

TEST(WorkShare, EachRequestIsPlannedByOneOfTheTeam) {
    Team team(3);
    std::vector<std::string> sent;
    for (int i = 0; i < 300; ++i) team.send(sent.emplace_back("r" + std::to_string(i)));
    std::vector<std::string> planned;
    for (auto& planner : team.planners) {
        EXPECT_GT(planner->planned.size(), 50u);
        EXPECT_EQ(planner->share.counters().peers, 2u);
        EXPECT_EQ(planner->share.counters().held, 300 - planner->planned.size());
        planned.insert(planned.end(), planner->planned.begin(), planner->planned.end());
    }
    std::ranges::sort(sent);
    std::ranges::sort(planned);
    EXPECT_EQ(planned, sent);
}

TEST(WorkShare, OneThatStartsHoldsEverythingUntilItKnowsTheOthers) {
    Planner fresh(1);
    fresh.share.receive(request(1, "a"), kStart);
    EXPECT_FALSE(fresh.share.tick(kStart + WorkShare::kSettle - 1ms));
    EXPECT_TRUE(fresh.share.tick(kStart + WorkShare::kSettle));
    EXPECT_THAT(fresh.planned, IsEmpty());
    const auto late = kReady + 5ms;
    EXPECT_TRUE(fresh.share.tick(late));
    EXPECT_THAT(fresh.planned, ElementsAre("a"));
    EXPECT_THAT(fresh.taken_over, IsEmpty());
    EXPECT_EQ(fresh.last->received(), late) << "its time budget counts from here";
}

TEST(WorkShare, OneThatStartsBesideOthersLeavesThemTheirs) {
    Team team(1);
    Planner fresh(7);
    fresh.share.see(team[0].id, true, kStart);
    team.send("a");
    fresh.share.receive(request(1, "a"), kStart);
    fresh.share.answered(key_of("a"), kStart);
    fresh.share.tick(kReady);
    EXPECT_THAT(team[0].planned, ElementsAre("a"));
    EXPECT_THAT(fresh.all(), IsEmpty());
}

TEST(WorkShare, TheRequestsOfALostOneFallToTheOthersOnce) {
    Team team(3);
    const std::string id = team.send_to(0);
    team.lose(0);
    EXPECT_EQ(
        std::ranges::count(team[1].taken_over, id) + std::ranges::count(team[2].taken_over, id), 1);
    EXPECT_EQ(team[1].share.counters().taken_over + team[2].share.counters().taken_over,
              team[0].planned.size());
}

TEST(WorkShare, WhatWasAnsweredIsNotTakenOver) {
    Team team(2);
    const std::string id = team.send_to(0);
    for (const auto& planned : team[0].planned) team[1].share.answered(key_of(planned), kReady);
    team.lose(0);
    EXPECT_THAT(team[1].taken_over, IsEmpty());
    EXPECT_EQ(team[1].share.counters().held, 0u);
}

TEST(WorkShare, AReplyMayComeBeforeItsRequest) {
    Team team(2);
    const std::string id = team.send_to(0);
    for (const auto& planned : team[0].planned) team[1].share.answered(key_of(planned), kReady);
    Team late(2);
    late[1].share.answered(key_of(id), kReady);
    late.send(id);
    EXPECT_EQ(late[1].share.counters().held, 0u);
    late.lose(0);
    EXPECT_THAT(late[1].taken_over, IsEmpty());
}

TEST(WorkShare, AnEarlyReplyIsForgottenAfterASecond) {
    Team team(2);
    const std::string id = team.send_to(0);
    Team later(2);
    later[1].share.answered(key_of(id), kReady - 1s);
    later.send(id);
    EXPECT_EQ(later[1].share.counters().held, 1u);
}

TEST(WorkShare, OneThatDoesNotAnswerInTimeIsPassedOver) {
    Team team(2);
    const std::string id = team.send_to(0);
    const auto due = deadline_of(*request(1, id)) + WorkShare::kPatience;
    team[1].share.tick(due - 1s);
    EXPECT_THAT(team[1].taken_over, IsEmpty());
    team[1].share.tick(due + 1s);
    EXPECT_THAT(team[1].taken_over, testing::Contains(id));
    EXPECT_EQ(team[1].last->received(), due + 1s);
}

// The first of the two that could take it over has failed as well.
TEST(WorkShare, ItFallsToOneAfterTheOther) {
    Team team(3);
    const std::string id = team.send_to(0);
    auto now = deadline_of(*request(1, id)) + WorkShare::kPatience + 1s;
    team[1].share.tick(now);
    team[2].share.tick(now);
    const std::size_t first = std::ranges::count(team[1].taken_over, id) == 1 ? 1 : 2;
    const std::size_t second = 3 - first;
    EXPECT_EQ(std::ranges::count(team[second].taken_over, id), 0);
    now += 1h;
    team[second].share.tick(now);
    EXPECT_EQ(std::ranges::count(team[second].taken_over, id), 1);
}

TEST(WorkShare, OneThatComesBackTakesItsShareAgain) {
    Team team(2);
    team.lose(0);
    team.send("while away");
    EXPECT_THAT(team[1].planned, testing::Contains("while away"));
    team[1].share.see(team[0].id, true, kReady);
    const std::size_t before = team[1].planned.size();
    team.send_to(0);
    EXPECT_GE(team[1].share.counters().held, 1u);
    EXPECT_GE(team[1].planned.size(), before);
}

TEST(WorkShare, RetriesAreHeldAndAnsweredEach) {
    Team team(2);
    const std::string id = team.send_to(0);
    const auto held = team[1].share.counters().held;
    team.send(id);
    EXPECT_EQ(team[1].share.counters().held, held + 1);
    team[1].share.answered(key_of(id), kReady);
    EXPECT_EQ(team[1].share.counters().held, held);
    team.lose(0);
    EXPECT_EQ(std::ranges::count(team[1].taken_over, id), 1);
}

TEST(WorkShare, CallsOfACallerThatLeftAreForgottenTopicRequestsAreNot) {
    Team team(2);
    std::string by_topic = team.send_to(0);
    auto call = request(1, by_topic);
    call->call = true;
    team[1].share.receive(std::move(call), kReady);
    const auto held = team[1].share.counters().held;
    team[1].share.drop(request(2, "x")->identity().writer);
    EXPECT_EQ(team[1].share.counters().held, held);
    team[1].share.drop(request(1, "x")->identity().writer);
    EXPECT_EQ(team[1].share.counters().held, held - 1);
}

TEST(WorkShare, TheOldestAreForgottenWhereThereIsNoRoom) {
    ShareConfig config = shared();
    config.max_held_requests = 2;
    Team team(2, config);
    std::vector<std::string> ids;
    for (int i = 0; i < 3; ++i) ids.push_back(team.send_to(0));
    EXPECT_EQ(team[1].share.counters().held, 2u);
    EXPECT_EQ(team[1].share.counters().forgotten, 1u);
    team.lose(0);
    EXPECT_THAT(team[1].taken_over, ElementsAre(ids[1], ids[2]));
}

// 100,000 faces of 12 bytes are beyond a megabyte.
TEST(WorkShare, BytesAreLimitedToo) {
    ShareConfig config = shared();
    config.max_held_bytes = 1u << 20;
    Team team(2, config);
    const std::string id = team.send_to(0);
    auto large = request(1, id);
    large->counted.faces = 100000;
    team[1].share.receive(std::move(large), kReady);
    EXPECT_EQ(team[1].share.counters().held, 0u);
    EXPECT_EQ(team[1].share.counters().forgotten, 2u);
}

TEST(WorkShare, OneThatLeavesTakesNoMoreAndTellsWhetherOthersAreLeft) {
    Team team(2);
    EXPECT_TRUE(team[0].share.leave());
    const auto before = team[0].all();
    for (int i = 0; i < 20; ++i) team.send("late" + std::to_string(i));
    EXPECT_EQ(team[0].all(), before);
    EXPECT_FALSE(team[0].share.tick(kReady + 1h));
    team.lose(0);
    EXPECT_FALSE(team[1].share.leave());
}

// Nobody else answers what came before it began.
TEST(WorkShare, TheLastOneThatLeavesAnswersWhatItHolds) {
    Planner alone(1);
    alone.share.receive(request(1, "a"), kStart);
    EXPECT_FALSE(alone.share.leave());
    EXPECT_THAT(alone.planned, ElementsAre("a"));
}

}  // namespace
}  // namespace graspd::server
