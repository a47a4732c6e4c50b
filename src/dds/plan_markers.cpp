#include "plan_markers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "convert_basics.hpp"

namespace graspd::dds {
namespace {

using std_msgs::msg::dds_::ColorRGBA_;
using visualization_msgs::msg::dds_::Marker_;
using visualization_msgs::msg::dds_::MarkerArray_;

// The constants of visualization_msgs/Marker.
constexpr std::int32_t kCube = 1;
constexpr std::int32_t kSphereList = 7;
constexpr std::int32_t kTextViewFacing = 9;
constexpr std::int32_t kTriangleList = 11;
constexpr std::int32_t kAdd = 0;
constexpr std::int32_t kDeleteAll = 3;

// Sizes for hands that open by 5 to 15 cm.
constexpr double kContact_m = 0.006;       // across
constexpr double kLetter_m = 0.012;        // high
constexpr double kLabelAbove_m = 0.03;     // the object, where no hand carries a label
constexpr double kSphereSpacings = 0.6;    // across, so that a region's samples stay apart
constexpr float kOtherHands_alpha = 0.3F;  // of all but the best, which they would hide

constexpr std::array<std::array<float, 3>, 5> kScale = {
    {{0, 0, 1}, {0, 1, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}};
constexpr std::array<std::array<float, 3>, 6> kRegionColors = {{{1.0F, 0.5F, 0.0F},
                                                                {0.6F, 0.0F, 0.8F},
                                                                {0.0F, 0.6F, 0.5F},
                                                                {0.9F, 0.2F, 0.6F},
                                                                {0.5F, 0.35F, 0.1F},
                                                                {0.2F, 0.2F, 0.6F}}};

ColorRGBA_ color_of(const std::array<float, 3>& rgb, float alpha = 1.0F) {
    ColorRGBA_ color;
    color.r(rgb[0]);
    color.g(rgb[1]);
    color.b(rgb[2]);
    color.a(alpha);
    return color;
}

/// Between the colours of the scale, linearly.
ColorRGBA_ concavity_color(double concavity_m, double deepest_m) {
    if (!std::isfinite(concavity_m)) return color_of({0.3F, 0.3F, 0.3F});
    const double share = deepest_m > 0.0 ? std::clamp(concavity_m / deepest_m, 0.0, 1.0) : 0.0;
    const double at = share * (kScale.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
    const auto part = static_cast<float>(at - static_cast<double>(below));
    std::array<float, 3> rgb{};
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        rgb[i] = kScale[below][i] + part * (kScale[below + 1][i] - kScale[below][i]);
    }
    return color_of(rgb);
}

/// Red for a score of 0, yellow for 0.5, green for 1.
ColorRGBA_ grasp_color(double score, float alpha) {
    const auto good = static_cast<float>(std::clamp(score, 0.0, 1.0));
    return color_of({std::min(1.0F, 2.0F - 2.0F * good), std::min(1.0F, 2.0F * good), 0.0F}, alpha);
}

/// The array under way: who adds a marker says what is in it.
class Markers {
public:
    explicit Markers(const std_msgs::msg::dds_::Header_& header) : header_(header) {
        add("", 0, kCube).action(kDeleteAll);
    }
    /// At the origin of F, 1 m in size, white.
    Marker_& add(const char* name_space, std::size_t id, std::int32_t type) {
        Marker_& marker = array_.markers().emplace_back();
        marker.header(header_);
        marker.ns(name_space);
        marker.id(static_cast<std::int32_t>(id));
        marker.type(type);
        marker.action(kAdd);
        marker.pose(write_pose(Eigen::Isometry3d::Identity()));
        marker.scale(write_vector(Eigen::Vector3d::Ones()));
        marker.color(color_of({1, 1, 1}));
        return marker;
    }
    MarkerArray_ take() { return std::move(array_); }

private:
    const std_msgs::msg::dds_::Header_& header_;
    MarkerArray_ array_;
};

void add_triangles(const TriangleMesh& mesh, Marker_& marker) {
    marker.points().reserve(3 * mesh.faces.size());
    for (const Triangle& face : mesh.faces) {
        for (const std::uint32_t corner : face) {
            marker.points().push_back(write_point(mesh.vertices[corner]));
        }
    }
}

void add_object(const PlanPicture& picture, Markers& markers) {
    if (picture.object_F.faces.empty()) return;
    Marker_& marker = markers.add("object", 0, kTriangleList);
    add_triangles(picture.object_F, marker);
    marker.colors().reserve(marker.points().size());
    for (const Triangle& face : picture.object_F.faces) {
        for (const std::uint32_t corner : face) {
            marker.colors().push_back(
                concavity_color(picture.concavity_m[corner], picture.deepest_m));
        }
    }
}

void add_regions(const PlanPicture& picture, Markers& markers) {
    for (std::size_t i = 0; i < picture.regions.size(); ++i) {
        Marker_& marker = markers.add("regions", i, kSphereList);
        marker.scale(write_vector(Eigen::Vector3d::Constant(kSphereSpacings * picture.spacing_m)));
        marker.color(color_of(kRegionColors[i % kRegionColors.size()]));
        for (const Eigen::Vector3d& point : picture.regions[i].points_F) {
            marker.points().push_back(write_point(point));
        }
    }
}

void add_part(const PicturedPart& part, std::size_t id, const ColorRGBA_& color, Markers& markers) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&part)) {
        Marker_& marker = markers.add("grippers", id, kTriangleList);
        marker.color(color);
        add_triangles(*mesh, marker);
        return;
    }
    const auto& box = std::get<OrientedBox>(part);
    Marker_& marker = markers.add("grippers", id, kCube);
    marker.color(color);
    marker.pose(write_pose(box.pose));
    marker.scale(write_vector(2.0 * box.half_extent));
}

void add_hands(const PlanPicture& picture, const std::vector<Grasp>& grasps, Markers& markers) {
    std::size_t id = 0;
    for (std::size_t i = 0; i < picture.hands_F.size(); ++i) {
        const auto color = grasp_color(grasps[i].score, i == 0 ? 1.0F : kOtherHands_alpha);
        for (const PicturedPart& part : picture.hands_F[i]) add_part(part, id++, color, markers);
    }
}

void add_contacts(std::size_t count, const std::vector<Grasp>& grasps, Markers& markers) {
    if (count == 0) return;
    Marker_& marker = markers.add("contacts", 0, kSphereList);
    marker.scale(write_vector(Eigen::Vector3d::Constant(kContact_m)));
    for (std::size_t i = 0; i < count; ++i) {
        for (const Contact& contact : grasps[i].contacts) {
            marker.points().push_back(write_point(contact.point_F));
            marker.colors().push_back(grasp_color(grasps[i].score, 1.0F));
        }
    }
}

void add_label(const std::string& text, std::size_t id, const Eigen::Vector3d& at_F,
               Markers& markers) {
    Marker_& marker = markers.add("labels", id, kTextViewFacing);
    marker.text(text);
    marker.pose(write_pose(Eigen::Isometry3d(Eigen::Translation3d(at_F))));
    marker.scale(write_vector(Eigen::Vector3d::Constant(kLetter_m)));
}

void add_labels(const PlanPicture& picture, const PlanReply& reply, Markers& markers) {
    for (std::size_t i = 0; i < picture.hands_F.size(); ++i) {
        std::array<char, 48> text{};
        std::snprintf(text.data(), text.size(), "%zu: %.2f", i + 1, reply.grasps[i].score);
        add_label(text.data(), i, reply.grasps[i].X_FH.translation(), markers);
    }
    if (!picture.hands_F.empty()) return;
    Eigen::AlignedBox3d box_F;
    for (const Eigen::Vector3d& vertex : picture.object_F.vertices) box_F.extend(vertex);
    if (box_F.isEmpty()) return;
    const double z_m = box_F.max().z() + kLabelAbove_m;
    add_label(to_string(reply.status), 0, {box_F.center().x(), box_F.center().y(), z_m}, markers);
}

}  // namespace

MarkerArray_ plan_markers(const PlanPicture& picture, const PlanReply& reply,
                          const std_msgs::msg::dds_::Header_& header) {
    Markers markers(header);
    add_object(picture, markers);
    add_regions(picture, markers);
    add_hands(picture, reply.grasps, markers);
    add_contacts(picture.hands_F.size(), reply.grasps, markers);
    add_labels(picture, reply, markers);
    return markers.take();
}

}  // namespace graspd::dds
