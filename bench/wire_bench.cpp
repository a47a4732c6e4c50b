// What the wire costs: a request goes to a planner that does not plan and comes back with ten
// grasps.
//
//     wire_bench [PROFILE.xml] [--benchmark_filter=...]
//
// Both ends live in this process but talk over the profile's transport (default dds/loopback.xml;
// the profiles switch delivery within a process off). One round is: the client's conversion, the
// request's bytes over the transport, the guard, the planner's conversion of every field, the
// reply's bytes back and their conversion. Counters, medians of the rounds: convert_ms is the
// planner's conversion.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "graspd/base/freed_memory.hpp"
#include "graspd/config/profile_directory.hpp"
#include "graspd/dds/planner_client.hpp"
#include "graspd/dds/planner_port.hpp"
#include "meter.hpp"
#include "support/shapes.hpp"
#include "value_of.hpp"

namespace {

using namespace graspd;
using bench::ms_since;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kGrasps = 10;  // as a reply has by default
constexpr std::uint32_t kDomain = 214;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return values.empty() ? 0.0 : *middle;
}

/// Converts every request and answers with grasps that nobody planned.
class Echo {
public:
    explicit Echo(const DdsSettings& settings)
        : port_(bench::value_of(PlannerPort::open(settings, [this](auto request) {
              const auto start = Clock::now();
              const auto converted = request->convert({});
              convert_ms_.push_back(ms_since(start));
              OutgoingReply out;
              out.to = std::move(request);
              out.reply.status = converted.ok() ? PlanStatus::kOk : PlanStatus::kInternalError;
              out.reply.grasps.resize(kGrasps);
              port_->write(out);
          }))) {}
    ~Echo() { port_->stop_listening(); }

    std::vector<double> take_convert_ms() { return std::exchange(convert_ms_, {}); }

private:
    std::vector<double> convert_ms_;
    std::unique_ptr<PlannerPort> port_;
};

void round_trips(benchmark::State& state, Echo& echo, PlannerClient& client) {
    PlanRequest request;
    request.frame_id = "table";
    const auto mesh = test::torus(0.05, 0.015, static_cast<std::size_t>(state.range(0)));
    state.counters["kB"] =
        1e-3 * static_cast<double>(24 * mesh.vertices.size() + 12 * mesh.faces.size());
    request.object_O = mesh;
    request.grippers = {Gripper{}};
    request.grippers[0].name = "claw";
    echo.take_convert_ms();
    std::size_t number = 0;
    for (auto _ : state) {
        request.request_id = std::to_string(state.range(0)) + "-" + std::to_string(number++);
        const auto reply = client.request(request, std::chrono::seconds(10), 0);
        if (!reply.ok() || reply.value().status != PlanStatus::kOk) {
            state.SkipWithError("no reply");
            break;
        }
    }
    state.counters["convert_ms"] = median(echo.take_convert_ms());
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    keep_freed_memory(kFreedMemory_bytes);  // as the daemon
    try {
        DdsSettings settings;
        settings.domain = kDomain;
        settings.profile_file =
            argc > 1 ? argv[1]
                     : (bench::value_of(find_profiles()) / "dds" / "loopback.xml").string();
        Echo echo(settings);
        const auto client = bench::value_of(PlannerClient::open(settings, "wire_bench"));
        if (!client->wait_for_planner(std::chrono::seconds(10))) {
            std::cerr << "wire_bench: the two ends did not find each other\n";
            return 1;
        }
        benchmark::RegisterBenchmark(
            "round_trip", [&](benchmark::State& state) { round_trips(state, echo, *client); })
            ->Arg(12)
            ->Arg(16000)
            ->Arg(210000)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
        benchmark::RunSpecifiedBenchmarks();
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "wire_bench: " << error.what() << '\n';
        return 1;
    }
}
