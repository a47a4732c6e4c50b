# `cpack` in a build of the preset `package` makes three Debian packages, see scripts/packages:
# graspd (programs, systemd unit), libgraspd (shared libraries, profiles), libgraspd-dev (headers, CMake
# files, interface files). Dependencies are found by dpkg-shlibdeps (Debian: dpkg-dev).
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "graspd maintainers")
# Packages must name an address; there is none, and .invalid (RFC 2606) leads to nobody's. See SECURITY.md.
set(CPACK_PACKAGE_CONTACT "graspd maintainers <graspd@graspd.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL graspd libgraspd libgraspd-dev)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# So that dpkg-shlibdeps finds our own libraries in the other component, also before that one is packed.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src ${PROJECT_BINARY_DIR}/src/dds)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")

set(CPACK_COMPONENT_GRASPD_DESCRIPTION "Grasp planner for unknown objects: daemon and command line
 graspd plans grasps for objects that nobody has modelled before: publish a mesh
 or a point cloud over DDS, from ROS 2 or any other participant, and get ranked,
 collision-free grasps or the reasons why there are none.")
set(CPACK_COMPONENT_LIBGRASPD_DESCRIPTION "Grasp planner for unknown objects: libraries
 The planner and its DDS client as shared libraries, with gripper and network
 profiles.")
set(CPACK_COMPONENT_LIBGRASPD-DEV_DESCRIPTION "Grasp planner for unknown objects: development files
 Headers, CMake files, the IDL and the ROS 2 interface package graspd_msgs.")

set(graspd_deb_version ${PROJECT_VERSION})
set(CPACK_DEBIAN_GRASPD_PACKAGE_NAME graspd)
set(CPACK_DEBIAN_GRASPD_PACKAGE_DEPENDS "libgraspd (= ${graspd_deb_version})")
# EGL needs a driver for the pictures of simulate and report.
set(CPACK_DEBIAN_GRASPD_PACKAGE_RECOMMENDS libgl1-mesa-dri)
set(CPACK_DEBIAN_LIBGRASPD_PACKAGE_NAME libgraspd)
set(CPACK_DEBIAN_LIBGRASPD_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBGRASPD-DEV_PACKAGE_NAME libgraspd-dev)
set(CPACK_DEBIAN_LIBGRASPD-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBGRASPD-DEV_PACKAGE_SHLIBDEPS OFF)
# The CMake files name the programs too; Fast DDS is there for those who use graspd::dds.
set(CPACK_DEBIAN_LIBGRASPD-DEV_PACKAGE_DEPENDS
    "graspd (= ${graspd_deb_version}), libgraspd (= ${graspd_deb_version}), libeigen3-dev")
set(CPACK_DEBIAN_LIBGRASPD-DEV_PACKAGE_RECOMMENDS "libfastrtps-dev, libfastcdr-dev")
include(CPack)
