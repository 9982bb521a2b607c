#!/bin/sh
# Changes one mask of the header at a time and compiles tests/edited/edited.c with it: all that is
# true of the masks must be true of others, and every point that a mask is for must move.
CC=${CC:-cc}
out=build/edited
mkdir -p $out

. tests/lib/step.sh

# edit NAME FUNCTION WEIGHTS CAGES FORMULA: the function's mask becomes WEIGHTS, the points of CAGES
# move, and FORMULA explains none of them.
edit() {
    name=$1
    mkdir -p $out/$name
    awk -v mask="$2" -v weights="$3" '
        index($0, "static sdv_mask " mask "(") { inside = 1 }
        inside && /sdv_mask mask = / { sub(/\{.*\}/, "{ " weights " }"); changed = 1 }
        /^}/ { inside = 0 }
        { print }
        END { exit !changed }' subdiv.h > $out/$name/subdiv.h || echo "no mask in $2"
    step "$name compiles" $CC -std=c99 -O0 -DSUBDIV_NO_OBJ "-DNEVER=\"$5\"" -I$out/$name -Itests \
        tests/edited/edited.c -o $out/$name/edited -lm
    step "$name holds" $out/$name/edited $out/$name/points
    for cage in $4; do
        step "$name moves $cage" $out/$name/edited $out/plain/points $out/$name/points $cage
    done
}

edit plain  sdv_catmull_clark_vertex '(n - 2.0) / n, w, w, 0' '' ''
edit vertex sdv_catmull_clark_vertex '1 - n * 1.6 * w, 0.9 * w, 0.7 * w, 0' smooth '(n-2)/n'
edit edge   sdv_catmull_clark_edge   '0.3, 0, 0.4 / faces, 0' smooth '(a + b + f + g) / 4'
edit crease sdv_crease_vertex        '0.5, 0, 0, 0.25' 'crease loop_crease' 'cubic B-spline'
edit smooth_triangle sdv_smooth_triangle_edge '0.45 - face, 0, face + 0.05, 0' triangles ''
edit loop_edge   sdv_loop_edge       '0.4, 0, 0.2 / faces, 0' loop '(3 a + 3 b + c + d) / 8'
edit loop_vertex sdv_loop_vertex     '1 - n * 0.8 * b, 0.8 * b, 0, 0' loop '(5/8 - '

printf '%-24s %4d passed, %d failed\n' edited "$passed" "$failed"
test "$failed" -eq 0
