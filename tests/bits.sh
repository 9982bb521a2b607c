#!/bin/sh
# bits.sh EXPECTED NAME: compares the bits of results with EXPECTED, what tests/bits.c prints when
# it is compiled as usual. NAME is a compiler: it optimises much and little, with SIMD and without,
# as C and C++, and with all instructions of this processor, such as those that multiply and add in
# one step. Or NAME is another platform, whose emulator also runs a few of the other tests; it is
# skipped if that is not installed.
expected=$1
name=$2
out=build/bits/$name
compile=$name
run=
cages=
mkdir -p $out

case $name in
aarch64)
    packages="qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross"
    compile="aarch64-linux-gnu-gcc -static" run=qemu-aarch64 ;;
armhf)
    packages="qemu-user gcc-arm-linux-gnueabihf libc6-dev-armhf-cross"
    compile="arm-linux-gnueabihf-gcc -static" run=qemu-arm ;;
s390x)
    packages="qemu-user gcc-s390x-linux-gnu libc6-dev-s390x-cross"
    compile="s390x-linux-gnu-gcc -static" run=qemu-s390x ;;
i686)
    packages="qemu-user gcc-i686-linux-gnu libc6-dev-i386-cross"
    compile="i686-linux-gnu-gcc -static -msse2 -mfpmath=sse" run=qemu-i386 ;;
windows)
    packages="gcc-mingw-w64-x86-64 wine64"
    compile=x86_64-w64-mingw32-gcc run=/usr/lib/wine/wine64
    export WINEDEBUG=-all WINEPREFIX="$PWD/$out/wine" ;;
wasm32 | wasm32-simd)
    packages="clang lld wasi-libc libclang-rt-dev-wasm32 nodejs"
    compile="clang --target=wasm32-wasi --sysroot=/usr" run="node --no-warnings tests/lib/wasi.js"
    [ $name = wasm32 ] || compile="$compile -msimd128" ;;
esac

. tests/lib/step.sh

# program FLAGS...: a program of these flags and files, run. It prints what it has to say.
program() {
    $compile -I. "$@" -o $out/program.exe -lm && $run $out/program.exe $cages
}

# compare FLAGS...: Windows ends lines in its own way.
compare() {
    cages=$(echo examples/cages/*.obj)
    program "$@" tests/bits.c > $out/printed && tr -d '\r' < $out/printed | diff $expected -
}

# What follows the header in its file is compiled as the user asks.
fuses() {
    {
        echo '#include "subdiv.h"'
        echo 'double after(double a, double b, double c) { return a * b + c; }'
    } > $out/after.c
    $compile -O2 -mfma -DSUBDIV_STATIC -DSUBDIV_IMPLEMENTATION -I. -S $out/after.c -o $out/after.s &&
        grep vfmadd $out/after.s
}

same() {
    step "the bits of $name $*" compare "$@"
}

echo 'int main(void) { return 0; }' > $out/empty.c
if [ -z "$run" ]; then
    same -O0
    [ $name = tcc ] || same -O1 -DSUBDIV_NO_SIMD
    if [ $name != tcc ] && $compile -march=native $out/empty.c -o $out/empty 2> $out/log; then
        same -O3 -march=native
        same -O2 -march=native -DSUBDIV_NO_SIMD
        same -O2 -march=native -x c++ -std=c++11
    fi
    if [ $name != tcc ] && $compile -mfma $out/empty.c -o $out/empty 2> $out/log; then
        step "$name fuses behind the header" fuses
    fi
elif program $out/empty.c > $out/log 2>&1; then
    step "$name" $compile -O2 -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o $out/subdiv.o
    same -DSUBDIV_IMPLEMENTED $out/subdiv.o
    cages=
    for test in recorded masks; do
        step "test_$test on $name" program -DSUBDIV_IMPLEMENTED $out/subdiv.o tests/test_$test.c
    done
else
    echo "$name is skipped: it needs $packages"
fi

printf '%-24s %4d passed, %d failed\n' "bits $name" $passed $failed
[ $failed = 0 ]
