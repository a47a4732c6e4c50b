#include "graspd/planner/planner.hpp"

#include <algorithm>

#include "answer.hpp"
#include "check_request.hpp"
#include "graspd/base/parallel.hpp"
#include "graspd/base/settings.hpp"
#include "graspd/base/stop.hpp"
#include "judge_candidates.hpp"
#include "pose_tolerance.hpp"
#include "search_grasps.hpp"
#include "select_grasps.hpp"
#include "suggest.hpp"
#include "trace_plan.hpp"

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

/// Prepares an object under its key.
Result<PreparedObjectPtr> prepared_as(std::string object_key,
                                      const std::variant<TriangleMesh, PointCloud>& object_O,
                                      const PlannerConfig& config, StageLog& log) {
    auto object = prepare_object(object_O, config, log);
    if (!object) return object.error();
    object.value().object_key = std::move(object_key);
    return std::make_shared<const PreparedObject>(std::move(object).value());
}

/// Prepares the request's object unless it is there already; says so in the answer.
std::optional<PlanError> make_ready(PreparedObjectPtr& object, const PlanRequest& request,
                                    const PlannerConfig& config, Answer& answer) {
    answer.reply.object_key = object ? object->object_key : object_key_of(request.object_O);
    if (!object) {
        auto fresh = prepared_as(answer.reply.object_key, request.object_O, config, answer.log);
        if (!fresh) return fresh.error();
        object = std::move(fresh).value();
    } else {
        if (object->settings != settings_of_preparation(config)) {
            return PlanError{PlanErrorCode::kInvalidInput,
                             "object " + object->object_key + " was prepared under other settings"};
        }
        for (const StageReport& stage : object->stages) answer.log.add(stage);
    }
    answer.reply.report.findings = object->findings;
    return std::nullopt;
}

/// Gravity's direction as far as the request tells it.
std::optional<Eigen::Vector3d> gravity_P(const PlanRequest& request,
                                         const Eigen::Isometry3d& X_FP) {
    std::optional<Eigen::Vector3d> down_F = request.options.gravity_F;
    if (!down_F && request.support_plane) down_F = -request.support_plane->normal_F;
    if (!down_F) return std::nullopt;
    return Eigen::Vector3d(X_FP.linear().transpose() * down_F->normalized());
}

/// Where the object is and what it weighs: the same whatever limits are planned within.
struct Scene {
    const PreparedObject& object;
    Eigen::Isometry3d X_FP;
    Surroundings surroundings;
    Eigen::Vector3d center_of_mass_P;
    double mass_kg;
    std::optional<Eigen::Vector3d> down_P;  ///< unit, of gravity
    std::vector<SeenSurface> seen;  ///< by the request's grippers, as far as they were asked

    Scene(const PlanRequest& request, const PreparedObject& prepared)
        : object(prepared),
          X_FP(request.X_FO * prepared.X_OP),
          surroundings(request, prepared, X_FP.inverse()),
          center_of_mass_P(
              request.options.center_of_mass_O
                  ? Eigen::Vector3d(prepared.X_OP.inverse() * *request.options.center_of_mass_O)
                  : prepared.center_of_mass_P),
          mass_kg(object_mass_kg(request.options, prepared.volume_m3)),
          down_P(gravity_P(request, X_FP)) {}
};

Judgement judgement_of(const PlanRequest& request, const Scene& scene, const Gripper& gripper,
                       const PlannerConfig& config, bool traced = false) {
    return {request,      scene.object, scene.surroundings.world(), gripper,
            config,       scene.X_FP,   scene.center_of_mass_P,     scene.mass_kg,
            scene.down_P, traced};
}

/// Sections II-B to II-F (concavities, boundaries, candidates, force balance, manipulability): what
/// there is within the limits of a request. When it is stopped, what the rounds until then gave.
Result<Found> find_grasps(const PlanRequest& request, Scene& scene, const PlannerConfig& config,
                          StageLog& log, bool traced = false) {
    Found found;
    found.rejections = Rejections(traced);
    std::vector<GradedGrasp> grasps;
    for (std::size_t i = 0; i < request.grippers.size() && !found.stopped; ++i) {
        const Gripper& gripper = request.grippers[i];
        const bool searches = request.candidates_FH.empty();
        const bool across =
            is_wanted(kWall, request.options) || is_wanted(kWholeObject, request.options);
        if (searches && scene.seen.size() == i) {
            auto seen = see_surface(scene.object, gripper, config, across, log);
            if (!seen) return seen.error();
            scene.seen.push_back(std::move(seen).value());
        } else if (searches && across && !scene.seen[i].across) {
            scene.seen[i].across = look_across(scene.object, gripper, config);
        }
        const Judgement judgement = judgement_of(request, scene, gripper, config, traced);
        auto of_gripper = searches ? search_grasps(judgement, scene.seen[i], log)
                                   : judge_candidates(judgement, log);
        std::ranges::move(of_gripper.grasps, std::back_inserter(grasps));
        found.rejections.merge(of_gripper.rejections);
        found.boundaries.push_back(std::move(of_gripper.boundaries));
        found.stopped = of_gripper.stopped;
    }
    // II-F: the best per concavity, then the best over all; of what was found until a stop as well.
    const StopScope to_the_end(nullptr);
    auto best = select_grasps(std::move(grasps), scene.surroundings.world(), request, config,
                              scene.X_FP, found.rejections, log);
    if (!best) return best.error();
    found.grasps = std::move(best).value();
    return found;
}

/// What errors of the hand's pose the best few stand; none is told when this is stopped.
void measure_tolerances(const PlanRequest& request, std::vector<Grasp>& grasps, const Scene& scene,
                        const PlannerConfig& config, StageLog& log) {
    const std::size_t count = std::min<std::size_t>(config.search.tolerances, grasps.size());
    if (count == 0) return;
    constexpr const char* kTolerance = "planner/pose_tolerance";
    std::vector<PoseTolerance> tolerances(count);
    log.run(kTolerance, count, [&] {
        for_blocks(count, 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const auto gripper =
                    std::ranges::find(request.grippers, grasps[i].gripper_name, &Gripper::name);
                tolerances[i] =
                    pose_tolerance(grasps[i], judgement_of(request, scene, *gripper, config));
            }
        });
        return 0;
    });
    for (std::size_t i = 0; i < count; ++i) grasps[i].tolerance = tolerances[i];
    log.out(kTolerance, count);
}

/// What would help, by planning again for the same object within other limits. Throws Stopped.
std::string suggestion_for(const PlanRequest& request, const Found& found, Scene& scene,
                           const PlannerConfig& config, StageLog& log) {
    constexpr const char* kSuggest = "planner/suggest";
    PlanRequest limits = request;  // copied for every plan, so without its bulk
    limits.object_O = TriangleMesh{};
    limits.obstacles.clear();
    const Replan replan = [&](const PlanRequest& changed) -> std::vector<Grasp> {
        StageLog log_of_its_own;
        auto again = find_grasps(changed, scene, config, log_of_its_own);
        if (!again) return std::vector<Grasp>{};
        if (again.value().stopped) throw Stopped{kSuggest};
        return std::move(again.value().grasps);
    };
    const double widest_m =
        mesh_diagonal_m(scene.object.mesh_P) + 2.0 * config.manipulability.preshape_margin_m;
    const Verdict verdict{limits, found.grasps, found.rejections, widest_m};
    const auto suggestion =
        log.run(kSuggest, 0, [&] { return suggest(verdict, config.suggest, replan); });
    log.count(kSuggest, suggestion.plans, suggestion.text.empty() ? 0 : 1);
    return suggestion.text;
}

/// Throws Stopped where the caller wants no more; `answer` then holds what was concluded.
PlanReply plan_to_the_end(const PlanRequest& request, PreparedObjectPtr& object,
                          const PlannerConfig& config, Answer& answer, PlanTrace* trace) {
    if (const auto bad = check_settings(config)) return answer.refuse(*bad);
    if (const auto bad = check_request(request)) return answer.refuse(*bad);
    // II-A: the object and its concavity.
    if (const auto bad = make_ready(object, request, config, answer)) return answer.refuse(*bad);
    const auto units = guess_units(object->size_m, request.grippers, config.guess_units);
    if (!units) return answer.refuse(units.error());
    if (units.value()) answer.reply.report.findings.push_back(*units.value());

    Scene scene(request, *object);
    if (trace != nullptr) trace_object(scene.X_FP, scene.object, scene.center_of_mass_P, *trace);
    const auto found = find_grasps(request, scene, config, answer.log, trace != nullptr);
    if (!found) return answer.refuse(found.error());
    if (trace != nullptr) trace_search(request, scene.seen, found.value(), *trace);
    answer.conclude(found.value(), scene.X_FP);
    if (found.value().stopped) return answer.stop(*found.value().stopped);
    measure_tolerances(request, answer.reply.grasps, scene, config, answer.log);

    if (request.options.want_suggestion || found.value().grasps.empty()) {
        answer.reply.report.suggestion =
            suggestion_for(request, found.value(), scene, config, answer.log);
    }
    return answer.finish();
}

}  // namespace

Result<PreparedObjectPtr> prepare(const std::variant<TriangleMesh, PointCloud>& object_O,
                                  const PlannerConfig& config) {
    if (const auto bad = check_settings(config)) return *bad;
    StageLog log;
    return prepared_as(object_key_of(object_O), object_O, config, log);
}

double object_mass_kg(const PlanOptions& options, double volume_m3) {
    return options.mass_kg.value_or(
        std::clamp(kDensity_kg_m3 * volume_m3, kLeastMass_kg, kGreatestMass_kg));
}

PlanReply plan(const PlanRequest& request, const PlannerConfig& config,
               const StopQuery& stop_requested, PlanTrace* trace) {
    PreparedObjectPtr object;
    return plan(request, object, config, stop_requested, trace);
}

PlanReply plan(const PlanRequest& request, PreparedObjectPtr& object, const PlannerConfig& config,
               const StopQuery& stop_requested, PlanTrace* trace) {
    const StopScope stoppable(stop_requested);
    if (trace != nullptr) *trace = {};
    Answer answer(request);
    try {
        return plan_to_the_end(request, object, config, answer, trace);
    } catch (const Stopped& stopped) {
        return answer.stop(stopped);
    }
}

}  // namespace graspd
