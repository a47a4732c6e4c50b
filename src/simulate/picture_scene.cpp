#include "picture_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "load_model.hpp"

namespace graspd::simulate_detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kFieldOfView_rad = std::numbers::pi / 4.0;  // MuJoCo's default, of the height
constexpr double kElevation_deg = -20.0;                     // the camera looks down a little
constexpr double kUnderAll_m = 0.005;                        // the floor, below everything

/// Numbers as text, as many digits as a float has.
class NumberText {
public:
    NumberText& operator<<(double number) {
        char digits[24];
        std::snprintf(digits, sizeof digits, "%.7g ", number);
        text_ += digits;
        return *this;
    }
    NumberText& operator<<(const Vector3d& vector) {
        return *this << vector.x() << vector.y() << vector.z();
    }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

/// The object as a skin on the body `object`: MuJoCo's meshes must be clean, its skins need not.
/// Every face has corners of its own, so that it looks as flat as it is.
std::string skin_text(const PictureScene& scene) {
    NumberText vertices, faces, ids, weights, places;
    int corner = 0;
    for (const Triangle& face : scene.mesh_F.faces) {
        for (const std::uint32_t vertex : face) {
            vertices << scene.mesh_F.vertices[vertex];
            faces << corner;
            ids << corner++;
            weights << 1.0;
            if (!scene.shares.empty()) places << scene.shares[vertex] << 0.5;
        }
    }
    const std::string paint =
        scene.shares.empty() ? "" : "material=\"scale\" texcoord=\"" + places.text() + "\" ";
    return "<skin name=\"surface\" rgba=\".80 .82 .85 1\" " + paint + "vertex=\"" +
           vertices.text() + "\" face=\"" + faces.text() +
           "\"><bone body=\"object\" bindpos=\"0 0 0\" bindquat=\"1 0 0 0\" vertid=\"" +
           ids.text() + "\" vertweight=\"" + weights.text() + "\"/></skin>";
}

std::string part_text(const GripperPart& part, const char* colour) {
    return "<body mocap=\"true\"><geom type=\"box\" rgba=\"" + std::string(colour) + "\" size=\"" +
           (NumberText() << 0.5 * part.box_G.sizes()).text() + "\"/></body>";
}

}  // namespace

std::string scene_text(const PictureScene& scene, const std::vector<GripperPart>& parts,
                       const Eigen::AlignedBox3d& bounds, const RenderConfig& config) {
    const std::string size = "offwidth=\"" + std::to_string(config.width) + "\" offheight=\"" +
                             std::to_string(config.height) + "\"";
    const Vector3d light = Vector3d(-0.3, 0.4, -1.0).normalized();
    const char *dark = ".35 .37 .42 1", *warm = ".86 .62 .20 1";
    return "<mujoco><statistic extent=\"" +
           (NumberText() << 0.5 * bounds.diagonal().norm()).text() + "\" center=\"" +
           (NumberText() << bounds.center()).text() + "\"/><visual><global " + size +
           "/><headlight ambient=\".35 .35 .35\" " +
           "diffuse=\".35 .35 .35\" specular=\".1 .1 .1\"/><map znear=\".02\" zfar=\"50\"/>" +
           "</visual><asset><texture name=\"sky\" type=\"skybox\" builtin=\"flat\" " +
           "rgb1=\"1 1 1\" rgb2=\"1 1 1\" width=\"8\" height=\"48\"/>" +
           "<texture name=\"scale\" type=\"2d\" builtin=\"flat\" width=\"" +
           std::to_string(Drawing::kTexels) + "\" height=\"1\" rgb1=\"1 1 1\"/>" +
           "<material name=\"scale\" texture=\"scale\" specular=\"0\"/>" +
           "<texture name=\"floor\" type=\"2d\" builtin=\"checker\" rgb1=\".93 .93 .93\" " +
           "rgb2=\".85 .85 .85\" width=\"64\" height=\"64\"/><material name=\"floor\" " +
           "texture=\"floor\" texrepeat=\"20 20\" texuniform=\"true\" specular=\"0\"/>" +
           skin_text(scene) + "</asset><worldbody><light directional=\"true\" pos=\"" +
           (NumberText() << bounds.center() - bounds.diagonal().norm() * light).text() +
           "\" dir=\"" + (NumberText() << light).text() +
           "\" diffuse=\".5 .5 .5\"/><geom type=\"plane\" size=\"0 0 .1\" " +
           "material=\"floor\" pos=\"0 0 " +
           (NumberText() << bounds.min().z() - kUnderAll_m).text() + "\"/>" +
           "<body name=\"object\" mocap=\"true\"><geom type=\"sphere\" size=\".001\" " +
           "rgba=\"0 0 0 0\"/></body>" + part_text(parts[0], dark) + part_text(parts[1], warm) +
           part_text(parts[2], warm) + "</worldbody></mujoco>";
}

Drawing::Drawing(const std::string& text, const Texels& texels) {
    mjv_defaultScene(&scene);
    mjv_defaultOption(&option);
    mjv_defaultCamera(&camera);
    mjr_defaultContext(&context);
    model = load_model(text);
    const int texture = mj_name2id(model, mjOBJ_TEXTURE, "scale");
    std::ranges::copy(texels, model->tex_rgb + model->tex_adr[texture]);
    data = mj_makeData(model);
    mjv_makeScene(model, &scene, 100 + kMostDots);
    mjr_makeContext(model, &context, mjFONTSCALE_100);
    mjr_setBuffer(mjFB_OFFSCREEN, &context);
    if (context.currentBuffer != mjFB_OFFSCREEN) {
        throw std::runtime_error("MuJoCo: no off-screen buffer");
    }
}

Drawing::~Drawing() {
    mjr_freeContext(&context);
    mjv_freeScene(&scene);
    mj_deleteData(data);
    mj_deleteModel(model);
}

Stage::Stage(const Gripper& gripper, double contact_width_m, const Vector3d& up_F)
    : gripper_(gripper), contact_width_m_(contact_width_m) {
    X_WF_.linear() = Eigen::Quaterniond::FromTwoVectors(up_F, Vector3d::UnitZ()).toRotationMatrix();
}

std::array<Isometry3d, 4> Stage::poses(const SimulatedFrame& frame) const {
    std::array<Isometry3d, 4> result;
    result[0] = X_WF_ * frame.X_FO;
    const auto boxes = parts(frame.opening_m);
    for (std::size_t i = 0; i < 3; ++i) {
        result[i + 1] = X_WF_ * frame.X_FG * Eigen::Translation3d(boxes[i].box_G.center());
    }
    return result;
}
Eigen::AlignedBox3d Stage::bounds(const SimulatedFrame& frame, const TriangleMesh& mesh_F) const {
    Eigen::AlignedBox3d bounds;
    for (const Vector3d& vertex : mesh_F.vertices) bounds.extend(X_WF_ * frame.X_FO * vertex);
    for (const GripperPart& part : parts(frame.opening_m)) {
        for (int k = 0; k < 8; ++k) {
            const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(k);
            bounds.extend(X_WF_ * frame.X_FG * part.box_G.corner(corner));
        }
    }
    return bounds;
}
Vector3d Stage::view(const SimulatedFrame& frame) const {
    const Eigen::Matrix3d axes = (X_WF_ * frame.X_FG).linear();
    Vector3d forward = axes.col(1) + 0.4 * axes.col(0);
    forward.z() = 0.0;
    if (forward.norm() < 0.2) forward = Vector3d(axes(0, 2), axes(1, 2), 0.0);
    return forward.normalized();
}

void Drawing::place(const std::array<Isometry3d, 4>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Vector3d at = poses[i].translation();
        const Eigen::Quaterniond turn(poses[i].linear());
        const double quat[] = {turn.w(), turn.x(), turn.y(), turn.z()};
        std::copy(at.data(), at.data() + 3, data->mocap_pos + 3 * i);
        std::copy(std::begin(quat), std::end(quat), data->mocap_quat + 4 * i);
    }
    mj_forward(model, data);
}

void Drawing::aim(const Eigen::AlignedBox3d& bounds, const Vector3d& forward) {
    const Vector3d center = bounds.center();
    std::copy(center.data(), center.data() + 3, camera.lookat);
    camera.distance = 0.5 * bounds.diagonal().norm() / std::sin(0.5 * kFieldOfView_rad);
    camera.azimuth = std::atan2(forward.y(), forward.x()) * 180.0 / std::numbers::pi;
    camera.elevation = kElevation_deg;
}

Image Drawing::picture(const RenderConfig& config, const std::vector<mjvGeom>& more) {
    mjv_updateScene(model, data, &option, nullptr, &camera, mjCAT_ALL, &scene);
    for (const mjvGeom& geom : more) {
        if (scene.ngeom == scene.maxgeom) break;
        scene.geoms[scene.ngeom++] = geom;
    }
    const mjrRect all{0, 0, static_cast<int>(config.width), static_cast<int>(config.height)};
    mjr_render(all, &scene, &context);
    const std::size_t row = std::size_t{3} * config.width;
    std::vector<std::uint8_t> upside_down(row * config.height);
    mjr_readPixels(upside_down.data(), nullptr, all, &context);
    Image image{config.width, config.height, {}};
    for (std::size_t y = config.height; y-- > 0;) {
        const auto begin = upside_down.begin() + static_cast<std::ptrdiff_t>(y * row);
        image.rgb.insert(image.rgb.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
    }
    return image;
}

}  // namespace graspd::simulate_detail
