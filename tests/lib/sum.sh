#!/bin/sh
# sum.sh LOGS...: adds up the lines "name  N passed, N failed" of all logs, and fails with them.
cat "$@" | awk '
    /[0-9] passed, [0-9]+ failed$/ { passed += $(NF - 3); failed += $(NF - 1) }
    END { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 || passed == 0 }'
