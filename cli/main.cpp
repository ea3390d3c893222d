// SPDX-License-Identifier: MIT
#include "frame/program.hpp"

int main(int argc, char** argv) { return quadrille::cli::run_program(argc, argv); }
