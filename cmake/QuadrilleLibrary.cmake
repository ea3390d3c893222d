# SPDX-License-Identifier: MIT
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

# quadrille_add_library(<folder> HEADERS ... SOURCES ... [LINK folder...] [PRIVATE_LINK target...])
# Headers are relative to include/quadrille/<folder>, sources to src. LINK names folders of this
# project, PRIVATE_LINK libraries from outside; one that consists of headers only has no business
# with users of an installed package: name it as $<BUILD_INTERFACE:target>.
function(quadrille_add_library folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;SOURCES;LINK;PRIVATE_LINK")
  set(target quadrille_${folder})
  list(TRANSFORM arg_HEADERS PREPEND "include/quadrille/${folder}/")
  list(TRANSFORM arg_SOURCES PREPEND "src/")
  list(TRANSFORM arg_LINK PREPEND "quadrille_")
  add_library(${target} ${arg_SOURCES})
  add_library(quadrille::${folder} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${arg_HEADERS})
  # Private headers are named with their room: "cost/descent.hpp".
  target_include_directories(${target} PRIVATE src)
  target_link_libraries(${target} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK})
  quadrille_compile_options(${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${folder}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    # Static libraries too: they end up in Python modules and in users' shared libraries.
    POSITION_INDEPENDENT_CODE ON
    # Nothing depends on <target>_EXPORTS; without it, static and shared objects are the same.
    DEFINE_SYMBOL ""
    INSTALL_RPATH "$ORIGIN"
    VERIFY_INTERFACE_HEADER_SETS ${PROJECT_IS_TOP_LEVEL})
  set_property(GLOBAL APPEND PROPERTY QUADRILLE_LIBRARIES ${target})
endfunction()
