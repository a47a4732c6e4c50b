#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "exit_code.hpp"
#include "support/shapes.hpp"
#include "write_simulation.hpp"

namespace graspd::cli {
namespace {

/// Runs `graspctl simulate` on a mesh.
struct Command {
    std::filesystem::path place = std::filesystem::path(testing::TempDir()) /
                                  ("graspd_simulate_" + std::to_string(::getpid()));
    PlanArguments plan;
    SimulateArguments simulate;
    OutputArguments output{"json", (place / "out.json").string(), ""};

    explicit Command(const TriangleMesh& mesh) {
        std::filesystem::create_directories(place);
        plan.object.file = (place / "object.off").string();
        std::ofstream off(plan.object.file);
        off << "OFF\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
        for (const auto& v : mesh.vertices) off << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
        for (const auto& f : mesh.faces) {
            off << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
        }
    }
    int run() const { return run_simulate(plan, "", simulate, output); }
    nlohmann::json result() const {
        std::ifstream stream(output.out);
        return nlohmann::json::parse(stream);
    }
};

// 40 x 50 x 60 mm of 500 kg/m3 weigh 0.06 kg; every good grasp of it holds.
TEST(SimulateCommand, PlansAndExecutesTheBestGrasp) {
    const Command command(test::box({0.04, 0.05, 0.06}));
    EXPECT_EQ(command.run(), kExitOk);
    const auto json = command.result();
    EXPECT_EQ(json["schema"], "graspd/1");
    EXPECT_EQ(json["status"], "OK");
    EXPECT_FALSE(json["grasps"].empty());
    const auto& run = json["simulation"];
    EXPECT_EQ(run["verdict"], "holds");
    EXPECT_EQ(run["phase"], "shake");
    EXPECT_EQ(run["rank"], 1);
    EXPECT_NEAR(run["mass"].get<double>(), 0.06, 1e-6);
    EXPECT_EQ(run["grip_force"], 20.0);
    EXPECT_EQ(run["friction"], 0.6);
    EXPECT_LT(run["shift"].get<double>(), 0.02);
}

// No hand of ours opens by 0.5 m: the reply says why there is no grasp, as `plan` does.
TEST(SimulateCommand, SaysWhyThereIsNoGrasp) {
    const Command command(test::box({0.5, 0.5, 0.5}));
    EXPECT_EQ(command.run(), kExitNoGrasp);
    EXPECT_EQ(command.result()["status"], "NO_GRASP");
    EXPECT_FALSE(command.result().contains("simulation"));
}

TEST(SimulateCommand, LineSaysVerdictAndFigures) {
    PlanReply reply;
    reply.request_id = "mug";
    reply.grasps.resize(3);
    reply.grasps[1].score = 0.5;
    SimulationRun run;
    run.rank = 2;
    run.result.verdict = GraspVerdict::kSlips;
    run.result.detail = "it moved";
    run.result.shift_m = 0.0214;
    run.result.turn_rad = 0.5;
    run.config.mass_kg = 0.25;
    EXPECT_EQ(write_simulation_line(reply, run),
              "mug: slips: grasp 2 of 3 (score 0.500), 0.250 kg, 20.0 N a finger, friction 0.60: "
              "it moved, moved 21.4 mm and 28.6 degrees in the hand\n");
}

}  // namespace
}  // namespace graspd::cli
