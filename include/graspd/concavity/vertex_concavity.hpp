#pragma once

#include <array>
#include <string>
#include <string_view>

#include "graspd/base/settings.hpp"
#include "graspd/concavity/shortest_path_concavity.hpp"
#include "graspd/concavity/tetrahedral_concavity.hpp"

namespace graspd {

/// How the vertices' concavity is computed.
enum class ConcavityMethod : std::uint8_t {
    kAnyAngle,     ///< shortest_path_concavity
    kTetrahedral,  ///< tetrahedral_concavity, the paper's own way
};
/// By their numbers.
inline constexpr std::array<std::string_view, 2> kConcavityMethods = {"any_angle", "tetrahedral"};

/// Which method is asked for.
struct VertexConcavityConfig {
    std::string method = "any_angle";  ///< one of kConcavityMethods

    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
        visit("method", self.method, Choices(kConcavityMethods));
    }
};

/// The settings of every method, of which one is used.
struct ConcavitySettings {
    const VertexConcavityConfig& choice;
    const ConcavityConfig& any_angle;
    const TetrahedralConfig& tetrahedral;
};

/// @return kInvalidInput for a name that is none of kConcavityMethods
Result<ConcavityMethod> concavity_method(const VertexConcavityConfig& config);

/// The vertices' concavity by the method asked for. An error of that method is the answer: there is
/// no fall back to the other one, whose values would be worth something else.
///
/// Source: Lei & Wisse 2016, Sec. II-A.
/// @param mesh, hull, bvh  as of shortest_path_concavity
/// @return the method's own errors, or that of concavity_method
Result<ConcavityField> vertex_concavity(const TriangleMesh& mesh, const OuterHull& hull,
                                        const TriangleBvh& bvh, const ConcavitySettings& settings);

}  // namespace graspd
