#include "graspd/concavity/outer_hull.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "graspd/base/stop.hpp"
#include "graspd/base/stoppable_sort.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace graspd {
namespace {

// qhull reports after so many new facets, a few milliseconds, and a report is where it can be told
// to stop.
constexpr const char* kCommand = "qhull Pp TF1000";  // Pp: no warnings; facets merged by default

/// qhull's state, freed on every way out, with the stream that it writes errors and reports to.
///
/// qhull has no way to be interrupted from outside, and no exception may go through it. But it
/// reads its limit of added points anew for every point, and it writes a report now and then:
/// whoever receives that can lower the limit.
class QhullSession {
public:
    QhullSession() {
        const cookie_io_functions_t functions = {nullptr, &QhullSession::receive, nullptr, nullptr};
        errors_ = fopencookie(this, "w", functions);
        if (errors_ != nullptr) std::setvbuf(errors_, nullptr, _IOLBF, BUFSIZ);
        qh_zero(&state, errors_);
    }
    QhullSession(const QhullSession&) = delete;
    QhullSession& operator=(const QhullSession&) = delete;
    ~QhullSession() {
        qh_freeqhull(&state, !qh_ALL);
        int remaining = 0, total = 0;
        qh_memfreeshort(&state, &remaining, &total);
        if (errors_ != nullptr) std::fclose(errors_);
    }

    FILE* errors() const { return errors_; }
    bool is_stopped() const { return is_stopped_; }
    /// Errors begin with their number, reports do not.
    std::string first_error_line() {
        std::fflush(errors_);
        const std::size_t begin = std::min(text_.find("QH"), text_.size());
        return text_.substr(begin, text_.find('\n', begin) - begin);
    }

    qhT state{};

private:
    static ssize_t receive(void* session, const char* text, std::size_t size) noexcept {
        auto& self = *static_cast<QhullSession*>(session);
        try {
            self.text_.append(text, self.text_.size() < kMostText ? size : 0);
            stop_point();
        } catch (const Stopped&) {
            self.is_stopped_ = true;
            self.state.STOPadd = 1;        // no point more than there are
        } catch (const std::exception&) {  // no memory for the text
        }
        return static_cast<ssize_t>(size);
    }

    static constexpr std::size_t kMostText = 65536;
    FILE* errors_ = nullptr;
    std::string text_;
    bool is_stopped_ = false;
};

/// @param middle  what was subtracted from the points
HullFacet read_facet(const facetT& facet, const Eigen::Vector3d& middle) {
    HullFacet out;
    out.normal = Eigen::Map<const Eigen::Vector3d>(facet.normal);
    out.offset_m = out.normal.dot(middle) - facet.offset;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet.vertices) {
        out.box.extend(Eigen::Map<const Eigen::Vector3d>(vertex->point) + middle);
    }
    return out;
}

}  // namespace

Result<OuterHull> outer_hull(std::span<const Eigen::Vector3d> points) {
    if (points.size() < 4) {
        return PlanError{PlanErrorCode::kDegenerate,
                         "a hull needs 4 points, got " + std::to_string(points.size())};
    }
    std::vector<coordT> coordinates;
    coordinates.reserve(3 * points.size());
    // qhull's tolerances grow with the coordinates, so they are centred first.
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : points) box.extend(point);
    const Eigen::Vector3d middle = box.center();
    stop_point();
    for (const Eigen::Vector3d& point : points) {
        const Eigen::Vector3d p = point - middle;
        coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
    }

    QhullSession session;
    if (session.errors() == nullptr) {
        return PlanError{PlanErrorCode::kInternal, "no memory for qhull's error stream"};
    }
    qhT* qh = &session.state;
    std::string command = kCommand;
    const int failed = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(),
                                    False, command.data(), nullptr, session.errors());
    if (session.is_stopped()) throw Stopped{};
    if (failed != 0) {
        return PlanError{PlanErrorCode::kDegenerate, "no convex hull of " +
                                                         std::to_string(points.size()) +
                                                         " points: " + session.first_error_line()};
    }
    OuterHull hull;
    facetT* facet = nullptr;
    FORALLfacets {
        stop_point(hull.facets.size());
        hull.facets.push_back(read_facet(*facet, middle));
    }
    vertexT* vertex = nullptr;
    FORALLvertices {
        stop_point(hull.vertices.size());
        hull.vertices.push_back(static_cast<std::uint32_t>(qh_pointid(qh, vertex->point)));
    }
    stoppable_sort(hull.vertices);
    qh_getarea(qh, qh->facet_list);
    hull.volume_m3 = qh->totvol;
    return hull;
}

}  // namespace graspd
