#include "search_grasps.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "boundary_axes.hpp"
#include "find_poses.hpp"
#include "graspd/base/parallel.hpp"
#include "opposite_axes.hpp"
#include "order_axes.hpp"
#include "refine_grasps.hpp"

namespace graspd::planner_detail {
namespace {

constexpr std::size_t kBatch = 8;       // axes of which none is like another
constexpr std::size_t kLeastTried = 2;  // of them side by side

/// What one axis gave.
struct Attempt {
    std::vector<GradedGrasp> grasps;
    Rejections rejections;
    StageLog log;
    std::uint32_t poses = 0;  ///< that were checked in full
};

/// Evaluates poses of an axis, a few at a time side by side: a batch whose axes have very different
/// numbers of poses then keeps all threads at work.
void try_poses(const ClosingAxis& axis, std::span<const ApproachPose> poses,
               const Judgement& judgement, Attempt& attempt) {
    constexpr std::size_t kAtATime = 4;
    std::vector<Attempt> parts((poses.size() + kAtATime - 1) / kAtATime);
    for_blocks(poses.size(), kAtATime, [&](std::size_t first, std::size_t last) {
        Attempt& part = parts[first / kAtATime];
        part.rejections = Rejections(judgement.traced);
        for (std::size_t i = first; i < last; ++i) {
            auto grasp = evaluate_pose(axis, poses[i], judgement, part.rejections, part.log);
            if (grasp) part.grasps.push_back(std::move(*grasp));
        }
    });
    for (Attempt& part : parts) {
        std::ranges::move(part.grasps, std::back_inserter(attempt.grasps));
        attempt.rejections.merge(part.rejections);
        attempt.log.merge(part.log);
    }
}

/// The poses of one axis in their order, until enough of them gave a grasp: those that follow are
/// turned to between the directions of the first.
Attempt try_axis(const ClosingAxis& axis, const Judgement& judgement) {
    constexpr const char* kPoses = "planner/find_poses";
    constexpr std::size_t kBetweenLooks = 8;  // poses
    Attempt attempt{{}, Rejections(judgement.traced), {}, 0};
    const auto poses =
        attempt.log.run(kPoses, 1, [&] { return find_poses(axis, judgement, attempt.rejections); });
    attempt.log.out(kPoses, poses.size());
    // Where near grasps are to fall, all are asked: the one that is clear may be the last.
    const std::size_t enough = judgement.request.options.min_clearance_m > 0.0
                                   ? poses.size()
                                   : judgement.config.search.grasps_per_axis;
    std::span<const ApproachPose> untried = poses;
    while (!untried.empty() && attempt.grasps.size() < enough) {
        const std::size_t count = std::min(kBetweenLooks, untried.size());
        try_poses(axis, untried.first(count), judgement, attempt);
        untried = untried.subspan(count);
    }
    attempt.poses = static_cast<std::uint32_t>(poses.size() - untried.size());
    for (const ApproachPose& pose : untried) {
        attempt.rejections.add("pose_surplus",
                               [&] { return traced(axis, pose, judgement.gripper.name); });
    }
    return attempt;
}

/// After how many axes with a good grasp a round may end: where near grasps are to fall, after
/// none.
std::uint32_t good_axes_wanted(const Judgement& judgement) {
    const PlanOptions& options = judgement.request.options;
    if (options.min_clearance_m > 0.0) return std::numeric_limits<std::uint32_t>::max();
    return std::max(judgement.config.search.good_axes_per_round, options.max_grasps);
}

/// One round: tries axes in their order, a batch at a time, until enough of them gave a grasp.
///
/// Which axes a batch holds, and what of its attempts counts, does not depend on threads: an
/// attempt beyond what the round needs is thrown away.
class Round {
public:
    Round(const Judgement& judgement, std::vector<ClosingAxis> ordered)
        : rejections_(judgement.traced),
          judgement_(judgement),
          pending_(std::move(ordered)),
          good_left_(good_axes_wanted(judgement)),
          poses_left_(judgement.config.search.poses_per_round) {}

    bool done() const { return pending_.empty(); }
    void try_batch(StageLog& log);

    std::vector<GradedGrasp> grasps_;
    Rejections rejections_;

private:
    bool is_full() const {
        return held_.size() >= judgement_.config.search.axes_per_round || good_left_ == 0 ||
               poses_left_ == 0;
    }
    bool like_any(const ClosingAxis& axis, const std::vector<ClosingAxis>& others) const {
        return std::ranges::any_of(
            others, [&](const ClosingAxis& other) { return similar(axis, other, judgement_); });
    }
    void leave(const ClosingAxis& axis, const char* reason) {
        rejections_.add(reason, [&] { return traced(axis, {}, judgement_.gripper.name); });
    }
    /// How many axes to try next: as many as are still wanted, should all give a good grasp, but no
    /// fewer than kLeastTried; what an axis beyond gives is thrown away.
    std::size_t wanted() const {
        const std::size_t held = judgement_.config.search.axes_per_round - held_.size();
        return std::max(std::min<std::size_t>(good_left_, held), kLeastTried);
    }
    std::vector<ClosingAxis> next_batch();
    void try_some(std::span<const ClosingAxis> axes, StageLog& log);
    void accept(const ClosingAxis& axis, Attempt attempt, StageLog& log);

    const Judgement& judgement_;
    std::vector<ClosingAxis> pending_;
    std::vector<ClosingAxis> held_;  ///< axes on which a grasp was found
    std::uint32_t good_left_;        ///< axes with a good grasp that are still wanted
    std::uint32_t poses_left_;
};

/// The next axes that are neither like one that holds nor like each other; what is like another
/// of the batch waits for the next one.
std::vector<ClosingAxis> Round::next_batch() {
    std::vector<ClosingAxis> batch, rest;
    for (const ClosingAxis& axis : pending_) {
        if (batch.size() < kBatch && like_any(axis, held_)) {
            leave(axis, "axis_similar");
        } else if (batch.size() < kBatch && !like_any(axis, batch)) {
            batch.push_back(axis);
        } else {
            rest.push_back(axis);
        }
    }
    pending_ = std::move(rest);
    return batch;
}

void Round::accept(const ClosingAxis& axis, Attempt attempt, StageLog& log) {
    if (is_full()) {
        return leave(axis, "axis_surplus");
    }
    log.merge(attempt.log);
    poses_left_ -= std::min(poses_left_, attempt.poses);
    rejections_.merge(attempt.rejections);
    if (!attempt.grasps.empty()) held_.push_back(axis);
    const double good = judgement_.config.search.good_score;
    if (good_left_ > 0 && std::ranges::any_of(attempt.grasps, [&](const GradedGrasp& grasp) {
            return grasp.score.score >= good;
        })) {
        --good_left_;
    }
    std::ranges::move(attempt.grasps, std::back_inserter(grasps_));
}

/// Tries axes side by side; what each gave counts in their order.
void Round::try_some(std::span<const ClosingAxis> axes, StageLog& log) {
    std::vector<Attempt> attempts(axes.size());
    for_blocks(axes.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) attempts[i] = try_axis(axes[i], judgement_);
    });
    for (std::size_t i = 0; i < axes.size(); ++i) accept(axes[i], std::move(attempts[i]), log);
}

void Round::try_batch(StageLog& log) {
    const std::vector<ClosingAxis> batch = next_batch();
    std::span<const ClosingAxis> untried = batch;
    while (!untried.empty() && !is_full()) {
        const std::size_t count = std::min(wanted(), untried.size());
        try_some(untried.first(count), log);
        untried = untried.subspan(count);
    }
    for (const ClosingAxis& axis : untried) leave(axis, "axis_surplus");
    if (!is_full()) return;
    for (const ClosingAxis& axis : pending_) {
        leave(axis, like_any(axis, held_) ? "axis_similar" : "axis_surplus");
    }
    pending_.clear();
}

/// Runs rounds into one result and drops the one that is interrupted.
class Rounds {
public:
    Rounds(const Judgement& judgement, StageLog& log, SearchResult& result)
        : judgement_(judgement), log_(log), result_(result) {}

    bool wanted(GraspSource source) const { return is_wanted(source, judgement_.request.options); }
    void run(std::vector<ClosingAxis> axes);
    /// Counts axes of a source that the request does not ask for.
    void leave_out(const std::vector<ClosingAxis>& axes) {
        for (const ClosingAxis& axis : axes) {
            result_.rejections.add("axis_source_unwanted",
                                   [&] { return traced(axis, {}, judgement_.gripper.name); });
        }
    }

private:
    const Judgement& judgement_;
    StageLog& log_;
    SearchResult& result_;
};

void Rounds::run(std::vector<ClosingAxis> axes) {
    constexpr const char* kOrder = "planner/order_axes";
    Rejections unfit(judgement_.traced);
    const std::size_t found = axes.size();
    auto ordered =
        log_.run(kOrder, found, [&] { return order_axes(std::move(axes), judgement_, unfit); });
    log_.out(kOrder, ordered.size());
    Round round(judgement_, std::move(ordered));
    while (!round.done()) round.try_batch(log_);
    std::ranges::move(round.grasps_, std::back_inserter(result_.grasps));
    result_.rejections.merge(unfit);
    result_.rejections.merge(round.rejections_);
}

/// The paper's candidates of all concavities, each concavity on a thread of its own.
/// @param boundaries  filled where candidates are traced
std::vector<std::vector<ClosingAxis>> axes_of(const SeenSurface& seen, const Judgement& judgement,
                                              StageLog& log,
                                              std::vector<TracedBoundary>& boundaries) {
    std::vector<std::vector<ClosingAxis>> axes(seen.concavities.size());
    std::vector<std::vector<TracedBoundary>> traces(seen.concavities.size());
    each_logged(axes.size(), log, [&](std::size_t i, StageLog& part) {
        axes[i] = boundary_axes(seen.concavities[i], static_cast<std::int32_t>(i), seen.surface,
                                judgement.object, judgement.gripper, judgement.config, part,
                                judgement.traced ? &traces[i] : nullptr);
    });
    for (auto& trace : traces) std::ranges::move(trace, std::back_inserter(boundaries));
    return axes;
}

/// Every round that the request wants.
/// @param boundaries  filled where candidates are traced
void search(Rounds& rounds, const Judgement& judgement, const SeenSurface& seen, StageLog& log,
            std::vector<TracedBoundary>& boundaries) {
    const bool along = rounds.wanted(kBoundary);
    const bool across = rounds.wanted(kWall) || rounds.wanted(kWholeObject);
    std::vector<std::vector<ClosingAxis>> of_concavities;
    std::vector<ClosingAxis> opposite;
    run_together({[&] {
                      if (along) of_concavities = axes_of(seen, judgement, log, boundaries);
                  },
                  [&] {
                      if (!across) return;
                      opposite = opposite_axes(seen, judgement.object, judgement.gripper,
                                               judgement.config);
                  }});
    for (auto& axes : of_concavities) rounds.run(std::move(axes));
    if (!across) return;
    if (seen.across) log.merge(seen.across->log);
    for (const GraspSource source : {kWall, kWholeObject}) {
        std::vector<ClosingAxis> of_source;
        std::ranges::copy_if(opposite, std::back_inserter(of_source),
                             [&](const ClosingAxis& a) { return a.source == source; });
        if (rounds.wanted(source)) {
            rounds.run(std::move(of_source));
        } else {
            rounds.leave_out(of_source);
        }
    }
}

}  // namespace

bool is_wanted(GraspSource source, const PlanOptions& options) {
    const unsigned sources = options.sources;
    return sources == 0 || (sources & source) != 0;
}

SearchResult search_grasps(const Judgement& judgement, const SeenSurface& seen, StageLog& log) {
    SearchResult result{{}, Rejections(judgement.traced), {}, {}};
    Rounds rounds(judgement, log, result);
    try {
        search(rounds, judgement, seen, log, result.boundaries);
        refine_grasps(result.grasps, judgement, log);
    } catch (const Stopped& stopped) {
        result.stopped = stopped;
    }
    return result;
}

}  // namespace graspd::planner_detail
