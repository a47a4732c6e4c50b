// How long whole plans take in a process that runs for long, as the daemon does, and in which
// stages:
//
//   plan_bench [--runs N] [--gripper NAME] [--config PLANNER.yaml] FILE...
//
// One warm-up, then N runs a file (default 11). A line a file with the median of the whole, then a
// line a stage: median and most over the files of each file's median. Stages that run on several
// threads at a time add up their threads' times, so they can add up to more than the whole.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
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
std::map<std::string, std::vector<double>> measure(const PlanRequest& request,
                                                   const PlannerConfig& config, int runs) {
    std::map<std::string, std::vector<double>> ms;
    for (int run = -1; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        const PlanReply reply = plan(request, config);
        const std::chrono::duration<double, std::milli> taken =
            std::chrono::steady_clock::now() - start;
        if (run < 0) continue;
        ms["total"].push_back(taken.count());
        for (const StageReport& stage : reply.report.stages) ms[stage.name].push_back(stage.ms);
    }
    return ms;
}

}  // namespace

int main(int count, char** arguments) {
    CLI::App app("times of whole plans");
    int runs = 11;
    std::string gripper_name = "parallel_85";
    std::string config_file;
    std::vector<std::string> files;
    app.add_option("--runs", runs)->check(CLI::PositiveNumber);
    app.add_option("--gripper", gripper_name);
    app.add_option("--config", config_file);
    app.add_option("FILE", files)->required();
    CLI11_PARSE(app, count, arguments);

    keep_freed_memory(kFreedMemory_bytes);  // as the daemon does
    PlannerConfig config;
    if (!config_file.empty()) config = value_of(load_config<PlannerConfig>(config_file));
    PlanRequest request;
    request.grippers = {
        value_of(find_gripper(gripper_name, value_of(find_profiles()) / "grippers"))};
    std::map<std::string, std::vector<double>> medians;
    for (const std::string& file : files) {
        request.object_O = value_of(read_object(file)).object;
        for (const auto& [stage, ms] : measure(request, config, runs)) {
            medians[stage].push_back(median(ms));
        }
        std::printf("%-40s %8.1f ms\n", std::filesystem::path(file).filename().c_str(),
                    medians["total"].back());
    }
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [stage, ms] : medians) order.emplace_back(median(ms), stage);
    std::ranges::sort(order, std::ranges::greater{});
    for (const auto& [ms, stage] : order) {
        std::printf("  %-38s %8.2f ms, at most %8.2f\n", stage.c_str(), ms,
                    std::ranges::max(medians[stage]));
    }
}
