#pragma once

#include "graspd/collision/manipulability.hpp"
#include "graspd/concavity/vertex_concavity.hpp"
#include "graspd/contour/boundary_points.hpp"
#include "graspd/contour/concave_hull.hpp"
#include "graspd/grasp/contact_patch.hpp"
#include "graspd/grasp/force_balance.hpp"
#include "graspd/grasp/grasp_candidates.hpp"
#include "graspd/grasp/grasp_sides.hpp"
#include "graspd/grasp/load_ratios.hpp"
#include "graspd/grasp/local_cloud.hpp"
#include "graspd/grasp/opposite_candidates.hpp"
#include "graspd/grasp/rank_grasps.hpp"
#include "graspd/grasp/score_grasp.hpp"
#include "graspd/grasp/step_points.hpp"
#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/face_sensor.hpp"
#include "graspd/mesh/sample_surface.hpp"
#include "graspd/mesh/segment_scene.hpp"
#include "graspd/mesh/triangulate_cloud.hpp"
#include "graspd/planner/guess_units.hpp"
#include "graspd/planner/search_config.hpp"
#include "graspd/planner/suggest_config.hpp"
#include "graspd/regions/cluster_concavities.hpp"
#include "graspd/regions/concavity_frame.hpp"
#include "graspd/regions/extract_concave_areas.hpp"

namespace graspd {

/// Every parameter of the planner, one group a stage; profiles/planner.yaml has the same tree.
struct PlannerConfig {
    SegmentSceneConfig segment_scene;
    TriangulateCloudConfig triangulate_cloud;
    ConditionMeshConfig condition_mesh;
    FaceSensorConfig face_sensor;
    GuessUnitsConfig guess_units;
    VertexConcavityConfig vertex_concavity;
    ConcavityConfig shortest_path_concavity;
    TetrahedralConfig tetrahedral_concavity;
    SampleSurfaceConfig sample_surface;
    ExtractConcaveAreasConfig extract_concave_areas;
    ClusterConcavitiesConfig cluster_concavities;
    ConcavityFrameConfig concavity_frame;
    ConcaveHullConfig concave_hull;
    BoundaryPointsConfig boundary_points;
    StepPointsConfig step_points;
    GraspSidesConfig grasp_sides;
    ForceBalanceConfig force_balance;
    GraspCandidatesConfig grasp_candidates;
    OppositeCandidatesConfig opposite_candidates;
    LocalCloudConfig local_cloud;
    ContactPatchConfig contact_patch;
    LoadRatiosConfig load_ratios;
    ManipulabilityConfig manipulability;
    ScoreGraspConfig score_grasp;
    RankGraspsConfig rank_grasps;
    SearchConfig search;
    SuggestConfig suggest;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("segment_scene", self.segment_scene);
        visit("triangulate_cloud", self.triangulate_cloud);
        visit("condition_mesh", self.condition_mesh);
        visit("face_sensor", self.face_sensor);
        visit("guess_units", self.guess_units);
        visit("vertex_concavity", self.vertex_concavity);
        visit("shortest_path_concavity", self.shortest_path_concavity);
        visit("tetrahedral_concavity", self.tetrahedral_concavity);
        visit("sample_surface", self.sample_surface);
        visit("extract_concave_areas", self.extract_concave_areas);
        visit("cluster_concavities", self.cluster_concavities);
        visit("concavity_frame", self.concavity_frame);
        visit("concave_hull", self.concave_hull);
        visit("boundary_points", self.boundary_points);
        visit("step_points", self.step_points);
        visit("grasp_sides", self.grasp_sides);
        visit("force_balance", self.force_balance);
        visit("grasp_candidates", self.grasp_candidates);
        visit("opposite_candidates", self.opposite_candidates);
        visit("local_cloud", self.local_cloud);
        visit("contact_patch", self.contact_patch);
        visit("load_ratios", self.load_ratios);
        visit("manipulability", self.manipulability);
        visit("score_grasp", self.score_grasp);
        visit("rank_grasps", self.rank_grasps);
        visit("search", self.search);
        visit("suggest", self.suggest);
    }

    /// For vertex_concavity(); refers to this.
    ConcavitySettings concavity() const {
        return {vertex_concavity, shortest_path_concavity, tetrahedral_concavity};
    }
};

}  // namespace graspd
