#!/bin/sh
# The thread sanitizer over every public call with threads, and over the thread example. CC names
# the compiler.
CC=${CC:-cc}
out=build/check/threads
flags="-std=c99 -g -O1 -fsanitize=thread -pthread -I."
mkdir -p $out

. tests/lib/step.sh

echo 'int main(void) { return 0; }' > $out/empty.c
if $CC $flags $out/empty.c -o $out/empty > $out/log 2>&1 && $out/empty; then
    # Small cages take several jobs, too.
    step "the header compiles" $CC $flags -DSDV_JOB_POINTS=16 -DSUBDIV_IMPLEMENTATION -x c \
        -c subdiv.h -o $out/subdiv.o
    for program in tests/test_threads examples/07_threads; do
        step "$program compiles" $CC $flags -DSUBDIV_IMPLEMENTED $program.c $out/subdiv.o \
            -o $out/program -lm
        step "$program" $out/program
    done
else
    echo "threads: $CC has no -fsanitize=thread here, SKIPPED"
fi

printf '%-24s %4d passed, %d failed\n' threads $passed $failed
[ $failed = 0 ]
