#include "convert_reply.hpp"

#include <algorithm>

namespace graspd::dds {
namespace {

constexpr const char* kScoreKind = "calibrated";
constexpr const char* kConvention = "tcp_z_approach_x_closing";
constexpr PoseTolerance kNotMeasured{-1.0, -1.0};
constexpr std::size_t kMostNearMisses = 3;  // the bound of idl/graspd.idl

wire::LinearMotion_ write_motion(const LinearMotion& motion) {
    wire::LinearMotion_ out;
    out.direction(write_vector(motion.direction_F));
    out.distance(motion.distance_m);
    return out;
}

wire::Grasp_ write_grasp(const Grasp& in) {
    wire::Grasp_ out;
    out.pose(write_pose(in.X_FG));
    out.pre_grasp_pose(write_pose(in.X_FG_pregrasp));
    out.hand_pose(write_pose(in.X_FH));
    out.approach(write_motion(in.approach));
    out.retreat(write_motion(in.retreat));
    out.open_width(in.open_width_m);
    out.width(in.width_m);
    for (std::size_t side = 0; side < in.contacts.size(); ++side) {
        out.contacts()[side].point(write_point(in.contacts[side].point_F));
        out.contacts()[side].normal(write_vector(in.contacts[side].normal_F));
    }
    out.gripper(in.gripper_name);
    out.concavity_index(in.concavity_index);
    out.concavity_depth(in.concavity_depth_m);
    out.clearance(in.clearance_m);
    out.beta(in.beta_rad);
    out.min_friction(in.min_friction);
    out.min_force(in.min_force_N);
    out.score(in.score);
    for (const ScoreTerm& term : in.terms) {
        wire::ScoreTerm_& entry = out.terms().emplace_back();
        entry.name(term.name);
        entry.value(term.value);
    }
    out.source(in.source);
    const PoseTolerance tolerance = in.tolerance.value_or(kNotMeasured);
    out.tolerance_shift(tolerance.shift_m);
    out.tolerance_turn(tolerance.turn_rad);
    return out;
}

wire::Report_ write_report(const PlanReport& in) {
    wire::Report_ out;
    for (const StageReport& stage : in.stages) {
        wire::StageReport_& entry = out.stages().emplace_back();
        entry.name(stage.name);
        entry.ms(stage.ms);
        entry.items_in(stage.in);
        entry.items_out(stage.out);
    }
    for (const RejectionCount& rejection : in.rejections) {
        wire::RejectionCount_& entry = out.rejections().emplace_back();
        entry.reason(rejection.reason);
        entry.count(rejection.count);
    }
    for (std::size_t i = 0; i < std::min(in.near_misses.size(), kMostNearMisses); ++i) {
        wire::NearMiss_& entry = out.near_misses().emplace_back();
        entry.pose(write_pose(in.near_misses[i].X_FG));
        entry.reason(in.near_misses[i].reason);
        entry.margin(in.near_misses[i].margin);
        entry.unit(in.near_misses[i].unit);
    }
    for (const Finding& finding : in.findings) {
        wire::Finding_& entry = out.findings().emplace_back();
        entry.code(finding.code);
        entry.value(finding.value);
        entry.detail(finding.detail);
    }
    out.suggestion(in.suggestion);
    return out;
}

Eigen::Vector3d vector_of(const geometry_msgs::msg::dds_::Vector3_& v) {
    return {v.x(), v.y(), v.z()};
}

Eigen::Vector3d vector_of(const geometry_msgs::msg::dds_::Point_& p) {
    return {p.x(), p.y(), p.z()};
}

LinearMotion read_motion(const wire::LinearMotion_& motion) {
    return {vector_of(motion.direction()), motion.distance()};
}

GraspSource read_source(std::uint8_t source, const std::string& path, FirstError& errors) {
    for (const GraspSource known : {kBoundary, kWall, kWholeObject}) {
        if (source == known) return known;
    }
    errors.invalid(path + ".source = " + std::to_string(source) + " must be 1, 2 or 4");
    return kBoundary;
}

Grasp read_grasp(const wire::Grasp_& in, const std::string& path, FirstError& errors) {
    Grasp out;
    out.X_FG = read_pose(in.pose(), path + ".pose", errors);
    out.X_FG_pregrasp = read_pose(in.pre_grasp_pose(), path + ".pre_grasp_pose", errors);
    out.X_FH = read_pose(in.hand_pose(), path + ".hand_pose", errors);
    out.approach = read_motion(in.approach());
    out.retreat = read_motion(in.retreat());
    out.open_width_m = in.open_width();
    out.width_m = in.width();
    for (std::size_t side = 0; side < out.contacts.size(); ++side) {
        out.contacts[side] = {vector_of(in.contacts()[side].point()),
                              vector_of(in.contacts()[side].normal())};
    }
    out.gripper_name = in.gripper();
    out.concavity_index = in.concavity_index();
    out.concavity_depth_m = in.concavity_depth();
    out.clearance_m = in.clearance();
    out.beta_rad = in.beta();
    out.min_friction = in.min_friction();
    out.min_force_N = in.min_force();
    out.score = in.score();
    for (const wire::ScoreTerm_& term : in.terms()) {
        out.terms.push_back({term.name(), term.value()});
    }
    out.source = read_source(in.source(), path, errors);
    if (in.tolerance_shift() >= 0.0 && in.tolerance_turn() >= 0.0) {
        out.tolerance = {in.tolerance_shift(), in.tolerance_turn()};
    }
    return out;
}

PlanReport read_report(const wire::Report_& in, FirstError& errors) {
    PlanReport out;
    for (const wire::StageReport_& stage : in.stages()) {
        out.stages.push_back({stage.name(), stage.ms(), stage.items_in(), stage.items_out()});
    }
    for (const wire::RejectionCount_& rejection : in.rejections()) {
        out.rejections.push_back({rejection.reason(), rejection.count()});
    }
    check_count(in.near_misses().size(), kMostNearMisses, "report.near_misses", errors);
    for (std::size_t i = 0; i < in.near_misses().size() && !errors.any(); ++i) {
        const wire::NearMiss_& miss = in.near_misses()[i];
        const std::string path = element("report.near_misses", i);
        out.near_misses.push_back({read_pose(miss.pose(), path + ".pose", errors), miss.reason(),
                                   miss.margin(), miss.unit()});
    }
    for (const wire::Finding_& finding : in.findings()) {
        out.findings.push_back({finding.code(), finding.value(), finding.detail()});
    }
    out.suggestion = in.suggestion();
    return out;
}

}  // namespace

wire::RankedGrasps_ write_reply(const PlanReply& reply, const ReplyEnvelope& envelope) {
    wire::RankedGrasps_ out;
    out.header(envelope.header);
    out.request_writer(envelope.request_writer);
    out.client_id(envelope.client_id);
    out.request_id(envelope.request_id);
    out.attempt(envelope.attempt);
    out.object_key(reply.object_key);
    out.status(static_cast<std::uint8_t>(reply.status));
    out.message(reply.message);
    out.strategy(reply.strategy);
    out.score_kind(kScoreKind);
    out.convention(kConvention);
    for (const Grasp& grasp : reply.grasps) out.grasps().push_back(write_grasp(grasp));
    out.report(write_report(reply.report));
    out.planner_id(envelope.planner_id);
    out.planner_version(envelope.planner_version);
    out.config_hash(envelope.config_hash);
    return out;
}

Result<PlanReply> read_reply(const wire::RankedGrasps_& reply) {
    FirstError errors;
    if (reply.status() > static_cast<std::uint8_t>(PlanStatus::kInternalError)) {
        errors.invalid("status = " + std::to_string(reply.status()) + " must be at most 8");
    }
    if (reply.convention() != kConvention) {
        errors.invalid("convention = " + shown(reply.convention()) + " must be \"" + kConvention +
                       "\"");
    }
    PlanReply out;
    out.request_id = reply.request_id();
    out.frame_id = reply.header().frame_id();
    out.object_key = reply.object_key();
    out.status = static_cast<PlanStatus>(reply.status());
    out.message = reply.message();
    out.strategy = reply.strategy();
    for (std::size_t i = 0; i < reply.grasps().size() && !errors.any(); ++i) {
        out.grasps.push_back(read_grasp(reply.grasps()[i], element("grasps", i), errors));
    }
    out.report = read_report(reply.report(), errors);
    if (errors.any()) return *errors.error();
    return out;
}

}  // namespace graspd::dds
