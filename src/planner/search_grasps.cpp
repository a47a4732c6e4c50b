#include "search_grasps.hpp"

#include <algorithm>

#include "boundary_axes.hpp"
#include "find_poses.hpp"
#include "opposite_axes.hpp"
#include "order_axes.hpp"

namespace graspd::planner_detail {
namespace {

/// Runs rounds into one result and drops the one that is interrupted.
class Rounds {
public:
    Rounds(const Judgement& judgement, const StopQuery& stop_requested, StageLog& log)
        : judgement_(judgement), stop_requested_(stop_requested), log_(log) {}

    bool stopped() {
        result_.stopped = result_.stopped || (stop_requested_ && stop_requested_());
        return result_.stopped;
    }
    bool wanted(GraspSource source) const {
        const unsigned sources = judgement_.request.options.sources;
        return sources == 0 || (sources & source) != 0;
    }
    void run(std::vector<ClosingAxis> axes);
    /// Counts axes of a source that the request does not ask for.
    void leave_out(std::size_t axes) { result_.rejections.add("axis_source_unwanted", axes); }
    SearchResult take() { return std::move(result_); }

private:
    bool try_axis(const ClosingAxis& axis, std::uint32_t& poses_left, SearchResult& round);

    const Judgement& judgement_;
    const StopQuery& stop_requested_;
    StageLog& log_;
    SearchResult result_;
};

void Rounds::run(std::vector<ClosingAxis> axes) {
    constexpr const char* kOrder = "planner/order_axes";
    SearchResult round;
    const std::size_t found = axes.size();
    const auto ordered = log_.run(
        kOrder, found, [&] { return order_axes(std::move(axes), judgement_, round.rejections); });
    log_.out(kOrder, ordered.size());
    std::vector<ClosingAxis> held;  // axes on which a grasp was found
    std::uint32_t poses_left = judgement_.config.search.poses_per_round;
    for (const ClosingAxis& axis : ordered) {
        if (stopped()) return;
        const bool known = std::ranges::any_of(
            held, [&](const ClosingAxis& other) { return similar(axis, other, judgement_); });
        const bool enough = held.size() >= judgement_.config.search.axes_per_round;
        if (known || enough || poses_left == 0) {
            round.rejections.add(known ? "axis_similar" : "axis_surplus");
            continue;
        }
        if (try_axis(axis, poses_left, round)) held.push_back(axis);
    }
    std::ranges::move(round.grasps, std::back_inserter(result_.grasps));
    result_.rejections.merge(round.rejections);
}

/// Evaluates the poses of one axis. @return whether it gave a grasp
bool Rounds::try_axis(const ClosingAxis& axis, std::uint32_t& poses_left, SearchResult& round) {
    constexpr const char* kPoses = "planner/find_poses";
    const auto poses =
        log_.run(kPoses, 1, [&] { return find_poses(axis, judgement_, round.rejections); });
    log_.out(kPoses, poses.size());
    const std::size_t before = round.grasps.size();
    for (const ApproachPose& pose : poses) {
        if (auto grasp = evaluate_pose(axis, pose, judgement_, round.rejections, log_)) {
            round.grasps.push_back(std::move(*grasp));
        }
    }
    poses_left -= std::min(poses_left, static_cast<std::uint32_t>(poses.size()));
    return round.grasps.size() > before;
}

}  // namespace

SearchResult search_grasps(const Judgement& judgement, const SeenSurface& seen,
                           const StopQuery& stop_requested, StageLog& log) {
    const PlannerConfig& config = judgement.config;
    const Gripper& gripper = judgement.gripper;
    const PreparedObject& object = judgement.object;
    const auto& [surface, concavities] = seen;
    Rounds rounds(judgement, stop_requested, log);
    if (rounds.wanted(kBoundary)) {
        for (std::size_t i = 0; i < concavities.size() && !rounds.stopped(); ++i) {
            rounds.run(boundary_axes(concavities[i], static_cast<std::int32_t>(i), surface, object,
                                     gripper, config, log));
        }
    }
    if ((rounds.wanted(kWall) || rounds.wanted(kWholeObject)) && !rounds.stopped()) {
        const auto axes = opposite_axes(concavities, surface, object, gripper, config, log);
        for (const GraspSource source : {kWall, kWholeObject}) {
            if (rounds.stopped()) continue;
            std::vector<ClosingAxis> of_source;
            std::ranges::copy_if(axes, std::back_inserter(of_source),
                                 [&](const ClosingAxis& a) { return a.source == source; });
            if (rounds.wanted(source)) {
                rounds.run(std::move(of_source));
            } else {
                rounds.leave_out(of_source.size());
            }
        }
    }
    return rounds.take();
}

}  // namespace graspd::planner_detail
