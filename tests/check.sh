#!/bin/sh
# make check: the header under every compiler and C and C++ standard that is installed, optimised and
# not, with the strict warnings as errors; then the tests under the address and undefined-behaviour
# sanitizers. The last line is "N passed, N failed".
mkdir -p build/check
passed=0
failed=0
strict="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"

step() {
    if "$@" > build/check/log 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $*"
        head -n 20 build/check/log
    fi
}

build_and_run() {
    "$@" -o build/check/program -lm && build/check/program > build/check/out
}

for compiler in gcc clang; do
    command -v $compiler > /dev/null || { echo "$compiler is not installed: skipped"; continue; }
    for level in -O0 -O3; do
        for standard in c99 c11; do
            step build_and_run $compiler -std=$standard $level $strict -I. tests/compile/c99.c
            step build_and_run $compiler -std=$standard $level $strict -I. tests/test_masks.c
        done
        step build_and_run $compiler -std=gnu99 $level -march=native -I. tests/test_recorded.c
        for standard in c++11 c++17; do
            step build_and_run $compiler -x c++ -std=$standard $level $strict -I. tests/compile/cpp11.cpp \
                -lstdc++
        done
    done
    sanitize="-g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all"
    for test in masks order invariants patches evaluate recorded obj errors memory; do
        step build_and_run $compiler -std=c99 $sanitize -pthread -I. tests/test_$test.c
    done
done

step sh tests/simd.sh

echo "$passed passed, $failed failed"
[ $failed = 0 ]
