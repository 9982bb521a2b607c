#!/bin/sh
# Runs the test programs given, then the scripts, then the comparison with OpenSubdiv where it is
# installed, and adds up their last lines, "name  N passed, N failed". Called by make test.
log=build/test.log
: > $log

run() {
    "$@" > build/test.out 2>&1
    status=$?
    cat build/test.out
    cat build/test.out >> $log
    # A program that crashed or said nothing counts as one failure.
    if ! tail -n 1 build/test.out | grep -q '[0-9]* passed, [0-9]* failed'; then
        echo "$1: ended with status $status before its last line     0 passed, 1 failed" | tee -a $log
    fi
}

for test in "$@"; do run $test; done
run sh tests/compile.sh
run sh tests/docs.sh
run sh tests/test_cli.sh

echo '#include <opensubdiv/far/primvarRefiner.h>' > build/osd.cpp
if ${CXX:-c++} -fsyntax-only build/osd.cpp 2> build/osd.log; then
    if ${MAKE:-make} -s build/opensubdiv; then
        run build/opensubdiv --continuity --random "${CAGES:-1000}" tests/oracle/*.obj examples/cages/*.obj
    else
        echo "opensubdiv: does not build     0 passed, 1 failed" | tee -a $log
    fi
else
    echo "The comparison with OpenSubdiv was SKIPPED: it needs a C++ compiler and libosd-dev."
fi

awk '/[0-9]+ passed, [0-9]+ failed/ {
         for (i = 1; i < NF; i++) {
             if ($(i + 1) ~ /^passed/) passed += $i
             if ($(i + 1) ~ /^failed/) failed += $i
         }
     }
     END { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 || passed == 0 }' $log
