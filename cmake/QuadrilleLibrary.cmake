# SPDX-License-Identifier: MIT
include(GNUInstallDirs)

# One library target per folder: quadrille_<folder>, alias quadrille::<folder>.

# What every target of this project is compiled with; nothing of it reaches users of the library.
function(quadrille_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 warns about its own std::string (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(QUADRILLE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# quadrille_precompile(<target> <header>...): two thirds of the time of a compilation are spent on
# reading headers; these, and those that everything includes, are read once for the target.
# Each file names what it uses all the same: builds without the option see to that.
function(quadrille_precompile target)
  if(QUADRILLE_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE <algorithm> <cstdint> <functional> <memory>
      <optional> <span> <string> <utility> <vector> ${ARGN})
  endif()
endfunction()

# quadrille_add_library(<folder> [OPTIONAL] HEADERS ... [INTERNAL_HEADERS ...] SOURCES ...
#   [LINK folder...] [PUBLIC_LINK target...] [PRIVATE_LINK target...])
# Headers are relative to include/quadrille/<folder>, sources to src. INTERNAL_HEADERS are for the
# other folders of this project, and not installed. LINK names folders of this
# project, PRIVATE_LINK libraries from outside; one that consists of headers only has no business
# with users of an installed package: name it as $<BUILD_INTERFACE:target>. PUBLIC_LINK are those
# that public headers name. An OPTIONAL library is no part of quadrille::quadrille, a component of the
# package and of what is installed, and static always: it is small, and has no ABI to keep.
function(quadrille_add_library folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OPTIONAL" ""
    "HEADERS;INTERNAL_HEADERS;SOURCES;LINK;PUBLIC_LINK;PRIVATE_LINK")
  set(target quadrille_${folder})
  list(TRANSFORM arg_SOURCES PREPEND "src/")
  list(TRANSFORM arg_LINK PREPEND "quadrille_")
  set(kind)
  set(component dev)
  if(arg_OPTIONAL)
    set(kind STATIC)
    set(component ${folder})
  endif()
  add_library(${target} ${kind} ${arg_SOURCES})
  add_library(quadrille::${folder} ALIAS ${target})
  target_include_directories(${target}
    PUBLIC "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>"
      "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
    # Private headers are named with their room: "cost/relaxation.hpp".
    PRIVATE src)
  target_link_libraries(${target} PUBLIC ${arg_LINK} ${arg_PUBLIC_LINK}
    PRIVATE ${arg_PRIVATE_LINK})
  quadrille_compile_options(${target})
  quadrille_precompile(${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${folder}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    # Static libraries too: they end up in Python modules and in users' shared libraries.
    POSITION_INDEPENDENT_CODE ON
    # Nothing depends on <target>_EXPORTS; without it, static and shared objects are the same.
    DEFINE_SYMBOL ""
    # Public headers say what is visible; see quadrille/core/export.hpp.
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    INSTALL_RPATH "$ORIGIN")
  if(BUILD_SHARED_LIBS AND NOT APPLE AND NOT WIN32)
    # CaDiCaL's archive was compiled for all to see.
    target_link_options(${target} PRIVATE "LINKER:--exclude-libs,ALL")
  endif()
  # One that is not listed would be missing in the package.
  file(GLOB headers RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}/include/quadrille/${folder}"
    "include/quadrille/${folder}/*.hpp")
  list(REMOVE_ITEM headers ${arg_HEADERS} ${arg_INTERNAL_HEADERS})
  if(headers)
    message(FATAL_ERROR "${folder}: public headers that are not listed: ${headers}")
  endif()
  foreach(header IN LISTS arg_HEADERS arg_INTERNAL_HEADERS)
    if(header MATCHES "[.]hpp$")  # Tables that a header includes do not compile on their own.
      set_property(GLOBAL APPEND PROPERTY QUADRILLE_HEADERS "quadrille/${folder}/${header}")
    endif()
    if(QUADRILLE_INSTALL AND NOT header IN_LIST arg_INTERNAL_HEADERS)
      install(FILES "include/quadrille/${folder}/${header}"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/quadrille/${folder}" COMPONENT ${component})
    endif()
  endforeach()
  if(arg_OPTIONAL)
    set_property(GLOBAL APPEND PROPERTY QUADRILLE_OPTIONAL_LIBRARIES ${target})
  else()
    set_property(GLOBAL APPEND PROPERTY QUADRILLE_LIBRARIES ${target})
  endif()
endfunction()

# The target quadrille_headers, which is built on demand: each public header compiles on its own, as
# in the build of a user who takes warnings for errors.
function(quadrille_check_headers)
  get_property(headers GLOBAL PROPERTY QUADRILLE_HEADERS)
  get_property(libraries GLOBAL PROPERTY QUADRILLE_LIBRARIES)
  get_property(optional GLOBAL PROPERTY QUADRILLE_OPTIONAL_LIBRARIES)
  set(sources)
  foreach(header IN LISTS headers)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/headers/${header}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include <${header}>\n#include <${header}>\n" @ONLY)
    list(APPEND sources "${source}")
  endforeach()
  add_library(quadrille_headers OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(quadrille_headers PRIVATE ${libraries} ${optional})
  target_compile_features(quadrille_headers PRIVATE cxx_std_20)
  target_compile_options(quadrille_headers PRIVATE -O2 -Wall -Wextra -Werror)
endfunction()
