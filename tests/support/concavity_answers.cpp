#include "support/concavity_answers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/shape_builders.hpp"
#include "support/shapes.hpp"
#include "support/tunnels.hpp"
#include "support/vases.hpp"

namespace graspd::test {
namespace {

using Eigen::Vector3d;

double radius(const Vector3d& p) {
    return std::hypot(p.x(), p.y());
}

/// Of a lathe's mesh: greatest radius, height of its ring, corners of a ring, greatest height.
struct Rings {
    double radius_m = 0.0, height_m = 0.0, sides = 0.0, top_m = 0.0;

    explicit Rings(const TriangleMesh& mesh) {
        for (const Vector3d& p : mesh.vertices) {
            top_m = std::max(top_m, p.z());
            if (radius(p) <= radius_m + kNear) continue;
            radius_m = radius(p);
            height_m = std::abs(p.z());
        }
        for (const Vector3d& p : mesh.vertices) {
            sides += std::abs(p.z() - height_m) < kNear && radius(p) > radius_m - kNear;
        }
    }
    /// Distance from a corner of a ring to the side of the hull's polygon, straight out. The ring's
    /// corners have the angles of the hull's, and the sides lie cos(pi / n) nearer.
    double outward_m(const Vector3d& p) const {
        return (radius_m - radius(p)) * std::cos(std::numbers::pi / sides);
    }
};

ConcavityAnswer channel(std::size_t faces) {
    constexpr double kDepth = 0.05, kWidth = 0.03, kLength = 0.2;
    return {"channel", u_channel(kDepth, kWidth, 0.005, kLength, faces), [](const Vector3d& p) {
                const bool inside = std::abs(p.x()) < 0.5 * kWidth + kNear && p.z() > -kNear;
                return inside ? std::min(kDepth - p.z(), 0.5 * kLength - std::abs(p.y())) : 0.0;
            }};
}

ConcavityAnswer hole(std::size_t faces) {
    return {"blind hole", blind_hole_block({0.06, 0.06, 0.08}, 0.03, 0.06, faces),
            [](const Vector3d& p) {
                const bool inside = p.head<2>().cwiseAbs().maxCoeff() < 0.015 + kNear;
                return inside && p.z() > -0.06 - kNear ? -p.z() : 0.0;
            }};
}

ConcavityAnswer plate(std::size_t faces) {
    return {"plate", plate_with_hole({0.1, 0.1, 0.03}, 0.04, faces), [](const Vector3d& p) {
                const bool inside = p.head<2>().cwiseAbs().maxCoeff() < 0.02 + kNear;
                return inside ? 0.015 - std::abs(p.z()) : 0.0;
            }};
}

ConcavityAnswer angle_iron(std::size_t faces) {
    constexpr double kA = 0.05, kB = 0.07, kWall = 0.01, kLength = 0.2;
    return {"L", l_shape(kA + kWall, kB + kWall, kWall, kLength, faces), [](const Vector3d& p) {
                const double x = p.x() - kWall, z = p.z() - kWall;
                if (x < -kNear || z < -kNear) return 0.0;
                const double slanted = (kA * kB - kB * x - kA * z) / std::hypot(kA, kB);
                return std::min(slanted, 0.5 * kLength - std::abs(p.y()));
            }};
}

ConcavityAnswer square_hourglass(std::size_t faces) {
    return {"box hourglass", box_hourglass({0.08, 0.1, 0.015}, 0.02, 0.05, faces),
            [](const Vector3d& p) {
                if (std::abs(p.z()) > 0.025 + kNear) return 0.0;
                return std::min(0.04 - std::abs(p.x()), 0.05 - std::abs(p.y()));
            }};
}

ConcavityAnswer round_cup(std::size_t faces) {
    return {"cup", cup(0.04, 0.09, 0.004, faces), [](const Vector3d& p) {
                const bool inside = radius(p) < 0.036 + kNear && p.z() > 0.004 - kNear;
                return inside ? 0.09 - p.z() : 0.0;
            }};
}

ConcavityAnswer half_shell(std::size_t faces) {
    return {"bowl", bowl(0.07, 0.005, faces),
            [](const Vector3d& p) { return p.norm() < 0.0675 ? -p.z() : 0.0; }};
}

ConcavityAnswer ring_of_tube(std::size_t faces) {
    const TriangleMesh mesh = torus(0.06, 0.02, faces);
    const Rings rings(mesh);
    return {"torus", mesh, [rings](const Vector3d& p) {
                return radius(p) < 0.06 ? rings.top_m - std::abs(p.z()) : 0.0;
            }};
}

ConcavityAnswer square_ring(std::size_t faces) {
    return {"ring", ring(0.03, 0.05, 0.04, faces), [](const Vector3d& p) {
                return radius(p) < 0.03 + kNear ? 0.02 - std::abs(p.z()) : 0.0;
            }};
}

ConcavityAnswer balls_on_a_bar(std::size_t faces) {
    const TriangleMesh mesh = dumbbell(0.03, 0.01, 0.12, faces);
    const Rings rings(mesh);
    return {"dumbbell", mesh, [rings](const Vector3d& p) {
                return std::abs(p.z()) < rings.height_m + kNear ? rings.outward_m(p) : 0.0;
            }};
}

ConcavityAnswer discs_on_a_neck(std::size_t faces) {
    const TriangleMesh mesh = hourglass(0.04, 0.01, 0.05, 0.015, faces);
    const Rings rings(mesh);
    return {"hourglass", mesh, [rings](const Vector3d& p) {
                return std::abs(p.z()) < 0.025 + kNear ? rings.outward_m(p) : 0.0;
            }};
}

/// A closed channel whose lid has a slot. From beneath the lid the way bends once, at the slot's
/// lower edge.
ConcavityAnswer undercut_channel(std::size_t faces) {
    constexpr double kSlot = 0.01, kRoom = 0.04, kDepth = 0.03, kLid = 0.006, kEnd = 0.15;
    TriangleMesh mesh = grid_solid(
        {std::vector<double>{-0.045, -kRoom, -kSlot, kSlot, kRoom, 0.045},
         {-kEnd, kEnd},
         {-0.005, 0.0, kDepth, kDepth + kLid}},
        [](int i, int, int k) {
            if (i == 0 || i == 4 || k == 0) return true;
            return k == 2 && i != 2;
        },
        faces);
    return {"undercut channel", std::move(mesh), [](const Vector3d& p) {
                const double top = kDepth + kLid;
                const bool in_room = std::abs(p.x()) < kRoom + kNear && p.z() < kDepth + kNear;
                const bool in_slot = std::abs(p.x()) < kSlot + kNear;
                if (p.z() < -kNear || (!in_room && !in_slot)) return 0.0;
                const double under = std::max(0.0, std::abs(p.x()) - kSlot);
                const double bent = std::hypot(under, std::max(0.0, kDepth - p.z())) + kLid;
                const double up = under > 0.0 ? bent : top - p.z();
                return std::min(up, kEnd - std::abs(p.y()));
            }};
}

/// Two rooms one above the other, slots in the floor between them and in the lid. From the left end
/// of the lower room's floor the way leads to the left lower edge (0, c) of the lower slot, across
/// it to its right upper edge (s, c + s), on to the left lower edge (d, 2 c + s) of the upper slot
/// and straight up. Its slopes are c / (room's half) < 1, 1 and c / (d - s) < 1: it bends round all
/// three. Only that corner's line of vertices is asked for; the rest is nan.
ConcavityAnswer labyrinth(std::size_t faces) {
    constexpr double kC = 0.01, kS = 0.005, kD = 0.035, kLeft = -0.03, kEnd = 0.25;
    TriangleMesh mesh = grid_solid(
        {std::vector<double>{-0.035, kLeft, 0.0, kS, kD, kD + kS, 0.05, 0.055},
         {-kEnd, kEnd},
         {-0.005, 0.0, kC, kC + kS, 2 * kC + kS, 2 * kC + 2 * kS}},
        [](int i, int, int k) {
            if (i == 0 || i == 6 || k == 0) return true;
            return (k == 2 && i != 2) || (k == 4 && i != 4);
        },
        faces);
    return {"labyrinth", std::move(mesh), [](const Vector3d& p) {
                const bool in_corner = std::abs(p.x() - kLeft) < kNear && std::abs(p.z()) < kNear;
                if (!in_corner) return std::nan("");
                const double way =
                    std::hypot(kLeft, kC) + std::hypot(kS, kS) + std::hypot(kD - kS, kC) + kS;
                return std::min(way, kEnd - std::abs(p.y()));
            }};
}

ConcavityAnswer block(std::size_t faces) {
    return {"box", box({0.1, 0.2, 0.3}, faces), [](const Vector3d&) { return 0.0; }};
}

ConcavityAnswer ball(std::size_t faces) {
    return {"sphere", sphere(0.05, faces), [](const Vector3d&) { return 0.0; }};
}

ConcavityAnswer truncated_wedge(std::size_t faces) {
    return {"wedge", wedge(0.02, 0.06, 0.08, 0.05, faces), [](const Vector3d&) { return 0.0; }};
}

ConcavityAnswer plane_tunnel(std::size_t faces) {
    return {"tunnel_2d", tunnel_2d(faces), tunnel_2d_concavity_m};
}

ConcavityAnswer skew_tunnel(std::size_t faces) {
    return {"tunnel_3d", tunnel_3d(faces), tunnel_3d_concavity_m};
}

ConcavityAnswer round_lip(std::size_t faces) {
    const VaseAnswer answer = vase_answer(faces);
    return {"vase", vase(faces), [answer](const Vector3d& p) { return answer.lowest_m(p); }};
}

ConcavityAnswer twisted_lip(std::size_t faces) {
    const VaseAnswer answer = twisted_vase_answer(faces);
    return {"twisted vase", twisted_vase(faces, 5),
            [answer](const Vector3d& p) { return answer.lowest_m(p); },
            [answer](const Vector3d& p) { return answer.highest_m(p); }};
}

struct NamedAnswer {
    const char* name;
    ConcavityAnswer (*make)(std::size_t faces);
};

constexpr std::array<NamedAnswer, 14> kStraight{{{"box", block},
                                                 {"sphere", ball},
                                                 {"wedge", truncated_wedge},
                                                 {"channel", channel},
                                                 {"blind hole", hole},
                                                 {"plate", plate},
                                                 {"L", angle_iron},
                                                 {"box hourglass", square_hourglass},
                                                 {"cup", round_cup},
                                                 {"bowl", half_shell},
                                                 {"torus", ring_of_tube},
                                                 {"ring", square_ring},
                                                 {"dumbbell", balls_on_a_bar},
                                                 {"hourglass", discs_on_a_neck}}};
constexpr std::array<NamedAnswer, 2> kBent{
    {{"undercut channel", undercut_channel}, {"labyrinth", labyrinth}}};
constexpr std::array<NamedAnswer, 4> kFurther{{{"tunnel_2d", plane_tunnel},
                                               {"tunnel_3d", skew_tunnel},
                                               {"vase", round_lip},
                                               {"twisted vase", twisted_lip}}};

std::vector<NamedAnswer> all_answers() {
    std::vector<NamedAnswer> all(kStraight.begin(), kStraight.end());
    all.insert(all.end(), kBent.begin(), kBent.end());
    all.insert(all.end(), kFurther.begin(), kFurther.end());
    return all;
}

}  // namespace

std::vector<ConcavityAnswer> straight_answers(std::size_t faces) {
    std::vector<ConcavityAnswer> answers;
    for (const NamedAnswer& answer : kStraight) answers.push_back(answer.make(faces));
    return answers;
}

std::vector<ConcavityAnswer> bent_answers(std::size_t faces) {
    std::vector<ConcavityAnswer> answers;
    for (const NamedAnswer& answer : kBent) answers.push_back(answer.make(faces));
    return answers;
}

std::vector<std::string> answer_names() {
    std::vector<std::string> names;
    for (const NamedAnswer& answer : all_answers()) names.emplace_back(answer.name);
    return names;
}

ConcavityAnswer concavity_answer(const std::string& name, std::size_t faces) {
    const std::vector<NamedAnswer> all = all_answers();
    const auto named =
        std::ranges::find_if(all, [&](const NamedAnswer& answer) { return name == answer.name; });
    return named->make(faces);
}

}  // namespace graspd::test
