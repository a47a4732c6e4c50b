#include "pose_tolerance.hpp"

#include <algorithm>
#include <initializer_list>

#include "evaluate_pose.hpp"
#include "graspd/base/parallel.hpp"

namespace graspd::planner_detail {
namespace {

class ErrorTrial {
public:
    ErrorTrial(const Grasp& grasp, const Judgement& judgement)
        : judgement_(judgement),
          X_PG_(judgement.X_FP.inverse() * grasp.X_FG),
          width_m_(grasp.width_m) {}

    bool stands_shift(double shift_m) const {
        return stands({1, 2}, [&](const Eigen::Vector3d& along) {
            return Eigen::Isometry3d(Eigen::Translation3d(shift_m * along));
        });
    }
    bool stands_turn(double turn_rad) const {
        return stands({0, 1, 2}, [&](const Eigen::Vector3d& about) {
            return Eigen::Isometry3d(Eigen::AngleAxisd(turn_rad, about));
        });
    }

private:
    /// Whether the grasp stands an error to either side of each of some axes.
    template <class Error>
    bool stands(std::initializer_list<int> axes, Error&& error) const {
        return std::ranges::all_of(axes, [&](int axis) {
            const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
            return holds(X_PG_ * error(unit)) && holds(X_PG_ * error(-unit));
        });
    }
    bool holds(const Eigen::Isometry3d& X_PG) const {
        const auto moved = evaluate_beside(X_PG, width_m_, judgement_);
        return moved && moved->score.score >= judgement_.config.rank_grasps.likely_score;
    }

    const Judgement& judgement_;
    Eigen::Isometry3d X_PG_;
    double width_m_;
};

/// The greatest error that stands, of `most` and its halves.
template <class Stands>
double greatest(double most, std::uint32_t halvings, Stands&& stands) {
    for (std::uint32_t i = 0; i <= halvings; ++i, most *= 0.5) {
        if (stands(most)) return most;
    }
    return 0.0;
}

}  // namespace

PoseTolerance pose_tolerance(const Grasp& grasp, const Judgement& judgement) {
    const SearchConfig& search = judgement.config.search;
    const ErrorTrial trial(grasp, judgement);
    PoseTolerance tolerance;
    run_together({[&] {
                      tolerance.shift_m =
                          greatest(search.tolerance_shift_m, search.tolerance_halvings,
                                   [&](double shift_m) { return trial.stands_shift(shift_m); });
                  },
                  [&] {
                      tolerance.turn_rad =
                          greatest(search.tolerance_turn_rad, search.tolerance_halvings,
                                   [&](double turn_rad) { return trial.stands_turn(turn_rad); });
                  }});
    tolerance.shift_m =
        std::min(tolerance.shift_m, std::max(0.0, 0.5 * (grasp.open_width_m - grasp.width_m)));
    return tolerance;
}

}  // namespace graspd::planner_detail
