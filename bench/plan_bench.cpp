// How long whole plans take in a process that runs for long, as the daemon does, and in which
// stages:
//
//   plan_bench [--runs N] [--gripper NAME] [--config PLANNER.yaml] [--prepared] FILE...
//
// One warm-up, then N runs a file (default 11). A line a file with the median of the whole, then a
// line a stage: median and most over the files of each file's median. Stages that run on several
// threads at a time add up their threads' times, so they can add up to more than the whole.
// With --prepared each run is followed by one of the same request about the object as the run
// before prepared it: a second column, what share of the first it takes, and the prepared object's
// memory.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "graspd/base/freed_memory.hpp"
#include "graspd/config/load_config.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/mesh/read_object.hpp"
#include "graspd/planner/planner.hpp"
#include "value_of.hpp"

namespace {

using namespace graspd;
using bench::value_of;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Milliseconds by stage, "total" among them, one value a run.
using Times = std::map<std::string, std::vector<double>>;

void add_plan(Times& times, const PlanRequest& request, PreparedObjectPtr& object,
              const PlannerConfig& config) {
    const auto start = std::chrono::steady_clock::now();
    const PlanReply reply = plan(request, object, config);
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    times["total"].push_back(taken.count());
    for (const StageReport& stage : reply.report.stages) times[stage.name].push_back(stage.ms);
}

/// Of plans that prepare the object and of plans that need not, in turn.
struct Measured {
    Times cold, warm;
    double prepared_MB = 0.0;  ///< that the prepared object takes
};
Measured measure(const PlanRequest& request, const PlannerConfig& config, int runs,
                 bool also_prepared) {
    Measured out;
    for (int run = -1; run < runs; ++run) {
        Times warm_up;
        PreparedObjectPtr object;
        add_plan(run < 0 ? warm_up : out.cold, request, object, config);
        if (also_prepared) add_plan(run < 0 ? warm_up : out.warm, request, object, config);
        if (object) out.prepared_MB = 1e-6 * static_cast<double>(memory_bytes(*object));
    }
    return out;
}

}  // namespace

int main(int count, char** arguments) {
    CLI::App app("times of whole plans");
    int runs = 11;
    std::string gripper_name = "parallel_85";
    std::string config_file;
    bool prepared = false;
    std::vector<std::string> files;
    app.add_option("--runs", runs)->check(CLI::PositiveNumber);
    app.add_option("--gripper", gripper_name);
    app.add_option("--config", config_file);
    app.add_flag("--prepared", prepared);
    app.add_option("FILE", files)->required();
    CLI11_PARSE(app, count, arguments);

    keep_freed_memory(kFreedMemory_bytes);  // as the daemon does
    PlannerConfig config;
    if (!config_file.empty()) config = value_of(load_config<PlannerConfig>(config_file));
    PlanRequest request;
    request.grippers = {
        value_of(find_gripper(gripper_name, value_of(find_profiles()) / "grippers"))};
    std::map<std::string, std::vector<double>> medians;
    std::vector<double> shares;
    for (const std::string& file : files) {
        request.object_O = value_of(read_object(file)).object;
        auto [cold, warm, prepared_MB] = measure(request, config, runs, prepared);
        const double total_ms = median(cold["total"]);
        std::printf("%-40s %8.1f ms", std::filesystem::path(file).filename().c_str(), total_ms);
        if (prepared) {
            const double prepared_ms = median(warm["total"]);
            std::printf(" %8.1f ms prepared (%4.2f, %.1f MB)", prepared_ms, prepared_ms / total_ms,
                        prepared_MB);
            shares.push_back(prepared_ms / total_ms);
        }
        std::printf("\n");
        for (const auto& [stage, ms] : prepared ? warm : cold) medians[stage].push_back(median(ms));
    }
    if (prepared) std::printf("prepared over cold, median %.2f\n", median(shares));
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [stage, ms] : medians) order.emplace_back(median(ms), stage);
    std::ranges::sort(order, std::ranges::greater{});
    for (const auto& [ms, stage] : order) {
        std::printf("  %-38s %8.2f ms, at most %8.2f\n", stage.c_str(), ms,
                    std::ranges::max(medians[stage]));
    }
}
