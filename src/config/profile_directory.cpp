#include "graspd/config/profile_directory.hpp"

#include <cstdlib>

namespace graspd {

ProfilePlaces profile_places() {
    const char* environment = std::getenv("GRASPD_PROFILES");  // NOLINT(concurrency-mt-unsafe)
    std::error_code ignored;  // no /proc: the executable stays unknown
    return {environment != nullptr ? environment : "",
            std::filesystem::read_symlink("/proc/self/exe", ignored), GRASPD_SOURCE_PROFILES};
}

Result<std::filesystem::path> find_profiles(const ProfilePlaces& places) {
    std::error_code ignored;
    if (!places.environment.empty()) {
        if (std::filesystem::is_directory(places.environment, ignored)) {
            return std::filesystem::path(places.environment);
        }
        return PlanError{PlanErrorCode::kUnreadableFile,
                         "GRASPD_PROFILES = " + places.environment + " is not a directory"};
    }
    const auto installed =
        (places.executable.parent_path() / ".." / "share" / "graspd" / "profiles")
            .lexically_normal();
    if (!places.executable.empty() && std::filesystem::is_directory(installed, ignored)) {
        return installed;
    }
    if (std::filesystem::is_directory(places.source_tree, ignored)) return places.source_tree;
    return PlanError{PlanErrorCode::kUnreadableFile, "no profiles: neither " + installed.string() +
                                                         " nor " + places.source_tree.string() +
                                                         " is a directory; set GRASPD_PROFILES"};
}

}  // namespace graspd
