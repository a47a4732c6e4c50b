#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace graspd::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A promise that some input breaks. libFuzzer takes the uncaught exception for a crash.
class BrokenPromise : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

inline void require(bool kept, const std::string& promise) {
    if (!kept) throw BrokenPromise(promise);
}

// The targets: each takes any bytes, and returns when every promise of the code held. @return
// whether the input was accepted, not refused

/// Byte 0: which sample of the wire; the rest: its payload, encapsulation header first. Guard,
/// layout, generated reader and conversion, as the daemon and the clients call them.
bool fuzz_guard(Bytes bytes);

/// Byte 0: format and how the object is taken on; the rest: the file.
bool fuzz_object_file(Bytes bytes);

/// Byte 0: what kind of text; the rest: planner.yaml, a gripper, a URDF, ROS arguments, ...
bool fuzz_yaml(Bytes bytes);

/// A request, built from the bytes so that it is valid, and then damaged. plan() twice.
bool fuzz_plan(Bytes bytes);

/// A file of this process with the extension given, for readers that take a path.
class ScratchFile {
public:
    explicit ScratchFile(const std::string& name);
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile();

    const std::filesystem::path& write(Bytes bytes) const;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline std::string_view text_of(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace graspd::fuzz
