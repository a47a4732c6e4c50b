#pragma once

#include <filesystem>
#include <string>

#include "graspd/base/result.hpp"

namespace graspd {

/// The places where profiles may lie; the first that applies is taken.
struct ProfilePlaces {
    std::string environment;            ///< value of GRASPD_PROFILES, empty when unset
    std::filesystem::path executable;   ///< the running program; empty when unknown
    std::filesystem::path source_tree;  ///< profiles/ of the tree that was compiled
};

/// This process's places: environment, /proc/self/exe, the path compiled in.
ProfilePlaces profile_places();

/// The directory that holds planner.yaml, grippers/ and dds/: GRASPD_PROFILES when it is set, else
/// ../share/graspd/profiles beside the executable's folder, else the source tree's profiles/.
/// @return kUnreadableFile when GRASPD_PROFILES names no directory (it is never passed over in
///         silence), or when none of the places exists
Result<std::filesystem::path> find_profiles(const ProfilePlaces& places = profile_places());

}  // namespace graspd
