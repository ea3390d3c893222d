# SPDX-License-Identifier: MIT
# Install rules and the package configuration for find_package(quadrille). Components: library (shared
# libraries), dev, ompl, program, python, and licences, for which Debian's packages have a form of their own.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(quadrille_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/quadrille")

# A static libquadrille_sat.a needs CaDiCaL when a user links. Systems ship a CaDiCaL that is too
# old, and a private prefix of this build may be gone by then; so the archive it was built and tested
# with is installed beside the library, and a user needs nothing but the install prefix. A shared
# CaDiCaL is looked for again on the user's machine.
set(quadrille_bundled_cadical "")
set(quadrille_link_glibc_shim OFF)
set(quadrille_targets ${QUADRILLE_LIBRARIES} quadrille_umbrella)
if(NOT BUILD_SHARED_LIBS)
  cmake_path(GET CaDiCaL_LIBRARY EXTENSION LAST_ONLY extension)
  if(extension STREQUAL CMAKE_STATIC_LIBRARY_SUFFIX)
    cmake_path(GET CaDiCaL_LIBRARY FILENAME archive)
    set(quadrille_bundled_cadical "${CMAKE_INSTALL_LIBDIR}/quadrille/${archive}")
    install(FILES "${CaDiCaL_LIBRARY}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/quadrille" COMPONENT dev)
  else()
    install(FILES cmake/FindCaDiCaL.cmake cmake/cadical_check.cpp
      sat/src/engine/derivation_tracer.hpp sat/src/engine/derived_clause_tracer.hpp
      DESTINATION "${quadrille_package_dir}" COMPONENT dev)
  endif()
  if(TARGET quadrille_glibc_shim)
    set(quadrille_link_glibc_shim ON)
    list(APPEND quadrille_targets quadrille_glibc_shim)
  endif()
endif()
# CaDiCaL is inside what is installed, as an archive or linked into the library: its licence asks
# that its notice goes along.
find_file(QUADRILLE_CADICAL_NOTICE NAMES copyright LICENSE
  HINTS "${CaDiCaL_INCLUDE_DIR}/../../share/doc/libcadical-dev" "${CaDiCaL_INCLUDE_DIR}/.."
  NO_DEFAULT_PATH)
mark_as_advanced(QUADRILLE_CADICAL_NOTICE)
if(QUADRILLE_CADICAL_NOTICE)
  install(FILES "${QUADRILLE_CADICAL_NOTICE}" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
    RENAME copyright-cadical COMPONENT licences)
endif()
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT licences)

# The installed program finds shared libraries wherever the prefix is.
if(TARGET quadrille)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY "${CMAKE_INSTALL_FULL_BINDIR}"
    OUTPUT_VARIABLE libraries)
  set_target_properties(quadrille PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
endif()

install(TARGETS ${quadrille_targets} EXPORT quadrilleTargets
  LIBRARY COMPONENT library NAMELINK_COMPONENT dev
  ARCHIVE COMPONENT dev)
install(EXPORT quadrilleTargets NAMESPACE quadrille:: DESTINATION "${quadrille_package_dir}"
  COMPONENT dev)

# What needs packages that most users do not have, as a component of its own.
if(TARGET quadrille_ompl)
  install(TARGETS quadrille_ompl EXPORT quadrilleOmplTargets ARCHIVE COMPONENT ompl)
  install(EXPORT quadrilleOmplTargets NAMESPACE quadrille::
    DESTINATION "${quadrille_package_dir}" COMPONENT ompl)
  install(FILES cmake/FindQuadrilleOmpl.cmake DESTINATION "${quadrille_package_dir}" COMPONENT ompl)
endif()

# For users without CMake. The libraries that others depend on come last.
get_property(libraries GLOBAL PROPERTY QUADRILLE_LIBRARIES)
list(REVERSE libraries)
list(TRANSFORM libraries PREPEND "-l")
if(NOT BUILD_SHARED_LIBS)
  if(quadrille_bundled_cadical)
    list(APPEND libraries "\${prefix}/${quadrille_bundled_cadical}")
  else()
    list(APPEND libraries -lcadical)
  endif()
  if(quadrille_link_glibc_shim)
    list(APPEND libraries -lquadrille_glibc_shim)
  endif()
  # Not as Requires: FCL's flags ask for C++11, after the user's own.
  list(APPEND libraries -lyaml-cpp -lpugixml -lfcl -lccd -pthread)
endif()
list(JOIN libraries " " quadrille_pc_libraries)
# Relative, so that the prefix may move.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
  BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" OUTPUT_VARIABLE quadrille_pc_prefix)
configure_file(cmake/quadrille.pc.in quadrille.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/quadrille.pc"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)

configure_package_config_file(cmake/quadrilleConfig.cmake.in quadrilleConfig.cmake
  INSTALL_DESTINATION "${quadrille_package_dir}"
  PATH_VARS quadrille_bundled_cadical)
# Before 1.0 a minor version may break its users.
write_basic_package_version_file(quadrilleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_CURRENT_BINARY_DIR}/quadrilleConfig.cmake"
  "${CMAKE_CURRENT_BINARY_DIR}/quadrilleConfigVersion.cmake"
  DESTINATION "${quadrille_package_dir}" COMPONENT dev)
