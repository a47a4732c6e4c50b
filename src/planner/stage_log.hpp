#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "graspd/base/parallel.hpp"
#include "graspd/base/stop.hpp"
#include "graspd/planner/plan_types.hpp"

namespace graspd::planner_detail {

/// What the stages did and how long they took, in the order of their first call.
class StageLog {
public:
    /// Runs a stage and adds its wall time and its count of inputs, also when it is stopped.
    template <class Work>
    auto run(const char* name, std::uint64_t in, Work&& work) {
        const Timing timing{*this, name, in};
        return as_stage(name, std::forward<Work>(work));
    }
    /// Adds to a stage's counts, where the inputs are known only afterwards.
    void count(const char* name, std::uint64_t in, std::uint64_t out) {
        entry(name).in += in;
        entry(name).out += out;
    }
    /// Adds a stage that took its own time.
    void add(const StageReport& report) {
        StageReport& stage = entry(report.name);
        stage.ms += report.ms;
        stage.in += report.in;
        stage.out += report.out;
    }
    /// Adds to a stage's count of outputs.
    void out(const char* name, std::uint64_t count) { entry(name).out += count; }

    /// Adds another log's figures: of work that ran beside other work, so that the milliseconds are
    /// those of all threads together.
    void merge(const StageLog& other) {
        for (const StageReport& stage : other.stages_) add(stage);
    }

    const std::vector<StageReport>& stages() const { return stages_; }
    std::vector<StageReport> take() { return std::move(stages_); }

private:
    /// Adds to a stage when it goes.
    struct Timing {
        StageLog& log;
        const char* name;
        std::uint64_t in;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

        ~Timing() {
            const std::chrono::duration<double, std::milli> taken =
                std::chrono::steady_clock::now() - start;
            StageReport& stage = log.entry(name);
            stage.ms += taken.count();
            stage.in += in;
        }
    };

    StageReport& entry(const std::string& name) {
        const auto found = std::ranges::find(stages_, name, &StageReport::name);
        if (found != stages_.end()) return *found;
        stages_.push_back({name, 0.0, 0, 0});
        return stages_.back();
    }
    std::vector<StageReport> stages_;
};

/// Calls work(i, part) for every i below count, side by side, each with a log of its own; the parts
/// go to `log` in the order of i.
template <class Work>
void each_logged(std::size_t count, StageLog& log, Work&& work) {
    std::vector<StageLog> parts(count);
    for_blocks(count, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) work(i, parts[i]);
    });
    for (const StageLog& part : parts) log.merge(part);
}

}  // namespace graspd::planner_detail
