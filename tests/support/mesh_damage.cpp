#include "support/mesh_damage.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

namespace graspd::test {
namespace {

/// A permutation that is the same with every standard library (std::shuffle's is not).
std::vector<std::uint32_t> permutation(std::size_t size, std::mt19937_64& random) {
    std::vector<std::uint32_t> order(size);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

/// In [-1, 1).
double fraction(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1.0p-52 - 1.0;
}

}  // namespace

TriangleMesh moved(TriangleMesh mesh, const Eigen::Isometry3d& X_new_old) {
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex = X_new_old * vertex;
    return mesh;
}

Eigen::Isometry3d random_pose(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Eigen::Vector4d turn;
    Eigen::Vector3d shift;
    for (double& value : turn) value = fraction(random);
    for (double& value : shift) value = 0.5 * fraction(random);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::Quaterniond(turn.normalized()));
    pose.pretranslate(shift);
    return pose;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
    for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= factor;
    return mesh;
}

TriangleMesh noisy(TriangleMesh mesh, double share_of_diagonal, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
    const double reach_m = share_of_diagonal * box.diagonal().norm();
    for (Eigen::Vector3d& vertex : mesh.vertices) {
        for (double& coordinate : vertex) coordinate += reach_m * fraction(random);
    }
    return mesh;
}

TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed,
                      std::vector<std::uint32_t>* new_of_old) {
    std::mt19937_64 random(seed);
    const std::vector<std::uint32_t> place = permutation(mesh.vertices.size(), random);
    const std::vector<std::uint32_t> face_order = permutation(mesh.faces.size(), random);
    TriangleMesh result;
    result.vertices.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < place.size(); ++i) result.vertices[place[i]] = mesh.vertices[i];
    for (const std::uint32_t f : face_order) {
        const Triangle& face = mesh.faces[f];
        const std::size_t start = random() % 3;
        result.faces.push_back(
            {place[face[start]], place[face[(start + 1) % 3]], place[face[(start + 2) % 3]]});
    }
    if (new_of_old) *new_of_old = place;
    return result;
}

std::vector<std::size_t> choose_faces(const TriangleMesh& mesh, std::size_t count,
                                      std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const std::vector<std::uint32_t> order = permutation(mesh.faces.size(), random);
    const std::ptrdiff_t kept = static_cast<std::ptrdiff_t>(std::min(count, order.size()));
    std::vector<std::size_t> chosen(order.begin(), order.begin() + kept);
    std::ranges::sort(chosen);
    return chosen;
}

TriangleMesh with_flipped(TriangleMesh mesh, const std::vector<std::size_t>& faces) {
    for (const std::size_t f : faces) std::swap(mesh.faces.at(f)[1], mesh.faces.at(f)[2]);
    return mesh;
}

TriangleMesh without(const TriangleMesh& mesh, const std::vector<std::size_t>& faces) {
    TriangleMesh result;
    result.vertices = mesh.vertices;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (std::ranges::find(faces, f) == faces.end()) result.faces.push_back(mesh.faces[f]);
    }
    return result;
}

TriangleMesh with_duplicates(TriangleMesh mesh, const std::vector<std::size_t>& faces) {
    for (const std::size_t f : faces) mesh.faces.push_back(Triangle(mesh.faces.at(f)));
    return mesh;
}

TriangleMesh to_soup(const TriangleMesh& mesh) {
    TriangleMesh soup;
    for (const Triangle& face : mesh.faces) {
        const std::uint32_t first = static_cast<std::uint32_t>(soup.vertices.size());
        for (const std::uint32_t vertex : face) soup.vertices.push_back(mesh.vertices[vertex]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

TriangleMesh joined(const TriangleMesh& first, const TriangleMesh& second) {
    TriangleMesh mesh = first;
    const std::uint32_t shift = static_cast<std::uint32_t>(first.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), second.vertices.begin(), second.vertices.end());
    for (const Triangle& face : second.faces) {
        mesh.faces.push_back({face[0] + shift, face[1] + shift, face[2] + shift});
    }
    return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
    for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

}  // namespace graspd::test
