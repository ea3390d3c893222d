# SPDX-License-Identifier: MIT
find_path(CaDiCaL_INCLUDE_DIR cadical.hpp HINTS ${CADICAL_ROOT} PATH_SUFFIXES include/cadical include NO_DEFAULT_PATH)
find_library(CaDiCaL_LIBRARY NAMES cadical libcadical.a HINTS ${CADICAL_ROOT} PATH_SUFFIXES lib lib/x86_64-linux-gnu NO_DEFAULT_PATH)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CaDiCaL REQUIRED_VARS CaDiCaL_LIBRARY CaDiCaL_INCLUDE_DIR)
if(CaDiCaL_FOUND AND NOT TARGET CaDiCaL::CaDiCaL)
  add_library(CaDiCaL::CaDiCaL STATIC IMPORTED)
  set_target_properties(CaDiCaL::CaDiCaL PROPERTIES IMPORTED_LOCATION ${CaDiCaL_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${CaDiCaL_INCLUDE_DIR})
endif()
