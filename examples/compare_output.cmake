# SPDX-License-Identifier: MIT
# cmake -DPROGRAM=... -DARGUMENTS=... -DEXPECTED=file -P compare_output.cmake
# Runs an example and compares what it prints with a file.
execute_process(COMMAND "${PROGRAM}" ${ARGUMENTS}
  OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE status)
file(READ "${EXPECTED}" expected)
if(NOT status EQUAL 0 OR NOT output STREQUAL expected)
  message(FATAL_ERROR
    "exit status ${status}\n--- expected\n${expected}--- printed\n${output}--- errors\n${errors}")
endif()
