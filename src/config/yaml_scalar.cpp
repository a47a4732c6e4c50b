#include "yaml_scalar.hpp"

namespace graspd::config_detail {
namespace {

std::string place(const std::filesystem::path& file, const YAML::Node& node) {
    const YAML::Mark mark = node.Mark();
    if (mark.is_null()) return file.string() + ": ";
    return file.string() + ":" + std::to_string(mark.line + 1) + ": ";
}

std::string shown(const YAML::Node& node) {
    if (node.IsScalar()) return node.Tag() == "!" ? '"' + node.Scalar() + '"' : node.Scalar();
    if (node.IsNull()) return "(nothing)";
    return node.IsMap() ? "(a group of keys)" : "(a list)";
}

}  // namespace

Result<YAML::Node> load_yaml(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {  // it would open, and read as empty
        return PlanError{PlanErrorCode::kUnreadableFile, file.string() + ": is a directory"};
    }
    try {
        return YAML::LoadFile(file.string());
    } catch (const YAML::BadFile&) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         file.string() + ": cannot be opened for reading"};
    } catch (const YAML::Exception& error) {
        return PlanError{PlanErrorCode::kUnreadableFile,
                         file.string() + ": not YAML: " + error.what()};
    }
}

PlanError bad_value(const std::filesystem::path& file, const YAML::Node& node,
                    const std::string& key, const std::string& must) {
    const std::string name = key.empty() ? "the file" : key;
    return {PlanErrorCode::kInvalidInput,
            place(file, node) + name + " = " + shown(node) + " " + must};
}

PlanError repeated_key(const std::filesystem::path& file, const YAML::Node& node,
                       const std::string& key) {
    return {PlanErrorCode::kInvalidInput, place(file, node) + key + " is given twice"};
}

PlanError unknown_key(const std::filesystem::path& file, const YAML::Node& node,
                      const std::string& key, const std::string& known) {
    return {PlanErrorCode::kInvalidInput,
            place(file, node) + "unknown key " + key + " (known here: " + known + ")"};
}

bool parse_scalar(const YAML::Node& node, bool& value) {
    if (!node.IsScalar() || node.Tag() == "!") return false;
    if (node.Scalar() != "true" && node.Scalar() != "false") return false;
    value = node.Scalar() == "true";
    return true;
}

bool parse_scalar(const YAML::Node& node, std::string& value) {
    if (!node.IsScalar()) return false;
    value = node.Scalar();
    return true;
}

}  // namespace graspd::config_detail
