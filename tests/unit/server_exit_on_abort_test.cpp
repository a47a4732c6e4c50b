#include "exit_on_abort.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace graspd::server {
namespace {

void abort_after(int code) {
    exit_on_abort(code);
    std::abort();
}

TEST(ExitOnAbort, TheCodeIsTheOneGiven) {
    EXPECT_EXIT(abort_after(0), testing::ExitedWithCode(0), "event=aborted");
    EXPECT_EXIT(abort_after(1), testing::ExitedWithCode(1), "event=aborted");
    EXPECT_EXIT(std::abort(), testing::KilledBySignal(SIGABRT), "");
}

}  // namespace
}  // namespace graspd::server
