# For the scripts of tests, which set out to a folder below build: step NAME COMMAND runs the
# command and counts it in passed or failed; of a failure it shows the command and what it printed.
passed=0
failed=0

step() {
    step_name=$1
    shift
    if "$@" > $out/log 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED  $step_name: $*"
        head -n 20 $out/log
    fi
}
