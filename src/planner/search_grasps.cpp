#include "search_grasps.hpp"

#include <algorithm>

#include "boundary_axes.hpp"
#include "choose_axes.hpp"
#include "find_concavities.hpp"
#include "opposite_axes.hpp"

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
    void run(std::vector<ClosingAxis> axes, std::uint32_t most);
    SearchResult take() { return std::move(result_); }

private:
    const Judgement& judgement_;
    const StopQuery& stop_requested_;
    StageLog& log_;
    SearchResult result_;
};

void Rounds::run(std::vector<ClosingAxis> axes, std::uint32_t most) {
    constexpr const char* kChoose = "planner/choose_axes";
    SearchResult round;
    const std::size_t found = axes.size();
    const auto chosen = log_.run(kChoose, found, [&] {
        return choose_axes(std::move(axes), most, judgement_, round.rejections);
    });
    log_.out(kChoose, chosen.size());
    for (const ClosingAxis& axis : chosen) {
        if (stopped()) return;
        auto grasps = evaluate_axis(axis, judgement_, round.rejections, log_);
        std::ranges::move(grasps, std::back_inserter(round.grasps));
    }
    std::ranges::move(round.grasps, std::back_inserter(result_.grasps));
    result_.rejections.merge(round.rejections);
}

}  // namespace

Result<SearchResult> search_grasps(const Judgement& judgement, const StopQuery& stop_requested,
                                   StageLog& log) {
    const PlannerConfig& config = judgement.config;
    const Gripper& gripper = judgement.gripper;
    const PreparedObject& object = judgement.object;
    const auto surface = log.run("mesh/sample_surface", object.mesh_P.faces.size(), [&] {
        return sample_surface(object.mesh_P, object.field.value_m, gripper.finger_width_m,
                              config.sample_surface);
    });
    if (!surface) return surface.error();
    log.out("mesh/sample_surface", surface.value().samples.size());
    const auto concavities =
        find_concavities(surface.value(), gripper.finger_thickness_m, config, log);
    if (!concavities) return concavities.error();

    Rounds rounds(judgement, stop_requested, log);
    if (rounds.wanted(kBoundary)) {
        for (std::size_t i = 0; i < concavities.value().size() && !rounds.stopped(); ++i) {
            rounds.run(boundary_axes(concavities.value()[i], static_cast<std::int32_t>(i),
                                     surface.value(), object, gripper, config, log),
                       config.search.boundary_pairs);
        }
    }
    if ((rounds.wanted(kWall) || rounds.wanted(kWholeObject)) && !rounds.stopped()) {
        const auto axes =
            opposite_axes(concavities.value(), surface.value(), object, gripper, config, log);
        for (const GraspSource source : {kWall, kWholeObject}) {
            if (!rounds.wanted(source) || rounds.stopped()) continue;
            std::vector<ClosingAxis> of_source;
            std::ranges::copy_if(axes, std::back_inserter(of_source),
                                 [&](const ClosingAxis& a) { return a.source == source; });
            rounds.run(std::move(of_source), config.search.opposite_pairs);
        }
    }
    return rounds.take();
}

}  // namespace graspd::planner_detail
