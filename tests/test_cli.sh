#!/bin/sh
# The command line: every option, exit codes, messages, standard input and output, failing output.
#
#     sh tests/test_cli.sh [PROGRAM]          PROGRAM: build/subdiv when not given

program=$(cd "$(dirname "${1:-build/subdiv}")" && pwd)/$(basename "${1:-build/subdiv}")
mkdir -p build/cli && cd build/cli || exit 1
rm -rf ./*
LC_ALL=C
export LC_ALL
passed=0
failed=0

subdiv() {
    "$program" "$@"
}

# fine NAME COMMAND: the command has to succeed.
fine() {
    name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED  $name"
    fi
}

# ends STATUS ARGUMENTS: the exit status of subdiv, whose output stands in out and err afterwards.
# What is wrong takes exactly one line on err, and nothing on out.
ends() {
    expected=$1
    shift
    subdiv "$@" > out 2> err
    status=$?
    fine "subdiv $*: exit $status, not $expected" test $status = "$expected"
    if [ "$expected" != 0 ]; then
        fine "subdiv $*: one line on standard error" test "$(wc -l < err)" -eq 1
        fine "subdiv $*: begins with subdiv:" grep -q '^subdiv: ' err
        fine "subdiv $*: nothing on standard output" test ! -s out
    fi
}

says() {
    fine "\"$(cat err)\" does not say \"$1\"" grep -qF -e "$1" err
}

# counts FILE VERTICES FACES
counts() {
    fine "$1 has $2 vertices and $3 faces" \
        awk -v vertices="$2" -v faces="$3" '/^v / { v++ } /^f / { f++ }
            END { exit !(v + 0 == vertices && f + 0 == faces) }' "$1"
}

same() {
    fine "$1 is not $2" cmp -s "$1" "$2"
}

differ() {
    fine "$1 is the same as $2" sh -c "! cmp -s $1 $2"
}

# -------------------------------------------------------------------------------- files to work on

# A cube whose top is sharp, its bottom missing.
cat > box.obj <<'END'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
t crease 2/1/0 4 5 1.5
t crease 2/1/0 5 6 2.5
t crease 2/1/0 6 7 10
END

cat > tetrahedron.obj <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
END

# Everything that --info tells apart.
cat > zoo.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0.5 0
v 0.5 -1 0
v 0.5 0 1
v 9 9 9
v 5 0 0
v 6 0 0
v 6 1 0
v 5.5 2 0
v 5 1 -0.1
f 1 2 3 4
f 2 5 3
f 2 1 6
f 1 2 7
f 9 10 11 12 13
t crease 2/1/0 1 2 2
t crease 2/1/0 2 3 11
t corner 1/1/0 5 3
t hole 1/0/0 4
END

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' > bad_index.obj
printf 'v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n' > bad_vertex.obj
printf '# nothing\n' > empty.obj
{ cat box.obj; printf 't hole 1/0/0 77\nt corner 1/1/0 88 1\nf 1 2\n'; } > warnings.obj
{ cat box.obj; printf 't crease 2/1/0 0 6 1\n'; } > diagonal.obj

# ---------------------------------------------------------------------------------- help, version

ends 0 --help
for option in --scheme --levels --boundary --creasing --triangles --uv --limit --threads \
              --tessellate --curve --vertex-rule \
              --crease-angle --crease-smoothing-groups --crease-seams --crease-sharpness \
              --stream --part --triangulate --info --explain --time --help --version; do
    fine "--help names $option" grep -q -e "$option" out
done
for option in "-s, --scheme" "-l, --levels" "-b, --boundary" "-c, --creasing" "-t, --triangles" \
              "-u, --uv" "-L, --limit" "-j, --threads" "-h, --help"; do
    fine "--help says $option" grep -q -e "^  $option" out
done
fine "--help is not an error" test ! -s err
cp out help
ends 0 -h
same out help
ends 0 box.obj --help
same out help
ends 0 --version
fine "--version prints one line" grep -qx 'subdiv [0-9]*\.[0-9]*' out

# ----------------------------------------------------------------------------------------- levels

ends 0 box.obj one.obj
fine "nothing is printed" test ! -s out -a ! -s err
counts one.obj 25 20
ends 0 -l 2 box.obj two.obj
counts two.obj 89 80
for form in '-l2' '-l 2' '--levels=2' '--levels 2' '-l 7 -l 2'; do
    # Unquoted: the form is one or several words.
    ends 0 $form box.obj form.obj
    same form.obj two.obj
    ends 0 box.obj $form form.obj
    same form.obj two.obj
    ends 0 box.obj form.obj $form
    same form.obj two.obj
done
ends 0 -l0 box.obj zero.obj
counts zero.obj 8 5
ends 0 -l 0 zero.obj again.obj
same zero.obj again.obj
ends 0 -l1 one.obj one_and_one.obj
counts one_and_one.obj 89 80
ends 1 -l 40 box.obj form.obj
ends 1 -l 2147483647 box.obj form.obj
ends 2 -l 2147483648 box.obj
says "whole number"
ends 2 -l 4294967298 box.obj
ends 2 -l -1 box.obj
says "'-1'"
ends 2 --levels=1.5 box.obj
says "'1.5'"
ends 2 -l '' box.obj
ends 2 -l x box.obj
ends 2 -l2x box.obj
ends 2 box.obj -l
says "needs a value"

# ----------------------------------------------------------------------------------------- curves

{ printf 'v 0 0 0 1 0 0\nv 8 0 0\nv 0 8 0\nl 1 2 3\nf 1 2 3\nl 1 2 3 1\n'; } > lines.obj
printf 'v 0 0 0 1 0 0\nv 4 0 0 1 0.5 0.5\nv 6 1 0 1 0.875 0.875\nv 4 4 0 1 1 1\nv 0 8 0 1 1 1\n' > curve
printf 'v 1 1 0 1 0.25 0.25\nv 4 0 0 1 0.5 0.5\nv 6 1 0 1 0.875 0.875\n' >> curve
printf 'v 4 4 0 1 1 1\nv 1 6 0 1 0.875 0.875\nv 0 4 0 1 0.5 0.5\n' >> curve
printf 'l 1 2 3 4 5\nl 6 7 8 9 10 11 6\n' >> curve
ends 0 --curve b-spline lines.obj curve.obj
same curve.obj curve
ends 0 --curve b-spline -l 2 lines.obj twice.obj
ends 0 --curve b-spline curve.obj form.obj
same form.obj twice.obj
ends 0 --curve=chaikin -l 3 lines.obj chaikin.obj
counts chaikin.obj 48 0
ends 0 --curve=chaikin -l 3 --limit lines.obj form.obj
differ form.obj chaikin.obj
ends 0 --info lines.obj
fine "--info counts polylines" grep -qx 'polylines  *2' out
ends 0 lines.obj form.obj
says "2 polylines are left out: --curve refines them"
ends 0 -l0 lines.obj form.obj
fine "level 0 keeps lines" test "$(grep -c '^l ' form.obj)" = 2 -a ! -s err
ends 1 --curve chaikin box.obj
says "no polylines"
ends 1 --curve chaikin -l 31 lines.obj
says "too many points"
ends 2 --curve bezier lines.obj
says "b-spline|chaikin"
ends 2 --curve chaikin --stream lines.obj
says "not for surfaces"

# --------------------------------------------------------------------------------- scheme and rules

ends 0 -l2 -s bilinear box.obj bilinear.obj
counts bilinear.obj 89 80
differ bilinear.obj two.obj
ends 0 -l2 --scheme=catmull-clark box.obj form.obj
same form.obj two.obj
ends 0 -s loop tetrahedron.obj loop.obj
counts loop.obj 10 16
ends 1 -s loop box.obj form.obj
says "face 0"
ends 0 -s loop --triangulate box.obj form.obj
counts form.obj 25 40
ends 2 -s butterfly box.obj
says "catmull-clark|loop|bilinear"
says "butterfly"
ends 2 -s catmull box.obj
ends 2 -s 'catmull-clark|loop' box.obj
ends 2 -s '' box.obj

# Each rule changes the result, its default does not, and the file's own tags count until a rule is
# given. The single face has vertices with one face; the box has semi-sharp creases.
printf 'v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nf 1 2 3 4\n' > quad.obj
{ cat quad.obj; echo 't interpolateboundary 1/0/0 1'; } > quad_corner.obj
ends 0 -l0 quad.obj plain.obj
ends 0 quad.obj quad_edge_1.obj
ends 0 -b edge quad.obj form.obj
same form.obj quad_edge_1.obj
ends 0 -b edge-and-corner quad.obj quad_corner_1.obj
differ quad_corner_1.obj quad_edge_1.obj
ends 0 quad_corner.obj form.obj
same form.obj quad_corner_1.obj
ends 0 --boundary edge quad_corner.obj form.obj
same form.obj quad_edge_1.obj
ends 0 -bnone quad.obj form.obj
counts form.obj 9 0
ends 2 -b corner quad.obj
says "edge|edge-and-corner|none"

ends 0 -l2 -c chaikin box.obj chaikin.obj
differ chaikin.obj two.obj
fine "chaikin is kept for the next refinement" grep -qx 't creasemethod 0/0/1 chaikin' chaikin.obj
ends 0 -l2 -c uniform box.obj form.obj
same form.obj two.obj
{ cat box.obj; echo 't creasemethod 0/0/1 chaikin'; } > box_chaikin.obj
ends 0 -l2 box_chaikin.obj form.obj
same form.obj chaikin.obj
ends 0 -l2 --creasing uniform box_chaikin.obj form.obj
same form.obj two.obj
ends 2 -c normal box.obj

ends 0 -t smooth tetrahedron.obj smooth.obj
ends 0 -t catmull-clark tetrahedron.obj rough.obj
ends 0 tetrahedron.obj form.obj
same form.obj rough.obj
differ smooth.obj rough.obj
ends 2 --triangles round tetrahedron.obj

ends 0 --vertex-rule standard tetrahedron.obj form.obj
same form.obj rough.obj
for rule in averaged doo-sabin; do
    ends 0 --vertex-rule $rule tetrahedron.obj $rule.obj
    differ $rule.obj rough.obj
    ends 1 -s loop --vertex-rule $rule tetrahedron.obj
    says "\"$rule\" is for Catmull-Clark"
done
differ averaged.obj doo-sabin.obj
ends 0 -s loop --vertex-rule=five-eighths tetrahedron.obj five-eighths.obj
ends 0 -s loop --vertex-rule warren tetrahedron.obj warren.obj
same warren.obj loop.obj                            # at valence 3 they are the same rule
differ five-eighths.obj loop.obj
ends 1 --vertex-rule warren tetrahedron.obj
says '"warren" is for Loop'
ends 1 -s bilinear --vertex-rule averaged tetrahedron.obj
ends 1 --vertex-rule doo-sabin --tessellate 2 tetrahedron.obj
says '"doo-sabin"'
ends 2 --vertex-rule catmull tetrahedron.obj
says "standard|averaged|doo-sabin|warren|five-eighths"
ends 0 --vertex-rule averaged --explain 0 tetrahedron.obj
fine "--explain names the vertex rule" grep -q 'n = 3, by the vertex rule "averaged"$' out

# ---------------------------------------------------------------------------------------- creases

# tags FILE COUNT SHARPNESS: so many creases with this sharpness, and no others.
tags() {
    fine "$1 has $2 creases of $3: $(grep -c '^t crease ' $1)" \
        awk -v n="$2" -v s="$3" '/^t crease / { all++; if ($6 == s) with++ }
            END { exit !(all + 0 == n && with + 0 == n) }' $1
}

# Eight edges of the box have two faces, all at right angles; four are at its open bottom.
grep -v '^t' box.obj > bare.obj
ends 0 -l 0 bare.obj plain.obj
for form in '--crease-angle 30' '--crease-angle=89.9' '--crease-angle 0 --crease-sharpness 10' \
            '--crease-angle 1e1 --crease-sharpness=1e30'; do
    ends 0 -l 0 $form bare.obj form.obj
    tags form.obj 8 10
done
ends 0 -l 0 --crease-angle 90 bare.obj form.obj
same form.obj plain.obj
ends 0 -l 0 --crease-angle 91 bare.obj form.obj
same form.obj plain.obj
ends 0 -l 0 --crease-angle 30 --crease-sharpness 2.5 bare.obj form.obj
tags form.obj 8 2.5
ends 0 -l 2 form.obj semisharp.obj
ends 0 -l 2 --crease-angle 30 --crease-sharpness 2.5 bare.obj form.obj
same form.obj semisharp.obj
ends 0 -l 2 --stream --crease-angle 30 --crease-sharpness 2.5 - form.obj < bare.obj
same form.obj semisharp.obj
differ semisharp.obj two.obj
# The tags of the file stay, unless these are sharper: 1.5 becomes 2, 2.5 and 10 stay.
ends 0 -l 0 --crease-angle 30 --crease-sharpness 2 box.obj form.obj
fine "raised" test "$(grep '^t crease' form.obj | head -n 3 | cut -d ' ' -f 6 | tr '\n' ' ')" = '2 2.5 10 '
fine "added" test "$(grep -c '^t crease .* 2$' form.obj)" = 6
ends 0 -l 0 --crease-seams bare.obj form.obj
same form.obj plain.obj
fine "no UVs: a warning" grep -qx 'subdiv: warning: bare.obj: the mesh has no UVs' err
ends 0 -l 0 --crease-smoothing-groups bare.obj form.obj
same form.obj plain.obj
fine "no groups: a warning" grep -qx 'subdiv: warning: bare.obj: the mesh has no smoothing groups' err
ends 0 -l 0 --crease-seams --crease-angle 30 --crease-smoothing-groups bare.obj form.obj
tags form.obj 8 10
fine "two warnings" grep -q 'no smoothing groups (and 1 more)' err

# Smoothing groups: a top of its own, everything flat, nothing but the sides in a group.
{ grep '^v' bare.obj; printf 's 1\nf 5 6 7 8\ns 2\n'; grep '^f' bare.obj | tail -n 4; } > groups.obj
ends 0 -l 0 --crease-smoothing-groups groups.obj form.obj
tags form.obj 4 10
fine "no warning" test ! -s err
sed 's/^s .*/s off/' groups.obj > flat.obj
ends 0 -l 0 --crease-smoothing-groups --crease-sharpness 3 flat.obj form.obj
tags form.obj 8 3
sed '/^s 1/d' groups.obj > sides.obj
ends 0 -l 0 --crease-smoothing-groups sides.obj form.obj
tags form.obj 4 10

# UV seams: two quads that agree on the UVs of their edge, by value, and two that do not.
strip='v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n'
strip=$strip'vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 1\nvt 1 0\nf 1/1 2/2 3/3 4/4\n'
printf "$strip"'f 2/7 5/5 6/6 3/3\n' > sewn.obj
printf "$strip"'f 2/1 5/5 6/6 3/3\n' > seam.obj
ends 0 -l 0 --crease-seams sewn.obj form.obj
tags form.obj 0 10
fine "no warning" test ! -s err
ends 0 -l 0 --crease-seams seam.obj form.obj
tags form.obj 1 10
for form in '-1' 181 x '' nan inf 0x10 '1 2' 30deg; do
    ends 2 --crease-angle "$form" bare.obj
    says "from 0 to 180, not '$form'"
done
for form in 0 -1 x '' nan inf; do
    ends 2 --crease-angle 1 --crease-sharpness "$form" bare.obj
    says "above 0, not '$form'"
done
ends 2 --crease-sharpness 2 bare.obj
says "needs one of the other crease options"
ends 2 --crease-seams=1 bare.obj
says "takes no value"
ends 2 bare.obj --crease-angle
says "needs a value"

# --------------------------------------------------------------------------------------------- UVs

# A strip of two quads whose UVs are cut apart: sharp corners stay, smooth ones move.
cat > seam.obj <<'END'
v 0 0 0
v 1 0 0
v 2 0 0
v 0 1 0
v 1 1 0
v 2 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vt 5 0
vt 6 0
vt 6 1
vt 5 1
f 1/1 2/2 5/3 4/4
f 2/5 3/6 6/7 5/8
END
for option in '--uv corners-only' '-u corners-plus1' '-ucorners-plus2' '--uv=boundaries' '-u all'; do
    ends 0 -l 2 $option seam.obj uv.obj
    fine "$option: two islands of 25 UVs" test "$(grep -c '^vt ' uv.obj)" = 50
    fine "$option: UVs on all faces" test "$(grep -c '^f [0-9]*/[0-9]' uv.obj)" = 32
    fine "$option: corners stay" test "$(grep -c -e '^vt 0 0$' -e '^vt 6 1$' uv.obj)" = 2
done
ends 0 -l 2 -u none seam.obj uv.obj
fine "-u none: two islands of 25 UVs" test "$(grep -c '^vt ' uv.obj)" = 50
fine "-u none: no corner stays" test "$(grep -c -e '^vt 0 0$' -e '^vt 6 1$' uv.obj)" = 0
ends 0 --stream -l 2 -u none seam.obj streamed.obj
same streamed.obj uv.obj
ends 2 --uv blue box.obj
says "corners-only"

# ----------------------------------------------------------------------------------------- limit

# The corner 0 0 0 of a cube has its limit at 1/4 1/4 1/4.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n' > limit.obj
printf 'f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' >> limit.obj
for level in 0 1 2; do
    ends 0 --limit -l $level limit.obj form.obj
    fine "--limit -l $level moves a corner" grep -q '^v 0\.25 0\.25 0\.25' form.obj
    ends 0 -L -l $level -j 3 limit.obj threads.obj
    same threads.obj form.obj
done
ends 0 --limit --stream -l 2 limit.obj streamed.obj
same streamed.obj form.obj

# ------------------------------------------------------------------------------------- tessellate

# A cube in quads: rate 4 is the limit of level 2; 3 is what no level is.
ends 0 --limit -l 2 limit.obj form.obj
ends 0 --tessellate 4 limit.obj tiles.obj
fine "--tessellate 4 has the faces of two levels" \
    test "$(grep '^f' tiles.obj | cksum)" = "$(grep '^f' form.obj | cksum)"
ends 0 --tessellate 3 limit.obj tiles.obj
counts tiles.obj 56 54
fine "--tessellate writes normals" test "$(grep -c '^vn' tiles.obj)" = 56
ends 0 --tessellate 3 -j 3 limit.obj threads.obj
same threads.obj tiles.obj
ends 2 --tessellate 0 limit.obj form.obj
says "--tessellate needs a whole number from 1 up"
ends 2 --tessellate 3 -l 2 limit.obj form.obj
says "--tessellate goes without --levels"
ends 2 --tessellate 3 --stream limit.obj form.obj
says "--tessellate goes without --levels and --stream"

# --------------------------------------------------------------------------------------- explain

ends 0 --explain 0 limit.obj
fine "--explain names the rule" grep -q '^Vertex 0 is interior, of valence 3, and smooth\.$' out
fine "--explain has fractions" grep -q '^    5/12    vertex 0$' out
ends 0 --crease-angle 30 --explain 8 limit.obj
fine "--explain sees creases" grep -q 'is a crease, sharp forever\.$' out
ends 0 --explain all limit.obj
fine "--explain all has a line for each point" test "$(grep -c ' | ' out)" = 27
fine "--explain all names rules" grep -q '^0 vertex 0: smooth smooth 1 nothing-sharp | 0:0.41666' out
fine "--explain all has masks" grep -q '^25 face 5: .* | [0-7]:0.25 [0-7]:0.25 [0-7]:0.25 ' out
ends 2 --explain al limit.obj
ends 0 -s loop --triangulate --explain 25 limit.obj
ends 1 --explain 26 limit.obj
says "8 to 19 of edges, 20 to 25 of faces"
ends 2 --explain 0 limit.obj form.obj
says "standard output alone"
awk 'BEGIN { n = 3000; for (i = 0; i < n; i++) print "v", i, i % 7, 0; printf "f"
             for (i = 1; i <= n; i++) printf " %d", i; print "" }' > huge.obj
ends 0 --explain 6000 huge.obj
fine "--explain of a large face is whole" grep -q '^\[CC78\]' out

# --------------------------------------------------------------------------------------- threads

# The same bytes for any number of threads, also for more than there are jobs or cores.
cages=$(ls ../../examples/cages/*.obj)
for cage in zoo.obj box_chaikin.obj $cages; do
    ends 0 -l 3 $cage serial.obj
    for n in 1 2 3 7 100000; do
        ends 0 -l 3 -j $n $cage form.obj
        same form.obj serial.obj
    done
done
ends 0 -l 3 -s loop --triangulate zoo.obj serial.obj
ends 0 -l 3 -s loop --triangulate --threads=4 zoo.obj form.obj
same form.obj serial.obj
ends 2 -j 0 box.obj
says "whole number"
ends 2 -j many box.obj
says "whole number"
ends 2 box.obj -j
says "needs a value"

# While it waits for its input, the threads are there.
# has_threads PROCESS COUNT: comes to have so many within five seconds.
has_threads() {
    for try in 1 2 3 4 5 6 7 8 9 10; do
        if [ "$(ls /proc/$1/task 2> /dev/null | wc -l)" = "$2" ]; then return 0; fi
        sleep 0.5
    done
    return 1
}

if [ -d /proc/self/task ] && mkfifo pipe; then
    for n in 1 2 5; do
        "$program" -j $n pipe form.obj &
        fine "-j $n makes $n threads" has_threads $! $n
        kill $!
        wait $! 2> /dev/null
    done
fi

# While it waits for its output to be read, they have worked.
# busy PROCESS: another thread than the first comes to have run for 1 ms within ten seconds.
busy() {
    for try in $(seq 50); do
        sleep 0.2
        if cat /proc/$1/task/*/schedstat 2> /dev/null |
            awk 'NR > 1 && $1 > 1e6 { busy = 1 } END { exit !busy }'; then return 0; fi
    done
    return 1
}

if [ -p pipe ] && [ -f /proc/self/schedstat ]; then
    "$program" -j 2 -l 7 ../../examples/cages/octopus.obj pipe &
    fine "-j 2: both threads refine" busy $!
    kill $!
    wait $! 2> /dev/null
fi

# ------------------------------------------------------------------------------------- bad usage

ends 2
says "INPUT"
says "try subdiv --help"
ends 2 --frobnicate box.obj
says "--frobnicate"
says "try subdiv --help"
ends 2 -x box.obj
says "-x"
ends 2 --level 2 box.obj
ends 2 --levels2 box.obj
ends 2 --info=yes box.obj
says "takes no value"
ends 2 --time=1 box.obj
ends 2 -hx
ends 2 box.obj form.obj third.obj
says "third.obj"
fine "a refused command writes nothing" test ! -e third.obj
cp box.obj ./-box.obj
ends 0 -l 2 -- -box.obj -fine.obj
same ./-fine.obj two.obj
ends 2 -- box.obj form.obj --info

# ----------------------------------------------------------------------- standard input and output

subdiv -l2 box.obj > out
same out two.obj
subdiv -l2 box.obj - > out
same out two.obj
subdiv -l2 - < box.obj > out
same out two.obj
subdiv -l2 - out.obj < box.obj
same out.obj two.obj
cat box.obj | subdiv - | subdiv - > out
same out one_and_one.obj
subdiv -l2 box.obj box_itself.obj && cp box.obj itself.obj && subdiv -l2 itself.obj itself.obj
same itself.obj two.obj
ends 1 - < bad_vertex.obj
says "-: line 2: "
ends 1 - < /dev/null
says "no vertices"
ends 1 - <&-
says "reading"

# ----------------------------------------------------------------------------- bad input and output

ends 1 nowhere.obj form.obj
says "nowhere.obj"
ends 1 bad_index.obj form.obj
says "bad_index.obj:4: "
says "9"
ends 1 bad_vertex.obj form.obj
says "bad_vertex.obj:2: "
ends 1 empty.obj form.obj
says "no vertices"
ends 1 . form.obj
ends 1 box.obj nowhere/form.obj
says "nowhere/form.obj"
ends 1 box.obj .
ends 1 --info bad_index.obj
says "bad_index.obj:4: "

# An error leaves OUTPUT as it was.
echo kept > kept.obj
cp kept.obj kept_copy.obj
ends 1 bad_index.obj kept.obj
same kept.obj kept_copy.obj
ends 1 -s loop box.obj kept.obj
same kept.obj kept_copy.obj
ends 1 -l 30 box.obj kept.obj
same kept.obj kept_copy.obj

if [ -w /dev/full ]; then
    ends 1 -l 3 box.obj /dev/full
    says "/dev/full"
    fine "/dev/full is still there" test -c /dev/full
    for arguments in 'box.obj' 'box.obj -' '-l 6 box.obj' '--info box.obj' --help --version; do
        subdiv $arguments > /dev/full 2> err
        fine "subdiv $arguments > /dev/full: exit 1" test $? = 1
        fine "subdiv $arguments > /dev/full: one line" test "$(wc -l < err)" -eq 1
        says "standard output"
    done
fi
subdiv box.obj >&- 2> err
fine "closed standard output: exit 1" test $? = 1
says "standard output"

# A reader that goes away ends the program without a word.
for form in '-l 6' '-l 6 --stream'; do
    { subdiv $form box.obj 2> err; echo $? > status; } | true
    fine "subdiv $form, broken pipe: exit 1" test "$(cat status)" = 1
    fine "subdiv $form, broken pipe: not a word" test ! -s err
done

# OUTPUT is whole or as it was: a full disk and Ctrl-C leave the old file, and nothing beside it.
# unharmed WHAT: that is so of kept.obj.
unharmed() {
    same kept.obj kept_copy.obj
    fine "$1: nothing is left beside OUTPUT" test "$(ls kept*)" = "$(printf 'kept.obj\nkept_copy.obj')"
}

for form in '' --stream; do
    (ulimit -f 8 2> err && trap '' XFSZ 2> err && exec "$program" $form -l 6 box.obj kept.obj 2> err)
    fine "full disk $form: exit 1" test $? = 1
    says "kept.obj"
    unharmed "full disk $form"
done
chmod 640 kept.obj
# The shell has programs in the background ignore INT.
default=
env --default-signal=INT true 2> err && default='env --default-signal=INT,HUP'
for signal in ${default:+INT HUP} TERM; do
    $default "$program" --stream -l 10 box.obj kept.obj 2> err &
    for try in 1 2 3 4 5 6 7 8 9 10; do
        test -s kept.obj.$!.tmp && break
        sleep 0.1
    done
    fine "$signal: it writes beside OUTPUT" test -s kept.obj.$!.tmp
    fine "$signal: with its permissions" \
        test "$(ls -l kept.obj.$!.tmp | cut -c 1-10)" = -rw-r-----
    kill -s $signal $!
    wait $! 2> /dev/null
    fine "$signal: exit 1" test $? = 1
    unharmed $signal
done
ln -s kept.obj link.obj
ends 0 -l 2 box.obj link.obj
fine "a link stays one" test -h link.obj
same kept.obj two.obj
fine "permissions stay" test "$(ls -l kept.obj | cut -c 1-10)" = -rw-r-----
cp kept_copy.obj kept.obj
subdiv -l 2 box.obj /dev/stdout > out
same out two.obj
if [ -p pipe ]; then
    cat pipe > out &
    ends 0 -l 2 box.obj pipe
    wait $!
    fine "a pipe stays one" test -p pipe
fi

# --------------------------------------------------------------------------------------- stream

# The same bytes as in one piece, tags and all.
for cage in box.obj box_chaikin.obj zoo.obj quad.obj quad_corner.obj warnings.obj $cages; do
    for form in '-l 0' '-l 1' '-l 3' '-l 2 -s bilinear' '-l 2 -s loop --triangulate' \
                '-l 2 -b none' '-l 3 -t smooth -c chaikin -b edge-and-corner'; do
        ends 0 $form $cage whole.obj
        ends 0 $form --stream $cage form.obj
        same form.obj whole.obj
        subdiv $form --stream -j 3 $cage > out 2> err
        same out whole.obj
    done
done
ends 0 --stream -l 2 - form.obj < box.obj
same form.obj two.obj
cp box.obj itself.obj
ends 0 --stream -l 2 itself.obj itself.obj
same itself.obj two.obj

# Parts of the text: one behind the other they are the whole.
for cage in box_chaikin.obj warnings.obj zoo.obj $cages; do
    for form in '-l 0' '-l 2' '-L -l 2'; do
        ends 0 $form --stream $cage whole.obj
        for n in 1 2 7; do
            k=1
            : > parts.obj
            while [ $k -le $n ]; do
                subdiv --part $k/$n $form $cage >> parts.obj 2> err
                k=$((k + 1))
            done
            same parts.obj whole.obj
        done
    done
done
ends 0 -l 4 --part 2/3 box.obj part.obj
fine "a part is a third" awk -v part="$(wc -c < part.obj)" -v whole="$(subdiv -l 4 box.obj | wc -c)" \
    'BEGIN { exit !(part > whole / 4 && part < whole / 2) }'
for part in 0/2 3/2 2 /2 2/ 1/0 x/2 1/2/3 -1/2 99999999999/2; do
    ends 2 --part $part box.obj kept.obj
    says "--part needs K/N"
done
for arguments in 'box.obj form.ply' '--tessellate 2 box.obj' '--curve chaikin box.obj' \
                 '--picture form.png box.obj' '-o results box.obj' '--info box.obj' \
                 '--explain 1 box.obj'; do
    ends 2 --part 1/2 $arguments
    says "--part"
done
cp box.obj itself.obj
ends 2 --part 1/2 itself.obj itself.obj
same itself.obj box.obj
# A face of the cage is cut, too.
ends 0 -l 6 --part 4/4 quad.obj part.obj
fine "the last part of one quad" awk -v part="$(wc -c < part.obj)" \
    -v whole="$(subdiv -l 6 quad.obj | wc -c)" 'BEGIN { exit !(part > whole / 10) }'
# A file that may not be so large is an error, and leaves nothing behind.
(ulimit -f 20; exec "$program" -l 7 box.obj limited.obj) 2> err
fine "a file too large: exit 1" test $? = 1
says "writing failed"
fine "a file too large: nothing is left" test -z "$(find . -name "limited.obj*")"

for arguments in 'bad_index.obj' '-s loop box.obj' '-l 30 box.obj'; do
    ends 1 --stream $arguments kept.obj
    same kept.obj kept_copy.obj
done
ends 1 --stream box.obj nowhere/form.obj
says "nowhere/form.obj"
if [ -w /dev/full ]; then
    for level in 0 1 6; do
        ends 1 --stream -l $level box.obj /dev/full
        says "/dev/full"
        subdiv --stream -l $level box.obj > /dev/full 2> err
        fine "--stream -l $level > /dev/full: exit 1" test $? = 1
        says "standard output"
    done
    ends 1 --stream -l 0 ../../examples/cages/octopus.obj /dev/full
    says "/dev/full"
fi

# within MB ARGUMENTS: in so much memory.
within() {
    (ulimit -v $((1024 * $1)) && shift && exec "$program" "$@")
}

# lines LEVEL: of the box. Its 8 vertices, 12 edges and 5 faces become points; then the faces, the
# boundary rule and the one crease that is left.
lines() {
    n=$((1 << $1))
    echo $((8 + 12 * (n - 1) + 5 * (n - 1) * (n - 1) + 5 * n * n + 1 + n))
}

# Level 10 has five million faces, in 250 MB of text, and the mesh would take 168 MB. Level 11 has more
# than 2^24 vertices, 670 MB of mesh, and is streamed without being asked.
if within 64 --version > /dev/null 2>&1; then
    fine "lines 5" test "$(subdiv -l 5 box.obj | wc -l)" -eq "$(lines 5)"
    fine "--stream in 64 MB" test "$(within 64 -l 10 --stream box.obj | wc -l)" -eq "$(lines 10)"
    fine "fewer threads than asked for, for want of memory" within 64 -l 2 -j 256 box.obj form.obj
    same form.obj two.obj
    within 64 -l 10 box.obj > /dev/null 2> err
    fine "in one piece 64 MB are not enough" test $? = 1
    says "out of memory"
    { within 64 -l 11 box.obj 2> err; echo $? > status; } | head -n 8 > out
    fine "a large result, not read to its end: exit 1" test "$(cat status)" = 1
    fine "a large result, not read to its end: not a word" test ! -s err
    counts out 8 0
fi

# ------------------------------------------------------------------------------------- warnings

ends 0 warnings.obj form.obj
fine "one line of warning" test "$(wc -l < err)" -eq 1
fine "the first of three warnings" \
    grep -q '^subdiv: warning: warnings.obj:[0-9]*: .* (and 2 more)$' err
same form.obj one.obj
ends 0 diagonal.obj form.obj
fine "one warning" grep -q '^subdiv: warning: ' err
fine "and no more" sh -c '! grep -q more err'
same form.obj one.obj
ends 0 --info diagonal.obj form.obj
fine "a warning is told once" sh -c '! grep -q more err'
ends 0 --info warnings.obj
fine "warnings with --info" grep -q '^subdiv: warning: ' err

# ------------------------------------------------------------------------------------- info, time

# row TEXT VALUE: a line of --info.
row() {
    fine "--info: $1 is $2: $(grep -F -e "$1" out)" grep -qE -e "^ *$1  +$2\$" out
}

ends 0 --info zoo.obj
row vertices 13
row edges 15
row faces 5
row 'of 3' 3
row 'of 4' 1
row 'of 5' 1
row 'boundary edges' 13
row 'non-manifold edges' 1
row 'isolated vertices' 1
row 'extraordinary vertices' 0
row creases 2
row 'creases that never fade' 1
row corners 1
row holes 1
row components 2
row 'bounding box' '0 -1 -0.1 to 9 9 9'
row oddities 2
fine "--info: counted from 0" grep -qx '  (faces, vertices and tags are counted from 0)' out
fine "--info: an edge" grep -qx '  edge 0-1 has 3 faces: 0, 2, 3' out
fine "--info: a vertex" grep -qx '  no face has vertex 7' out
fine "--info prints no mesh" sh -c '! grep -q "^[vf] " out'
printf 'mtllib a\no b\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 1\ng a\nusemtl c\nf 1/1 2/2 3/1
usemtl d\n' > named.obj
ends 0 --info named.obj
row UVs 2
row 'vertices with colours' 3
row statements 5
row usemtl 2
row mtllib 1
fine "--info: no smoothing groups" sh -c '! grep -q "^  s " out'
ends 0 --info box.obj info.obj
same info.obj one.obj
row vertices 8
row 'boundary edges' 4
row 'extraordinary vertices' 4
row creases 3
row oddities 0
fine "--info: nothing counted" sh -c '! grep -q counted out'
ends 0 --info --crease-angle 30 bare.obj
row creases 8
# Ten of a kind are shown: twelve vertices in one place, three without a face.
{ for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo v 1 2 3; done
  printf 'v 1 0 0\nv 2 0 0\nv 3 0 0\n'
  echo f 1 2 3 4 5 6 7 8 9 10 11 12; } > many.obj
ends 0 --info many.obj
row oddities 15
fine "--info: the last that is shown" grep -qx '  vertex 10 is at the same place as vertex 0' out
fine "--info: no more are shown" sh -c '! grep -q "vertex 11 is" out'
fine "--info: and the others" grep -qx '  and 1 more' out
fine "--info: the other kinds are shown" test "$(grep -c '  no face has vertex 1[234]$' out)" = 3
fine "--info: no area" grep -qx '  face 0 has no area' out
ends 0 -s loop --info tetrahedron.obj
row 'extraordinary vertices' 4
ends 0 --info -s loop box.obj
ends 0 - --info < box.obj
row vertices 8
ends 2 --info box.obj -
says "standard output"

ends 0 --time -l 5 box.obj timed.obj
fine "--time prints four lines" test "$(wc -l < err)" -eq 4
for step in load prepare refine save; do
    fine "--time: $step" grep -qxE "$step [0-9]+\.[0-9]{3} ms [0-9]+\.[0-9]{2} ns/vertex" err
done
fine "--time: nothing on standard output" test ! -s out
per_vertex='{ m = $1 == "load" ? 8 : n; error = $4 * m / 1e6 - $2
    if (error * error > (0.001 + 1e-8 * m) ^ 2) exit 1 }'
n=$(grep -c '^v ' timed.obj)
fine "--time: ns/vertex are ms by vertices" awk -v n="$n" "$per_vertex" err
ends 0 --time --stream -l 5 box.obj streamed.obj
same streamed.obj timed.obj
fine "--time --stream prints three lines" test "$(wc -l < err)" -eq 3
for step in load prepare refine+save; do
    fine "--time --stream: $step" grep -q "^$step [0-9.]* ms [0-9.]* ns/vertex\$" err
done
fine "--time --stream: ns/vertex are ms by vertices" awk -v n="$n" "$per_vertex" err
ends 0 --time --info box.obj
fine "--time --info: one line" test "$(wc -l < err)" -eq 1
fine "--time --info: load" grep -q '^load ' err

# The limit surface at samples: of a flat grid of nine quads, and of triangles around a point.
{ for y in 0 1 2 3; do for x in 0 1 2 3; do echo "v $x $y 0"; done; done
  for f in 1 2 3 5 6 7 9 10 11; do echo "f $f $((f + 1)) $((f + 5)) $((f + 4))"; done; } > flat.obj
printf '# places\n4 0 0 # a vertex\n\n4 0.25 1\r\n 4\t1 .5\n' > samples.txt
printf '1 1 0 1 0 0 0 1 0\n1.25 2 0 1 0 0 0 1 0\n2 1.5 0 1 0 0 0 1 0\n' > expected.txt
ends 0 --eval samples.txt flat.obj
same out expected.txt
ends 0 --eval - flat.obj < samples.txt
same out expected.txt
ends 0 --eval=samples.txt -j 2 - < flat.obj
same out expected.txt
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > corner.obj
printf '0/1 0 0\n0/2 1 1\n' > samples.txt
ends 0 -s bilinear --eval samples.txt corner.obj
printf '1 0 0 -0.5 0.5 0 -0.5 0 0\n0.33333334 0.33333334 0 0.33333334 -0.16666667 0 0.33333334 -0.16666667 0\n' > expected.txt
fine "--eval: the corner of a triangle" test "$(head -n 1 out)" = "$(head -n 1 expected.txt)"
: > samples.txt
ends 0 --eval samples.txt flat.obj
fine "--eval: nothing for no samples" test ! -s out
for line in '9 0 0' '4/1 0 0' '4 2 0' '4 0 -1' '4 nan 0' '4 0' '4 0 0 0' '-1 0 0' '4/ 0 0' 'x 0 0' '4 0 0x'
do
    printf '4 0 0\n%s\n4 1 1\n' "$line" > samples.txt
    ends 1 --eval samples.txt flat.obj
    says "samples.txt:2: "
done
printf '\357\273\2774 0 0\n' > samples.txt
ends 0 --eval samples.txt flat.obj
fine "--eval: a byte order mark" test "$(cat out)" = '1 1 0 1 0 0 0 1 0'
awk '/^v/ { $2 = $2 % 2 ? "3e38" : "-3e38" } { print }' flat.obj > large.obj
printf '4 0.5 0.5\n4 0 0.5\n' > samples.txt
ends 1 --eval samples.txt large.obj
says "samples.txt:1: "
ends 1 --eval no_such_file flat.obj
says no_such_file
ends 2 --eval samples.txt flat.obj out.obj
ends 2 --eval samples.txt -l 2 flat.obj
ends 2 --eval - -
ends 2 --eval

# --------------------------------------------------------------------- formats, pictures, folders

# floats FILE SKIP COUNT: so many floats of a file behind so many bytes, a line each.
floats() {
    od -An -v -w4 -tf4 -j "$2" -N $((4 * $3)) "$1" | tr -d ' '
}

# Two materials in turn, with UVs.
{
    cat limit.obj
    printf 'vt 0 0\nvt 1 0\nvt 1 1\n'
    printf 'usemtl red\nf 1/1 4/2 3/3\nusemtl blue\nf 1/1 3/2 8/3\nusemtl red\nf 1/1 3/3 2/2\n'
} | grep -v '^f [0-9]* ' > turns.obj
ends 0 -L -l 2 limit.obj form.obj
for format in ply stl glb; do
    ends 0 -L -l 2 limit.obj form.$format
    ends 0 -l 1 turns.obj turns.$format
done
head -c 300 form.ply | sed '/^end_header/q' > header
fine "PLY counts vertices" grep -qx "element vertex $(grep -c '^v ' form.obj)" header
fine "PLY counts faces" grep -qx "element face $(grep -c '^f ' form.obj)" header
floats form.ply "$(wc -c < header)" 6 > ply
awk '/^v / && !v { v = $2 " " $3 " " $4 } /^vn / { print v " " $2 " " $3 " " $4; exit }' form.obj |
    tr ' ' '\n' > first
fine "PLY begins with the first vertex and its normal" sh -c \
    "paste ply first | awk '{ d = \$1 - \$2; if (d * d > 1e-12) exit 1 }'"
triangles=$((2 * $(grep -c '^f ' form.obj)))
fine "STL has two triangles for each quad" test "$(wc -c < form.stl)" -eq $((84 + 50 * triangles))
floats form.stl 84 12 > stl
fine "STL: normals are at right angles" awk '{ x[NR - 1] = $1 } END {
        for (k = 0; k < 3; k++) { a = x[6 + k] - x[3 + k]; sum += a * x[k]; square += x[k] * x[k] }
        exit !(sum * sum < 1e-10 && (square - 1) ^ 2 < 1e-10) }' stl
for file in form turns; do
    fine "$file.glb begins as glTF does" test "$(head -c 4 $file.glb)" = glTF
    fine "$file.glb has the length that it says" test \
        "$(od -An -tu4 -j 8 -N 4 $file.glb | tr -d ' ')" -eq "$(wc -c < $file.glb)"
done
sed -n 's/.*"name":"default"[^[]*\[\([^]]*\)\].*/\1/p' form.glb | head -n 1 > color
fine "glb: faces without a material are blue" awk -F , '{ exit !($3 > $2 && $2 > $1) }' color
fine "glb: a material for each usemtl" grep -qa '"name":"red".*"name":"blue"' turns.glb
validator=../node_modules/gltf-validator
if [ -d $validator ]; then
    for file in form turns; do
        node -e "require('./$validator').validateBytes(require('fs').readFileSync('$file.glb'))
            .then(r => process.exit(r.issues.numErrors + r.issues.numWarnings))"
        fine "$file.glb: the validator of Khronos finds nothing" test $? -eq 0
    done
else
    echo "glTF: not validated, which needs npm install --prefix build gltf-validator@2.0.0-dev.3.10"
fi
ends 2 limit.obj form.xyz
says "the formats are .obj, .ply, .stl and .glb"
ends 2 --stream limit.obj form.glb

# Pictures are the same of a cage that is twice as large: only the shape counts.
awk '/^v / { $2 *= 2; $3 *= 2; $4 *= 2 } { print }' box.obj > twice.obj
ends 0 -L -l 3 --picture box.png box.obj
ends 0 -L -l 3 --picture twice.png twice.obj
same box.png twice.png
fine "--picture writes PNG" test "$(head -c 4 box.png | od -An -tx1 | tr -d ' ')" = 89504e47
grep -v crease box.obj > smooth.obj
ends 0 -L -l 3 --picture smooth.png smooth.obj
differ box.png smooth.png
ends 0 -l 1 --picture beside.png box.obj beside.obj
counts beside.obj 25 20
width='od -An -v -tu1 -j 16 -N 4'
fine "with OUTPUT, the picture is twice as wide" test \
    "$($width beside.png | awk '{ print $3 * 256 + $4 }')" -eq \
    "$($width box.png | awk '{ print 2 * ($3 * 256 + $4) }')"
ends 0 -s loop --triangulate --picture beside.png box.obj beside.obj
ends 2 --picture box.jpg box.obj
ends 2 --picture box.png --stream box.obj
printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' > stroke.obj
ends 1 --picture stroke.png stroke.obj
says "there are no faces to show; --curve refines polylines"

# Polylines are drawn, with faces or without.
ends 0 --curve chaikin -l 3 --picture chaikin.png lines.obj
sed 's/8/16/' lines.obj > twice.obj
ends 0 --curve chaikin -l 3 --picture twice.png twice.obj
same chaikin.png twice.png
ends 0 --curve b-spline -l 3 --picture spline.png lines.obj
differ chaikin.png spline.png
ends 0 -l 0 --picture lines.png lines.obj
grep -v '^l' lines.obj > face.obj
ends 0 -l 0 --picture face.png face.obj
differ lines.png face.png
ends 0 --curve chaikin --picture beside.png stroke.obj beside.obj
fine "--curve --picture: the cage is beside the curve" test \
    "$($width beside.png | awk '{ print $3 * 256 + $4 }')" -eq \
    "$($width chaikin.png | awk '{ print 2 * ($3 * 256 + $4) }')"

# Pages: the data of each level is what the level writes by itself.
# words FORMAT NAME STEP: the numbers of an array of page.html, a line each; of the first STEP is 1
words() {
    sed -n "s/^\"$2\":\"\([^\"]*\).*/\1/p" page.html | sed -n "$3p" | base64 -d | od -An -v -w4 "-t$1" |
        tr -d ' '
}

# page_holds OPTIONS: page.html has the points and faces that subdiv writes for levels 0 to 2
page_holds() {
    for level in 0 1 2; do
        ends 0 "$@" -l $level box.obj level.obj
        words f4 points $((level + 1)) > points
        words u4 faces $((level + 1)) > faces
        fine "--html $*: the points of level $level" sh -c "grep '^v ' level.obj | cut -d ' ' -f 2- |
            tr ' ' '\n' | paste - points | awk '{ d = \$1 - \$2; if (d * d > 1e-12 || NF < 2) exit 1 }'"
        grep '^f ' level.obj | cut -d ' ' -f 2- | tr ' ' '\n' |
            awk -F / '{ print $1 - 1 }' > expected
        same faces expected
    done
}

ends 0 -l 2 --html page.html box.obj
fine "--html prints nothing" test ! -s out
page_holds
fine "--html: a page ends" test "$(tail -n 1 page.html)" = "</html>"
fine "--html: two creases that fade, each in 4 pieces" test "$(grep -o '^"creases":\["[^"]*' page.html |
    sed -n '3s/.*"//p' | base64 -d | wc -c)" -eq 64
fine "--html: needs nothing from elsewhere" sh -c '! grep -q "https\{0,1\}:" page.html'
ends 0 -L -l 2 --html page.html box.obj beside.obj
page_holds -L
words f4 normals 1 > normals
fine "--html: normals have length 1" awk '{ s += $1 * $1 } NR % 3 == 0 {
    if ((s - 1) ^ 2 > 1e-10) exit 1; s = 0 }' normals
ends 0 -L -l 2 box.obj level.obj
same level.obj beside.obj
cp box.obj '<b>"&.obj'
ends 0 --html page.html '<b>"&.obj'
fine "--html: a name with signs of HTML" grep -qx '<title>&#60;b&#62;&#34;&#38;</title>' page.html
cp box.obj "$(printf 'caf\351.obj')"
ends 0 --html page.html "$(printf 'caf\351.obj')"
fine "--html: a name in Latin-1" grep -qx '<title>caf&#233;</title>' page.html
cp box.obj "$(printf 'caf\303\251.obj')"
ends 0 --html page.html "$(printf 'caf\303\251.obj')"
fine "--html: a name in UTF-8" grep -qx "$(printf '<title>caf\303\251</title>')" page.html
ends 0 --tessellate 3 --html page.html box.obj
fine "--html: a tessellation and its cage" test "$(grep -o '"label":"[^"]*"' page.html | tr '\n' ' ')" \
    = '"label":"level 0" "label":"3 pieces an edge" '
echo old > page.html
ends 1 -l 10 --html page.html box.obj
says "the page would have at least 280 MB, 100 are allowed: take fewer levels"
# More than the check before refining counts: the normals of both sides of creases.
ends 1 -l 9 -L --crease-angle 10 --html page.html box.obj
says "MB, 100 are allowed: take fewer levels"
fine "--html: how large it would be" sh -c '! grep -q "at least" err'
ends 1 --tessellate 700 --html page.html box.obj
says "take fewer pieces"
ends 1 --html page.html stroke.obj
says "there are no faces to show"
fine "--html: what fails leaves the file" test "$(cat page.html)" = old
ends 1 --html no/page.html box.obj
if [ -c /dev/full ]; then
    for kind in ply stl glb; do
        ln -s /dev/full full.$kind
        ends 1 box.obj full.$kind
        says "writing failed: No space left on device"
    done
    for kind in html,--html png,--picture; do
        ln -s /dev/full full.${kind%,*}
        ends 1 ${kind#*,} full.${kind%,*} box.obj
        says "writing failed: No space left on device"
    done
fi
cp box.obj cage.html
ends 2 --html cage.html cage.html
ln -sf cage.html link.html
ends 2 --html cage.html link.html
ends 2 --html form.html box.obj form.html
same cage.html box.obj
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' > place.obj
ends 0 -l 1 --picture place.png --html page.html place.obj
ends 2 --html page.png box.obj
ends 2 --html page.html --stream box.obj
ends 1 --html page.html --curve chaikin box.obj
says "no polylines"
ends 1 --curve chaikin -l 22 --html page.html lines.obj
says "the page would have at least 671 MB, 100 are allowed: take fewer levels"
ends 0 --curve chaikin -l 2 --html page.html lines.obj
for level in 0 1 2; do
    ends 0 --curve chaikin -l $level lines.obj level.obj
    words f4 points $((level + 1)) | awk '{ print $1 + 0 }' > points
    grep '^v ' level.obj | cut -d ' ' -f 2-4 | tr ' ' '\n' | awk '{ print $1 + 0 }' > expected
    same points expected
    words u4 polylines $((level + 1)) | paste - - > polylines
    awk '/^l / { for (i = 3; i <= NF; i++) print $(i - 1) - 1 "\t" $i - 1 }' level.obj > expected
    same polylines expected
done
ends 2 --html page.html -o results box.obj
ends 2 --html

# What cannot be written is an error that says why, and leaves the old file; also of a part.
# unwritten FORMAT ARGUMENTS: that is so of a file of this format.
unwritten() {
    rm -f kept* && echo kept > kept_copy.obj && echo kept > "kept.$1"
    fits="kept.$1" && shift
    (ulimit -f 8 && exec "$program" -l 4 "$@" "$fits" 2> err)
    fine "$*: exit 1" test $? = 1
    says "$fits: writing failed: File too large"
    same "$fits" kept_copy.obj
    fine "$*: nothing is left beside it" test "$(ls kept* | wc -l)" -eq 2
    [ -c /dev/full ] || return
    ln -sf /dev/full "$fits"
    subdiv -l 4 "$@" "$fits" 2> err
    fine "$*, disk full: exit 1" test $? = 1
    says "$fits: writing failed: No space left on device"
}

for format in ply stl glb; do unwritten $format limit.obj; done
unwritten obj --part 2/3 limit.obj
unwritten png limit.obj --picture
unwritten html limit.obj --html

# Several inputs go to a folder; one that fails does not keep the others.
ends 0 -l 1 -o results box.obj limit.obj
ends 0 -l 1 box.obj single.obj
same results/box.obj single.obj
cp box.obj 'back\slash.obj'
ends 0 -l 1 -o results 'back\slash.obj'
same 'results/back\slash.obj' single.obj
echo 'f 1 2 3' > broken.obj
rm -r results
subdiv -l 1 -o results broken.obj box.obj > out 2> err
fine "-o with a broken file ends with 1" test $? -eq 1
same results/box.obj single.obj
mkdir -p other && cp box.obj other
ends 2 -o results box.obj other/box.obj
for folder in . ../cli other; do
    ends 2 -l 1 -o $folder single.obj other/box.obj
    says "a result would replace its cage"
done
same other/box.obj box.obj
ends 2 box.obj single.obj limit.obj

ends 0 --no-tags -l 1 box.obj untagged.obj
grep -v '^t ' single.obj > expected.obj
same untagged.obj expected.obj
sed 's|1/1|1/99|' turns.obj > uvs.obj
ends 1 -l 1 uvs.obj
says "--no-uvs reads the rest"
ends 0 --no-uvs -l 1 uvs.obj without.obj
fine "--no-uvs leaves UVs out" sh -c '! grep -q "^vt" without.obj'
ends 1 -s loop limit.obj
says "--triangulate cuts larger faces"
ends 0 -l 0 --merge-materials turns.obj merged.obj
fine "--merge-materials: each material once" test "$(grep -c '^usemtl' merged.obj)" -eq 2
fine "--merge-materials: the same faces" test \
    "$(grep '^f' merged.obj | sort)" = "$(grep '^f' turns.obj | sort)"
ends 0 --help
fine "--help ends with three examples" test "$(sed -n '/^examples:/,$p' out | grep -c subdiv)" -eq 3

printf '%-24s %4d passed, %d failed\n' cli $passed $failed
[ $failed = 0 ]
