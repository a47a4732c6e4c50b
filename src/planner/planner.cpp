#include "graspd/planner/planner.hpp"

#include <algorithm>

#include "check_request.hpp"
#include "graspd/base/fnv1a.hpp"
#include "graspd/base/settings.hpp"
#include "search_grasps.hpp"
#include "select_grasps.hpp"

namespace graspd {
namespace {

using namespace planner_detail;

// Defaults of the request's mass (DESIGN 5, Score).
constexpr double kDensity_kg_m3 = 500.0;
constexpr double kLeastMass_kg = 0.02;
constexpr double kGreatestMass_kg = 0.5;

/// Named, because validate() is a gripper's too.
std::optional<PlanError> check_settings(const PlannerConfig& config) {
    return validate<PlannerConfig>(config);
}

PlanStatus status_of(PlanErrorCode code) {
    switch (code) {
        case PlanErrorCode::kUnknownGripper: return PlanStatus::kUnknownGripper;
        case PlanErrorCode::kUnknownObject: return PlanStatus::kUnknownObject;
        case PlanErrorCode::kInternal: return PlanStatus::kInternalError;
        default: return PlanStatus::kInvalidRequest;
    }
}

std::string strategy_of(const std::vector<Grasp>& grasps) {
    if (grasps.empty()) return "";
    const auto whole = std::ranges::count(grasps, kWholeObject, &Grasp::source);
    if (whole == 0) return "concavity";
    return whole == std::ssize(grasps) ? "whole_object" : "mixed";
}

std::string why_none(const std::vector<RejectionCount>& rejections) {
    if (rejections.empty()) return "no candidate was found";
    std::uint64_t all = 0;
    for (const RejectionCount& row : rejections) all += row.count;
    return "none of " + std::to_string(all) + " candidates holds and is free; most fell by " +
           rejections.front().reason + " (" + std::to_string(rejections.front().count) + ")";
}

/// The reply under construction.
struct Answer {
    PlanReply reply;
    StageLog log;
    Rejections rejections;

    PlanReply refuse(const PlanError& error) {
        reply.status = status_of(error.code);
        reply.message = error.detail;
        reply.report.stages = log.take();
        return std::move(reply);
    }
    PlanReply finish(std::vector<Grasp> grasps, bool stopped, const Eigen::Isometry3d& X_FP) {
        reply.grasps = std::move(grasps);
        reply.strategy = strategy_of(reply.grasps);
        reply.report.rejections = rejections.counts();
        reply.report.near_misses = rejections.misses();
        for (NearMiss& miss : reply.report.near_misses) miss.X_FG = X_FP * miss.X_FG;
        reply.report.stages = log.take();
        const bool none = reply.grasps.empty();
        reply.status =
            stopped ? PlanStatus::kPartial : (none ? PlanStatus::kNoGrasp : PlanStatus::kOk);
        if (stopped)
            reply.message = "stopped before the end; the best of the rounds that were done";
        if (none && !stopped) reply.message = why_none(reply.report.rejections);
        return std::move(reply);
    }
};

}  // namespace

std::string object_key_of(const std::variant<TriangleMesh, PointCloud>& object_O) {
    std::uint64_t hash = kFnvOffset;
    const auto add = [&](const auto& items) {
        if (items.empty()) return;
        using Item = std::remove_cvref_t<decltype(items.front())>;
        hash =
            fnv1a({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)}, hash);
    };
    if (const auto* mesh = std::get_if<TriangleMesh>(&object_O)) {
        add(mesh->vertices);
        add(mesh->faces);
    } else {
        add(std::get<PointCloud>(object_O).points);
    }
    return to_hex(hash);
}

double object_mass_kg(const PlanOptions& options, double volume_m3) {
    return options.mass_kg.value_or(
        std::clamp(kDensity_kg_m3 * volume_m3, kLeastMass_kg, kGreatestMass_kg));
}

PlanReply plan(const PlanRequest& request, const PlannerConfig& config,
               const StopQuery& stop_requested) {
    Answer answer;
    answer.reply.request_id = request.request_id;
    answer.reply.frame_id = request.frame_id;
    if (const auto bad = check_settings(config)) return answer.refuse(*bad);
    if (const auto bad = check_request(request)) return answer.refuse(*bad);
    answer.reply.object_key = object_key_of(request.object_O);

    // II-A: the object and its concavity.
    auto object = prepare_object(request.object_O, config, answer.log);
    if (!object) return answer.refuse(object.error());
    answer.reply.report.findings = object.value().findings;
    const Eigen::Isometry3d& X_OP = object.value().X_OP;
    const Eigen::Isometry3d X_FP = request.X_FO * X_OP;
    const Surroundings surroundings(request, object.value(), X_FP.inverse());
    const Eigen::Vector3d center_of_mass_P =
        request.options.center_of_mass_O
            ? Eigen::Vector3d(X_OP.inverse() * *request.options.center_of_mass_O)
            : object.value().center_of_mass_P;

    // II-B to II-F: concavities, boundaries, candidates, force balance, manipulability.
    std::vector<GradedGrasp> grasps;
    bool stopped = false;
    for (const Gripper& gripper : request.grippers) {
        const Judgement judgement{request,
                                  object.value(),
                                  surroundings.world(),
                                  gripper,
                                  config,
                                  X_FP,
                                  center_of_mass_P,
                                  object_mass_kg(request.options, object.value().volume_m3)};
        auto found = search_grasps(judgement, stop_requested, answer.log);
        if (!found) return answer.refuse(found.error());
        std::ranges::move(found.value().grasps, std::back_inserter(grasps));
        answer.rejections.merge(found.value().rejections);
        stopped = found.value().stopped;
        if (stopped) break;
    }

    // II-F: the best per concavity, then the best over all.
    auto best = select_grasps(std::move(grasps), surroundings.world(), request, config, X_FP,
                              answer.rejections, answer.log);
    if (!best) return answer.refuse(best.error());
    return answer.finish(std::move(best).value(), stopped, X_FP);
}

}  // namespace graspd
