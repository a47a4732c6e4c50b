#include "graspd/base/hull_points.hpp"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include <Eigen/Geometry>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace graspd {
namespace {

struct Close {
    void operator()(FILE* file) const { std::fclose(file); }
    void operator()(qhT* qh) const {
        qh_freeqhull(qh, !qh_ALL);
        int remaining = 0, total = 0;
        qh_memfreeshort(qh, &remaining, &total);
    }
};

/// A hull as qhull has it, as long as this object lives.
class Hull {
public:
    /// @param options  of qhull
    Hull(const std::vector<Eigen::Vector3d>& points, const char* options) {
        if (points.size() < 4 || !silence_) return;
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& point : points) box.extend(point);
        middle_ = box.center();
        coordinates_.reserve(3 * points.size());  // from the middle: qhull's tolerances grow with
        for (const Eigen::Vector3d& point : points) {  // them
            const Eigen::Vector3d p = point - middle_;
            coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
        }
        qh_zero(&state_, silence_.get());
        session_.reset(&state_);
        std::string command = options;
        failed_ = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), coordinates_.data(),
                               False, command.data(), nullptr, silence_.get()) != 0;
    }
    /// Null: there is none.
    qhT* get() { return failed_ ? nullptr : session_.get(); }

    /// Rising indices of the points that are corners.
    std::vector<std::size_t> corners() {
        qhT* qh = get();
        std::vector<std::size_t> corners;
        vertexT* vertex = nullptr;
        FORALLvertices {
            corners.push_back(static_cast<std::size_t>(qh_pointid(qh, vertex->point)));
        }
        std::ranges::sort(corners);
        return corners;
    }

private:
    std::unique_ptr<FILE, Close> silence_{std::fopen("/dev/null", "w")};
    std::vector<coordT> coordinates_;
    Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
    qhT state_{};
    std::unique_ptr<qhT, Close> session_;  // before what it uses goes
    bool failed_ = true;
};

PlanError no_hull(const std::vector<Eigen::Vector3d>& points) {
    return {PlanErrorCode::kDegenerate,
            std::to_string(points.size()) + " points have no convex hull"};
}

/// A facet of three corners, as places in the list of all corners.
Triangle read_triangle(qhT* qh, facetT& facet, const std::vector<std::size_t>& corners,
                       const std::vector<Eigen::Vector3d>& points) {
    std::vector<std::size_t> ids;
    vertexT *vertex = nullptr, **vertexp = nullptr;
    FOREACHvertex_(facet.vertices) {
        ids.push_back(static_cast<std::size_t>(qh_pointid(qh, vertex->point)));
    }
    assert(ids.size() == 3);  // qhull's option Qt
    const Eigen::Vector3d outward(facet.normal[0], facet.normal[1], facet.normal[2]);
    const Eigen::Vector3d turn =
        (points[ids[1]] - points[ids[0]]).cross(points[ids[2]] - points[ids[0]]);
    if (turn.dot(outward) < 0.0) std::swap(ids[1], ids[2]);
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto at = std::ranges::lower_bound(corners, ids[k]);
        triangle[k] = static_cast<std::uint32_t>(at - corners.begin());
    }
    return triangle;
}

std::vector<Eigen::Vector3d> chosen(const std::vector<Eigen::Vector3d>& points,
                                    const std::vector<std::size_t>& corners) {
    std::vector<Eigen::Vector3d> hull;
    hull.reserve(corners.size());
    for (const std::size_t corner : corners) hull.push_back(points[corner]);
    return hull;
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> hull_points(const std::vector<Eigen::Vector3d>& points) {
    Hull hull(points, "qhull Pp");
    if (hull.get() == nullptr) return no_hull(points);
    return chosen(points, hull.corners());
}

Result<TriangleMesh> hull_mesh(const std::vector<Eigen::Vector3d>& points) {
    Hull hull(points, "qhull Qt Pp");
    qhT* qh = hull.get();
    if (qh == nullptr) return no_hull(points);
    const std::vector<std::size_t> corners = hull.corners();
    TriangleMesh mesh{chosen(points, corners), {}};
    facetT* facet = nullptr;
    FORALLfacets {
        mesh.faces.push_back(read_triangle(qh, *facet, corners, points));
    }
    return mesh;
}

}  // namespace graspd
