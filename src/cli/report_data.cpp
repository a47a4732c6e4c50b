#include "report_data.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "base64.hpp"
#include "json_values.hpp"

namespace graspd::cli {
namespace {

constexpr const char* kReportSchema = "graspd-report/1";

/// Coordinates one after the other, as floats.
class Coordinates {
public:
    /// @param X_VA  pose of the points' frame in the view's
    explicit Coordinates(const Eigen::Isometry3d& X_VA) : X_VA_(X_VA) {}
    Coordinates& add(const Eigen::Vector3d& point_A) {
        const Eigen::Vector3d point = X_VA_ * point_A;
        for (const double value : {point.x(), point.y(), point.z()}) {
            values_.push_back(static_cast<float>(value));
        }
        return *this;
    }
    Coordinates& add(const std::vector<Eigen::Vector3d>& points_A) {
        values_.reserve(values_.size() + 3 * points_A.size());
        for (const Eigen::Vector3d& point : points_A) add(point);
        return *this;
    }
    std::string text() const { return base64_of(values_); }

private:
    Eigen::Isometry3d X_VA_;
    std::vector<float> values_;
};

std::string floats(const std::vector<double>& values) {
    return base64_of(std::vector<float>(values.begin(), values.end()));
}

std::string indices_of(const std::vector<Triangle>& faces) {
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * faces.size());
    for (const Triangle& face : faces) indices.insert(indices.end(), face.begin(), face.end());
    return base64_of(indices);
}

Json object_of(const TracedObject& object, const Eigen::Isometry3d& X_VP) {
    std::vector<std::uint8_t> flags;
    for (const ConcavityFlag flag : object.flag) flags.push_back(static_cast<std::uint8_t>(flag));
    return {{"vertices", Coordinates(X_VP).add(object.mesh_P.vertices).text()},
            {"faces", indices_of(object.mesh_P.faces)},
            {"concavity", floats(object.concavity_m)},
            {"flags", base64_of(flags)},
            {"hull", base64_of(object.hull)},
            {"volume", object.volume_m3},
            {"center_of_mass", json_of(Eigen::Vector3d(X_VP * object.center_of_mass_P))}};
}

Json search_of(const TracedSearch& search, const Eigen::Isometry3d& X_VP) {
    Coordinates points(X_VP);
    for (const SurfaceSample& sample : search.surface_P.samples) points.add(sample.point);
    Json concavities = Json::array();
    for (const Concavity& concavity : search.concavities) {
        concavities.push_back({{"depth", concavity.depth_m},
                               {"salient", base64_of(concavity.salient)},
                               {"enlarged", base64_of(concavity.enlarged)}});
    }
    Json boundaries = Json::array();
    for (const TracedBoundary& boundary : search.boundaries) {
        boundaries.push_back({{"concavity", boundary.concavity},
                              {"points", Coordinates(X_VP).add(boundary.ordered_P).text()},
                              {"steps", Coordinates(X_VP).add(boundary.steps_P).text()}});
    }
    return {{"gripper", search.gripper_name},
            {"points", points.text()},
            {"spacing", search.surface_P.spacing_m},
            {"concavities", std::move(concavities)},
            {"boundaries", std::move(boundaries)}};
}

/// Numbers given to names in the order in which they come.
class NameTable {
public:
    std::uint8_t number_of(const std::string& name) {
        const auto [entry, is_new] =
            numbers_.try_emplace(name, static_cast<std::uint8_t>(names_.size()));
        if (is_new) names_.push_back(name);
        return entry->second;
    }
    const std::vector<std::string>& names() const { return names_; }

private:
    std::map<std::string, std::uint8_t> numbers_;
    std::vector<std::string> names_;
};

/// Candidates by columns.
struct CandidateColumns {
    NameTable reasons, grippers;
    std::vector<std::string> units;  ///< of the margins, one a reason
    std::vector<std::uint8_t> reason, gripper, source;
    std::vector<std::int32_t> concavity;
    std::vector<float> quaternion, width, margin, beta, min_friction, score;

    void add(const TracedCandidate& candidate, const Eigen::Matrix3d& rotation_VG) {
        reason.push_back(reasons.number_of(candidate.reason));
        units.resize(reasons.names().size());
        if (!candidate.unit.empty()) units[reason.back()] = candidate.unit;
        gripper.push_back(grippers.number_of(candidate.gripper_name));
        source.push_back(static_cast<std::uint8_t>(candidate.source));
        concavity.push_back(candidate.concavity);
        const Eigen::Quaternionf turn(rotation_VG.cast<float>());
        quaternion.insert(quaternion.end(), {turn.x(), turn.y(), turn.z(), turn.w()});
        width.push_back(static_cast<float>(candidate.width_m));
        margin.push_back(static_cast<float>(candidate.margin));
        beta.push_back(static_cast<float>(candidate.beta_rad));
        min_friction.push_back(static_cast<float>(candidate.min_friction));
        score.push_back(static_cast<float>(candidate.score));
    }
};

Json candidates_of(const std::vector<TracedCandidate>& candidates, const Eigen::Isometry3d& X_VP) {
    CandidateColumns columns;
    Coordinates positions(X_VP);
    for (const TracedCandidate& candidate : candidates) {
        columns.add(candidate, X_VP.linear() * candidate.X_PG.linear());
        positions.add(candidate.X_PG.translation());
    }
    return {{"count", candidates.size()},
            {"reasons", columns.reasons.names()},
            {"units", columns.units},
            {"grippers", columns.grippers.names()},
            {"reason", base64_of(columns.reason)},
            {"gripper", base64_of(columns.gripper)},
            {"source", base64_of(columns.source)},
            {"concavity", base64_of(columns.concavity)},
            {"position", positions.text()},
            {"quaternion", base64_of(columns.quaternion)},
            {"width", base64_of(columns.width)},
            {"margin", base64_of(columns.margin)},
            {"beta", base64_of(columns.beta)},
            {"min_friction", base64_of(columns.min_friction)},
            {"score", base64_of(columns.score)}};
}

const char* member_name(GripperMember member) {
    switch (member) {
        case GripperMember::kPalm: return "palm";
        case GripperMember::kFingerLeft: return "finger_left";
        case GripperMember::kFingerRight: return "finger_right";
    }
    return "palm";
}

/// The parts in G: what collides, so boxes only where there are no convex parts.
Json parts_of(const Gripper& gripper, double contact_width_m, double opening_m) {
    Json parts = Json::array();
    for (const PlacedPart& part : placed_parts(gripper, contact_width_m, opening_m)) {
        const auto in_G = Eigen::Isometry3d::Identity();
        parts.push_back({{"member", member_name(part.member)},
                         {"points", Coordinates(in_G).add(part.points_G).text()}});
    }
    if (!parts.empty()) return parts;
    for (const GripperPart& part : gripper_parts(gripper, contact_width_m, opening_m)) {
        parts.push_back({{"member", part.name},
                         {"box",
                          {{"min", json_of(Eigen::Vector3d(part.box_G.min()))},
                           {"max", json_of(Eigen::Vector3d(part.box_G.max()))}}}});
    }
    return parts;
}

Json hand_of(const Grasp& grasp, const std::vector<Gripper>& grippers) {
    const auto gripper = std::ranges::find(grippers, grasp.gripper_name, &Gripper::name);
    if (gripper == grippers.end()) return {{"open", Json::array()}, {"contact", Json::array()}};
    return {{"open", parts_of(*gripper, grasp.width_m, grasp.open_width_m)},
            {"contact", parts_of(*gripper, grasp.width_m, grasp.width_m)}};
}

Json options_of(const PlanOptions& options) {
    Json json = {{"max_grasps", options.max_grasps},
                 {"time_budget_s", options.time_budget_s},
                 {"friction", options.friction},
                 {"min_clearance_m", options.min_clearance_m},
                 {"mass_kg", nullptr},
                 {"gravity", nullptr},
                 {"grip_force_N", options.grip_force_N},
                 {"sources", Json::array()},
                 {"suggestion", options.want_suggestion},
                 {"seed", options.seed}};
    if (options.mass_kg) json["mass_kg"] = *options.mass_kg;
    if (options.gravity_F) json["gravity"] = json_of(*options.gravity_F);
    for (const GraspSource source : {kBoundary, kWall, kWholeObject}) {
        const bool wanted = options.sources == 0 || (options.sources & source) != 0;
        if (wanted) json["sources"].push_back(to_string(source));
    }
    return json;
}

Json box_of(const OrientedBox& box) {
    Json rotation = Json::array();
    for (Eigen::Index row = 0; row < 3; ++row) {
        for (Eigen::Index column = 0; column < 3; ++column) {
            rotation.push_back(box.pose.linear()(row, column));
        }
    }
    return {{"position", json_of(Eigen::Vector3d(box.pose.translation()))},
            {"rotation", std::move(rotation)},
            {"half_extent", json_of(box.half_extent)}};
}

Json request_of(const PlanRequest& request, const Eigen::Isometry3d& X_VF) {
    Json json = {{"options", options_of(request.options)},
                 {"grippers", Json::array()},
                 {"support_plane", nullptr},
                 {"obstacles", Json::array()},
                 {"approach_cones", Json::array()},
                 {"keep_out", Json::array()}};
    for (const Gripper& gripper : request.grippers) json["grippers"].push_back(gripper.name);
    if (request.support_plane) {
        json["support_plane"] = {{"normal", json_of(request.support_plane->normal_F)},
                                 {"offset", request.support_plane->offset_m}};
    }
    for (const Obstacle& obstacle : request.obstacles) {
        const Eigen::Isometry3d X_VO = X_VF * obstacle.X_FO;
        json["obstacles"].push_back(
            {{"vertices", Coordinates(X_VO).add(obstacle.mesh.vertices).text()},
             {"faces", indices_of(obstacle.mesh.faces)}});
    }
    for (const ApproachCone& cone : request.approach_cones) {
        json["approach_cones"].push_back(
            {{"axis", json_of(cone.axis_F)}, {"half_angle", cone.half_angle_rad}});
    }
    for (const OrientedBox& box : request.keep_out_F) json["keep_out"].push_back(box_of(box));
    return json;
}

}  // namespace

std::string report_data(const ProcessPlan& plan, const PlanTrace& trace, const std::string& file) {
    const Eigen::Vector3d origin_F = trace.X_FP.translation();
    const Eigen::Isometry3d X_VF(Eigen::Translation3d(-origin_F));
    const Eigen::Isometry3d X_VP = X_VF * trace.X_FP;
    Json searches = Json::array();
    for (const TracedSearch& search : trace.searches) searches.push_back(search_of(search, X_VP));
    Json hands = Json::array();
    for (const Grasp& grasp : plan.reply.grasps) {
        hands.push_back(hand_of(grasp, plan.request.grippers));
    }
    const Json json = {
        {"schema", kReportSchema},
        {"file", std::filesystem::path(file).filename().string()},
        {"origin", json_of(origin_F)},
        {"request", request_of(plan.request, X_VF)},
        {"object", object_of(trace.object, X_VP)},
        {"searches", std::move(searches)},
        {"candidates", candidates_of(trace.candidates, X_VP)},
        {"hands", std::move(hands)},
        {"reply", Json::parse(write_json(plan.reply, plan.request.grippers, plan.origin))}};
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace graspd::cli
