// Concavity of object files against exact predicates and a brute-force visibility graph:
//
//     concavity_accuracy FILE...
//
// One line per file: faces and vertices as conditioned, whether the mesh intersects itself, the
// share of vertices proven exact and the number found enclosed. Over the vertices that are not
// fill, in % of the graph's largest value: by how much the worst and the 99th percentile are longer
// than the graph, how many are longer by over 0.5 %, the least difference (shorter is right where
// nothing is blocked: the graph bends at vertices alone); how many vertices have a way out in one
// of the two alone. The path segments, and how many of them exact predicates find blocked.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/read_object.hpp"
#include "support/path_certificate.hpp"
#include "support/visibility_graph.hpp"

namespace graspd {
namespace {

/// Differences to the graph in % of its largest value.
struct Excess {
    double worst = 0.0, p99 = 0.0, least = 0.0;
    std::size_t over = 0;       ///< longer by over half a percent
    std::size_t one_sided = 0;  ///< finite in one of the two alone
};

Excess excess_over(const std::vector<double>& graph_m, const ConcavityField& field,
                   std::size_t asked) {
    Excess excess;
    double largest_m = 0.0;
    std::vector<double> differences_m;
    for (std::size_t v = 0; v < asked; ++v) {
        const bool both = std::isfinite(graph_m[v]) && std::isfinite(field.value_m[v]);
        excess.one_sided += !both && std::isfinite(graph_m[v]) != std::isfinite(field.value_m[v]);
        if (!both) continue;
        largest_m = std::max(largest_m, graph_m[v]);
        differences_m.push_back(field.value_m[v] - graph_m[v]);
    }
    if (differences_m.empty() || largest_m <= 0.0) return excess;
    std::ranges::sort(differences_m);
    const auto share = [&](std::size_t i) { return 100.0 * differences_m[i] / largest_m; };
    excess.worst = share(differences_m.size() - 1);
    excess.p99 = share(static_cast<std::size_t>(0.99 * static_cast<double>(differences_m.size())));
    excess.least = share(0);
    excess.over = static_cast<std::size_t>(std::ranges::count_if(
        differences_m, [&](double difference) { return difference > 0.005 * largest_m; }));
    return excess;
}

/// What to print, or why there is nothing.
Result<std::string> measure(const std::filesystem::path& path) {
    const auto file = read_object(path);
    if (!file.ok()) return file.error();
    const auto* soup = std::get_if<TriangleMesh>(&file.value().object);
    if (!soup) return PlanError{PlanErrorCode::kInvalidInput, "a cloud, no mesh"};
    const auto closed = condition_mesh(*soup, {});
    if (!closed.ok()) return closed.error();
    const TriangleMesh& mesh = closed.value().mesh;
    auto hull = outer_hull(mesh.vertices);
    if (!hull.ok()) return hull.error();
    const ConcavityConfig config;
    const TriangleBvh bvh(mesh,
                          mesh_diagonal_m(mesh) * config.start_offset / kOffsetOverRayTolerance);
    auto field = shortest_path_concavity(mesh, hull.value(), bvh, config);
    if (!field.ok()) return field.error();

    const test::ConcavityRun run{std::move(hull).value(), std::move(field).value()};
    const test::ExactSurface surface(mesh);
    const test::PathCertificate found = test::certify_paths(mesh, run, surface);
    const Excess excess = excess_over(test::visibility_graph_m(mesh, run.hull, surface), run.field,
                                      mesh.vertices.size() - closed.value().fill_vertices);
    const auto enclosed = std::ranges::count(run.field.flag, ConcavityFlag::kEnclosed);
    char line[256];
    std::snprintf(
        line, sizeof line, "%7zu %8zu %9s %6.2f %8td %8.3f %8.4f %6zu %8.3f %9zu %8zu %7zu",
        mesh.faces.size(), mesh.vertices.size(), test::intersects_itself(mesh) ? "yes" : "no",
        100.0 * static_cast<double>(found.exact) / static_cast<double>(found.vertices), enclosed,
        excess.worst, excess.p99, excess.over, excess.least, excess.one_sided, found.segments,
        found.blocked);
    return std::string(line);
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: concavity_accuracy FILE...\n");
        return 2;
    }
    std::printf("%-28s %7s %8s %9s %6s %8s %8s %8s %6s %8s %9s %8s %7s\n", "file", "faces",
                "vertices", "self-int.", "exact%", "enclosed", "worst%", "p99%", ">0.5%", "least%",
                "one-sided", "segments", "blocked");
    bool all = true;
    for (int i = 1; i < argc; ++i) {
        const std::filesystem::path path = argv[i];
        const auto line = graspd::measure(path);
        all = all && line.ok();
        std::printf("%-28s %s\n", path.filename().c_str(),
                    line.ok() ? line.value().c_str() : line.error().detail.c_str());
        std::fflush(stdout);
    }
    return all ? 0 : 1;
}
