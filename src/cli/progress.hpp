#pragma once

#include <chrono>
#include <condition_variable>
#include <iosfwd>
#include <mutex>
#include <string>
#include <thread>

namespace graspd::cli {

/// Where progress goes, and how.
struct ProgressPlace {
    std::ostream& to;
    bool shown = false;     ///< false: not a byte is written
    bool coloured = false;  ///< by terminal escapes
};

/// Standard error: shown if it is a terminal that can move its cursor (TERM is not dumb), coloured
/// unless NO_COLOR is set to something.
ProgressPlace progress_on_standard_error();

/// One line without its end: what goes on, a bar of the time budget, both times.
std::string progress_line(const std::string& what, double elapsed_s, double budget_s,
                          bool coloured);

/// Shows what goes on from 0.3 s after its start, ten times a second, until it is destroyed; then
/// the line is empty again. Draws in a thread of its own.
class Progress {
public:
    /// @param budget_s  [s] > 0, of everything together
    Progress(const ProgressPlace& place, std::string what, double budget_s);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The next stage begins.
    void next(const std::string& what);

private:
    void draw(const std::stop_token& stop);

    ProgressPlace place_;
    double budget_s_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::string what_;     ///< guarded by mutex_
    std::jthread thread_;  ///< last: it uses all of the above
};

}  // namespace graspd::cli
