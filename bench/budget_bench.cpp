// How late plan() ends when its time budget is over, and what planning takes at most.
//
//   budget_bench [--faces N,...] [--budgets MS,...] [--runs N] [--gripper NAME] [SHAPE...]
//   budget_bench --gaps MS SHAPE/FACES      places that do not ask for so long, with the call stack
//   budget_bench --peak SHAPE/FACES|FILE    most memory of one plan, beside the object itself
//
// Shapes are those of the concavity's tests (cup, sphere, bowl, ...). A line a mesh and budget: how
// often it was stopped, median and greatest overrun, and the stage of the greatest one. An overrun
// is from the budget's end to the reply, and none for a plan that ended within it.
#include <execinfo.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

#include "bench_meshes.hpp"
#include "graspd/base/freed_memory.hpp"
#include "graspd/config/load_gripper.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/planner/planner.hpp"
#include "meter.hpp"
#include "value_of.hpp"

namespace {

using namespace graspd;
using bench::ms_since;
using bench::peak_mb;
using bench::value_of;
using Clock = std::chrono::steady_clock;

struct Overrun {
    double ms = 0.0;
    bool stopped = false;
    std::string message;
};

Overrun overrun_of(const PlanRequest& request, double budget_ms) {
    const auto start = Clock::now();
    const PlanReply reply = plan(request, {}, [&] { return ms_since(start) >= budget_ms; });
    const double late_ms = ms_since(start) - budget_ms;
    return {std::max(0.0, late_ms), reply.status == PlanStatus::kPartial, reply.message};
}

void print_overruns(const PlanRequest& request, const std::string& name, double budget_ms,
                    int runs) {
    std::vector<Overrun> all;
    for (int run = 0; run < runs; ++run) all.push_back(overrun_of(request, budget_ms));
    std::ranges::sort(all, {}, &Overrun::ms);
    const auto stopped = std::ranges::count(all, true, &Overrun::stopped);
    const std::string& text = all.back().message;
    std::printf("%-16s %6.0f ms  stopped %2d/%2d  median %6.1f  worst %6.1f ms  %s\n", name.c_str(),
                budget_ms, static_cast<int>(stopped), runs, all[all.size() / 2].ms, all.back().ms,
                text.substr(0, text.find(';')).c_str());
    std::fflush(stdout);
}

/// Writes the call stack at every place that asks for the first time after `gap_ms`.
class GapWatch {
public:
    explicit GapWatch(double gap_ms) : gap_ms_(gap_ms) {}

    bool operator()() {
        thread_local Clock::time_point last = Clock::now();
        const double gap_ms = ms_since(last);
        last = Clock::now();
        if (gap_ms < gap_ms_) return false;
        const std::scoped_lock lock(mutex_);
        std::array<void*, 24> frames{};
        const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
        std::printf("gap of %.1f ms before\n", gap_ms);
        std::fflush(stdout);
        backtrace_symbols_fd(frames.data(), count, STDOUT_FILENO);
        last = Clock::now();
        return false;
    }

private:
    double gap_ms_;
    std::mutex mutex_;
};

}  // namespace

int main(int count, char** arguments) {
    CLI::App app("time budgets and memory of whole plans");
    std::vector<std::string> faces = {"1000", "100000", "1000000", "2100000"};
    std::vector<double> budgets_ms = {1, 10, 50, 200, 1000, 5000};
    std::vector<std::string> shapes;
    std::string gripper = "parallel_85";
    int runs = 5;
    double gaps_ms = 0.0;
    bool peak = false;
    app.add_option("--faces", faces)->delimiter(',');
    app.add_option("--budgets", budgets_ms)->delimiter(',');
    app.add_option("--runs", runs)->check(CLI::PositiveNumber);
    app.add_option("--gripper", gripper);
    app.add_option("--gaps", gaps_ms);
    app.add_flag("--peak", peak);
    app.add_option("SHAPE", shapes)->required();
    CLI11_PARSE(app, count, arguments);

    keep_freed_memory(kFreedMemory_bytes);  // as the daemon does
    PlanRequest request;
    request.request_id = "bench";
    request.grippers = {value_of(find_gripper(gripper, value_of(find_profiles()) / "grippers"))};
    for (const std::string& shape : shapes) {
        if (peak || gaps_ms > 0.0) {
            request.object_O = value_of(bench::bench_mesh(shape));
            const auto& mesh = std::get<TriangleMesh>(request.object_O);
            const double before_mb = peak_mb();
            GapWatch watch(gaps_ms);
            const auto start = Clock::now();
            const PlanReply reply =
                gaps_ms > 0.0 ? plan(request, {}, std::ref(watch)) : plan(request, {});
            std::printf("%-16s %zu vertices %zu faces  %s  %.0f ms  peak %.0f MB over %.0f MB\n",
                        shape.c_str(), mesh.vertices.size(), mesh.faces.size(),
                        to_string(reply.status), ms_since(start), peak_mb() - before_mb, before_mb);
            continue;
        }
        for (const std::string& many : faces) {
            const std::string name = shape + "/" + many;
            request.object_O = value_of(bench::bench_mesh(name));
            for (const double budget_ms : budgets_ms) {
                print_overruns(request, name, budget_ms, runs);
            }
        }
    }
    return 0;
}
