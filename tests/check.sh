#!/bin/sh
# make check: the header under every compiler and C and C++ standard that is installed, optimised and
# not, with the strict warnings as errors; then the tests under the address and undefined-behaviour
# sanitizers, half of them with each compiler. The last line is "N passed, N failed".
out=build/check
strict="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
installed=

. tests/step.sh

build_and_run() {
    "$@" -o $out/program -lm && $out/program > $out/out
}

check_with() {
    compiler=$1
    out=$out/$compiler
    mkdir -p $out
    for level in -O0 -O3; do
        for standard in c99 c11; do
            step $compiler build_and_run $compiler -std=$standard $level $strict -I. tests/compile/c99.c
            step $compiler build_and_run $compiler -std=$standard $level $strict -I. tests/test_masks.c
        done
        step $compiler build_and_run $compiler -std=gnu99 $level -march=native -I. tests/test_recorded.c
        for standard in c++11 c++17; do
            step $compiler build_and_run $compiler -x c++ -std=$standard $level $strict -I. tests/compile/cpp11.cpp \
                -lstdc++
        done
    done
    sanitize="-g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all"
    for test in $2; do
        step $compiler build_and_run $compiler -std=c99 $sanitize -pthread -I. tests/test_$test.c
    done
    echo "$passed passed, $failed failed" > $out/counts
}

rm -rf $out
mkdir -p $out
half="masks order invariants patches recorded creases check obj"
rest="evaluate limit exact stencils errors uv partial_uvs tessellate memory"
for compiler in gcc clang; do
    command -v $compiler > /dev/null && installed="$installed $compiler"
done
for compiler in $installed; do
    [ "$installed" = " gcc clang" ] || half="$half $rest"
    check_with $compiler "$half" &
    half=$rest
done
wait

step simd sh tests/simd.sh
cat $out/*/counts | awk -v passed=$passed -v failed=$failed '
    { passed += $1; failed += $3 }
    END { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 }'
