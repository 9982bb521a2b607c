#!/bin/sh
# plain.sh OBJECT: SUBDIV_PLAIN beside the library as it is, of which OBJECT is compiled. In plain
# mode's header each function of >>masks says that it is called.
CC=${CC:-cc}
out=build/plain
mkdir -p $out

. tests/lib/step.sh

awk '
    /^\/\/ -+ >>/ { inside = />>masks/ }
    { print }
    inside && /^static (sdv_mask|double) / { at = 1 }
    at && /^{/ { print "    called(__func__);"; at = 0; count++ }
    END { exit count < 10 }' subdiv.h > $out/subdiv.h || echo "few masks in subdiv.h"
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
step "plain mode compiles" $CC -std=c99 -O1 $warn -ffp-contract=off -I$out -c tests/plain/plain.c \
    -o $out/plain.o
step "its test compiles" $CC -std=c99 -O1 -DSUBDIV_IMPLEMENTED -I. -Itests tests/plain/compare.c \
    $out/plain.o "$1" -o $out/compare -lm
step "plain mode is the same" $out/compare

printf '%-24s %4d passed, %d failed\n' plain "$passed" "$failed"
test "$failed" -eq 0
