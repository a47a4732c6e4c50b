#include "convert_options.hpp"

namespace graspd::dds {
namespace {

// The ranges of idl/graspd.idl.
constexpr std::uint32_t kMostGrasps = 1000;
constexpr double kLongest_s = 3600.0;
constexpr double kMostFriction = 10.0;
constexpr double kMostClearance_m = 1.0;

void refuse_flag(bool flag, const char* name, FirstError& errors) {
    if (!flag) return;
    errors.set(PlanErrorCode::kUnsupported,
               "options[0]." + std::string(name) + " = true is not served yet");
}

PlanOptions read_option(const wire::PlanOptions_& in, FirstError& errors) {
    refuse_flag(in.concavity_field(), "concavity_field", errors);
    check_count(in.mass().size(), 1, "options[0].mass", errors);
    check_count(in.center_of_mass().size(), 1, "options[0].center_of_mass", errors);
    check_count(in.gravity().size(), 1, "options[0].gravity", errors);
    check_count(in.grip_force().size(), 1, "options[0].grip_force", errors);
    PlanOptions out;
    if (in.max_grasps() > kMostGrasps) {
        errors.invalid("options[0].max_grasps = " + std::to_string(in.max_grasps()) +
                       " must be at most " + std::to_string(kMostGrasps));
    }
    if (in.max_grasps() != 0) out.max_grasps = in.max_grasps();
    const double budget_s =
        read_number(in.time_budget(), "options[0].time_budget", {0.0, kLongest_s}, errors);
    if (budget_s != 0.0) out.time_budget_s = budget_s;
    out.friction =
        read_number(in.friction(), "options[0].friction", {0.0, kMostFriction, true}, errors);
    out.min_clearance_m = read_number(in.min_clearance(), "options[0].min_clearance",
                                      {0.0, kMostClearance_m}, errors);
    if (!in.mass().empty()) {
        out.mass_kg = read_number(in.mass().front(), "options[0].mass[0]", kPositive, errors);
    }
    if (!in.center_of_mass().empty()) {
        out.center_of_mass_O =
            read_finite(in.center_of_mass().front(), "options[0].center_of_mass[0]", errors);
    }
    if (!in.gravity().empty()) {
        out.gravity_F = read_unit(in.gravity().front(), "options[0].gravity[0]", errors);
    }
    if (!in.grip_force().empty()) {
        out.grip_force_N =
            read_number(in.grip_force().front(), "options[0].grip_force[0]", kPositive, errors);
    }
    if (in.sources() > kAllSources) {
        errors.invalid("options[0].sources = " + std::to_string(in.sources()) +
                       " has unknown bits, must be at most 7");
    }
    if (in.sources() != 0) out.sources = in.sources();
    out.want_markers = in.markers();
    out.want_suggestion = in.suggestion();
    out.seed = in.seed();
    return out;
}

}  // namespace

PlanOptions read_options(const wire::GraspRequest_& request, FirstError& errors) {
    check_count(request.options().size(), 1, "options", errors);
    if (request.options().empty()) return {};
    return read_option(request.options().front(), errors);
}

double asked_budget_s(const wire::GraspRequest_& request) {
    const double fallback_s = PlanOptions{}.time_budget_s;
    if (request.options().empty()) return fallback_s;
    const double asked_s = request.options().front().time_budget();
    return asked_s > 0.0 && asked_s <= kLongest_s ? asked_s : fallback_s;
}

wire::PlanOptions_ write_options(const PlanOptions& options) {
    wire::PlanOptions_ out;
    out.max_grasps(options.max_grasps);
    out.time_budget(options.time_budget_s);
    out.friction(options.friction);
    out.min_clearance(options.min_clearance_m);
    if (options.mass_kg) out.mass().push_back(*options.mass_kg);
    if (options.center_of_mass_O) {
        out.center_of_mass().push_back(write_point(*options.center_of_mass_O));
    }
    if (options.gravity_F) out.gravity().push_back(write_vector(*options.gravity_F));
    out.grip_force().push_back(options.grip_force_N);
    out.sources(options.sources);
    out.markers(options.want_markers);
    out.suggestion(options.want_suggestion);
    out.seed(options.seed);
    return out;
}

}  // namespace graspd::dds
