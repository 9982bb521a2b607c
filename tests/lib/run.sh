#!/bin/sh
# run.sh LOG COMMAND...: runs a test with its output in a log, and then shows that. The last line is
# "name  N passed, N failed"; a program that crashed or said no such thing gets one, with a failure.
log=$1
shift
mkdir -p "${log%/*}"
# glibc fills what malloc returns, so that nobody counts on zeros.
MALLOC_PERTURB_=165 "$@" > "$log" 2>&1
status=$?
last=$(tail -n 1 "$log" | grep '[0-9] passed, [0-9]* failed$')
case "$status $last" in
"0 "?*) ;;                            # all is well
*" 0 failed" | *" ") echo "${log##*/}: ended with status $status  0 passed, 1 failed" >> "$log" ;;
esac
cat "$log"
