#include "write_doctor.hpp"

#include "json_values.hpp"
#include "text_table.hpp"
#include "write_findings.hpp"

namespace graspd::cli {
namespace {

constexpr double kSquareCentimetres = 1e4;
constexpr double kCubicCentimetres = 1e6;

Json json_of(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const ObjectFigures& figures) {
    return {{"vertices", figures.vertices},
            {"faces", figures.faces},
            {"components", figures.components},
            {"holes", figures.holes},
            {"area", figures.area_m2},
            {"volume", json_of(figures.volume_m3)},
            {"size", {figures.size_m.x(), figures.size_m.y(), figures.size_m.z()}},
            {"spacing", json_of(figures.spacing_m)}};
}

std::string size_text(const Eigen::Vector3d& size_m) {
    return fixed(size_m.x(), 1, kMillimetres) + " x " + fixed(size_m.y(), 1, kMillimetres) + " x " +
           fixed(size_m.z(), 1, kMillimetres);
}

/// A row of the table: the figure before and after.
std::vector<std::string> row(const char* name, const Diagnosis& diagnosis,
                             std::string (*text)(const ObjectFigures&)) {
    return {name, text(diagnosis.before), diagnosis.after ? text(*diagnosis.after) : "-"};
}

std::string figure_rows(const Diagnosis& diagnosis) {
    TextTable table{{{"", "as stored", "as planned on"}}, {true}};
    const auto add = [&](const char* name, std::string (*text)(const ObjectFigures&)) {
        table.rows.push_back(row(name, diagnosis, text));
    };
    add(diagnosis.kind == "cloud" ? "points, vertices" : "vertices",
        [](const ObjectFigures& f) { return std::to_string(f.vertices); });
    add("faces", [](const ObjectFigures& f) { return std::to_string(f.faces); });
    add("components", [](const ObjectFigures& f) { return std::to_string(f.components); });
    add("holes", [](const ObjectFigures& f) { return std::to_string(f.holes); });
    add("area [cm2]",
        [](const ObjectFigures& f) { return fixed(f.area_m2, 2, kSquareCentimetres); });
    add("volume [cm3]", [](const ObjectFigures& f) {
        return f.volume_m3 ? fixed(*f.volume_m3, 3, kCubicCentimetres) : std::string("-");
    });
    add("box [mm]", [](const ObjectFigures& f) { return size_text(f.size_m); });
    add("spacing [mm]", [](const ObjectFigures& f) {
        return f.spacing_m ? fixed(*f.spacing_m, 2, kMillimetres) : std::string("-");
    });
    return "\n" + print_table(table);
}

}  // namespace

std::string write_doctor_table(const Diagnosis& diagnosis) {
    std::string text = diagnosis.file + ": " + diagnosis.kind + ", " +
                       (diagnosis.usable() ? "usable" : "refused: " + diagnosis.refusal) + "\n";
    if (diagnosis.kind != "unreadable") text += figure_rows(diagnosis);
    text += finding_rows(diagnosis.findings);
    if (!diagnosis.advice.empty()) text += "\n";
    for (const std::string& advice : diagnosis.advice) text += "would help: " + advice + "\n";
    return text;
}

std::string write_doctor_json(const Diagnosis& diagnosis) {
    const bool read = diagnosis.kind != "unreadable";
    const Json json = {{"schema", "graspd/1"},
                       {"file", diagnosis.file},
                       {"kind", diagnosis.kind},
                       {"verdict", diagnosis.usable() ? "usable" : "refused"},
                       {"message", diagnosis.refusal},
                       {"before", read ? json_of(diagnosis.before) : Json(nullptr)},
                       {"after", diagnosis.after ? json_of(*diagnosis.after) : Json(nullptr)},
                       {"findings", findings_json(diagnosis.findings)},
                       {"advice", diagnosis.advice}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace graspd::cli
