#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "graspd/base/result.hpp"

namespace graspd {

// Every stage keeps its parameters in a plain struct with a static member
//
//     template <class Self, class Visitor> static void describe(Self& self, Visitor&& visit) {
//         visit("max_rms_m", self.max_rms_m, 1e-6, 0.1);     // name, field, least, greatest
//     }
//
// The names are the keys of planner.yaml. Loading, printing, hashing and validating all walk this
// one list, so a parameter cannot have a range in one place and another range elsewhere.

/// A struct of named, bounded parameters.
template <class T>
concept Settings = requires(T& t) {
    T::describe(t, [](const char*, auto&, auto...) {});
};

/// The texts that a parameter may have: visit("method", self.method, kMethods).
using Choices = std::span<const std::string_view>;

/// "one, two, three".
inline std::string listed(Choices choices) {
    std::string text;
    for (const std::string_view choice : choices) {
        text += text.empty() ? "" : ", ";
        text += choice;
    }
    return text;
}

namespace detail {

/// Collects the first parameter that leaves its range.
struct RangeChecker {
    std::string prefix;
    std::optional<PlanError> error;

    template <Settings Group>
    void operator()(const char* name, Group& group) {
        RangeChecker inner{prefix + name + ".", {}};
        std::remove_const_t<Group>::describe(group, inner);
        if (!error) error = inner.error;
    }
    template <class T, class Bound>
    void operator()(const char* name, const T& value, Bound least, Bound greatest) {
        const bool inside = value >= static_cast<T>(least) && value <= static_cast<T>(greatest);
        if (error || inside) return;  // a NaN is not inside
        std::ostringstream text;
        text << prefix << name << " = " << value << " is outside [" << least << ", " << greatest
             << "]";
        error = PlanError{PlanErrorCode::kInvalidInput, text.str()};
    }
    void operator()(const char* name, const std::string& value, Choices choices) {
        if (error || std::ranges::find(choices, value) != choices.end()) return;
        error = PlanError{PlanErrorCode::kInvalidInput,
                          prefix + name + " = " + value + " is none of " + listed(choices)};
    }
    void operator()(const char*, const bool&) {}
    void operator()(const char*, const std::string&) {}
};

}  // namespace detail

/// Checks every parameter against its range.
/// @return nothing when all are inside, else an error naming the key, its value and its range
template <Settings Group>
std::optional<PlanError> validate(const Group& settings, const std::string& prefix = "") {
    detail::RangeChecker checker{prefix, {}};
    Group::describe(settings, checker);
    return checker.error;
}

}  // namespace graspd
