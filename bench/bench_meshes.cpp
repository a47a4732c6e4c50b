#include "bench_meshes.hpp"

#include <algorithm>
#include <charconv>
#include <variant>

#include "graspd/mesh/read_object.hpp"

namespace graspd::bench {
namespace {

/// Faces of NAME/FACES, or 0 where the name is no shape's.
std::size_t faces_of(const std::string& name, const std::string& shape) {
    std::size_t faces = 0;
    const char* first = name.data() + shape.size() + 1;
    const char* last = name.data() + name.size();
    const auto read = std::from_chars(first, last, faces);
    return read.ec == std::errc() && read.ptr == last ? faces : 0;
}

}  // namespace

Result<TriangleMesh> bench_mesh(const std::string& name) {
    for (const std::string& shape : test::answer_names()) {
        if (!name.starts_with(shape + "/")) continue;
        if (const std::size_t faces = faces_of(name, shape)) {
            return test::concavity_answer(shape, faces).mesh;
        }
    }
    const auto file = read_object(name);
    if (!file.ok()) return file.error();
    const auto* mesh = std::get_if<TriangleMesh>(&file.value().object);
    if (!mesh) return PlanError{PlanErrorCode::kInvalidInput, name + " has no faces"};
    return *mesh;
}

}  // namespace graspd::bench
