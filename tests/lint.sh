#!/bin/sh
# Looks at the header and the examples with the analyzers that are installed: no finding, or a
# reason. Reasons of clang-tidy are in .clang-tidy and examples/.clang-tidy, all others here.
out=build/lint
mkdir -p $out
printf '#define SUBDIV_IMPLEMENTATION\n#include "subdiv.h"\n' > $out/subdiv.c

. tests/lib/step.sh

has() {
    command -v "$1" > $out/log && return
    echo "lint: $1 is not installed, what it checks is SKIPPED"
    return 1
}

# Recursion, apart from:
#     subdiv_surface_free    the values of a surface, and its surface of level 1: 3 deep
#     sdv_prepare            for the limit of level 0, that of level 1: 2 deep
#     sdv_set_cut            areas into quarters, down to SDV_CELL_LEVELS
#     sdv_compose            a point from those of the level before: as deep as there are levels
recursion() {
    clang-tidy --quiet --checks=-*,misc-no-recursion $out/subdiv.c -- -std=c99 -I. 2>&1 |
        sed -n "s/.*function '\(.*\)' is within a recursive.*/\1/p" | sort > $out/recursive
    printf '%s\n' sdv_compose sdv_prepare sdv_set_cut subdiv_surface_free |
        diff - $out/recursive
}

if has clang-tidy; then
    step clang-tidy clang-tidy --quiet $out/subdiv.c -- -std=c99 -I.
    step "clang-tidy: examples" clang-tidy --quiet examples/*.c examples/cli/*.c -- -std=c99 -I. \
        -DSUBDIV_IMPLEMENTED
    step recursion recursion
fi

# Left out:
#     duplicateCondition     two statements under one condition read better on a line each
#     variableScope          what belongs together is declared together
#     constVariable          an array that only its callee takes for constant
#     uninitvar, legacyUninitvar, ctuuninitvar, unreadVariable     it does not see that an array is
#                            written by way of another pointer; the analyzers of clang and gcc do
#     toomanyconfigs, missingIncludeSystem     not about the code
if has cppcheck; then
    without="duplicateCondition variableScope constVariable uninitvar legacyUninitvar ctuuninitvar
             unreadVariable toomanyconfigs missingIncludeSystem"
    step cppcheck cppcheck --quiet --error-exitcode=1 --std=c99 -I. \
        --enable=warning,style,performance,portability $(printf -- '--suppress=%s ' $without) \
        -D__GNUC__ -D__SSE2__ $out/subdiv.c
fi

# With less to remember of each place than by default, which takes minutes and finds no more.
if has gcc; then
    step -fanalyzer gcc -std=c99 -O1 -fanalyzer -Werror -I. -c $out/subdiv.c -o $out/subdiv.o \
        --param analyzer-max-enodes-per-program-point=1 --param analyzer-bb-explosion-factor=1
fi

printf '%-24s %4d passed, %d failed\n' lint $passed $failed
[ $failed = 0 ]
