#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace graspd {

/// Why a stage could not give its result. Only what an input can cause has a code here; what only
/// a bug can cause is an assert.
enum class PlanErrorCode : std::uint8_t {
    kInvalidInput,    ///< a field is missing, non-finite or out of range
    kDegenerate,      ///< the input is well formed but its geometry carries no answer
    kTooLarge,        ///< a count exceeds its configured limit
    kUnsupported,     ///< a known option that this version does not serve
    kUnknownGripper,  ///< no gripper profile of that name
    kUnknownObject,   ///< no object under that key
    kUnreadableFile,  ///< a file is missing, or its contents are not what its name says
    kNoReply,         ///< the other end did not answer in time
    kInternal,        ///< a library failed where it should not have
};

/// The code's name as it appears in logs and messages, such as "kDegenerate" -> "degenerate".
const char* to_string(PlanErrorCode code);

/// An error with the offending field and value in `detail`, ready to be shown to the client.
struct PlanError {
    PlanErrorCode code = PlanErrorCode::kInternal;
    std::string detail;
};

/// Either a value or the reason why there is none. (g++ 12 has no std::expected.)
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}          // NOLINT
    Result(PlanError error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    const T& value() const& {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    T& value() & {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    T&& value() && {
        assert(ok());
        return std::move(*std::get_if<0>(&state_));
    }
    const PlanError& error() const {
        assert(!ok());
        return *std::get_if<1>(&state_);
    }

private:
    std::variant<T, PlanError> state_;
};

}  // namespace graspd
