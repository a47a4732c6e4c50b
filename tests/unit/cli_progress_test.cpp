#include "progress.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace graspd::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using namespace std::chrono_literals;

// A quarter of 10 s: 6 of 24 columns.
TEST(Progress, BarIsTheShareOfTheBudget) {
    EXPECT_EQ(progress_line("planning", 2.5, 10.0, false),
              "planning [======                  ] 2.5 s of 10.0 s");
    EXPECT_EQ(progress_line("planning", 0.0, 10.0, false),
              "planning [                        ] 0.0 s of 10.0 s");
}

// A reply may come a little after its budget.
TEST(Progress, BarEndsAtItsFrame) {
    EXPECT_EQ(progress_line("planning", 10.3, 10.0, false),
              "planning [========================] 10.3 s of 10.0 s");
}

TEST(Progress, ColoursOnlyWhereTheyAreWanted) {
    EXPECT_THAT(progress_line("planning", 5.0, 10.0, true), HasSubstr("\033[32m====="));
    EXPECT_THAT(progress_line("planning", 5.0, 10.0, false), Not(HasSubstr("\033")));
}

TEST(Progress, WritesNothingWhereItIsNotShown) {
    std::ostringstream text;
    {
        Progress progress({text, false, true}, "planning", 1.0);
        std::this_thread::sleep_for(500ms);
    }
    EXPECT_THAT(text.str(), IsEmpty());
}

TEST(Progress, ShowsItsStagesAndLeavesAnEmptyLine) {
    std::ostringstream text;
    {
        Progress progress({text, true, false}, "looking", 10.0);
        std::this_thread::sleep_for(1s);  // long enough for a busy machine
        progress.next("waiting");
        std::this_thread::sleep_for(1s);
    }
    EXPECT_THAT(text.str(), StartsWith("\r\033[Klooking ["));
    EXPECT_THAT(text.str(), HasSubstr("\r\033[Kwaiting ["));
    EXPECT_THAT(text.str(), EndsWith("\r\033[K"));
}

// 0.3 s pass before the first drawing.
TEST(Progress, WhatIsQuickIsNotShown) {
    std::ostringstream text;
    { Progress progress({text, true, false}, "planning", 10.0); }
    EXPECT_THAT(text.str(), IsEmpty());
}

}  // namespace
}  // namespace graspd::cli
