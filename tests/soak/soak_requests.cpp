#include "soak_requests.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "support/shapes.hpp"

namespace graspd::soak {

namespace {

constexpr double kHugeBudget_s = 0.5;

struct Shape {
    const char* kind;
    std::function<TriangleMesh()> make;
};

/// All of them have a side that a hand of 85 mm can take, and few faces.
const std::array<Shape, 10>& shapes() {
    static const std::array<Shape, 10> all = {{
        {"box",
         [] {
             return test::box({0.04, 0.06, 0.08});
         }},
        {"cup", [] { return test::cup(0.035, 0.08, 0.004, 400); }},
        {"torus", [] { return test::torus(0.04, 0.012, 400); }},
        {"l_shape", [] { return test::l_shape(0.08, 0.08, 0.015, 0.06); }},
        {"u_channel", [] { return test::u_channel(0.03, 0.03, 0.008, 0.08); }},
        {"bowl", [] { return test::bowl(0.06, 0.005, 400); }},
        {"cylinder", [] { return test::cylinder(0.03, 0.1, 200); }},
        {"wedge", [] { return test::wedge(0.06, 0.05, 0.07, 0.08); }},
        {"blind_hole",
         [] {
             return test::blind_hole_block({0.07, 0.07, 0.07}, 0.03, 0.04);
         }},
        {"ring", [] { return test::ring(0.03, 0.04, 0.02, 300); }},
    }};
    return all;
}

struct Fault {
    const char* kind;
    std::function<void(PlanRequest&)> make;
};

TriangleMesh& mesh_of(PlanRequest& request) {
    return std::get<TriangleMesh>(request.object_O);
}

const std::array<Fault, 5>& faults() {
    static const std::array<Fault, 5> all = {{
        {"nan_vertex",
         [](PlanRequest& to) {
             mesh_of(to).vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
         }},
        {"bad_index",
         [](PlanRequest& to) {
             mesh_of(to).faces[0] = {0, 1, 4000000};
         }},
        {"no_faces", [](PlanRequest& to) { mesh_of(to).faces.clear(); }},
        {"negative_friction", [](PlanRequest& to) { to.options.friction = -1.0; }},
        {"bad_rotation",
         [](PlanRequest& to) { to.X_FO.linear() = Eigen::Matrix3d::Constant(std::nan("")); }},
    }};
    return all;
}

/// Spreads neighbouring numbers (SplitMix64's last step).
std::uint64_t mixed(std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

void make_huge(Question& question) {
    question.kind = "huge";
    question.request.object_O = test::torus(0.05, 0.015, 100000);
    question.request.options.time_budget_s = kHugeBudget_s;
    question.expected = {PlanStatus::kOk, PlanStatus::kPartial, PlanStatus::kNoGrasp};
}

void make_cancelled(Question& question) {
    question.kind = "cancelled";
    question.request.object_O = test::torus(0.05, 0.015, 20000);
    question.cancel = true;
    question.expected = {PlanStatus::kCancelled, PlanStatus::kOk, PlanStatus::kPartial};
}

}  // namespace

Question make_question(const std::string& client, std::uint64_t number, const Gripper& gripper) {
    const std::uint64_t draw = mixed(number + 0x9e3779b97f4a7c15u);
    Question question;
    question.request.request_id = client + "-" + std::to_string(number);
    question.request.frame_id = "table";
    question.request.grippers = {gripper};
    const Shape& shape = shapes()[draw / 100 % shapes().size()];
    question.kind = shape.kind;
    question.request.object_O = shape.make();
    question.expected = {PlanStatus::kOk};
    const std::uint64_t share = draw % 100;
    if (share < 20) {
        const Fault& fault = faults()[share % faults().size()];
        question.kind = fault.kind;
        fault.make(question.request);
        question.expected = {PlanStatus::kInvalidRequest};
    } else if (share < 30) {
        question.again = true;
    } else if (share < 38) {
        make_cancelled(question);
    } else if (share < 40) {
        make_huge(question);
    }
    return question;
}

}  // namespace graspd::soak
