#include "doctor_advice.hpp"

#include <algorithm>
#include <string_view>

namespace graspd::cli {
namespace {

struct Advice {
    std::string_view code;
    std::string_view sentence;
};

// Findings without a row, such as vertices_welded or components, need nobody's hand.
constexpr Advice kAdvice[] = {
    {"units_suspected", "check the unit of the file: --units mm, --units cm or --scale"},
    {"self_intersections", "unite the parts in a modeller, or remesh, if contacts there matter"},
    {"holes_filled", "close the holes in a modeller where the flat fill is not what is there"},
    {"non_manifold_edges", "remove walls inside the object or split it where surfaces meet"},
    {"components_inverted", "write the faces counter-clockwise seen from outside"},
    {"faces_flipped", "write the faces counter-clockwise seen from outside"},
    {"faces_dropped", "export the file again: faces name vertices that are not there"},
    {"floating_parts", "remove specks that are no part of the object: they make its hull larger"},
    {"alpha_wrapped", "give the sheet a thickness, or close it to a body"},
    {"one_sided", "merge views from other sides, or send sensor_origin (--sensor X,Y,Z)"},
    {"outliers_removed", "filter the cloud if what was dropped belongs to the object"},
    {"points_thinned", "send fewer points, or raise triangulate_cloud.max_points"},
    {"points_not_finite", "nothing: points that were not measured are left out"},
};

// Parts of refusals, for what has no finding.
constexpr Advice kRemedies[] = {
    {"factor 0.001", "say that the file is in millimetres: --units mm"},
    {"factor 0.01 ", "say that the file is in centimetres: --units cm"},
    {"factor 1000", "scale the file back: --scale 1000"},
    {"factor 100 ", "scale the file back: --scale 100"},
    {"is flat", "give views of more than one plane, or a mesh with a thickness"},
    {"flat sheet", "give the sheet a thickness, or set condition_mesh.alpha_wrap: true"},
    {"is not finite", "export the file again: a vertex has no place"},
    {"uses vertex", "export the file again: faces name vertices that are not there"},
    {"finite distinct points", "take more views or a finer resolution"},
    {"hang together", "take more views or a finer resolution"},
    {"degenerate", "export the file with more digits, or in a larger unit"},
    {"limit max_", "decimate the mesh"},
    {"limit limit_points", "thin the cloud before sending it"},
};

void add(std::vector<std::string>& all, std::string_view sentence) {
    if (std::ranges::find(all, sentence) == all.end()) all.emplace_back(sentence);
}

}  // namespace

std::vector<std::string> advice_for(const std::vector<Finding>& findings,
                                    const std::string& refusal) {
    std::vector<std::string> all;
    const bool one_sided = std::ranges::count(findings, "one_sided", &Finding::code) > 0;
    for (const Finding& finding : findings) {
        if (one_sided && finding.code == "holes_filled") continue;  // the other side is missing
        for (const Advice& row : kAdvice) {
            if (row.code == finding.code) add(all, row.sentence);
        }
    }
    for (const Advice& row : kRemedies) {
        if (refusal.find(row.code) != std::string::npos) add(all, row.sentence);
    }
    return all;
}

}  // namespace graspd::cli
