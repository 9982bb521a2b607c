#!/bin/sh
# mutate.sh: are the tests good? Changes one place of subdiv.h after the other (see mutants.awk) and
# runs the tests with each of these mutants. One that no test notices is a test that is missing, or
# code that nobody needs, or it is equivalent: it computes the same. Those stand in equivalent.txt.
#
#     sh tests/mutate/mutate.sh             or: MUTANTS=1000 SEED=2 JOBS=4 sh tests/mutate/mutate.sh
#
# First come the tests that know most of the mutant's section, for SECONDS_EACH of processor time,
# up to the first check that fails; tcc compiles the header for them in a tenth of a second. What
# survives this is compared as an object at -O2 and linked with all tests; then come the sanitizers
# of make check, and then make test. QUICK=1 leaves all this to a later run. Everything is in
# build/mutate. Stop and start it as you like: results.txt keeps what was found.
MUTANTS=${MUTANTS:-320} SEED=${SEED:-1} JOBS=${JOBS:-2} SECONDS_EACH=${SECONDS_EACH:-3}
out=build/mutate
results=$out/results.txt
quick_cc=${QUICK_CC:-$(command -v tcc || echo "cc -O0")}
flags="-DTEST_STOP -ffp-contract=off"
cc="${CC:-cc} -std=c99 -DTEST_STOP -ffp-contract=off"
own="evaluate memory exact obj_numbers"
linked="recorded order stencils limit creases errors obj_read obj_write check masks uv doors"
linked="$linked partial_uvs vertex_rules exact_oracle tessellate curves normals conventions"
linked="$linked locations invariants buffers"
mkdir -p $out/0
touch $results

tests_of() {
    case $1 in
    memory|errors|validate) echo errors memory obj_read conventions ;;
    face-varying) echo recorded uv partial_uvs conventions evaluate ;;
    curves) echo curves ;;
    normals|limit-surface) echo normals creases limit evaluate conventions vertex_rules exact ;;
    limit-rows) echo limit evaluate vertex_rules exact ;;
    platform|grids|evaluate|results*|calls)
        echo recorded order evaluate limit errors locations memory uv ;;
    locations) echo locations exact stencils exact_oracle ;;
    split|patches|nests|leaves|cells|polynomials|samples|exact-surface)
        echo exact stencils exact_oracle vertex_rules ;;
    stencils) echo stencils doors ;;
    tile*|tessellator) echo tessellate doors errors ;;
    vertex-buffers) echo buffers errors ;;
    generators) echo creases check conventions memory ;;
    inspection|oddities) echo check errors ;;
    numbers|obj-read|obj-write) echo obj_numbers obj_read obj_write ;;
    explain) echo stencils vertex_rules ;;
    *) echo recorded order masks creases limit evaluate uv errors conventions invariants ;;
    esac
}

# build DIRECTORY TEST: links a test with the library of DIRECTORY, or compiles both.
build() {
    case " $own " in
    *" $2 "*) $quick_cc $flags -DSUBDIV_STATIC -I"$1" tests/test_"$2".c -o "$1/test" -lm -lpthread ;;
    *) $quick_cc $out/"$2".o "$1/subdiv.o" -o "$1/test" -lm ;;
    esac > "$1/log" 2>&1
}

compile() {
    (cd "$1" && $quick_cc $flags -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o subdiv.o) > "$1/log" 2>&1
}

# run DIRECTORY SECONDS: 0: passed; 137 or 152: it took longer. (Some meshes of test_errors are huge.)
run() {
    rm -f build/test_*.obj*                         # of a test that was ended
    (
        ulimit -t "$2"; ulimit -v 40000000; ulimit -c 0
        exec env MALLOC_PERTURB_=165 "$1/test"
    ) > "$1/log" 2>&1 < /dev/null
}

# The header itself must pass. Notes which tests it passes in time: they get twice as long, and what
# then takes longer does not end. The time of other tests decides nothing.
prepare() {
    if ! cmp -s subdiv.h $out/0/subdiv.h; then
        rm -f $out/*.o $out/?/*.o $out/?/*.clean $out/tests
        cp subdiv.h $out/0/subdiv.h
    fi
    touch $out/tests
    compile $out/0 || return 1
    for test in $linked; do
        $quick_cc $flags -DSUBDIV_IMPLEMENTED -I. -c tests/test_"$test".c -o $out/"$test".o || return 1
    done
    for test in $linked $own; do
        grep -q "^$test " $out/tests && continue
        build $out/0 "$test" && run $out/0 "$SECONDS_EACH"
        status=$?
        case $status in
        0) echo "$test $((2 * SECONDS_EACH))" >> $out/tests ;;
        137|152) echo "$test $SECONDS_EACH long" >> $out/tests ;;
        *) echo "$test fails without a mutation"; return 1 ;;
        esac
    done
}

# quick DIRECTORY SECTION: sets verdict and by.
quick() {
    verdict=survived by=quick
    compile "$1" || { verdict=invalid; return; }
    cmp -s "$1/subdiv.o" $out/0/subdiv.o && { verdict=same; return; }
    for test in $(tests_of "$2"); do
        build "$1" "$test"
        time=$(sed -n "s/^$test //p" $out/tests)
        run "$1" "${time%% *}"
        status=$?
        case $status in
        0) continue ;;
        137|152) [ "${time#* }" = long ] && continue ;;
        esac
        verdict=killed by=$test
        return
    done
}

# clean DIRECTORY TEST: a test under the sanitizers of make check, where each array is a block.
clean() {
    sanitize="$cc -O1 -fsanitize=address,undefined -fno-sanitize-recover=all -pthread -I$1 -I."
    case " $own " in
    *" $2 "*) $sanitize -DSUBDIV_STATIC tests/test_"$2".c -o "$1/test" -lm ;;
    *)
        [ -e "$1/sanitized.o" ] ||
            $sanitize -DSUBDIV_IMPLEMENTATION -x c -c "$1/subdiv.h" -o "$1/sanitized.o"
        $sanitize -DSUBDIV_IMPLEMENTED tests/test_"$2".c -x none "$1/sanitized.o" -o "$1/test" \
            -lm ;;
    esac && rm -f build/test_*.obj* &&
        (ulimit -t 100; ulimit -c 0; exec "$1/test") > "$1/log" 2>&1 < /dev/null
}

# sanitized DIRECTORY SECTION: those of its tests that are clean without a mutation.
sanitized() {
    rm -f "$1/sanitized.o"
    for test in $(tests_of "$2"); do
        [ "$test" = exact_oracle ] && continue                  # takes minutes
        [ -e $out/0/"$test".clean ] || { clean $out/0 "$test"; echo $? > $out/0/"$test".clean; }
        [ "$(cat $out/0/"$test".clean)" = 0 ] || continue
        clean "$1" "$test" || return 1
    done
}

# thorough DIRECTORY SECTION: the same object when optimised, or all tests that link with it, or
# sanitizers, or make test in a copy of everything.
thorough() {
    o2="$cc -O2 -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o O2.o"
    [ -e $out/0/O2.o ] || (cd $out/0 && $o2)
    (cd "$1" && $o2) && cmp -s "$1/O2.o" $out/0/O2.o && { verdict=same; return; }
    by=-
    for file in tests/test_*.c; do
        test=${file#tests/test_}
        test=${test%.c}
        case " $own growth " in *" $test "*) continue ;; esac
        object=$out/0/$test.o
        [ -e "$object" ] || $cc -O1 -DSUBDIV_IMPLEMENTED -I. -c "$file" -o "$object"
        $cc -pthread "$object" "$1/O2.o" -o "$1/test" -lm && run "$1" 100 && continue
        verdict=killed by=$test
        return
    done
    sanitized "$1" "$2" || { verdict=killed by=sanitizers; return; }
    rm -rf "$1/copy"
    mkdir "$1/copy"
    cp -r Makefile README.md LICENSE tests examples "$1/copy"
    cp "$1/subdiv.h" "$1/copy"
    timeout 1800 make -s -C "$1/copy" test HAVE_OSD=no > "$1/log" 2>&1 ||
        { verdict=killed by="make test"; }
}

# worker NUMBER: every JOBS-th mutant.
worker() {
    dir=$out/$1
    mkdir -p "$dir"
    awk -v jobs="$JOBS" -v me="$1" 'NR % jobs == me - 1' $out/list > "$dir/list"
    while IFS= read -r mutant; do
        case $(grep -F -e "${mutant#*	}" $results | tail -n 1) in
        "") ;;
        "survived	quick	"*) [ -n "$QUICK" ] && continue ;;
        *) continue ;;
        esac
        printf '%s\n' "$mutant" > "$dir/mutant"
        awk -F '\t' 'FNR == NR { at = $1; line = $4; next } { print FNR == at ? line : $0 }' \
            "$dir/mutant" subdiv.h > "$dir/subdiv.h"
        section=${mutant#*	}
        quick "$dir" "${section%%	*}"
        [ "$verdict" = survived ] && [ -z "$QUICK" ] && thorough "$dir" "${section%%	*}"
        printf '%s\t%s\t%s\n' "$verdict" "$by" "$mutant" >> $results
    done < "$dir/list"
}

prepare 2> $out/err || { cat $out/0/log $out/err; exit 1; }
awk -v seed="$SEED" -v count="$MUTANTS" -f tests/mutate/mutants.awk subdiv.h > $out/list
job=1
while [ $job -le "$JOBS" ]; do
    worker $job 2> $out/err$job &
    job=$((job + 1))
done
wait
awk -f tests/mutate/report.awk tests/mutate/equivalent.txt $out/list $results
