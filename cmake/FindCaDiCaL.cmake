# SPDX-License-Identifier: MIT
# Finds the SAT solver CaDiCaL and defines the target CaDiCaL::CaDiCaL.
#
# Searched: CADICAL_ROOT (variable, or environment variable) and nothing else when it is set;
# otherwise .deps/cadical beside this folder, where scripts/setup puts it; otherwise the system.
# CADICAL_ROOT may be an install prefix or a built source tree.
#
# Result: CaDiCaL_FOUND, CaDiCaL_VERSION, CaDiCaL_LIBRARY, CaDiCaL_INCLUDE_DIR, and
# CaDiCaL_NEEDS_GLIBC_SHIM (see glibc_shim.cpp).

include(FindPackageHandleStandardArgs)

# The search results are cached, and so is a wrong one: forget them when the place changes.
set(_cadical_root "${CADICAL_ROOT}")
if(NOT _cadical_root)
  set(_cadical_root "$ENV{CADICAL_ROOT}")
endif()
if(NOT "${_cadical_root}" STREQUAL "${_CaDiCaL_SEARCHED_ROOT}")
  unset(CaDiCaL_INCLUDE_DIR CACHE)
  unset(CaDiCaL_LIBRARY CACHE)
endif()
set(_CaDiCaL_SEARCHED_ROOT "${_cadical_root}" CACHE INTERNAL "")

cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH _cadical_source)
if(_cadical_root)
  set(_cadical_places HINTS "${_cadical_root}" NO_DEFAULT_PATH)
else()
  set(_cadical_places HINTS "${_cadical_source}/.deps/cadical/usr")
endif()
# include/cadical first: Debian has a link include/cadical.hpp too, but tracer.hpp only there.
find_path(CaDiCaL_INCLUDE_DIR cadical.hpp ${_cadical_places}
  PATH_SUFFIXES include/cadical include cadical src)
find_library(CaDiCaL_LIBRARY cadical ${_cadical_places}
  PATH_SUFFIXES "lib/${CMAKE_LIBRARY_ARCHITECTURE}" lib lib64 build)
mark_as_advanced(CaDiCaL_INCLUDE_DIR CaDiCaL_LIBRARY)

set(_cadical_advice
  "quadrille needs CaDiCaL >= 2.1.3 and < 3, of which 2.1.3 and 2.2.0 were tried (Debian 12 ships 1.5.3). Run \
scripts/setup, which gets Debian's newer package without touching the system, \
or build CaDiCaL yourself and pass -DCADICAL_ROOT=<prefix or source tree>.")

# The header carries no version. The library does, as the text behind CaDiCaL::signature().
set(CaDiCaL_VERSION "")
if(CaDiCaL_LIBRARY AND EXISTS "${CaDiCaL_LIBRARY}")
  file(STRINGS "${CaDiCaL_LIBRARY}" _cadical_signature REGEX "^cadical-[0-9]+\\.[0-9]" LIMIT_COUNT 1)
  if(_cadical_signature MATCHES "^cadical-([0-9]+(\\.[0-9]+)*)")
    set(CaDiCaL_VERSION "${CMAKE_MATCH_1}")
  endif()
endif()

# Compiles cadical_check.cpp, which uses all that this project does, and links it when LINK is given.
function(_cadical_try result)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LINK" "" "EXTRA")
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  set(libraries)
  if(arg_LINK)
    set(CMAKE_TRY_COMPILE_TARGET_TYPE EXECUTABLE)
    set(libraries LINK_LIBRARIES "${CaDiCaL_LIBRARY}")
  endif()
  set(dir "${CMAKE_CURRENT_BINARY_DIR}${CMAKE_FILES_DIRECTORY}/cadical_check")
  # Where this file is installed, all three are in one folder.
  set(includes "${CaDiCaL_INCLUDE_DIR};${CMAKE_CURRENT_FUNCTION_LIST_DIR};${_cadical_source}/sat/src/engine")
  try_compile(compiled "${dir}" SOURCES "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/cadical_check.cpp" ${arg_EXTRA}
    CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${includes}"
    ${libraries} CXX_STANDARD 20 OUTPUT_VARIABLE output)
  set(${result} ${compiled} PARENT_SCOPE)
  set(_cadical_output "${output}" PARENT_SCOPE)
endfunction()

# The first errors of a compiler, without the paths of the check.
function(_cadical_errors result output)
  string(REPLACE ";" "," output "${output}")
  string(REGEX MATCHALL "(error|undefined reference)[^\n]*" errors "${output}")
  list(REMOVE_DUPLICATES errors)
  list(SUBLIST errors 0 4 errors)
  list(JOIN errors "\n  " text)
  if(NOT text)
    set(text "${output}")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Checked once per library and header; a library that was replaced is checked again.
set(_cadical_problem "")
set(CaDiCaL_API_OK FALSE)
if(CaDiCaL_LIBRARY AND CaDiCaL_INCLUDE_DIR)
  file(TIMESTAMP "${CaDiCaL_LIBRARY}" _cadical_time)
  set(_cadical_key "${CaDiCaL_LIBRARY};${CaDiCaL_INCLUDE_DIR};${_cadical_time};${CMAKE_CXX_FLAGS}")
  if(NOT "${_cadical_key}" STREQUAL "${_CaDiCaL_CHECKED}")
    set(_cadical_shim FALSE)
    _cadical_try(_cadical_ok)
    if(NOT _cadical_ok)
      _cadical_errors(_cadical_errors "${_cadical_output}")
      set(_cadical_problem "its header lacks what is needed:\n  ${_cadical_errors}")
    else()
      _cadical_try(_cadical_ok LINK)
      if(NOT _cadical_ok AND _cadical_output MATCHES "__isoc23_")
        set(_cadical_shim TRUE)
        _cadical_try(_cadical_ok LINK EXTRA "${CMAKE_CURRENT_LIST_DIR}/glibc_shim.cpp")
      endif()
      if(NOT _cadical_ok)
        _cadical_errors(_cadical_errors "${_cadical_output}")
        set(_cadical_problem "a program cannot be linked with it:\n  ${_cadical_errors}")
      endif()
    endif()
    if(_cadical_ok)
      set(_CaDiCaL_CHECKED "${_cadical_key}" CACHE INTERNAL "")
      set(_CaDiCaL_SHIM ${_cadical_shim} CACHE INTERNAL "")
    endif()
  endif()
  if(NOT _cadical_problem)
    set(CaDiCaL_API_OK TRUE)
    set(CaDiCaL_NEEDS_GLIBC_SHIM ${_CaDiCaL_SHIM})
  endif()
endif()

set(_cadical_name "CaDiCaL ${CaDiCaL_VERSION} (${CaDiCaL_LIBRARY})")
if(NOT CaDiCaL_VERSION)
  set(_cadical_name "a CaDiCaL of unknown version (${CaDiCaL_LIBRARY})")
endif()
if(NOT CaDiCaL_LIBRARY OR NOT CaDiCaL_INCLUDE_DIR)
  set(_cadical_missing "its library")
  if(NOT CaDiCaL_INCLUDE_DIR AND CaDiCaL_LIBRARY)
    set(_cadical_missing "the header that belongs to ${CaDiCaL_LIBRARY}")
  elseif(NOT CaDiCaL_INCLUDE_DIR)
    set(_cadical_missing "library and header")
  endif()
  set(_cadical_problem "CaDiCaL was not found (missing: ${_cadical_missing}).")
  if(_cadical_root)
    string(PREPEND _cadical_problem "CADICAL_ROOT is ${_cadical_root}: ")
  endif()
elseif(CaDiCaL_VERSION AND CaDiCaL_FIND_VERSION_MIN AND CaDiCaL_VERSION VERSION_LESS CaDiCaL_FIND_VERSION_MIN)
  set(_cadical_problem "Found ${_cadical_name}, which is too old.")
elseif(CaDiCaL_VERSION AND CaDiCaL_FIND_VERSION_MAX
       AND NOT CaDiCaL_VERSION VERSION_LESS CaDiCaL_FIND_VERSION_MAX)
  set(_cadical_problem "Found ${_cadical_name}, which is too new.")
elseif(_cadical_problem)
  set(_cadical_problem "Found ${_cadical_name}, but ${_cadical_problem}")
endif()

# An unknown version is judged by the interface alone.
set(_cadical_version_var)
if(CaDiCaL_VERSION)
  set(_cadical_version_var VERSION_VAR CaDiCaL_VERSION)
endif()
find_package_handle_standard_args(CaDiCaL
  REQUIRED_VARS CaDiCaL_LIBRARY CaDiCaL_INCLUDE_DIR CaDiCaL_API_OK HANDLE_VERSION_RANGE
  ${_cadical_version_var}
  REASON_FAILURE_MESSAGE "${_cadical_problem}\n${_cadical_advice}\n")

if(CaDiCaL_FOUND AND NOT TARGET CaDiCaL::CaDiCaL)
  add_library(CaDiCaL::CaDiCaL UNKNOWN IMPORTED)
  set_target_properties(CaDiCaL::CaDiCaL PROPERTIES
    IMPORTED_LOCATION "${CaDiCaL_LIBRARY}"
    IMPORTED_LINK_INTERFACE_LANGUAGES CXX
    INTERFACE_INCLUDE_DIRECTORIES "${CaDiCaL_INCLUDE_DIR}")
endif()
