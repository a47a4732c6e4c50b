#include "urdf_model.hpp"

#include <fstream>
#include <iterator>
#include <set>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include "urdf_shapes.hpp"

namespace graspd::config_detail {
namespace {

/// Builds the chains of the named links, each joint once.
class Reader {
public:
    Reader(const std::filesystem::path& file, const urdf::ModelInterface& model,
           const UrdfNames& names)
        : file_(file), model_(model), names_(names) {}

    Result<UrdfModel> read();

private:
    /// A joint's position is multiplier q + offset.
    struct Rate {
        double multiplier = 0.0, offset = 0.0;
    };
    PlanError wrong(const std::string& what) const {
        return {PlanErrorCode::kInvalidInput, file_.string() + ": " + what};
    }
    Result<std::int32_t> add_link(const std::string& link);
    Result<Rate> rate_of(const urdf::Joint& joint) const;
    std::optional<PlanError> add_parts(GripperMember member, const std::string& name);
    std::optional<PlanError> set_range();

    const std::filesystem::path& file_;
    const urdf::ModelInterface& model_;
    const UrdfNames& names_;
    std::map<std::string, std::int32_t> joint_of_link_;
    UrdfModel out_;
};

Result<Reader::Rate> Reader::rate_of(const urdf::Joint& joint) const {
    if (joint.type == urdf::Joint::FIXED) return Rate{};
    Rate rate{1.0, 0.0};
    const urdf::Joint* at = &joint;
    std::set<std::string> seen;
    while (at->name != names_.driver_joint) {
        if (!seen.insert(at->name).second) return wrong("joint " + at->name + " mimics itself");
        if (!at->mimic) {
            return wrong("joint " + joint.name +
                         " moves, and neither is nor mimics driver_joint = " + names_.driver_joint);
        }
        rate.offset += rate.multiplier * at->mimic->offset;
        rate.multiplier *= at->mimic->multiplier;
        const auto next = model_.getJoint(at->mimic->joint_name);
        if (!next) {
            return wrong("joint " + at->name + " mimics " + at->mimic->joint_name +
                         ", which is not there");
        }
        at = next.get();
    }
    return rate;
}

/// The joint that carries a link, after all that carry it; -1 for the mounting link.
Result<std::int32_t> Reader::add_link(const std::string& name) {
    if (name == names_.mount_link) return -1;
    if (const auto known = joint_of_link_.find(name); known != joint_of_link_.end()) {
        return known->second;
    }
    const auto link = model_.getLink(name);
    if (!link) return wrong("link " + name + " is not there");
    const auto joint = link->parent_joint;
    if (!joint) {
        return wrong("link " + name + " does not hang on mount_link = " + names_.mount_link);
    }
    const auto parent = add_link(joint->parent_link_name);
    if (!parent.ok()) return parent.error();
    const bool turns =
        joint->type == urdf::Joint::REVOLUTE || joint->type == urdf::Joint::CONTINUOUS;
    const bool slides = joint->type == urdf::Joint::PRISMATIC;
    if (!turns && !slides && joint->type != urdf::Joint::FIXED) {
        return wrong("joint " + joint->name +
                     " is neither fixed, revolute, continuous nor prismatic");
    }
    const auto rate = rate_of(*joint);
    if (!rate.ok()) return rate.error();
    LinkageJoint out;
    out.name = joint->name;
    out.parent = parent.value();
    out.X_PJ = pose_of(joint->parent_to_joint_origin_transform);
    out.slides = slides;
    out.multiplier = rate.value().multiplier;
    out.offset = rate.value().offset;
    if (turns || slides) {
        const Eigen::Vector3d axis(joint->axis.x, joint->axis.y, joint->axis.z);
        if (!(axis.norm() > 0.0)) return wrong("joint " + joint->name + " has an axis of length 0");
        out.axis_J = axis.normalized();
    }
    out_.linkage.joints.push_back(out);
    const auto index = static_cast<std::int32_t>(out_.linkage.joints.size()) - 1;
    joint_of_link_[name] = index;
    return index;
}

std::optional<PlanError> Reader::add_parts(GripperMember member, const std::string& name) {
    const auto joint = add_link(name);
    if (!joint.ok()) return joint.error();
    const auto link = model_.getLink(name);
    if (link->collision_array.empty()) return wrong("link " + name + " has no collision geometry");
    for (const auto& collision : link->collision_array) {
        auto corners = corners_of(*collision->geometry, file_);
        if (!corners.ok()) return corners.error();
        ConvexPart part{name, member, std::move(corners).value(), joint.value()};
        const Eigen::Isometry3d X_LC = pose_of(collision->origin);
        for (Eigen::Vector3d& point : part.points) point = X_LC * point;
        out_.parts.push_back(std::move(part));
    }
    return std::nullopt;
}

std::optional<PlanError> Reader::set_range() {
    const auto driver = model_.getJoint(names_.driver_joint);
    if (!driver) return wrong("driver_joint = " + names_.driver_joint + " is not there");
    if (driver->limits) {
        out_.linkage.open_q = driver->limits->lower;
        out_.linkage.closed_q = driver->limits->upper;
    }
    return std::nullopt;
}

Result<UrdfModel> Reader::read() {
    if (!model_.getLink(names_.mount_link)) {
        return wrong("mount_link = " + names_.mount_link + " is not there");
    }
    if (auto bad = set_range()) return *std::move(bad);
    for (const auto& [member, links] : names_.links) {
        for (const std::string& link : links) {
            if (auto bad = add_parts(member, link)) return *std::move(bad);
        }
    }
    const std::string* pads[] = {&names_.left_pad_link, &names_.right_pad_link};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto joint = add_link(*pads[i]);
        if (!joint.ok()) return joint.error();
        out_.linkage.pads[i].joint = joint.value();
    }
    return std::move(out_);
}

/// Keeps urdfdom's first complaint, which otherwise goes to the terminal.
class Complaints : public console_bridge::OutputHandler {
public:
    Complaints() { console_bridge::useOutputHandler(this); }
    Complaints(const Complaints&) = delete;
    Complaints& operator=(const Complaints&) = delete;
    ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
    void log(const std::string& text, console_bridge::LogLevel, const char*, int) override {
        if (first.empty()) first = text;
    }
    std::string first;
};

}  // namespace

Result<UrdfModel> read_urdf(const std::filesystem::path& file, const UrdfNames& names) {
    std::ifstream stream(file);
    if (!stream) {
        return PlanError{PlanErrorCode::kUnreadableFile, file.string() + ": does not open"};
    }
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    urdf::ModelInterfaceSharedPtr model;
    Complaints complaints;
    try {
        model = urdf::parseURDF(text);
    } catch (const std::exception& problem) {
        complaints.first = problem.what();
    }
    if (!model) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         file.string() + ": is no URDF: " + complaints.first};
    }
    return Reader(file, *model, names).read();
}

}  // namespace graspd::config_detail
