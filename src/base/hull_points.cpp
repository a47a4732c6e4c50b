#include "graspd/base/hull_points.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

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

}  // namespace

Result<std::vector<Eigen::Vector3d>> hull_points(const std::vector<Eigen::Vector3d>& points) {
    const PlanError no_volume{PlanErrorCode::kDegenerate,
                              std::to_string(points.size()) + " points have no convex hull"};
    if (points.size() < 4) return no_volume;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) box.extend(point);
    std::vector<coordT> coordinates;  // from the middle: qhull's tolerances grow with them
    coordinates.reserve(3 * points.size());
    for (const Eigen::Vector3d& point : points) {
        const Eigen::Vector3d p = point - box.center();
        coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
    }
    const std::unique_ptr<FILE, Close> silence(std::fopen("/dev/null", "w"));
    if (!silence) return PlanError{PlanErrorCode::kInternal, "/dev/null does not open"};
    qhT state{};
    qh_zero(&state, silence.get());
    const std::unique_ptr<qhT, Close> session(&state);
    qhT* qh = session.get();
    std::string command = "qhull Pp";
    if (qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False,
                     command.data(), nullptr, silence.get()) != 0) {
        return no_volume;
    }
    std::vector<std::size_t> corners;
    vertexT* vertex = nullptr;
    FORALLvertices {
        corners.push_back(static_cast<std::size_t>(qh_pointid(qh, vertex->point)));
    }
    std::ranges::sort(corners);
    std::vector<Eigen::Vector3d> hull;
    hull.reserve(corners.size());
    for (const std::size_t corner : corners) hull.push_back(points[corner]);
    return hull;
}

}  // namespace graspd
