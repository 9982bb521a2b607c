#!/bin/sh
# coverage.sh DIRECTORY: what the tests in DIRECTORY ran of subdiv.h, which gcc compiled with
# --coverage. Adds plain mode and the command line.
out=$1
compile="gcc -std=c99 -O0 --coverage -Dalways_inline=unused -ffp-contract=off -I. -Itests"

# Its test fails here, as no mask says that it is called; but all of it runs.
$compile "-DSUBDIV_ASSERT(c)=" -Wno-unused -c tests/plain/plain.c -o "$out/in_plain.o" &&
$compile -DSUBDIV_IMPLEMENTED tests/plain/compare.c "$out/in_plain.o" "$out/plain.o" \
    -o "$out/compare" -lm || exit 1
"$out/compare" > "$out/compare.log"
sh tests/test_cli.sh "$out/subdiv" || exit 1

for notes in "$out"/plain.gcno "$out"/test_*.gcno "$out"/in_plain.gcno; do
    gcov -b -c -t "$notes" 2> "$out/gcov.log"
done | awk -f tests/coverage/report.awk tests/coverage/unreachable.txt -
