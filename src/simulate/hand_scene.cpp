#include "hand_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "graspd/simulate/box_contacts.hpp"
#include "load_model.hpp"

namespace graspd::simulate_detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// The base is so heavy that what a step's forces do to its given path stays below micrometres.
constexpr double kBaseMass_kg = 1000.0;
constexpr double kFingerMass_kg = 0.1;
constexpr double kFingerDamping = 100.0;  // [N s/m] 20 N close at 0.2 m/s
// Dofs and coordinates: those of the base, the two fingers, the object, in the model's order.
constexpr int kBaseDof = 0, kFingerDof = 6, kObjectDof = 8;
constexpr int kFingerPos = 7, kObjectPos = 9;
constexpr int kObjectBody = 4;
// Geoms in the model's order: palm, left, right, object.
constexpr int kHandGeoms = 3;

/// The surface that the running scene's contacts are with.
struct Collider {
    TriangleMesh mesh_B;  ///< [m] about the centre of mass
    TriangleBvh bvh;
};
const Collider* running = nullptr;

Vector3d vector_at(const mjtNum* numbers) {
    return {numbers[0], numbers[1], numbers[2]};
}

Matrix3d matrix_at(const mjtNum* numbers) {
    return Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>>(numbers);
}

Isometry3d geom_pose(const mjData* data, int geom) {
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = matrix_at(data->geom_xmat + std::ptrdiff_t{9} * geom);
    pose.translation() = vector_at(data->geom_xpos + std::ptrdiff_t{3} * geom);
    return pose;
}

/// In MuJoCo's table for sphere and box: the object's geom is a sphere around it, for MuJoCo's
/// broad phase; its true surface is `running`.
int collide(const mjModel* model, const mjData* data, mjContact* contacts, int object, int box,
            mjtNum /*margin*/) {
    if (running == nullptr) return 0;
    const Isometry3d X_FB = geom_pose(data, object);
    const OrientedBox box_B{X_FB.inverse(Eigen::Isometry) * geom_pose(data, box),
                            vector_at(model->geom_size + std::ptrdiff_t{3} * box)};
    const auto found = box_contacts(running->mesh_B, running->bvh, box_B);
    const int count = std::min(static_cast<int>(found.size()), mjMAXCONPAIR);
    for (int i = 0; i < count; ++i) {
        const BoxContact& contact = found[static_cast<std::size_t>(i)];
        const Vector3d normal = X_FB.linear() * -contact.normal;  // from the object to the box
        const Vector3d point = X_FB * (contact.point + 0.5 * contact.depth_m * contact.normal);
        contacts[i].dist = -contact.depth_m;
        for (int k = 0; k < 3; ++k) {
            contacts[i].pos[k] = point[k];
            contacts[i].frame[k] = normal[k];
        }
        for (int k = 3; k < 9; ++k) contacts[i].frame[k] = 0.0;  // MuJoCo completes it
    }
    return count;
}

std::string text_of(std::initializer_list<double> numbers) {
    std::string text;
    for (const double number : numbers) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.17g ", number);
        text += digits;
    }
    return text;
}

std::string text_of(const Vector3d& vector) {
    return text_of({vector.x(), vector.y(), vector.z()});
}

std::string pose_text(const Isometry3d& pose) {
    const Eigen::Quaterniond turn(pose.linear());
    return "pos=\"" + text_of(pose.translation()) + "\" quat=\"" +
           text_of({turn.w(), turn.x(), turn.y(), turn.z()}) + "\"";
}

std::string box_text(const Eigen::AlignedBox3d& box) {
    return "<geom class=\"hand\" type=\"box\" pos=\"" + text_of(box.center()) + "\" size=\"" +
           text_of(0.5 * box.sizes()) + "\"/>";
}

std::string finger_text(const GripperPart& finger, const char* name, double side, double travel_m) {
    const std::string mass = text_of({kFingerMass_kg});
    const std::string inertia = text_of(Vector3d::Constant(1e-4 * kFingerMass_kg));
    return "<body><inertial pos=\"0 0 0\" mass=\"" + mass + "\" diaginertia=\"" + inertia +
           "\"/><joint name=\"" + name + "\" type=\"slide\" axis=\"" + text_of({side, 0.0, 0.0}) +
           "\" limited=\"true\" solreflimit=\"0.004 1\" solimplimit=\"0.95 0.99 0.0005\" "
           "range=\"0 " +
           text_of({travel_m}) + "\" damping=\"" + text_of({kFingerDamping}) + "\"/>" +
           box_text(finger.box_G) + "</body>";
}

/// The model; what it does not say is MuJoCo's default.
std::string model_text(const SceneParts& parts, const SimulationConfig& config, double radius_m) {
    const auto boxes = gripper_parts(parts.gripper, parts.contact_width_m, parts.opening_m);
    const double travel = std::max(1e-6, 0.5 * (parts.opening_m - parts.gripper.min_width_m));
    const Matrix3d inertia = config.mass_kg * parts.solid.inertia_m2;
    const std::string base = text_of({kBaseMass_kg});
    // meaninertia scales the solver's tolerance: without it the heavy base would decide.
    return "<mujoco><compiler angle=\"radian\"/><statistic meaninertia=\"" +
           text_of({config.mass_kg}) + "\"/><size njmax=\"2000\" nconmax=\"200\"/>" +
           "<option timestep=\"" + text_of({config.time_step_s}) +
           "\" gravity=\"0 0 0\" cone=\"elliptic\" impratio=\"10\" tolerance=\"1e-10\"/>" +
           "<default><geom condim=\"4\" friction=\"" +
           text_of({config.friction, config.torsion_m, 1e-4}) +
           "\" solref=\"0.004 1\" solimp=\"0.95 0.99 0.0005 0.5 2\"/>" +
           "<equality solref=\"0.004 1\" solimp=\"0.95 0.99 0.0005\"/><default class=\"hand\">" +
           "<geom contype=\"1\" conaffinity=\"0\"/></default></default><worldbody><body " +
           pose_text(parts.X_FG) + "><freejoint/><inertial pos=\"0 0 0\" mass=\"" + base +
           "\" diaginertia=\"" + base + base + base + "\"/>" + box_text(boxes[0].box_G) +
           finger_text(boxes[1], "left", 1.0, travel) +
           finger_text(boxes[2], "right", -1.0, travel) + "</body><body pos=\"" +
           text_of(parts.solid.center) + "\"><freejoint/><inertial pos=\"0 0 0\" mass=\"" +
           text_of({config.mass_kg}) + "\" fullinertia=\"" +
           text_of({inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
                    inertia(1, 2)}) +
           "\"/><geom type=\"sphere\" contype=\"0\" conaffinity=\"1\" size=\"" +
           text_of({radius_m}) + "\"/></body></worldbody><equality><joint joint1=\"left\" " +
           "joint2=\"right\"/></equality></mujoco>";
}

TriangleMesh moved(const TriangleMesh& mesh, const Vector3d& offset) {
    TriangleMesh result = mesh;
    for (Vector3d& vertex : result.vertices) vertex += offset;
    return result;
}

double radius_m(const TriangleMesh& mesh) {
    double square = 0.0;
    for (const Vector3d& vertex : mesh.vertices) square = std::max(square, vertex.squaredNorm());
    return std::sqrt(square);
}

}  // namespace

struct HandScene::Physics {
    Collider collider;
    Vector3d center_F;  ///< [m] of mass, at the beginning
    mjModel* model = nullptr;
    mjData* data = nullptr;

    Physics(TriangleMesh mesh_B, const SceneParts& parts, const SimulationConfig& config)
        : collider{std::move(mesh_B), TriangleBvh({}, 0.0)}, center_F(parts.solid.center) {
        const double radius = radius_m(collider.mesh_B);
        collider.bvh = TriangleBvh(collider.mesh_B, 1e-6 * radius);
        mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_BOX] = collide;
        model = load_model(model_text(parts, config, radius));
        data = mj_makeData(model);
        running = &collider;
        mj_forward(model, data);
    }
    ~Physics() {
        running = nullptr;
        mj_deleteData(data);
        mj_deleteModel(model);
    }
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    void check() const {
        for (const mjtWarning kind : {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL, mjWARN_BADQPOS,
                                      mjWARN_BADQVEL, mjWARN_BADQACC}) {
            if (data->warning[kind].number > 0) mju_error(mju_warningText(kind, 0));
        }
    }
};

HandScene::HandScene(const SceneParts& parts, const SimulationConfig& config)
    : physics_(std::make_unique<Physics>(moved(*parts.mesh_F, -parts.solid.center), parts, config)),
      X_FG_(parts.X_FG) {}

HandScene::~HandScene() = default;

void HandScene::set_grip_force(double force_N) {
    physics_->data->qfrc_applied[kFingerDof] = force_N;
    physics_->data->qfrc_applied[kFingerDof + 1] = force_N;
}

void HandScene::set_object_damping(double rate_1_s) {
    mjModel& model = *physics_->model;
    const double mass = model.body_mass[kObjectBody];
    const double inertia = vector_at(model.body_inertia + std::ptrdiff_t{3} * kObjectBody).mean();
    for (int k = 0; k < 6; ++k) {
        model.dof_damping[kObjectDof + k] = rate_1_s * (k < 3 ? mass : inertia);
    }
}

void HandScene::set_weight(const Vector3d& force_N_F) {
    for (int k = 0; k < 3; ++k) physics_->data->xfrc_applied[6 * kObjectBody + k] = force_N_F[k];
}

void HandScene::step_to(const Isometry3d& X_FG) {
    const double step = physics_->model->opt.timestep;
    const Vector3d linear = (X_FG.translation() - X_FG_.translation()) / step;
    const Eigen::AngleAxisd turn(X_FG_.linear().transpose() * X_FG.linear());
    const Vector3d angular_G = turn.angle() / step * turn.axis();
    const Eigen::Quaterniond now(X_FG_.linear());
    mjData& data = *physics_->data;
    const double pose[] = {X_FG_.translation().x(),
                           X_FG_.translation().y(),
                           X_FG_.translation().z(),
                           now.w(),
                           now.x(),
                           now.y(),
                           now.z()};
    std::copy(std::begin(pose), std::end(pose), data.qpos);
    for (int k = 0; k < 3; ++k) {
        data.qvel[kBaseDof + k] = linear[k];
        data.qvel[kBaseDof + 3 + k] = angular_G[k];
    }
    mj_step(physics_->model, &data);
    physics_->check();
    X_FG_ = X_FG;
}

Isometry3d HandScene::X_FO() const {
    const mjtNum* q = physics_->data->qpos + kObjectPos;
    Isometry3d X_FB = Isometry3d::Identity();
    X_FB.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
    X_FB.translation() = vector_at(q);
    return X_FB * Eigen::Translation3d(-physics_->center_F);
}

double HandScene::opening_m() const {
    const mjtNum* q = physics_->data->qpos + kFingerPos;
    const mjtNum* box = physics_->model->geom_size;
    const mjtNum* at = physics_->model->geom_pos;
    const double inner_left = at[3] + box[3] + q[0], inner_right = at[6] - box[6] - q[1];
    return inner_right - inner_left;
}

std::array<bool, 3> HandScene::touching() const {
    std::array<bool, 3> touches{};
    for (int i = 0; i < physics_->data->ncon; ++i) {
        const mjContact& contact = physics_->data->contact[i];
        const int part = std::min(contact.geom1, contact.geom2);
        if (part < kHandGeoms) touches[static_cast<std::size_t>(part)] = true;
    }
    return touches;
}

}  // namespace graspd::simulate_detail
