#!/bin/sh
# examples.sh PROGRAMS...: runs the numbered examples and compares what they print with what the
# first comment of each shows, behind the line that builds it. It may show some of the lines only.
out=build/examples
mkdir -p $out

. tests/lib/step.sh

# Numbers agree to three digits or, if they are small, to 1e-6; those before "ms" are times. A word
# that ends in "..." stands for all that begin so.
cat > $out/compare.awk <<'END'
function agree(shown, printed, next_word) {
    sub(/^[(]+/, "", shown)
    sub(/^[(]+/, "", printed)
    if (shown ~ /\.\.\.$/) return index(printed, substr(shown, 1, length(shown) - 3)) == 1
    if (shown !~ /^-?[0-9]/ || printed !~ /^-?[0-9]/) return shown == printed
    difference = shown - printed
    size = shown < 0 ? -shown : shown + 0
    return difference * difference <= (1e-6 + 1e-3 * size) ^ 2 || next_word ~ /^ms/
}
function same_line(shown, printed,    a, b, count, i) {
    count = split(shown, a, " ")
    if (split(printed, b, " ") != count) return 0
    for (i = 1; i <= count; i++) if (!agree(a[i], b[i], a[i + 1])) return 0
    return 1
}
FNR == 1 { file++ }
!/^\/\// { inside = 0 }
file == 1 && inside && /^\/\/     / { expected[++lines] = substr($0, 8) }
/^\/\/     cc / { inside = 1 }
file == 2 && found < lines && same_line(expected[found + 1], $0) { found++ }
END {
    if (found < lines) print "not printed: " expected[found + 1]
    exit found < lines || lines == 0
}
END

for program; do
    name=$(basename "$program")
    if [ "$name" = 01_hello ]; then
        step "$name runs" "$program" examples/cages/octopus.obj $out/fine.obj
        step "$name prints nothing" test ! -s $out/log
        step "$name writes its mesh" grep -q '^f ' $out/fine.obj
        continue
    fi
    step "$name runs" "$program"
    cp $out/log $out/$name.txt
    step "$name prints what it shows" awk -f $out/compare.awk examples/$name.c $out/$name.txt
done

printf '%-24s %4d passed, %d failed\n' examples "$passed" "$failed"
test "$failed" -eq 0
