#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <utility>

namespace graspd::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kFirstDrawing = 300ms;  // what is quicker needs no bar
constexpr auto kPeriod = 100ms;
constexpr int kBarColumns = 24;
constexpr const char* kStartOfEmptyLine = "\r\033[K";
constexpr const char* kGreen = "\033[32m";
constexpr const char* kPlain = "\033[0m";

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

std::string seconds(double value_s) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f s", value_s);
    return text;
}

}  // namespace

ProgressPlace progress_on_standard_error() {
    const bool shown = ::isatty(STDERR_FILENO) == 1 && variable("TERM") != "dumb";
    return {std::cerr, shown, variable("NO_COLOR").empty()};
}

std::string progress_line(const std::string& what, double elapsed_s, double budget_s,
                          bool coloured) {
    const double share = std::clamp(elapsed_s / budget_s, 0.0, 1.0);
    const auto done = static_cast<std::size_t>(share * kBarColumns);
    const std::string bar = std::string(done, '=') + std::string(kBarColumns - done, ' ');
    return what + " [" + (coloured ? kGreen + bar + kPlain : bar) + "] " + seconds(elapsed_s) +
           " of " + seconds(budget_s);
}

Progress::Progress(const ProgressPlace& place, std::string what, double budget_s)
    : place_(place), budget_s_(budget_s), what_(std::move(what)) {
    if (place.shown) thread_ = std::jthread([this](const std::stop_token& stop) { draw(stop); });
}

Progress::~Progress() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
}

void Progress::next(const std::string& what) {
    const std::lock_guard lock(mutex_);
    what_ = what;
}

void Progress::draw(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    auto wait = kFirstDrawing;
    bool drawn = false;
    while (!wake_.wait_for(lock, stop, wait, [] { return false; }) && !stop.stop_requested()) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
        place_.to << kStartOfEmptyLine
                  << progress_line(what_, elapsed.count(), budget_s_, place_.coloured)
                  << std::flush;
        drawn = true;
        wait = kPeriod;
    }
    if (drawn) place_.to << kStartOfEmptyLine << std::flush;
}

}  // namespace graspd::cli
