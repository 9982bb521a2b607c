#!/bin/sh
# Compiles the programs of tests/compile in every way that subdiv.h offers, without a warning, and
# runs them: each makes a cube and looks whether it is right. CC and CXX name the compilers.
CC=${CC:-cc}
CXX=${CXX:-c++}
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
out=build/compile
from=tests/compile
mkdir -p $out

. tests/lib/step.sh

# c NAME FILES...: a C program of so many files, compiled, linked and run.
c() {
    name=$1
    shift
    step "$name compiles" $CC -std=c99 $warn -I. "$@" -o $out/$name -lm
    step "$name runs" $out/$name
}

c c99 $from/c99.c
step "two_files in C" $CC -std=c99 $warn -I. -c $from/two_files_a.c -o $out/two_files_a.o
c two_files $from/two_files_b.c $out/two_files_a.o
# The library never prints or ends the program, and leaves what is global as it is.
if nm -u $out/two_files_a.o > $out/symbols 2> $out/log && [ -s $out/symbols ]; then
    global='(.*printf|puts|f?putc(har)?|std(out|err)|_?exit|abort|setlocale|signal|raise|s?rand|setenv)'
    step "prints nothing, changes nothing global" sh -c "! grep -E ' _?$global(@|\$)' $out/symbols"
fi
# Private copies of all functions are more than one file uses.
c private -Wno-unused-function -DSUBDIV_NO_TOOLS -DSUBDIV_NO_OBJ $from/private_a.c \
    $from/private_b.c

# Nothing that opens, reads, writes or prints may be left under SUBDIV_NO_STDIO.
step "no_stdio with assert" $CC -std=c99 $warn -I. -fsyntax-only $from/no_stdio.c
step "no_stdio compiles" $CC -std=c99 $warn -DNDEBUG -I. -c $from/no_stdio.c -o $out/no_stdio.o
c no_stdio $out/no_stdio.o
if nm -u $out/no_stdio.o > $out/symbols 2> $out/log && [ -s $out/symbols ]; then
    files='f(open|close|read|write|error|flush|put[cs])|puts|printf|std(in|out|err)'
    step "no_stdio references no files" sh -c "! grep -E '$files' $out/symbols"
fi

# Less of the library, each part left out alone and all of them together; in C++, too.
# What is left out is not there.
exact='subdiv_(evaluate_at|tessellate|surface_tessellate|stencils_at)'
tools='subdiv_(explain|explain_points|check|inspect|crease_by_(angle|smoothing_groups|uv_seams))'
obj='subdiv_(load|save|stream)_obj'

# without NAME FUNCTIONS FLAGS...
without() {
    name=without_$1
    functions=$2
    shift 2
    c $name "$@" $from/parts.c
    if command -v $CXX > $out/log; then
        step "$name in C++" $CXX -x c++ -std=c++11 $warn -I. "$@" -fsyntax-only $from/parts.c
    fi
    if nm $out/$name > $out/symbols 2> $out/log; then
        step "$name has none of it" sh -c "! grep -E ' _?$functions' $out/symbols"
    fi
}

without exact "$exact" -DSUBDIV_NO_EXACT
without tools "$tools" -DSUBDIV_NO_TOOLS
without obj "$obj" -DSUBDIV_NO_OBJ
least="-DSUBDIV_NO_EXACT -DSUBDIV_NO_TOOLS -DSUBDIV_NO_OBJ"
without all "($exact|$tools|$obj)" $least

# macros FLAGS...: prints what the header has defined and not undefined, apart from SUBDIV_...
macros() {
    printf '#define SUBDIV_IMPLEMENTATION\n#include "subdiv.h"\n' > $out/macros.c
    $CC -std=c99 -I. "$@" -E -dD $out/macros.c | awk '
        /^# [0-9]+ "/ { inside = $3 ~ /subdiv\.h"$/ }
        inside && /^#(define|undef) / { sub(/\(.*/, "", $2) }
        inside && /^#define / { defined[$2] = 1 }
        inside && /^#undef / { delete defined[$2] }
        END { for (name in defined) if (name !~ /^SUBDIV_/) { print name; left = 1 }; exit left }'
}

# All names are those of the public API.
if $CC -E -dD -x c /dev/null > $out/log 2>&1; then
    step "no private macro is left" macros
    step "nor without SIMD" macros -DSUBDIV_NO_SIMD
    step "nor of less" macros $least -DSUBDIV_NO_STDIO
fi

# The command line for Windows, where MinGW is installed.
mingw=x86_64-w64-mingw32-gcc
if command -v $mingw > $out/log; then
    step "the command line with MinGW" $mingw -std=c99 -Wall -Wextra -Wpedantic -Werror -I. \
        examples/subdiv_cli.c examples/cli/*.c examples/demo/render.c examples/demo/picture.c \
        -o $out/subdiv.exe
fi

more=
if command -v $CXX > $out/log; then
    step "cpp11 compiles" $CXX -std=c++11 $warn -I. $from/cpp11.cpp -o $out/cpp11 -lm
    step "cpp11 runs" $out/cpp11
    step "without_all compiles in C++" $CXX -x c++ -std=c++11 $warn -I. $least $from/parts.c \
        -o $out/without_all_cpp -lm
    step "without_all runs in C++" $out/without_all_cpp
    step "two_files in C and C++" $CXX -std=c++11 $warn -I. $from/two_files_b.cpp \
        $out/two_files_a.o -o $out/two_files_cpp -lm
    step "two_files in C and C++ runs" $out/two_files_cpp
    # What users of the declarations may have set besides; clang does not know all of it.
    for option in -Wold-style-cast -Wdouble-promotion -Wuseless-cast; do
        echo 'int main() { return 0; }' > $out/empty.cpp
        $CXX -Werror $option -fsyntax-only $out/empty.cpp 2> $out/log && more="$more $option"
    done
    step "the declarations under$more" $CXX -std=c++11 $warn $more -I. -fsyntax-only \
        $from/two_files_b.cpp
    step "the implementation under$more" $CXX -std=c++11 $warn $more -I. -fsyntax-only \
        $from/cpp11.cpp
else
    echo "no C++ compiler: the C++ programs are skipped"
fi

printf '%-24s %4d passed, %d failed\n' compile $passed $failed
[ $failed = 0 ]
