# SPDX-License-Identifier: MIT
# Debian packages, by `cpack` in a build of the preset `package`: libquadrille<version> (the shared
# libraries), libquadrille-dev, quadrille (the program), python3-quadrille, and, where OMPL was found,
# libquadrille-ompl-dev. tests/package/check looks at them.

set(quadrille_maintainer "The Quadrille authors <maintainers@quadrille.example>")
set(name_library libquadrille${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(name_dev libquadrille-dev)
set(name_program quadrille)
set(name_python python3-quadrille)
set(name_ompl libquadrille-ompl-dev)
set(components library dev program)
if(TARGET quadrille_ompl)
  list(APPEND components ompl)
endif()
if(QUADRILLE_PYTHON)
  list(APPEND components python)
endif()

# Copyright and changelog, as Debian wants them beside every package.
set(packaging "${CMAKE_CURRENT_BINARY_DIR}/packaging")
file(READ LICENSE quadrille_licence)
set(cadical_licence "")
if(QUADRILLE_CADICAL_NOTICE)
  file(READ "${QUADRILLE_CADICAL_NOTICE}" cadical_licence)
endif()
file(WRITE "${packaging}/copyright"
  "Quadrille\n\n${quadrille_licence}\n"
  "CaDiCaL ${CaDiCaL_VERSION} is linked in. Its notice:\n\n${cadical_licence}")
# The day of the release stands in one place.
file(STRINGS CITATION.cff released REGEX "^date-released: ")
string(REGEX REPLACE "^date-released: " "" released "${released}")
execute_process(COMMAND date -R -u -d "${released}" OUTPUT_VARIABLE released
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(WRITE "${packaging}/changelog"
  "quadrille (${PROJECT_VERSION}) unstable; urgency=medium\n\n"
  "  * What has changed stands in CHANGELOG.md of the sources.\n\n"
  " -- ${quadrille_maintainer}  ${released}\n")
foreach(component IN LISTS components)
  # Not by `cmake --install`, which is asked for everything.
  install(FILES "${packaging}/copyright" "${packaging}/changelog"
    DESTINATION "share/doc/${name_${component}}" COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME quadrille)
set(CPACK_PACKAGE_VENDOR "The Quadrille authors")
set(CPACK_PACKAGE_CONTACT "${quadrille_maintainer}")
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
  GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/packaging/compress.cmake")
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SOURCE quadrille)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${quadrille_maintainer}")
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Dependencies on other packages are read from the binaries. The libraries of this build belong to no
# package yet: between components they are stated below.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
get_property(libraries GLOBAL PROPERTY QUADRILLE_LIBRARIES)
foreach(library IN LISTS libraries)
  get_target_property(folder ${library} BINARY_DIR)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${folder}")
endforeach()

set(about
  "Quadrille plans paths for many agents that move at the same time and must not
collide, on grids and for discs and polygons in continuous time, and proves
that no plan is cheaper.")
# quadrille_package(<component> <section> <what> <sentence>)
macro(quadrille_package component section what sentence)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION
    "exact multi-agent path finding - ${what}\n${about}\n\n${sentence}")
endmacro()
quadrille_package(library libs "shared libraries" "This package contains the shared libraries.")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY >=)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/packaging/triggers")
quadrille_package(dev libdevel "headers" "This package contains the headers, and files for CMake and
pkg-config.")
set(CPACK_COMPONENT_DEV_DEPENDS library)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
if(TARGET quadrille_ompl)
  quadrille_package(ompl libdevel "bridge to OMPL" "This package contains a static library and headers that take over roadmaps
from OMPL, and give it timed paths.")
  set(CPACK_COMPONENT_OMPL_DEPENDS dev)
  set(CPACK_DEBIAN_OMPL_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_OMPL_PACKAGE_DEPENDS "libompl-dev, libboost-serialization-dev, libeigen3-dev")
endif()
quadrille_package(program science "program" "This package contains the program quadrille.")
set(CPACK_COMPONENT_PROGRAM_DEPENDS library)
if(QUADRILLE_PYTHON)
  quadrille_package(python python "Python 3" "This package contains the Python package quadrille.")
  set(CPACK_COMPONENT_PYTHON_DEPENDS library)
  # The module is for this one version of Python.
  execute_process(
    COMMAND "${QUADRILLE_PYTHON_EXECUTABLE}" -c
      "from sys import version_info as v; print(f'python3 (>= {v[0]}.{v[1]}), python3 (<< {v[0]}.{v[1] + 1})')"
    OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${python}, python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-networkx, python3-pandas")
  # What Python compiles goes away with the package.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_LIST_DIR}/packaging/python/postinst"
    "${CMAKE_CURRENT_LIST_DIR}/packaging/python/prerm")
endif()
include(CPack)
