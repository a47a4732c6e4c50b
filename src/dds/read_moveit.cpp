#include <algorithm>

#include "convert_collision_object.hpp"
#include "convert_gripper.hpp"
#include "convert_moveit.hpp"

namespace graspd::dds {
namespace {

constexpr std::size_t kMostObjects = 256;
constexpr std::size_t kMostCandidates = 1000;

// A half space as a box, which ends further away than a gripper (2 m at most) can reach.
constexpr double kHalfWidth_m = 20.0, kHalfDepth_m = 10.0;

std::vector<Gripper> read_gripper(const MoveItCall& call, std::span<const Gripper> known,
                                  const MoveItSettings& settings, FirstError& errors) {
    std::string name = call.group_name().empty() ? settings.gripper : call.group_name();
    if (name.empty() && !known.empty()) name = known.front().name;
    const auto found = std::ranges::find(known, name, &Gripper::name);
    if (found != known.end()) return {*found};
    errors.set(PlanErrorCode::kUnknownGripper, "group_name = " + shown(call.group_name()) +
                                                   " names no gripper (known: " + names_of(known) +
                                                   ")");
    return {};
}

/// All parts as one object.
void read_target(const MoveItCall& call, const std::string& frame_id, PlanRequest& out,
                 FirstError& errors) {
    const CollisionParts target = read_collision_object(call.target(), "target", frame_id, errors);
    if (!target.planes_F.empty()) {
        errors.invalid("target.planes has " + std::to_string(target.planes_F.size()) +
                       " elements: a plane cannot be grasped");
    }
    if (target.solids_O.empty()) {
        errors.invalid(
            "target has neither meshes nor primitives (id = " + shown(call.target().id()) +
            "): graspd knows no planning scene, so send the geometry");
    }
    if (errors.any()) return;
    TriangleMesh whole;
    for (const TriangleMesh& part : target.solids_O) {
        const auto first = static_cast<std::uint32_t>(whole.vertices.size());
        whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const Triangle& face : part.faces) {
            whole.faces.push_back({first + face[0], first + face[1], first + face[2]});
        }
    }
    out.X_FO = target.X_FO;
    out.object_O = std::move(whole);
}

/// Which obstacles carry the object, by the names of support_surfaces.
std::vector<bool> read_supports(const MoveItCall& call, FirstError& errors) {
    std::vector<bool> supports(call.movable_obstacles().size());
    for (std::size_t i = 0; i < call.support_surfaces().size(); ++i) {
        const std::string& name = call.support_surfaces()[i];
        bool found = false;
        for (std::size_t k = 0; k < supports.size(); ++k) {
            if (call.movable_obstacles()[k].id() != name) continue;
            supports[k] = found = true;
        }
        if (found) continue;
        errors.invalid(element("support_surfaces", i) + " = " + shown(name) +
                       " is no id of movable_obstacles: graspd knows no planning scene, so send "
                       "its geometry there");
    }
    return supports;
}

Eigen::Vector3d middle_of(const PlanRequest& request) {
    const auto& mesh = std::get<TriangleMesh>(request.object_O);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& vertex : mesh.vertices) sum += vertex;
    return request.X_FO * Eigen::Vector3d(sum / static_cast<double>(mesh.vertices.size()));
}

/// The plane with its normal towards a place: a thin plane has its solid side where the object is
/// not.
SupportPlane facing(const SupportPlane& plane, const Eigen::Vector3d& place_F) {
    if (plane.normal_F.dot(place_F) >= plane.offset_m) return plane;
    return {-plane.normal_F, -plane.offset_m};
}

OrientedBox behind(const SupportPlane& plane, const Eigen::Vector3d& place_F) {
    const double height_m = plane.normal_F.dot(place_F) - plane.offset_m;
    OrientedBox box;
    box.pose.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), plane.normal_F)
                            .toRotationMatrix();
    box.pose.translation() = place_F - (height_m + kHalfDepth_m) * plane.normal_F;
    box.half_extent = Eigen::Vector3d(kHalfWidth_m, kHalfWidth_m, kHalfDepth_m);
    return box;
}

/// The first plane of a support carries the object; any other is something not to enter.
void read_obstacles(const MoveItCall& call, const std::string& frame_id, PlanRequest& out,
                    FirstError& errors) {
    const std::vector<bool> supports = read_supports(call, errors);
    if (errors.any()) return;
    const Eigen::Vector3d middle_F = middle_of(out);
    for (std::size_t i = 0; i < supports.size() && !errors.any(); ++i) {
        const std::string path = element("movable_obstacles", i);
        CollisionParts parts =
            read_collision_object(call.movable_obstacles()[i], path, frame_id, errors);
        if (parts.solids_O.empty() && parts.planes_F.empty()) {
            errors.invalid(path + " has neither meshes, primitives nor planes (id = " +
                           shown(call.movable_obstacles()[i].id()) + ")");
        }
        for (TriangleMesh& mesh : parts.solids_O) {
            out.obstacles.push_back({std::move(mesh), parts.X_FO});
        }
        for (const SupportPlane& plane : parts.planes_F) {
            const SupportPlane towards = facing(plane, middle_F);
            if (supports[i] && !out.support_plane) {
                out.support_plane = towards;
            } else {
                out.keep_out_F.push_back(behind(towards, middle_F));
            }
        }
        check_count(out.obstacles.size(), kMostParts, "movable_obstacles: meshes and primitives",
                    errors);
        check_count(out.keep_out_F.size(), kMostParts, "movable_obstacles: planes", errors);
    }
}

void read_candidates(const MoveItCall& call, const std::string& frame_id,
                     const MoveItSettings& settings, PlanRequest& out, FirstError& errors) {
    Eigen::Isometry3d X_PH = Eigen::Isometry3d::Identity();
    const auto hand =
        std::ranges::find(settings.hands, out.grippers.front().name, &MoveItHand::gripper);
    if (hand != settings.hands.end()) X_PH = hand->X_HP.inverse();
    const auto& candidates = call.candidate_grasps();
    for (std::size_t i = 0; i < candidates.size() && !errors.any(); ++i) {
        const std::string path = element("candidate_grasps", i) + ".grasp_pose";
        const auto& stamped = candidates[i].grasp_pose();
        check_frame(stamped.header().frame_id(), path, frame_id, errors);
        out.candidates_FH.push_back(read_pose(stamped.pose(), path + ".pose", errors) * X_PH);
    }
    out.options.max_grasps =
        std::max(out.options.max_grasps, static_cast<std::uint32_t>(candidates.size()));
}

}  // namespace

bool has_one_frame(const MoveItCall& call) {
    const std::string& frame_id = call.target().header().frame_id();
    const auto same = [&](const std_msgs::msg::dds_::Header_& header) {
        return header.frame_id().empty() || header.frame_id() == frame_id;
    };
    return std::ranges::all_of(call.movable_obstacles(),
                               [&](const auto& object) { return same(object.header()); }) &&
           std::ranges::all_of(call.candidate_grasps(), [&](const auto& grasp) {
               return same(grasp.grasp_pose().header());
           });
}

Result<PlanRequest> read_moveit_call(const MoveItCall& call, const std::string& request_id,
                                     std::span<const Gripper> known,
                                     const MoveItSettings& settings) {
    FirstError errors;
    PlanRequest out;
    out.request_id = request_id;
    const std::string& frame_id = call.target().header().frame_id();
    out.frame_id = frame_id;
    check_text(frame_id, "target.header.frame_id", {0, kMostFrameId}, errors);
    check_count(call.movable_obstacles().size(), kMostObjects, "movable_obstacles", errors);
    check_count(call.support_surfaces().size(), kMostObjects, "support_surfaces", errors);
    check_count(call.candidate_grasps().size(), kMostCandidates, "candidate_grasps", errors);
    if (!errors.any()) out.grippers = read_gripper(call, known, settings, errors);
    if (!errors.any()) read_target(call, frame_id, out, errors);
    if (!errors.any()) read_obstacles(call, frame_id, out, errors);
    if (!errors.any()) read_candidates(call, frame_id, settings, out, errors);
    if (errors.any()) return *errors.error();
    return out;
}

}  // namespace graspd::dds
