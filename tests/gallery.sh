#!/bin/sh
# gallery.sh NAMES...: the drawings of examples/README.md are what the programs draw, and all its
# pictures and programs are there.
out=build/gallery
text=examples/README.md

. tests/lib/step.sh

for name; do
    step "$name draws what the text shows" cmp $out/$name.svg examples/media/$name.svg
done
for file in $(grep -o '](\(media\|gallery\|[0-9]\)[^)]*)' $text | tr -d '()]'); do
    step "$text: $file" test -e examples/$file
done
for program in examples/gallery/*.c; do
    name=$(basename $program .c)
    [ $name = gallery ] || step "$text shows $name" grep -q "(media/$name\.\(svg\|png\))" $text
done

printf '%-24s %4d passed, %d failed\n' gallery $passed $failed
test $failed -eq 0
