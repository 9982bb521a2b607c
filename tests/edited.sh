#!/bin/sh
# Changes one mask of the header at a time and runs tests/edited/edited.c with it: all that is true
# of the masks must be true of others, and every point that a mask is for must move. The program is
# compiled once, with all edits: it is told which one counts.
CC=${CC:-cc}
out=build/edited
mkdir -p $out

. tests/lib/step.sh

# NAME FUNCTION WEIGHTS: the function's mask becomes WEIGHTS. In the later half one number is
# changed alone, so that they do not sum to 1.
cat > $out/edits <<'END'
vertex sdv_catmull_clark_vertex 1 - n * 1.6 * w, 0.9 * w, 0.7 * w, 0
edge sdv_catmull_clark_edge 0.3, 0, 0.4 / faces, 0
crease sdv_crease_vertex 0.5, 0, 0, 0.25
smooth_triangle sdv_smooth_triangle_edge 0.45 - face, 0, face + 0.05, 0
loop_edge sdv_loop_edge 0.4, 0, 0.2 / faces, 0
loop_vertex sdv_loop_vertex 1 - n * 0.8 * b, 0.8 * b, 0, 0
vertex_number sdv_catmull_clark_vertex (n - 2.0) / n, w, 1.2 * w, 0
edge_number sdv_catmull_clark_edge 0.3, 0, 0.5 / faces, 0
crease_number sdv_crease_vertex 0.7, 0, 0, 0.125
smooth_triangle_number sdv_smooth_triangle_edge 0.6 - face, 0, face, 0
loop_edge_number sdv_loop_edge 0.375, 0, 0.2 / faces, 0
loop_vertex_number sdv_loop_vertex 0.9 - n * b, b, 0, 0
chaikin sdv_chaikin_point 0.7, 0.3, 0, 0
chaikin_number sdv_chaikin_point 0.6, 0.25, 0, 0
END

awk '
    FNR == NR {
        name = $1; mask = $2; sub(/^[^ ]* [^ ]* /, "")
        edits[mask] = edits[mask] "    sdv_mask " name " = { " $0 " };\n" \
                                  "    if (edited(\"" name "\")) mask = " name ";\n"
        next
    }
    /^static sdv_mask / { mask = $3; sub(/\(.*/, "", mask) }
    { print }
    mask in edits && /sdv_mask mask = / {
        printf "%s", edits[mask]
        delete edits[mask]
    }
    END { for (mask in edits) { print "no mask in " mask > "/dev/stderr"; left = 1 }; exit left
    }' $out/edits subdiv.h > $out/subdiv.h
step "it compiles" $CC -std=c99 -O1 -DSUBDIV_NO_OBJ -I$out -Itests tests/edited/edited.c \
    -o $out/edited -lm

# edit NAME CAGES FORMULA: the points of CAGES move, and FORMULA explains none of them.
edit() {
    step "$1 holds" $out/edited check $out/$1.points "$1" "$3"
    for cage in $2; do
        step "$1 moves $cage" $out/edited moves $out/plain.points $out/$1.points $cage
    done
}

edit plain '' ''
edit vertex smooth '(n-2)/n'
edit edge smooth '(a + b + f + g) / 4'
edit crease 'crease loop_crease' 'cubic B-spline'
edit smooth_triangle triangles ''
edit loop_edge loop '(3 a + 3 b + c + d) / 8'
edit loop_vertex loop '(5/8 - '
edit vertex_number smooth '(n-2)/n'
edit edge_number smooth '(a + b + f + g) / 4'
edit crease_number 'crease loop_crease' 'cubic B-spline'
edit smooth_triangle_number triangles ''
edit loop_edge_number loop '(3 a + 3 b + c + d) / 8'
edit loop_vertex_number loop '(5/8 - '
edit chaikin chaikin ''
edit chaikin_number chaikin ''

printf '%-24s %4d passed, %d failed\n' edited "$passed" "$failed"
test "$failed" -eq 0
