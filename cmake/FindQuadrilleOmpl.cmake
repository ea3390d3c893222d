# SPDX-License-Identifier: MIT
# Finds OMPL and defines the target QuadrilleOmpl::ompl. The package's own file has no target, and
# names libraries that programs do not need.
find_package(ompl 1.5 QUIET)
find_package(Eigen3 3.3 QUIET NO_MODULE)
find_library(QUADRILLE_OMPL_LIBRARY ompl HINTS ${OMPL_LIBRARY_DIR})
find_path(QUADRILLE_OMPL_INCLUDE_DIR ompl/base/PlannerData.h HINTS ${OMPL_INCLUDE_DIR} NO_DEFAULT_PATH)
# Headers of OMPL refer to it.
find_library(QUADRILLE_BOOST_SERIALIZATION boost_serialization)
mark_as_advanced(QUADRILLE_OMPL_LIBRARY QUADRILLE_OMPL_INCLUDE_DIR QUADRILLE_BOOST_SERIALIZATION)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(QuadrilleOmpl REQUIRED_VARS QUADRILLE_OMPL_LIBRARY
  QUADRILLE_OMPL_INCLUDE_DIR QUADRILLE_BOOST_SERIALIZATION Eigen3_FOUND)
if(QuadrilleOmpl_FOUND AND NOT TARGET QuadrilleOmpl::ompl)
  add_library(QuadrilleOmpl::ompl UNKNOWN IMPORTED)
  set_target_properties(QuadrilleOmpl::ompl PROPERTIES
    IMPORTED_LOCATION "${QUADRILLE_OMPL_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${QUADRILLE_OMPL_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${QUADRILLE_BOOST_SERIALIZATION};Eigen3::Eigen")
endif()
