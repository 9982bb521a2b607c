#!/bin/sh
# The same bits with and without SIMD, at any level of optimisation and with any compiler. Where
# the processor fuses multiplications and additions, the compiler is told not to. CC and CXX name
# the compilers.
CC=${CC:-cc}
CXX=${CXX:-c++}
out=build/simd
passed=0
failed=0
first=
before=
mkdir -p $out

# same NAME COMPILER FLAGS...: compiles tests/simd.c and compares its sum with the first one.
same() {
    name=$1
    shift
    if ! "$@" -I. tests/simd.c -o $out/simd -lm > $out/log 2>&1; then
        failed=$((failed + 1))
        echo "FAILED  $name does not compile: $*"
        head -n 10 $out/log
        return
    fi
    sum=$($out/simd)
    first=${first:-$sum}
    if [ -n "$sum" ] && [ "$sum" = "$first" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED  $name: the sum is '$sum', not '$first'"
    fi
}

# works COMPILER FLAGS...: does the compiler take these flags?
works() {
    echo 'int main(void) { return 0; }' > $out/works.c
    "$@" $out/works.c -o $out/works > $out/log 2>&1 && $out/works
}

for compiler in $CC clang; do
    [ "$compiler" = "$before" ] && continue
    works $compiler -std=c99 || continue
    same "$compiler" $compiler -std=c99
    same "$compiler without SIMD" $compiler -std=c99 -DSUBDIV_NO_SIMD
    same "$compiler -O3" $compiler -std=c99 -O3
    same "$compiler -O3 without SIMD" $compiler -std=c99 -O3 -DSUBDIV_NO_SIMD
    native="-std=c99 -O3 -march=native -ffp-contract=off"
    before=$compiler
    works $compiler $native || continue
    same "$compiler, this processor" $compiler $native
    same "$compiler, this processor without SIMD" $compiler $native -DSUBDIV_NO_SIMD
done

if works $CXX -x c++ -std=c++11; then
    same "$CXX" $CXX -x c++ -std=c++11 -O2
    same "$CXX without SIMD" $CXX -x c++ -std=c++11 -O2 -DSUBDIV_NO_SIMD
fi

printf '%-24s %4d passed, %d failed\n' simd $passed $failed
[ $failed = 0 ]
