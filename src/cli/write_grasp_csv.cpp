#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "write_exports.hpp"
#include "yaml_text.hpp"

namespace graspd::cli {
namespace {

/// One line, cell by cell.
class CsvLine {
public:
    void number(double value) { add(plain(value)); }
    void integer(std::int64_t value) { add(std::to_string(value)); }
    void vector(const Eigen::Vector3d& value) {
        for (const double part : value) number(part);
    }
    void empty() { add(""); }
    /// As RFC 4180: quoted only where it must be, quotes doubled.
    void text(const std::string& value) {
        if (value.find_first_of(",\"\r\n") == std::string::npos) return add(value);
        std::string quoted = "\"";
        for (const char letter : value)
            quoted += letter == '"' ? std::string("\"\"") : std::string{letter};
        add(quoted + "\"");
    }
    const std::string& line() const { return line_; }

private:
    /// The shortest that reads back; infinity as Python, pandas and R read it.
    static std::string plain(double value) {
        if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
        return {digits.data(), end};
    }
    void add(const std::string& cell) {
        line_ += (first_ ? "" : ",") + cell;
        first_ = false;
    }

    std::string line_;
    bool first_ = true;
};

constexpr const char* kHeading =
    "rank,gripper,source,score,x_m,y_m,z_m,qx,qy,qz,qw,width_m,open_width_m,"
    "approach_x,approach_y,approach_z,approach_distance_m,"
    "retreat_x,retreat_y,retreat_z,retreat_distance_m,"
    "contact_left_x_m,contact_left_y_m,contact_left_z_m,normal_left_x,normal_left_y,normal_left_z,"
    "contact_right_x_m,contact_right_y_m,contact_right_z_m,"
    "normal_right_x,normal_right_y,normal_right_z,"
    "clearance_m,beta_rad,min_friction,min_force_N,concavity_index,concavity_depth_m,"
    "tolerance_shift_m,tolerance_turn_rad,"
    "hand_x_m,hand_y_m,hand_z_m,hand_qx,hand_qy,hand_qz,hand_qw";

/// The terms of all grasps, in the order in which they first come; each is a column.
std::vector<std::string> term_names(const GraspFile& file) {
    std::vector<std::string> names;
    for (const Grasp& grasp : file.grasps) {
        for (const ScoreTerm& term : grasp.terms) {
            if (std::ranges::find(names, term.name) == names.end()) names.push_back(term.name);
        }
    }
    return names;
}

void add_pose(CsvLine& line, const Eigen::Isometry3d& pose) {
    const Eigen::Quaterniond turn = quaternion_of(pose);
    line.vector(pose.translation());
    line.vector(turn.vec());
    line.number(turn.w());
}

void add_motion(CsvLine& line, const LinearMotion& motion) {
    line.vector(motion.direction_F);
    line.number(motion.distance_m);
}

void add_quality(CsvLine& line, const Grasp& grasp) {
    line.number(grasp.clearance_m);
    line.number(grasp.beta_rad);
    line.number(grasp.min_friction);
    line.number(grasp.min_force_N);
    line.integer(grasp.concavity_index);
    line.number(grasp.concavity_depth_m);
    if (grasp.tolerance) {
        line.number(grasp.tolerance->shift_m);
        line.number(grasp.tolerance->turn_rad);
    } else {
        line.empty();
        line.empty();
    }
}

std::string grasp_line(const Grasp& grasp, std::uint32_t rank,
                       const std::vector<std::string>& terms) {
    CsvLine line;
    line.integer(rank);
    line.text(grasp.gripper_name);
    line.text(to_string(grasp.source));
    line.number(grasp.score);
    add_pose(line, grasp.X_FG);
    line.number(grasp.width_m);
    line.number(grasp.open_width_m);
    add_motion(line, grasp.approach);
    add_motion(line, grasp.retreat);
    for (const Contact& contact : grasp.contacts) {
        line.vector(contact.point_F);
        line.vector(contact.normal_F);
    }
    add_quality(line, grasp);
    add_pose(line, grasp.X_FH);
    for (const std::string& name : terms) {
        const auto term = std::ranges::find(grasp.terms, name, &ScoreTerm::name);
        term == grasp.terms.end() ? line.empty() : line.number(term->value);
    }
    return line.line() + "\n";
}

}  // namespace

std::string write_grasp_csv(const GraspFile& file) {
    const std::vector<std::string> terms = term_names(file);
    CsvLine columns;
    for (const std::string& name : terms) columns.text("term_" + name);
    std::string text = kHeading + (terms.empty() ? "" : "," + columns.line()) + "\n";
    for (std::size_t i = 0; i < file.grasps.size(); ++i) {
        text += grasp_line(file.grasps[i], file.ranks[i], terms);
    }
    return text;
}

}  // namespace graspd::cli
