#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graspd/planner/plan_types.hpp"

namespace graspd::soak {

/// What is asked, and what may come of it.
struct Question {
    std::string kind;  ///< "box", "nan_vertex", "huge", "cancelled", ...
    PlanRequest request;
    std::vector<PlanStatus> expected;  ///< a terminal reply of another status is a violation
    bool cancel = false;               ///< to be cancelled while it is planned
    bool again = false;  ///< to be sent again, under the same id: the same answer must come
};

/// Question `number` of the client: of ten, six good ones of ten small shapes, two bad ones of five
/// kinds, and two that are repeated, cancelled or huge (one in fifty). The same arguments give the
/// same question.
Question make_question(const std::string& client, std::uint64_t number, const Gripper& gripper);

}  // namespace graspd::soak
