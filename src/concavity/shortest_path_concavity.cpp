#include "graspd/concavity/shortest_path_concavity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace graspd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxPull =
    64;  // bends of one string; a path with more is pulled by later relaxations

/// Vertex neighbours in compressed rows, each row rising and without repetition.
struct Adjacency {
    std::vector<std::uint32_t> start, neighbour;

    explicit Adjacency(const TriangleMesh& mesh) : start(mesh.vertices.size() + 1, 0) {
        std::vector<std::uint32_t> degree(mesh.vertices.size(), 0);
        for (const Triangle& t : mesh.faces) {
            for (const std::uint32_t v : t) degree[v] += 2;
        }
        for (std::size_t v = 0; v < degree.size(); ++v) start[v + 1] = start[v] + degree[v];
        neighbour.resize(start.back());
        std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
        for (const Triangle& t : mesh.faces) {
            for (int k = 0; k < 3; ++k) {
                neighbour[fill[t[k]]++] = t[(k + 1) % 3];
                neighbour[fill[t[k]]++] = t[(k + 2) % 3];
            }
        }
        compact();
    }

private:
    void compact() {
        std::uint32_t write = 0;
        std::uint32_t begin = 0;
        for (std::size_t v = 0; v + 1 < start.size(); ++v) {
            const std::uint32_t end = start[v + 1];
            std::sort(neighbour.begin() + begin, neighbour.begin() + end);
            const std::uint32_t row = write;
            for (std::uint32_t i = begin; i < end; ++i) {
                if (write == row || neighbour[write - 1] != neighbour[i]) {
                    neighbour[write++] = neighbour[i];
                }
            }
            begin = end;
            start[v] = row;
        }
        start.back() = write;
        neighbour.resize(write);
    }
};

std::vector<Eigen::Vector3d> angle_weighted_normals(const TriangleMesh& mesh) {
    std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
    for (const Triangle& t : mesh.faces) {
        const Eigen::Vector3d corner[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]],
                                           mesh.vertices[t[2]]};
        const Eigen::Vector3d normal =
            (corner[1] - corner[0]).cross(corner[2] - corner[0]).stableNormalized();
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d e1 = corner[(k + 1) % 3] - corner[k];
            const Eigen::Vector3d e2 = corner[(k + 2) % 3] - corner[k];
            normals[t[k]] += std::atan2(e1.cross(e2).norm(), e1.dot(e2)) * normal;
        }
    }
    for (Eigen::Vector3d& n : normals) n = n.stableNormalized();
    return normals;
}

/// The working state of one run; the stage function below shows its order.
class Engine {
public:
    Engine(const TriangleMesh& mesh, const OuterHull& hull, const TriangleBvh& bvh,
           const ConcavityConfig& config)
        : mesh_(mesh),
          bvh_(bvh),
          config_(config),
          planes_(hull),
          adjacency_(mesh),
          offset_m_(config.start_offset * mesh_diagonal_m(mesh)) {
        const std::vector<Eigen::Vector3d> normals = angle_weighted_normals(mesh);
        start_.reserve(normals.size());
        for (std::size_t v = 0; v < normals.size(); ++v) {
            start_.push_back(mesh.vertices[v] + offset_m_ * normals[v]);
        }
        field_.value_m.assign(normals.size(), kInfinity);
        field_.flag.assign(normals.size(), ConcavityFlag::kEnclosed);
        field_.parent.assign(normals.size(), ConcavityField::kNoParent);
        failed_.assign(normals.size() * config.failed_memory, ConcavityField::kNoParent);
        relaxations_.assign(normals.size(), 0);
    }

    void mark_unreferenced();
    void prove_direct();
    void propagate();
    ConcavityField take();

private:
    struct QueueItem {
        double value_m;
        std::uint32_t vertex;
        bool operator>(const QueueItem& other) const {
            return value_m != other.value_m ? value_m > other.value_m : vertex > other.vertex;
        }
    };

    bool referenced(std::uint32_t v) const {
        return field_.flag[v] != ConcavityFlag::kUnreferenced;
    }
    bool finished(std::uint32_t v) const { return std::isfinite(field_.value_m[v]); }

    /// Length of v's way out through a parent (a bend or a hull facet), seen or not.
    double length_through(std::uint32_t v, std::int32_t parent) const {
        if (parent >= 0) {
            return (mesh_.vertices[v] - mesh_.vertices[parent]).norm() + field_.value_m[parent];
        }
        const HullFacet& facet = planes_.facet(static_cast<std::uint32_t>(-1 - parent));
        return std::max(0.0, facet.offset_m - facet.normal.dot(mesh_.vertices[v]));
    }
    bool sees(std::uint32_t v, std::int32_t parent);
    bool try_parent(std::uint32_t v, std::int32_t parent);
    void pull(std::uint32_t v);
    bool relax(std::uint32_t from, std::uint32_t to);

    const TriangleMesh& mesh_;
    const TriangleBvh& bvh_;
    const ConcavityConfig& config_;
    HullPlaneTree planes_;
    Adjacency adjacency_;
    double offset_m_;
    std::vector<Eigen::Vector3d> start_;  ///< vertices lifted off the surface: where paths run
    std::vector<std::int32_t> failed_;    ///< ring of hidden parents per vertex
    std::vector<std::uint32_t> relaxations_;
    ConcavityField field_;
};

void Engine::mark_unreferenced() {
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        if (adjacency_.start[v] != adjacency_.start[v + 1]) continue;
        field_.flag[v] = ConcavityFlag::kUnreferenced;
        field_.value_m[v] = std::numeric_limits<double>::quiet_NaN();
    }
}

/// Step 1 and 2: the distance to the nearest hull plane is a lower bound; where the perpendicular
/// is free it is the answer.
void Engine::prove_direct() {
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        if (!referenced(v)) continue;
        const HullPlaneTree::Nearest nearest = planes_.nearest(mesh_.vertices[v]);
        const auto parent = -1 - static_cast<std::int32_t>(nearest.facet);
        if (!sees(v, parent)) continue;
        field_.value_m[v] = nearest.distance_m;
        field_.parent[v] = parent;
        field_.flag[v] = ConcavityFlag::kExact;
    }
}

bool Engine::sees(std::uint32_t v, std::int32_t parent) {
    const Eigen::Vector3d& from = start_[v];
    if (parent >= 0) return !bvh_.segment_blocked(from, start_[parent]);
    const HullFacet& facet = planes_.facet(static_cast<std::uint32_t>(-1 - parent));
    // Stop one offset short of the plane: faces of the object may lie in it.
    const double length = facet.offset_m - facet.normal.dot(from) - offset_m_;
    if (length <= 0.0) return true;
    return !bvh_.segment_blocked(from, from + length * facet.normal);
}

bool Engine::try_parent(std::uint32_t v, std::int32_t parent) {
    if (parent == ConcavityField::kNoParent || parent == static_cast<std::int32_t>(v)) return false;
    if (parent >= 0 && field_.parent[parent] == static_cast<std::int32_t>(v)) return false;
    const double length = length_through(v, parent);
    if (!(length < field_.value_m[v] * (1.0 - config_.min_gain))) return false;
    const auto ring = failed_.begin() + static_cast<std::ptrdiff_t>(v) * config_.failed_memory;
    const auto ring_end = ring + config_.failed_memory;
    if (std::find(ring, ring_end, parent) != ring_end) return false;
    if (!sees(v, parent)) {
        if (ring != ring_end) {
            std::rotate(ring, ring_end - 1, ring_end);
            *ring = parent;
        }
        return false;
    }
    field_.value_m[v] = length;
    field_.parent[v] = parent;
    field_.flag[v] = ConcavityFlag::kPath;
    return true;
}

/// Straightens v's way out: skip bends that are not needed, then slide the bend to its neighbours.
void Engine::pull(std::uint32_t v) {
    for (int round = 0; round < kMaxPull; ++round) {
        const std::int32_t bend = field_.parent[v];
        if (bend < 0) return;
        if (try_parent(v, field_.parent[bend])) continue;
        bool better = false;
        const auto b = static_cast<std::uint32_t>(bend);
        for (std::uint32_t i = adjacency_.start[b]; i < adjacency_.start[b + 1] && !better; ++i) {
            const std::uint32_t beside = adjacency_.neighbour[i];
            if (finished(beside)) better = try_parent(v, static_cast<std::int32_t>(beside));
        }
        if (!better) return;
    }
}

bool Engine::relax(std::uint32_t from, std::uint32_t to) {
    const bool improved =
        try_parent(to, field_.parent[from]) || try_parent(to, static_cast<std::int32_t>(from));
    if (improved) pull(to);
    return improved;
}

/// Step 3: Dijkstra from the proven vertices inwards. Values may sink again after a vertex has left
/// the queue, so an improved vertex is queued anew; the count of relaxations bounds the work.
void Engine::propagate() {
    std::priority_queue<QueueItem, std::vector<QueueItem>, std::greater<>> queue;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
        if (!referenced(v) || !finished(v)) continue;
        const auto row = adjacency_.neighbour.begin();
        const bool borders = std::any_of(row + adjacency_.start[v], row + adjacency_.start[v + 1],
                                         [&](std::uint32_t u) { return !finished(u); });
        if (borders) queue.push({field_.value_m[v], v});
    }
    while (!queue.empty()) {
        const QueueItem item = queue.top();
        queue.pop();
        if (item.value_m > field_.value_m[item.vertex]) continue;
        for (std::uint32_t i = adjacency_.start[item.vertex]; i < adjacency_.start[item.vertex + 1];
             ++i) {
            const std::uint32_t to = adjacency_.neighbour[i];
            if (field_.flag[to] == ConcavityFlag::kExact) continue;
            if (++relaxations_[to] > config_.max_relaxations_per_vertex) continue;
            if (relax(item.vertex, to)) queue.push({field_.value_m[to], to});
        }
    }
}

ConcavityField Engine::take() {
    // A bend's own value may have sunk after a string through it was measured.
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < field_.value_m.size(); ++v) {
        if (field_.flag[v] == ConcavityFlag::kPath) order.push_back(v);
    }
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return field_.value_m[a] != field_.value_m[b] ? field_.value_m[a] < field_.value_m[b]
                                                      : a < b;
    });
    for (const std::uint32_t v : order) {
        field_.value_m[v] = std::min(field_.value_m[v], length_through(v, field_.parent[v]));
    }
    for (const double value : field_.value_m) {
        if (std::isfinite(value)) field_.largest_m = std::max(field_.largest_m, value);
    }
    return std::move(field_);
}

}  // namespace

const char* to_string(ConcavityFlag flag) {
    switch (flag) {
        case ConcavityFlag::kExact: return "exact";
        case ConcavityFlag::kPath: return "path";
        case ConcavityFlag::kEnclosed: return "enclosed";
        case ConcavityFlag::kUnreferenced: return "unreferenced";
    }
    return "unknown";
}

double mesh_diagonal_m(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.faces) {
        for (const std::uint32_t v : t) box.extend(mesh.vertices[v]);
    }
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

Result<ConcavityField> shortest_path_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                               const TriangleBvh& bvh,
                                               const ConcavityConfig& config) {
    if (mesh.faces.empty() || hull.facets.empty()) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         "concavity needs a mesh with faces and its hull, got " +
                             std::to_string(mesh.faces.size()) + " faces and " +
                             std::to_string(hull.facets.size()) + " hull facets"};
    }
    Engine engine(mesh, hull, bvh, config);
    engine.mark_unreferenced();
    engine.prove_direct();
    engine.propagate();
    return engine.take();
}

std::vector<Eigen::Vector3d> escape_path(const TriangleMesh& mesh, const OuterHull& hull,
                                         const ConcavityField& field, std::uint32_t vertex) {
    std::vector<Eigen::Vector3d> path;
    if (!std::isfinite(field.value_m[vertex])) return path;
    std::int32_t at = static_cast<std::int32_t>(vertex);
    while (at >= 0 && path.size() <= mesh.vertices.size()) {
        path.push_back(mesh.vertices[at]);
        at = field.parent[at];
    }
    if (at != ConcavityField::kNoParent) {
        const HullFacet& facet = hull.facets[static_cast<std::size_t>(-1 - at)];
        const double gap = facet.offset_m - facet.normal.dot(path.back());
        path.push_back(path.back() + gap * facet.normal);
    }
    return path;
}

}  // namespace graspd
