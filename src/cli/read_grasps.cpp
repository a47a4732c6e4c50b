#include "read_grasps.hpp"

#include <algorithm>
#include <array>

#include "json_members.hpp"

namespace graspd::cli {
namespace {

using ReadJson = nlohmann::json;

// As on the wire: what was rounded to three decimals still passes.
constexpr double kTolerance = 1e-3;

/// Reads position and quaternion of an object; `rotation` need not be there, but must agree.
void read_pose(JsonMembers& in, Eigen::Isometry3d& to) {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector4d xyzw(0, 0, 0, 1);
    in.numbers<3>("position", position);
    in.numbers<4>("quaternion", xyzw);
    if (in.error()) return;
    if (!(std::abs(xyzw.norm() - 1.0) <= kTolerance)) {
        return in.fail("quaternion", *in.find("quaternion"), "is not of unit length");
    }
    to.linear() = Eigen::Quaterniond(xyzw).normalized().toRotationMatrix();
    to.translation() = position;
    if (!in.has("rotation")) return;
    Eigen::Matrix<double, 9, 1> rows = Eigen::Matrix<double, 9, 1>::Zero();
    in.numbers<9>("rotation", rows);
    if (in.error()) return;
    const Eigen::Matrix3d rotation = rows.reshaped<Eigen::RowMajor>(3, 3);
    if (!((rotation - to.linear()).cwiseAbs().maxCoeff() <= 4.0 * kTolerance)) {
        in.fail("rotation", *in.find("rotation"), "is another rotation than quaternion");
    }
}

void read_motion(JsonMembers& in, const char* key, LinearMotion& to) {
    const ReadJson* node = in.find(key);
    if (node == nullptr) return;
    JsonMembers motion(*node, in.path_of(key));
    motion.numbers<3>("direction", to.direction_F);
    motion.number("distance", to.distance_m);
    in.take(motion.error());
}

void read_contacts(JsonMembers& in, std::array<Contact, 2>& to) {
    const ReadJson* list = in.array("contacts");
    if (list == nullptr) return;
    if (list->size() != to.size()) return in.fail("contacts", *list, "must be two");
    for (std::size_t i = 0; i < to.size(); ++i) {
        JsonMembers contact((*list)[i], in.path_of("contacts[" + std::to_string(i) + "]"));
        contact.numbers<3>("point", to[i].point_F);
        contact.numbers<3>("normal", to[i].normal_F);
        in.take(contact.error());
    }
}

/// The mounting frame: from the file, else from the gripper. In H the TCP lies on Hz, the approach.
void read_hand_pose(JsonMembers& in, const Gripper* given, Grasp& to) {
    if (!in.has("hand_pose") && given != nullptr) {
        to.X_FH = to.X_FG * grasp_in_hand(*given, to.width_m).inverse();
        return;
    }
    if (!in.has("hand_pose")) {
        return in.fail(in.path_of("hand_pose") +
                       " is missing; it follows from the gripper: say it by --gripper NAME|FILE");
    }
    const ReadJson* node = in.find("hand_pose");
    if (node == nullptr) return;
    JsonMembers pose(*node, in.path_of("hand_pose"));
    read_pose(pose, to.X_FH);
    in.take(pose.error());
    if (in.error()) return;
    const Eigen::Isometry3d X_HG = to.X_FH.inverse() * to.X_FG;
    const double aside_m = X_HG.translation().head<2>().norm();
    const double lean_rad = angle_between_rad(X_HG.linear().col(2), Eigen::Vector3d::UnitZ());
    if (!(aside_m <= kTolerance && lean_rad <= 4.0 * kTolerance)) {
        in.fail("hand_pose", *node, "does not lie behind the grasp's pose along the approach");
    }
}

void read_terms(JsonMembers& in, std::vector<ScoreTerm>& to) {
    const ReadJson* node = in.find("terms");
    if (node == nullptr) return;
    JsonMembers terms(*node, in.path_of("terms"));
    for (const auto& [name, unused] : node->items()) {
        terms.number_or_null(name.c_str(), to.emplace_back(ScoreTerm{name, 0.0}).value);
    }
    in.take(terms.error());
}

void read_source(JsonMembers& in, GraspSource& to) {
    std::string name;
    in.text("source", name);
    if (in.error()) return;
    constexpr std::array kSources = {kBoundary, kWall, kWholeObject, kCandidate};
    const auto known = std::ranges::find_if(
        kSources, [&](GraspSource source) { return name == to_string(source); });
    if (known == kSources.end()) {
        return in.fail("source", *in.find("source"),
                       "must be boundary, wall, whole_object or candidate");
    }
    to = *known;
}

void read_tolerance(JsonMembers& in, std::optional<PoseTolerance>& to) {
    if (!in.has("tolerance")) return;  // older files lack it
    const ReadJson* node = in.find("tolerance");
    if (node == nullptr || node->is_null()) return;
    JsonMembers tolerance(*node, in.path_of("tolerance"));
    PoseTolerance read;
    tolerance.number("shift", read.shift_m);
    tolerance.number("turn", read.turn_rad);
    in.take(tolerance.error());
    to = read;
}

void read_concavity(JsonMembers& in, Grasp& to) {
    const ReadJson* node = in.find("concavity");
    if (node == nullptr) return;
    JsonMembers concavity(*node, in.path_of("concavity"));
    concavity.integer("index", to.concavity_index);
    concavity.number_or_null("depth", to.concavity_depth_m);
    in.take(concavity.error());
}

std::optional<PlanError> read_grasp(const ReadJson& node, std::size_t index, const Gripper* given,
                                    GraspFile& to) {
    JsonMembers in(node, "grasps[" + std::to_string(index) + "]");
    Grasp& grasp = to.grasps.emplace_back();
    in.integer("rank", to.ranks.emplace_back(0));
    in.number("width", grasp.width_m);
    in.number("open_width", grasp.open_width_m);
    in.number("score", grasp.score);
    in.number_or_null("clearance", grasp.clearance_m);
    in.number_or_null("beta_rad", grasp.beta_rad);
    in.number_or_null("min_friction", grasp.min_friction);
    in.number_or_null("min_force", grasp.min_force_N);
    in.text("gripper", grasp.gripper_name);
    if (!in.error()) read_pose(in, grasp.X_FG);
    if (!in.error()) read_hand_pose(in, given, grasp);
    read_motion(in, "approach", grasp.approach);
    read_motion(in, "retreat", grasp.retreat);
    read_contacts(in, grasp.contacts);
    read_terms(in, grasp.terms);
    read_source(in, grasp.source);
    read_tolerance(in, grasp.tolerance);
    read_concavity(in, grasp);
    return in.error();
}

void read_travel(JsonMembers& in, std::vector<PadTravel>& to) {
    const ReadJson* list = in.array("pad_travel");
    if (list == nullptr) return;
    for (const ReadJson& row : *list) {
        JsonMembers travel(row, in.path_of("pad_travel[" + std::to_string(to.size()) + "]"));
        PadTravel& read = to.emplace_back();
        travel.number("opening", read.opening_m);
        travel.number("pad_z", read.pad_z_m);
        in.take(travel.error());
    }
}

Result<Gripper> read_gripper(const ReadJson& node) {
    JsonMembers in(node, "gripper");
    Gripper gripper;
    in.text("name", gripper.name);
    in.number("max_width", gripper.max_width_m);
    in.number("min_width", gripper.min_width_m);
    in.number("finger_length", gripper.finger_length_m);
    in.number("finger_width", gripper.finger_width_m);
    in.number("finger_thickness", gripper.finger_thickness_m);
    in.number("tip_offset", gripper.tip_offset_m);
    in.number("palm_width", gripper.palm_width_m);
    in.number("palm_height", gripper.palm_height_m);
    in.number("palm_depth", gripper.palm_depth_m);
    in.number("palm_z", gripper.palm_z_m);
    in.number("closing_yaw", gripper.closing_yaw_rad);
    read_travel(in, gripper.pad_travel);
    if (in.error()) return *in.error();
    if (auto error = validate(gripper)) return *std::move(error);
    return gripper;
}

/// Whether the text is a reply of ours at all.
void check_kind(JsonMembers& in) {
    constexpr const char* kSchema = "graspd/1";
    constexpr const char* kConvention = "tcp_z_approach_x_closing";
    std::string schema, convention;
    in.text("schema", schema);
    if (!in.error() && schema != kSchema)
        in.fail("schema", schema, std::string("must be ") + kSchema);
    in.text("convention", convention);
    if (!in.error() && convention != kConvention) {
        in.fail("convention", convention, std::string("must be ") + kConvention);
    }
}

Result<GraspFile> read_reply(const ReadJson& node, const Gripper* given) {
    JsonMembers in(node, "");
    GraspFile file;
    check_kind(in);
    in.text("request_id", file.request_id);
    in.text("frame_id", file.frame_id);
    in.text("status", file.status);
    in.text("message", file.message);
    const ReadJson* grasps = in.array("grasps");
    if (in.error()) return *in.error();
    for (const ReadJson& grasp : *grasps) {
        if (auto error = read_grasp(grasp, file.grasps.size(), given, file)) {
            return *std::move(error);
        }
    }
    if (in.has("gripper")) file.gripper = read_gripper(node["gripper"]);
    return file;
}

}  // namespace

Result<GraspFile> read_grasps(const std::string& text, const Gripper* given) {
    try {
        return read_reply(ReadJson::parse(text), given);
    } catch (const ReadJson::exception& error) {
        return PlanError{PlanErrorCode::kInvalidInput,
                         std::string("cannot be read as JSON: ") + error.what()};
    }
}

}  // namespace graspd::cli
