#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include "ray_trees.hpp"

namespace graspd::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

bool meet(const Model& model, const fcl::CollisionGeometryd& shape, const fcl::Transform3d& pose) {
    const fcl::CollisionRequestd request;  // one contact is enough, and where it lies is not asked
    fcl::CollisionResultd result;
    return fcl::collide(&model, fcl::Transform3d::Identity(), &shape, pose, request, result) > 0;
}

void fill(Model& model, const TriangleMesh& mesh) {
    const auto index = [](std::uint32_t vertex) { return static_cast<std::size_t>(vertex); };
    std::vector<fcl::Triangle> faces;
    faces.reserve(mesh.faces.size());
    for (const Triangle& face : mesh.faces) {
        if (has_area(mesh, face)) {
            faces.emplace_back(index(face[0]), index(face[1]), index(face[2]));
        }
    }
    model.beginModel();
    model.addSubModel(mesh.vertices, faces);
    model.endModel();
}

class CapsuleTree final : public RayTree {
public:
    CapsuleTree(const TriangleMesh& mesh, double radius_m) : radius_m_(radius_m) {
        fill(model_, mesh);
    }
    bool blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const override {
        fcl::Transform3d pose = fcl::Transform3d::Identity();
        pose.linear() =
            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), b - a).toRotationMatrix();
        pose.translation() = 0.5 * (a + b);
        return meet(model_, fcl::Capsuled(radius_m_, (b - a).norm()), pose);
    }

private:
    Model model_;
    double radius_m_;
};

class TriangleTree final : public RayTree {
public:
    explicit TriangleTree(const TriangleMesh& mesh) { fill(model_, mesh); }
    bool blocked(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const override {
        Model segment;
        segment.beginModel(1, 3);
        segment.addTriangle(a, b, b);
        segment.endModel();
        return meet(model_, segment, fcl::Transform3d::Identity());
    }

private:
    Model model_;
};

}  // namespace

RayTreePtr fcl_capsule_tree(const TriangleMesh& mesh, double radius_m) {
    return std::make_unique<CapsuleTree>(mesh, radius_m);
}

RayTreePtr fcl_triangle_tree(const TriangleMesh& mesh) {
    return std::make_unique<TriangleTree>(mesh);
}

}  // namespace graspd::bench
