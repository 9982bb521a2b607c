#!/bin/sh
# fuzz.sh PROGRAM SECONDS SEEDS...: runs a fuzzer from folders of seeds and what earlier runs found,
# which stands in PROGRAM.found. An input that fails is kept beside it: PROGRAM INPUT runs it again.
# A first run makes the same inputs each time; under SEED=0 it makes others.
program=$1
seconds=$2
shift 2
mkdir -p "$program.found"
"$program" -seed="${SEED:-1}" -max_total_time="$seconds" -entropic=0 \
    -max_len=2000 -timeout=20 -artifact_prefix="$program." "$program.found" "$@" > "$program.out" 2>&1
status=$?
name=fuzz_${program##*/}
if [ $status = 0 ]; then
    inputs=$(sed -n 's/^Done \([0-9]*\) runs.*/\1/p' "$program.out")
    echo "$name, $inputs inputs  1 passed, 0 failed"
else
    grep -v "^#[0-9]\|NEW_FUNC" "$program.out" | tail -n 40
    echo "$name  0 passed, 1 failed"
fi
exit $status
