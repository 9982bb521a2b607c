#!/bin/sh
# How long subdiv.h takes to compile with -O2, beside stb_image.h of libstb-dev: the program of
# QUICK START in the opening comment, and the whole API. Processor time, the best of RUNS runs in
# turn, and the KB of code and constants.
#
#     RUNS=3 sh examples/bench/compile.sh         in the folder of subdiv.h
runs=${RUNS:-3}
out=build/bench_compile
mkdir -p $out

. tests/lib/section.sh

# seconds COMMAND: user and system time.
seconds() {
    (
        "$@" || exit 1
        times
    ) | awk '
        NR == 2 {
            gsub("s", "")
            for (i = 1; i < 3; i++) { split($i, t, "m"); sum += 60 * t[1] + t[2] }
        }
        END { if (NR < 2) exit 1; printf "%.3f\n", sum }'
}

section "QUICK START" > $out/quick_start.c
printf '#define SUBDIV_IMPLEMENTATION\n#include "subdiv.h"\n' > $out/whole_api.c
printf '#define STB_IMAGE_IMPLEMENTATION\n#include <stb/stb_image.h>\n' > $out/stb_image.c

for compiler in gcc clang; do
    command -v $compiler > /dev/null || continue
    programs="stb_image quick_start whole_api"
    $compiler -fsyntax-only $out/stb_image.c 2> /dev/null || programs="quick_start whole_api"
    rm -f $out/*.times
    run=0
    while [ $run -lt "$runs" ]; do
        for program in $programs; do
            seconds $compiler -O2 -I. -c $out/$program.c -o $out/$program.o >> $out/$program.times
        done
        run=$((run + 1))
    done
    echo
    echo "compiled by $compiler $($compiler -dumpversion) -O2    seconds   beside stb_image.h    KB"
    for program in $programs; do
        echo "$program $(sort -n $out/$program.times | head -n 1)" \
             "$(size $out/$program.o | awk 'NR == 2 { print $1 }')"
    done | awk '
        BEGIN {
            name["stb_image"] = "stb_image.h"
            name["quick_start"] = "the program of QUICK START"
            name["whole_api"] = "the whole API"
        }
        $1 == "stb_image" { stb = $2 }
        {
            ratio = stb ? sprintf("%.2fx", $2 / stb) : "-"
            printf "%-34s%8.2f%20s%9.0f\n", name[$1], $2, ratio, $3 / 1024
        }'
done
[ -f $out/stb_image.times ] || echo "(libstb-dev is not installed: nothing to compare with)"
