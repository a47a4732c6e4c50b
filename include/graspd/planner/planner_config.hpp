#pragma once

#include "graspd/mesh/condition_mesh.hpp"
#include "graspd/mesh/triangulate_cloud.hpp"

namespace graspd {

/// Every parameter of the planner, one group a stage; profiles/planner.yaml has the same tree.
struct PlannerConfig {
    TriangulateCloudConfig triangulate_cloud;
    ConditionMeshConfig condition_mesh;

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("triangulate_cloud", self.triangulate_cloud);
        visit("condition_mesh", self.condition_mesh);
    }
};

}  // namespace graspd
