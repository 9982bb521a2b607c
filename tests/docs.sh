#!/bin/sh
# docs.sh OBJECT: compiles and runs what the documentation shows: the programs in the opening
# comment of subdiv.h, and the first complete C program of README.md if there is one. The first has
# an implementation of its own, the others have that of OBJECT. CC names the compiler.
CC=${CC:-cc}
object=$1
flags="-std=c99 -Wall -Wextra -Wpedantic -Werror -I."
out=build/docs
rm -rf $out
mkdir -p $out

. tests/lib/step.sh
. tests/lib/section.sh

cat > $out/cage.obj <<'END'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END

# refines NAME WITH...: in its folder the program makes a fine.obj that is a closed mesh of quads.
refines() {
    program=$1
    shift
    rm -f $out/fine.obj
    step "$program compiles" $CC $flags $out/$program.c "$@" -o $out/$program -lm
    step "$program runs" sh -c "cd $out && ./$program"
    step "$program refines" awk '/^v / { v++ } /^f / && NF == 5 { f++ }
                           END { exit !(f > 6 && v == f + 2) }' $out/fine.obj
}

section "QUICK START" > $out/quick_start.c
refines quick_start
step "quick_start refines twice" test "$(grep -c '^f ' $out/fine.obj)" = 96

# Without a cage it says what is wrong and returns the error.
mv $out/cage.obj $out/cage.kept
step "quick_start fails" sh -c "cd $out && ! ./quick_start > message && grep -q cage.obj message"
mv $out/cage.kept $out/cage.obj

{
    echo '#define SUBDIV_IMPLEMENTATION'
    echo '#include "subdiv.h"'
    echo 'int main(void)'
    echo '{'
    section "BY HAND"
    echo '    subdiv_mesh fine = {0};'
    echo '    subdiv_result result = subdiv_refine(&fine, &cube, 2, NULL);'
    echo '    if (!result) result = subdiv_save_obj(&fine, "fine.obj", NULL);'
    echo '    subdiv_mesh_free(&fine);'
    echo '    return (int)result;'
    echo '}'
} > $out/by_hand.c
refines by_hand -DSUBDIV_IMPLEMENTED "$object"
step "by_hand has one crease left" test "$(grep -c '^t crease ' $out/fine.obj)" = 4

# The programs are C++ as well.
if command -v "${CXX:-c++}" > /dev/null; then
    step "quick_start is C++" "${CXX:-c++}" -x c++ -std=c++11 -I. -fsyntax-only $out/quick_start.c
    step "by_hand is C++" "${CXX:-c++}" -x c++ -std=c++11 -I. -fsyntax-only $out/by_hand.c
fi

# CONTENTS names every section of subdiv.h and no other.
grep -o '^// -.*>>[a-z-]*' subdiv.h | sed 's/.*>>//' | sort -u > $out/sections
sed -n '/CONTENTS/,/WORDS/p' subdiv.h | sed 's/.*>>masks$//' | grep -o '>>[a-z-]*' | sed 's/>>//' |
    sort -u > $out/contents
step "CONTENTS is complete" diff $out/sections $out/contents

# The first fenced block of README.md that holds a main.
if [ -f README.md ]; then
    awk '/^```/ { if (inside && main) { printf "%s", text; exit }
                  inside = !inside; main = 0; text = ""; next }
         inside { text = text $0 "\n"; if (/int main\(/) main = 1 }' README.md > $out/readme.c
    if [ -s $out/readme.c ]; then refines readme -DSUBDIV_IMPLEMENTED "$object"; fi
fi

# README.md names every public function, some of them by their last words, and every option.
step "README has every function" awk '
    FNR == NR { text = text $0; next }
    /End of the public API/ { exit }
    /^SUBDIV_DEF/ && match($0, /subdiv_[a-z_]+\(/) {
        name = substr($0, RSTART, RLENGTH - 1)
        for (end = name; end != "" && !index(text, "`" end "`") && !index(text, "`" end "("); )
            sub(/^_?[^_]*/, "", end)
        if (end == "") { print name; missing = 1 }
    }
    END { exit missing }' README.md subdiv.h
# has_calls FILES...: every public call that can fail is made in one of them.
has_calls() {
    cat "$@" | awk '
        FNR == NR { text = text $0; next }
        /End of the public API/ { exit }
        /^SUBDIV_DEF subdiv_result/ && match($0, /subdiv_[a-z_]+\(/) {
            name = substr($0, RSTART, RLENGTH)
            if (!index(text, name)) { print name; missing = 1 }
        }
        END { exit missing }' - subdiv.h
}

step "stack and threads: every call" has_calls tests/lib/every_call.h
step "wrong arguments: every call" has_calls tests/test_memory.c
step "misuse: every call" has_calls tests/fuzz/misuse.c
step "README has every option" awk '
    FNR == NR { text = text $0; next }
    match($0, /^    \{.*, "[a-z-]+"/) {
        split($0, parts, "\"")
        if (!index(text, "--" parts[2])) { print parts[2]; missing = 1 }
    }
    END { exit missing }' README.md examples/subdiv_cli.c

printf '%-24s %4d passed, %d failed\n' docs $passed $failed
[ $failed = 0 ]
