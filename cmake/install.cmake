# Install and export: find_package(graspd) gives graspd::core, and graspd::msgs and graspd::dds when
# they were built.
include(CMakePackageConfigHelpers)
