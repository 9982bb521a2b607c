#!/bin/sh
# check.sh COMPILER: the header under this compiler, in every C and C++ standard, optimised and not,
# with the strict warnings as errors. And all tests and examples as the single files that they are,
# which make test compiles without the implementation.
compiler=$1
strict="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
out=build/check/$compiler
mkdir -p $out

. tests/lib/step.sh

build_and_run() {
    "$@" -o $out/program -lm && $out/program > $out/out
}

for level in -O0 -O3; do
    for standard in c99 c11; do
        flags="-std=$standard $level $strict -I."
        step $compiler $compiler $flags -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o $out/plain.o
        for program in tests/compile/c99.c tests/test_masks.c; do
            step $compiler build_and_run $compiler $flags -DSUBDIV_IMPLEMENTED $program $out/plain.o
        done
    done
    step $compiler build_and_run $compiler -std=gnu99 $level -march=native -I. tests/test_recorded.c
    for standard in c++11 c++17; do
        step $compiler build_and_run $compiler -x c++ -std=$standard $level $strict -I. \
            tests/compile/cpp11.cpp -lstdc++
    done
done

for program in tests/test_*.c examples/*.c examples/cli/*.c examples/demo/*.c examples/bench/*.c; do
    step "$program alone" $compiler -std=c99 -Wall -Wextra -Wpedantic -Werror -pthread -I. \
        -fsyntax-only $program
done

printf '%-24s %4d passed, %d failed\n' "$compiler" $passed $failed
[ $failed = 0 ]
