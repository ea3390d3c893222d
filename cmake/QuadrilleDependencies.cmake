# SPDX-License-Identifier: MIT
# Everything from outside that the library is built on. Programs and tests find what only they need.

# quadrille_find_package(<package> <Debian package> [arguments of find_package...])
# A missing package explains itself.
macro(quadrille_find_package package debian)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR
      "quadrille needs ${package} (Debian package ${debian}), which was not found. "
      "Run scripts/setup, which installs what is missing, or install it and, when it is not in a "
      "usual place, name its prefix with -DCMAKE_PREFIX_PATH=<prefix>.")
  endif()
endmacro()

# A new major version may break its users, and what it no longer does right may still compile.
find_package(CaDiCaL 2.1.3...<3 REQUIRED)
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

if(CaDiCaL_NEEDS_GLIBC_SHIM AND NOT TARGET quadrille_glibc_shim)
  add_library(quadrille_glibc_shim STATIC cmake/glibc_shim.cpp)
  set_target_properties(quadrille_glibc_shim PROPERTIES
    EXPORT_NAME glibc_shim POSITION_INDEPENDENT_CODE ON)
  # After CaDiCaL's archive on every link line, its users' included.
  set_property(TARGET CaDiCaL::CaDiCaL APPEND PROPERTY
    INTERFACE_LINK_LIBRARIES quadrille_glibc_shim)
endif()

# For the readers and writers. Users of a static package link yaml-cpp: see quadrilleConfig.cmake.in.
quadrille_find_package(nlohmann_json nlohmann-json3-dev 3.11)
quadrille_find_package(yaml-cpp libyaml-cpp-dev 0.7)

# For geometry/. Users of a static package link FCL too; Boost is used for its headers alone.
quadrille_find_package(Eigen3 libeigen3-dev 3.3 NO_MODULE)
quadrille_find_package(ccd libccd-dev)
quadrille_find_package(fcl libfcl-dev 0.7)
quadrille_find_package(Boost libboost-dev 1.74)

# For the XML files of continuous/. Users of a static package link it.
quadrille_find_package(pugixml libpugixml-dev 1.10)
