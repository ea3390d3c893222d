# SPDX-License-Identifier: MIT
# Writes the files of the page into a C++ source: cmake -DFILES=a|b|... -DOUTPUT=x.cpp -P embed.cmake
#
# The first file is the HTML, the second one the style sheet, the others are JavaScript modules. A
# page of one file has no modules to import from, so they become one script: `import` statements go,
# and `export` in front of a declaration goes. Names at the top of the modules are therefore different
# from each other, which the type checker's build of the one script would notice.
string(REPLACE "|" ";" files "${FILES}")
set(names html style)
list(LENGTH files count)
math(EXPR last "${count} - 1")

set(parts "")
set(index 0)
foreach(file IN LISTS files)
  file(READ "${file}" text)
  if(file MATCHES "\\.js$")
    string(REGEX REPLACE "(^|\n)import [^\"]*\"[^\"]*\";" "" text "${text}")
    string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  endif()
  # The licence's line stands once in the page, not in each part.
  string(REGEX REPLACE "^[^\n]*SPDX-License-Identifier: MIT[^\n]*\n" "" text "${text}")
  if(index EQUAL 2)
    string(APPEND parts "};\nconst std::string_view kScript[] = {\n")
  endif()
  if(index EQUAL 0)
    string(APPEND parts "const std::string_view kDocument = R\"page(${text})page\";\n")
  elseif(index EQUAL 1)
    string(APPEND parts "const std::string_view kStyle[] = {R\"page(${text})page\"")
  else()
    string(APPEND parts "R\"page(${text})page\",\n")
  endif()
  math(EXPR index "${index} + 1")
endforeach()

file(WRITE "${OUTPUT}.new" "// SPDX-License-Identifier: MIT
// Made by view/embed.cmake.
#include \"page_parts.hpp\"

namespace quadrille::view {
namespace {
${parts}};
}  // namespace

PageParts page_parts() { return {kDocument, kStyle[0], kScript}; }

}  // namespace quadrille::view
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
