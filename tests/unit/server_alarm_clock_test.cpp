#include "alarm_clock.hpp"

#include <gmock/gmock.h>

#include <string>
#include <thread>
#include <vector>

#include "server_fakes.hpp"

namespace graspd::server {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using Clock = std::chrono::steady_clock;

TEST(AlarmClock, RingsInTheOrderOfTimesAndNotBefore) {
    test::Watched<std::vector<std::string>> rung;
    AlarmClock clock;
    const auto start = Clock::now();
    const auto ring = [&](const char* name, Clock::time_point when) {
        return clock.set(when, [&rung, name, when] {
            EXPECT_GE(Clock::now(), when);
            rung.change([&](auto& list) { list.emplace_back(name); });
        });
    };
    ring("third", start + 20ms);
    ring("first", start - 1h);
    ring("second", start + 10ms);
    const auto forgotten = ring("forgotten", start + 15ms);
    clock.forget(forgotten);
    ASSERT_TRUE(rung.wait([](const auto& list) { return list.size() == 3; }));
    EXPECT_THAT(rung.copy(), ElementsAre("first", "second", "third"));
}

// The clock's thread waits without a limit when nothing is set.
TEST(AlarmClock, WakesFromHavingNothingToDo) {
    test::Watched<int> rings;
    AlarmClock clock;
    for (int n = 1; n <= 3; ++n) {
        std::this_thread::sleep_for(20ms);
        clock.set(Clock::now() + 1ms, [&] { rings.change([](int& count) { ++count; }); });
        ASSERT_TRUE(rings.wait([n](int count) { return count == n; }));
    }
}

TEST(AlarmClock, MayBeSetAndForgottenFromAnAlarmAndAfterTheEnd) {
    test::Watched<int> rings;
    AlarmClock clock;
    const auto late = clock.set(Clock::now() + 1h, [] { FAIL() << "in an hour"; });
    clock.set(Clock::now(), [&] {
        clock.forget(late);
        clock.set(Clock::now(), [&] { rings.change([](int& count) { ++count; }); });
    });
    EXPECT_TRUE(rings.wait([](int count) { return count == 1; }));
    clock.stop();
    clock.set(Clock::now(), [] { FAIL() << "after the end"; });
    clock.forget(late);
    clock.stop();
}

}  // namespace
}  // namespace graspd::server
