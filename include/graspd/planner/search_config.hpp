#pragma once

#include <cstdint>

namespace graspd {

/// How much the planner looks at. All loops are bounded by these counts, never by the clock.
struct SearchConfig {
    bool exact_concavity = false;  ///< else without the last two steps of shortest_path_concavity
    std::uint32_t levels = 3;      ///< salience thresholds: salient_fraction x level_ratio^k
    double level_ratio = 0.6;      ///< [1] from one threshold to the next
    double level_growth = 1.5;     ///< [1] a region of a lower threshold counts as new from so many
                                   ///< times the samples of the region within it
    std::uint32_t planes = 3;      ///< of a concavity's three plane pairs, the best so many
    std::uint32_t approaches = 8;  ///< directions about each closing axis
    std::uint32_t insertions = 3;  ///< depths of the pads; 1: their centres at the contact
    double insertion_tip_offsets = 0.8;    ///< [1] between two depths, in tip offsets,
    double insertion_least_tip_m = 0.004;  ///< [m] or what leaves so much of the tips beyond the
                                           ///< contact, where that is less
    std::uint32_t probe_samples = 800;     ///< of the surface, for opposite candidates
    std::uint32_t axes_per_round = 24;     ///< a round (one concavity, the walls, the whole object)
                                           ///< ends when so many axes gave a grasp,
    std::uint32_t good_axes_per_round = 10;  ///< or so many, and as many as grasps are asked for, a
                                             ///< good one; never where there is a least clearance,
    double good_score = 0.95;                ///< [1] of a good grasp,
    std::uint32_t poses_per_round = 1000;    ///< or when so many poses were checked in full
    std::uint32_t grasps_per_axis = 6;       ///< an axis is left when so many of its poses, tried
                                             ///< eight at a time, gave a grasp; never where the
                                             ///< request has a least clearance
    double lever_weight_rad_m = 4.0;       ///< [rad/m] of the lever against the lean, when axes are
                                           ///< chosen
    std::uint32_t refined = 5;             ///< best grasps that are improved by small moves
    std::uint32_t refine_rounds = 3;       ///< of moves to either side, each half as far as before
    double refine_shift_m = 0.006;         ///< [m] first move along Gy and Gz
    double refine_turn_rad = 0.2;          ///< [rad] first turn about Gx, Gy and Gz
    std::uint32_t tolerances = 5;          ///< best grasps whose tolerance to errors is measured
    double tolerance_shift_m = 0.008;      ///< [m] greatest error tried along each axis
    double tolerance_turn_rad = 0.2;       ///< [rad] greatest error tried about each axis
    std::uint32_t tolerance_halvings = 4;  ///< of both: smaller errors that are tried
    double most_clearance_m = 0.05;        ///< [m] clearance is measured up to here

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("exact_concavity", self.exact_concavity);
        visit("levels", self.levels, 1u, 20u);
        visit("level_ratio", self.level_ratio, 0.05, 0.99);
        visit("level_growth", self.level_growth, 1.0, 100.0);
        visit("planes", self.planes, 1u, 3u);
        visit("approaches", self.approaches, 1u, 360u);
        visit("insertions", self.insertions, 1u, 10u);
        visit("insertion_tip_offsets", self.insertion_tip_offsets, 0.0, 1.0);
        visit("insertion_least_tip_m", self.insertion_least_tip_m, 0.0, 0.1);
        visit("probe_samples", self.probe_samples, 100u, 1000000u);
        visit("axes_per_round", self.axes_per_round, 1u, 100000u);
        visit("good_axes_per_round", self.good_axes_per_round, 1u, 100000u);
        visit("good_score", self.good_score, 0.0, 1.0);
        visit("poses_per_round", self.poses_per_round, 1u, 10000000u);
        visit("grasps_per_axis", self.grasps_per_axis, 1u, 100000u);
        visit("lever_weight_rad_m", self.lever_weight_rad_m, 0.0, 100.0);
        visit("refined", self.refined, 0u, 1000u);
        visit("refine_rounds", self.refine_rounds, 0u, 20u);
        visit("refine_shift_m", self.refine_shift_m, 0.0, 0.1);
        visit("refine_turn_rad", self.refine_turn_rad, 0.0, 1.0);
        visit("tolerances", self.tolerances, 0u, 1000u);
        visit("tolerance_shift_m", self.tolerance_shift_m, 0.0, 0.1);
        visit("tolerance_turn_rad", self.tolerance_turn_rad, 0.0, 1.0);
        visit("tolerance_halvings", self.tolerance_halvings, 0u, 20u);
        visit("most_clearance_m", self.most_clearance_m, 1e-3, 1.0);
    }
};

}  // namespace graspd
