# PCL's component libraries as imported targets, one by one. find_package(PCL) is not used: it runs
# VTK's CMake files and links pcl_io.
#
# graspd_pcl_common, _kdtree, _octree, _search, _sample_consensus, _filters, _features: the shared
# libraries; none of them needs VTK.
# graspd_pcl_surface: NOT libpcl_surface, which loads five VTK libraries. The surface classes are
# templates: include <pcl/surface/impl/gp3.hpp> and they are compiled into the
# .cpp that uses them; this target adds what they call (search, kdtree, qhull).
#
# Link them privately; PCL headers belong into .cpp files. A package that installs graspd_core must
# include this file before its exported targets.
include_guard(GLOBAL)

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Qhull REQUIRED)
find_path(GRASPD_PCL_INCLUDE_DIR pcl/pcl_config.h
          PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 REQUIRED)
file(STRINGS ${GRASPD_PCL_INCLUDE_DIR}/pcl/pcl_config.h graspd_pcl_version_line
     REGEX "define PCL_VERSION_PRETTY")
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" graspd_pcl_version "${graspd_pcl_version_line}")
if(graspd_pcl_version VERSION_LESS 1.13)
  message(FATAL_ERROR "PCL ${graspd_pcl_version} is too old: 1.13 or later is needed "
                      "(Debian: libpcl-dev)")
endif()

add_library(graspd_pcl_headers INTERFACE IMPORTED GLOBAL)
target_include_directories(graspd_pcl_headers SYSTEM INTERFACE ${GRASPD_PCL_INCLUDE_DIR})
target_link_libraries(graspd_pcl_headers INTERFACE Eigen3::Eigen)

# graspd_pcl_library(COMPONENT needed component...)
function(graspd_pcl_library component)
  find_library(GRASPD_PCL_${component}_LIBRARY pcl_${component} REQUIRED)
  add_library(graspd_pcl_${component} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(graspd_pcl_${component} PROPERTIES
    IMPORTED_LOCATION ${GRASPD_PCL_${component}_LIBRARY})
  target_link_libraries(graspd_pcl_${component} INTERFACE graspd_pcl_headers)
  foreach(needed ${ARGN})
    target_link_libraries(graspd_pcl_${component} INTERFACE graspd_pcl_${needed})
  endforeach()
endfunction()

graspd_pcl_library(common)
graspd_pcl_library(kdtree common)
graspd_pcl_library(octree common)
graspd_pcl_library(search kdtree octree common)
graspd_pcl_library(sample_consensus common)
graspd_pcl_library(filters sample_consensus search kdtree octree common)
graspd_pcl_library(features filters search kdtree octree common)

add_library(graspd_pcl_surface INTERFACE IMPORTED GLOBAL)
target_link_libraries(graspd_pcl_surface INTERFACE graspd_pcl_search graspd_pcl_kdtree
                      graspd_pcl_common Qhull::qhull_r)
