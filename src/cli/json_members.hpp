#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "graspd/base/result.hpp"

namespace graspd::cli {

/// Reads the members of one JSON object into variables and remembers the first that is missing or
/// of another kind; what comes after that is left as it is. So a row of reads needs one check.
class JsonMembers {
public:
    using Json = nlohmann::json;

    /// @param path  of the object, put before the members' names: "grasps[0]", or empty
    JsonMembers(const Json& node, std::string path) : node_(node), path_(std::move(path)) {
        if (!node_.is_object()) fail("", node_, "must be an object");
    }

    const std::optional<PlanError>& error() const { return error_; }
    bool has(const char* key) const { return node_.is_object() && node_.contains(key); }
    std::string path_of(const std::string& key) const {
        return path_.empty() || key.empty() ? path_ + key : path_ + "." + key;
    }

    void text(const char* key, std::string& to) {
        const Json* member = find(key);
        if (member == nullptr) return;
        if (!member->is_string()) return fail(key, *member, "must be a text");
        to = member->get<std::string>();
    }
    template <class Integer>
    void integer(const char* key, Integer& to) {
        const Json* member = find(key);
        if (member == nullptr) return;
        if (!member->is_number_integer()) return fail(key, *member, "must be an integer");
        to = member->get<Integer>();
    }
    void number(const char* key, double& to) {
        const Json* member = find(key);
        if (member == nullptr) return;
        if (!member->is_number()) return fail(key, *member, "must be a number");
        to = member->get<double>();
    }
    /// As number(); null is infinity, for which JSON has no number.
    void number_or_null(const char* key, double& to) {
        const Json* member = find(key);
        if (member == nullptr) return;
        if (!member->is_null()) return number(key, to);
        to = std::numeric_limits<double>::infinity();
    }
    template <int N>
    void numbers(const char* key, Eigen::Matrix<double, N, 1>& to) {
        const Json* member = find(key);
        if (member == nullptr) return;
        const std::string must = "must be " + std::to_string(N) + " numbers";
        if (!member->is_array() || member->size() != N) return fail(key, *member, must);
        for (Eigen::Index i = 0; i < N; ++i) {
            const Json& entry = (*member)[static_cast<std::size_t>(i)];
            if (!entry.is_number()) return fail(key, *member, must);
            to[i] = entry.get<double>();
        }
    }
    /// The member itself; null when something is wrong already, or with it.
    const Json* array(const char* key) {
        const Json* member = find(key);
        if (member == nullptr || member->is_array()) return member;
        fail(key, *member, "must be a list");
        return nullptr;
    }
    const Json* find(const char* key) {
        if (error_) return nullptr;
        const auto member = node_.find(key);
        if (member != node_.end()) return &*member;
        error_ = PlanError{PlanErrorCode::kInvalidInput, path_of(key) + " is missing"};
        return nullptr;
    }
    /// "PATH.KEY = VALUE MUST", a long value cut short.
    void fail(const std::string& key, const Json& value, const std::string& must) {
        constexpr std::size_t kLongest = 80;
        std::string shown = value.dump(-1, ' ', false, Json::error_handler_t::replace);
        if (shown.size() > kLongest) shown.replace(kLongest, std::string::npos, "...");
        const std::string name = path_of(key);
        fail((name.empty() ? "the whole file" : name) + " = " + shown + " " + must);
    }
    void fail(const std::string& detail) {
        if (!error_) error_ = PlanError{PlanErrorCode::kInvalidInput, detail};
    }
    void take(const std::optional<PlanError>& error) {
        if (!error_) error_ = error;
    }

private:
    const Json& node_;
    std::string path_;
    std::optional<PlanError> error_;
};

}  // namespace graspd::cli
