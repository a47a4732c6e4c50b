# Install and export, in the three components that packages.cmake makes Debian packages of: graspd (the
# programs), libgraspd (shared libraries, profiles) and libgraspd-dev. find_package(graspd) gives graspd::core and the program graspd::graspctl, and
# graspd::msgs, graspd::dds and the daemon graspd::graspd when they were built; graspd::simulate when
# asked for. The two have export sets of their own, so that a user of graspd::core needs neither Fast
# DDS nor MuJoCo.
include(CMakePackageConfigHelpers)

set(graspd_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/graspd)

# graspd_install(EXPORT target...): the ones that exist.
function(graspd_install export)
  foreach(target ${ARGN})
    if(NOT TARGET ${target})
      continue()
    endif()
    get_target_property(kind ${target} TYPE)
    if(kind STREQUAL EXECUTABLE)
      set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
      install(TARGETS ${target} EXPORT ${export} RUNTIME COMPONENT graspd)
    else()
      # DEFINE_SYMBOL: the objects of shared and static libraries are the same.
      set_target_properties(${target} PROPERTIES DEFINE_SYMBOL ""
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
      install(TARGETS ${target} EXPORT ${export}
              LIBRARY COMPONENT libgraspd NAMELINK_COMPONENT libgraspd-dev
              ARCHIVE COMPONENT libgraspd-dev
              FILE_SET HEADERS COMPONENT libgraspd-dev)
    endif()
  endforeach()
endfunction()

graspd_install(graspdTargets graspd_core graspctl)
install(EXPORT graspdTargets NAMESPACE graspd:: DESTINATION ${graspd_config_dir}
        COMPONENT libgraspd-dev)
if(TARGET graspd_msgs)
  graspd_install(graspdDdsTargets graspd_msgs graspd_dds graspd)
  install(EXPORT graspdDdsTargets NAMESPACE graspd:: DESTINATION ${graspd_config_dir}
          COMPONENT libgraspd-dev)
endif()
if(TARGET graspd_simulate)
  graspd_install(graspdSimulateTargets graspd_simulate)
  install(EXPORT graspdSimulateTargets NAMESPACE graspd:: DESTINATION ${graspd_config_dir}
          COMPONENT libgraspd-dev)
endif()

# Manual pages and completion, where the build could run the programs (src/cli, src/server). Optional: a build
# of the two programs alone has not written them.
if(TARGET graspctl_files)
  set(graspctl_dir ${PROJECT_BINARY_DIR}/src/cli)
  install(FILES ${graspctl_dir}/graspctl.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
          COMPONENT graspd OPTIONAL)
  install(FILES ${graspctl_dir}/graspctl.bash RENAME graspctl
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT graspd OPTIONAL)
  install(FILES ${graspctl_dir}/_graspctl  # where Debian's zsh looks
          DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT graspd OPTIONAL)
endif()
if(TARGET graspd_files)
  install(FILES ${PROJECT_BINARY_DIR}/src/server/graspd.8
          DESTINATION ${CMAKE_INSTALL_MANDIR}/man8 COMPONENT graspd OPTIONAL)
endif()

# The programs look for ../share/graspd/profiles from their own place.
install(DIRECTORY profiles/ DESTINATION share/graspd/profiles COMPONENT libgraspd)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT libgraspd)
if(TARGET graspd)
  configure_file(cmake/graspd.service.in graspd.service @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/graspd.service DESTINATION lib/systemd/system COMPONENT graspd)
endif()
if(EXISTS ${PROJECT_SOURCE_DIR}/idl)
  install(DIRECTORY idl/ DESTINATION share/graspd/idl COMPONENT libgraspd-dev)
endif()

configure_package_config_file(cmake/graspdConfig.cmake.in graspdConfig.cmake
                              INSTALL_DESTINATION ${graspd_config_dir})
write_basic_package_version_file(graspdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/graspdConfig.cmake ${PROJECT_BINARY_DIR}/graspdConfigVersion.cmake
              cmake/pcl.cmake
        DESTINATION ${graspd_config_dir} COMPONENT libgraspd-dev)
