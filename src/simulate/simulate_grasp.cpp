#include "graspd/simulate/simulate_grasp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "graspd/base/gravity.hpp"
#include "graspd/collision/gripper_collision.hpp"
#include "graspd/collision/manipulability.hpp"
#include "hand_motion.hpp"
#include "hand_scene.hpp"
#include "solid.hpp"

namespace graspd {
namespace {

using namespace simulate_detail;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using Phase = SimulationPhase;

constexpr double kSqueeze_s = 0.1;       // the grip force comes on
constexpr double kFloatRate_1_s = 10.0;  // the floating object's motion dies away in 0.1 s
constexpr double kLost_s = 0.05;         // without touch: the object may bounce for a moment
constexpr double kFar_m = 0.15;          // longer than any finger that we know
constexpr double kRayTolerance = 1e-6;   // of the diagonal
constexpr double kClosingStep_m = 0.0005;
constexpr double kApproachTime_s = 0.8;  // of the recorded frames; the check needs no time
constexpr double kClosingSpeed_m_s = 0.1;

std::optional<PlanError> check(const SimulationConfig& config) {
    struct Row {
        const char* field;
        double value, least, greatest;
    };
    const Row rows[] = {{"friction", config.friction, 1e-6, 100.0},
                        {"torsion", config.torsion_m, 0.0, 1.0},
                        {"grip_force", config.grip_force_N, 1e-3, 1e5},
                        {"mass", config.mass_kg, 1e-6, 1e4},
                        {"approach_slack", config.approach_slack_m, 0.0, 0.01},
                        {"lift", config.lift_m, 0.0, 10.0},
                        {"shake", config.shake_m, 0.0, 1.0},
                        {"shake", config.shake_rad, 0.0, 3.0},
                        {"most_shift", config.most_shift_m, 0.0, 10.0},
                        {"most_turn", config.most_turn_rad, 0.0, std::numbers::pi},
                        {"time_step", config.time_step_s, 1e-5, 0.002},
                        {"frame_interval", config.frame_interval_s, 0.0, 100.0}};
    for (const Row& row : rows) {
        if (row.value >= row.least && row.value <= row.greatest) continue;
        std::ostringstream text;
        text << "simulation." << row.field << " = " << row.value << " is outside [" << row.least
             << ", " << row.greatest << "]";
        return PlanError{PlanErrorCode::kInvalidInput, text.str()};
    }
    return std::nullopt;
}

double diagonal_m(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d bounds;
    for (const Vector3d& vertex : mesh.vertices) bounds.extend(vertex);
    return bounds.diagonal().norm();
}

/// One execution.
class Execution {
public:
    Execution(const TriangleMesh& mesh_F, const Solid& solid, const Gripper& gripper,
              const Grasp& grasp, const std::optional<SupportPlane>& plane,
              const SimulationConfig& config)
        : mesh_(mesh_F),
          bvh_(mesh_F, kRayTolerance * diagonal_m(mesh_F)),
          solid_(solid),
          gripper_(gripper),
          grasp_(grasp),
          config_(config),
          up_F_(config.up_F ? *config.up_F
                : plane     ? plane->normal_F
                            : Vector3d(-grasp.X_FG.linear().col(2))) {
        world_.object = {&mesh_, &bvh_};
        if (plane) world_.plane = HalfSpace{plane->normal_F, plane->offset_m};
    }

    SimulationResult run() {
        approach() && reach() && squeeze();
        return std::move(result_);
    }

private:
    bool end(GraspVerdict verdict, const std::string& detail) {
        result_.verdict = verdict;
        result_.detail = detail;
        return false;
    }

    /// The open hand on its way, by its exact swept volume.
    bool approach() {
        result_.phase = Phase::kApproach;
        const char* const names[] = {"palm", "left finger", "right finger"};
        auto boxes = swept_approach(gripper_, grasp_.X_FG, grasp_.width_m, grasp_.open_width_m,
                                    grasp_.approach.distance_m);
        record_approach();
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            boxes[i].half_extent.array() -= config_.approach_slack_m;
            boxes[i].half_extent = boxes[i].half_extent.cwiseMax(1e-6);
            const auto partner = find_collision(world_, boxes[i]);
            if (!partner) continue;
            return end(GraspVerdict::kCollision, std::string("the open hand's ") + names[i] +
                                                     " meets the " + to_string(*partner) +
                                                     " on its way");
        }
        return true;
    }

    bool fingers_touch(double opening_m) const {
        const auto parts = gripper_parts(gripper_, grasp_.width_m, opening_m);
        CollisionWorld object_only;
        object_only.object = world_.object;
        for (const std::size_t finger : {1, 2}) {
            OrientedBox box{grasp_.X_FG, 0.5 * parts[finger].box_G.sizes()};
            box.pose.translation() = grasp_.X_FG * parts[finger].box_G.center();
            if (find_collision(object_only, box)) return true;
        }
        return false;
    }

    /// Closes until a finger is about to touch.
    bool reach() {
        result_.phase = Phase::kClose;
        const double least = gripper_.min_width_m;
        double free = std::max(grasp_.open_width_m, least), touching = free;
        while (!fingers_touch(touching)) {
            free = touching;
            record(Phase::kClose, grasp_.X_FG, Isometry3d::Identity(), free,
                   0.5 * kClosingStep_m / kClosingSpeed_m_s);
            if (free <= least) {
                result_.width_m = least;
                return end(GraspVerdict::kNoContact, "the fingers close and meet nothing");
            }
            touching = std::max(least, free - kClosingStep_m);
        }
        for (int halving = 0; halving < 12; ++halving) {
            const double middle = 0.5 * (free + touching);
            (fingers_touch(middle) ? touching : free) = middle;
        }
        opening_m_ = free;
        return true;
    }

    /// Everything that physics decides.
    bool squeeze() {
        HandScene scene({&mesh_, solid_, gripper_, grasp_.X_FG, grasp_.width_m, opening_m_},
                        config_);
        const bool held =
            pass(scene, Phase::kClose) && pass(scene, Phase::kLift) && pass(scene, Phase::kShake);
        result_.width_m = scene.opening_m();
        return held && judge();
    }

    Isometry3d path(Phase phase, double time_s) const {
        Isometry3d X_FG = grasp_.X_FG;
        if (phase < Phase::kLift) return X_FG;
        X_FG.pretranslate(
            lift_at(phase == Phase::kLift ? time_s : duration_s(Phase::kLift), up_F_, config_));
        return phase == Phase::kShake ? X_FG * shake_at(time_s, config_) : X_FG;
    }

    /// One phase. @return whether both fingers hold the object at its end
    bool pass(HandScene& scene, Phase phase) {
        result_.phase = phase;
        const double duration = duration_s(phase);
        const auto steps = static_cast<int>(std::lround(duration / config_.time_step_s));
        scene.set_object_damping(phase == Phase::kClose ? kFloatRate_1_s : 0.0);
        std::array<double, 3> untouched_s{};  // since palm, left, right finger touched it last
        for (int step = 0; step < steps; ++step) {
            const double time_s = (step + 1) * config_.time_step_s;
            if (phase == Phase::kClose) {
                scene.set_grip_force(config_.grip_force_N * std::min(1.0, time_s / kSqueeze_s));
            }
            scene.set_weight(-kGravity_m_s2 * config_.mass_kg * weight_share(phase, time_s) *
                             up_F_);
            scene.step_to(path(phase, time_s));
            const auto touches = scene.touching();
            for (std::size_t i = 0; i < 3; ++i) {
                untouched_s[i] = touches[i] ? 0.0 : untouched_s[i] + config_.time_step_s;
            }
            X_GO_ = scene.X_FG().inverse(Eigen::Isometry) * scene.X_FO();
            record(phase, scene.X_FG(), scene.X_FO(), scene.opening_m(), config_.time_step_s);
            const bool gone = *std::ranges::min_element(untouched_s) > kLost_s ||
                              shift_m(grasp_.X_FG.inverse(Eigen::Isometry)) > kFar_m;
            if (gone && phase != Phase::kClose) return lost(phase, "the hand loses the object");
        }
        if (phase == Phase::kClose) {
            const Isometry3d X_GO_before = grasp_.X_FG.inverse(Eigen::Isometry);
            result_.close_shift_m = shift_m(X_GO_before);
            result_.close_turn_rad = turn_rad(X_GO_before);
            X_GO_closed_ = X_GO_;
        }
        if (untouched_s[1] > kLost_s || untouched_s[2] > kLost_s) {
            return lost(phase, "only one finger or none touches the object");
        }
        return true;
    }

    bool lost(Phase phase, const std::string& how) {
        return end(GraspVerdict::kDropped, how + " in the phase " + to_string(phase));
    }

    /// What became of the object's point at the TCP since another pose in the hand.
    double shift_m(const Isometry3d& X_GO_before) const {
        return (X_GO_ * X_GO_before.inverse(Eigen::Isometry)).translation().norm();
    }
    double turn_rad(const Isometry3d& X_GO_before) const {
        return Eigen::AngleAxisd(X_GO_.linear() * X_GO_before.linear().transpose()).angle();
    }

    bool judge() {
        result_.shift_m = shift_m(X_GO_closed_);
        result_.turn_rad = turn_rad(X_GO_closed_);
        const bool still =
            result_.shift_m <= config_.most_shift_m && result_.turn_rad <= config_.most_turn_rad;
        end(still ? GraspVerdict::kHolds : GraspVerdict::kSlips,
            still ? "both fingers hold it through lift and shake"
                  : "both fingers hold it, but it slipped");
        return still;
    }

    void record_approach() {
        if (config_.frame_interval_s <= 0.0) return;
        const auto count = std::lround(kApproachTime_s / config_.frame_interval_s);
        for (long i = 0; i < count; ++i) {
            const double left = 1.0 - double(i) / double(count);
            Isometry3d X_FG = grasp_.X_FG;
            X_FG.translate(Vector3d(0.0, 0.0, -left * grasp_.approach.distance_m));
            result_.frames.push_back(
                {Phase::kApproach, X_FG, Isometry3d::Identity(), grasp_.open_width_m});
        }
    }

    /// Adds a frame when it is time. @param step_s  since the last call
    void record(Phase phase, const Isometry3d& X_FG, const Isometry3d& X_FO, double opening_m,
                double step_s) {
        if (config_.frame_interval_s <= 0.0) return;
        since_frame_s_ += step_s;
        if (since_frame_s_ < config_.frame_interval_s * (1.0 - 1e-9)) return;
        since_frame_s_ -= config_.frame_interval_s;
        result_.frames.push_back({phase, X_FG, X_FO, opening_m});
    }

    const TriangleMesh& mesh_;
    TriangleBvh bvh_;
    const Solid& solid_;
    const Gripper& gripper_;
    const Grasp& grasp_;
    const SimulationConfig& config_;
    Vector3d up_F_;
    CollisionWorld world_;
    double opening_m_ = 0.0;
    Isometry3d X_GO_ = Isometry3d::Identity(), X_GO_closed_ = Isometry3d::Identity();
    double since_frame_s_ = 0.0;
    SimulationResult result_;
};

}  // namespace

const char* to_string(GraspVerdict verdict) {
    switch (verdict) {
        case GraspVerdict::kHolds: return "holds";
        case GraspVerdict::kCollision: return "collision";
        case GraspVerdict::kNoContact: return "no_contact";
        case GraspVerdict::kDropped: return "dropped";
        case GraspVerdict::kSlips: return "slips";
    }
    return "unknown";
}

const char* to_string(SimulationPhase phase) {
    switch (phase) {
        case SimulationPhase::kApproach: return "approach";
        case SimulationPhase::kClose: return "close";
        case SimulationPhase::kLift: return "lift";
        case SimulationPhase::kShake: return "shake";
    }
    return "unknown";
}

Result<SimulationResult> simulate_grasp(const TriangleMesh& mesh_F, const Gripper& gripper,
                                        const Grasp& grasp,
                                        const std::optional<SupportPlane>& plane,
                                        const SimulationConfig& config) {
    if (auto bad = check(config)) return *bad;
    if (auto bad = validate(gripper)) return *bad;
    if (!grasp.X_FG.matrix().allFinite()) {
        return PlanError{PlanErrorCode::kInvalidInput, "the grasp's pose is not finite"};
    }
    const Solid solid = solid_of(mesh_F);
    if (!(solid.volume_m3 > 0.0)) {
        return PlanError{PlanErrorCode::kDegenerate, "simulation: the mesh encloses a volume of " +
                                                         std::to_string(solid.volume_m3) + " m3"};
    }
    try {
        return Execution(mesh_F, solid, gripper, grasp, plane, config).run();
    } catch (const std::runtime_error& error) {
        return PlanError{PlanErrorCode::kInternal, error.what()};
    }
}

}  // namespace graspd
