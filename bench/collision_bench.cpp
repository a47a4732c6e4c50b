#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench_main.hpp"
#include "bench_meshes.hpp"
#include "graspd/base/gripper.hpp"
#include "graspd/collision/gripper_collision.hpp"
#include "support/shapes.hpp"

// How many poses of a whole gripper (palm and two fingers, free or not) are checked in a second:
//     collision_bench [--benchmark_filter=REGEX] [FILE...]
// For every object: hands in any pose near it, up to the first part that hits; the same with every
// part asked; hands drawn back until they are just free, by 0.1 mm, which are the dearest; and the
// clearances of these.

namespace {

using namespace graspd;
using Eigen::Vector3d;

constexpr std::size_t kPoses = 4096;

double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1.0p-53;
}
Vector3d random_vector(std::mt19937_64& random) {
    return 2.0 * Vector3d(fraction(random), fraction(random), fraction(random)) - Vector3d::Ones();
}

using Hand = std::vector<OrientedBox>;  // palm, left finger, right finger

/// A parallel_85 whose TCP stands within 20 mm of the surface, in any direction, open by any width.
Hand random_hand(const TriangleMesh& mesh, std::mt19937_64& random) {
    Eigen::Isometry3d X_WG(
        Eigen::AngleAxisd(std::acos(-1.0) * fraction(random), random_vector(random).normalized()));
    X_WG.translation() =
        mesh.vertices[random() % mesh.vertices.size()] + 0.02 * random_vector(random);
    const Gripper gripper;
    Hand hand;
    for (const GripperPart& part :
         gripper_parts(gripper, 0.0, (0.2 + 0.8 * fraction(random)) * gripper.max_width_m)) {
        OrientedBox box{X_WG, 0.5 * part.box_G.sizes()};
        box.pose.translation() = X_WG * part.box_G.center();
        hand.push_back(box);
    }
    return hand;
}

/// An object with hands around it.
struct Scene {
    explicit Scene(TriangleMesh m) : mesh(std::move(m)), tree(mesh, 1e-7) {
        world.object = {&mesh, &tree};
        std::mt19937_64 random(1);
        while (hands.size() < kPoses) hands.push_back(random_hand(mesh, random));
        for (const Hand& hand : hands) {
            if (!is_free(hand)) just_free.push_back(drawn_back(hand));
        }
    }
    /// Back along Gz until it is just free.
    Hand drawn_back(const Hand& hand) const {
        constexpr double kFar_m = 1.0, kExact_m = 1e-4;
        double hitting_m = 0.0, free_m = kFar_m;
        while (free_m - hitting_m > kExact_m) {
            const double middle_m = 0.5 * (hitting_m + free_m);
            (is_free(moved(hand, middle_m)) ? free_m : hitting_m) = middle_m;
        }
        return moved(hand, free_m);
    }
    static Hand moved(Hand hand, double back_m) {
        for (OrientedBox& box : hand) {
            box.pose.translation() -= back_m * box.pose.linear().col(2);
        }
        return hand;
    }
    bool is_free(const Hand& hand) const {
        for (const OrientedBox& box : hand) {
            if (find_collision(world, box)) return false;
        }
        return true;
    }
    TriangleMesh mesh;
    TriangleBvh tree;
    CollisionWorld world;
    std::vector<Hand> hands, just_free;
};

template <class Check>
void check_hands(benchmark::State& state, const std::vector<Hand>& hands, Check&& check) {
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(check(hands[next]));
        if (++next == hands.size()) next = 0;
    }
    state.SetItemsProcessed(state.iterations());
}

void add(const std::string& name, TriangleMesh mesh) {
    const auto scene = std::make_shared<const Scene>(std::move(mesh));
    const auto run = [&](const char* what, bool near, auto check) {
        const auto job = [scene, near, check](benchmark::State& state) {
            const auto& hands = near ? scene->just_free : scene->hands;
            check_hands(state, hands, [&](const Hand& hand) { return check(*scene, hand); });
            state.counters["faces"] = static_cast<double>(scene->mesh.faces.size());
            state.counters["hit_share"] = static_cast<double>(scene->just_free.size()) /
                                          static_cast<double>(scene->hands.size());
        };
        benchmark::RegisterBenchmark((name + "/" + what).c_str(), job)
            ->Unit(benchmark::kMicrosecond);
    };
    const auto until_hit = [](const Scene& s, const Hand& hand) { return s.is_free(hand); };
    const auto every_part = [](const Scene& s, const Hand& hand) {
        int hits = 0;
        for (const OrientedBox& box : hand) hits += find_collision(s.world, box).has_value();
        return hits;
    };
    const auto clearance = [](const Scene& s, const Hand& hand) {
        return find_clearance(s.world, hand, 0.02).distance_m;
    };
    run("until_a_part_hits", false, until_hit);
    run("every_part", false, every_part);
    if (scene->just_free.empty()) return;
    run("just_free", true, every_part);
    run("clearance", true, clearance);
}

bool add_file(const std::string& path) {
    auto mesh = bench::bench_mesh(path);
    if (!mesh.ok()) {
        std::fprintf(stderr, "%s\n", mesh.error().detail.c_str());
        return false;
    }
    add(std::filesystem::path(path).filename().string(), std::move(mesh).value());
    return true;
}

void add_shapes(bool any_named) {
    if (any_named) return;
    add("cup_16k", test::cup(0.04, 0.09, 0.004, 16000));
    add("torus_16k", test::torus(0.06, 0.02, 16000));
}

}  // namespace

int main(int count, char** arguments) {
    return bench::run_benchmarks(count, arguments, add_file, add_shapes);
}
