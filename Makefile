# make          build/subdiv, the command line
# make demo     refines the cages of examples/cages: OBJ files and pictures in build/
# make test     all tests; with a C++ compiler and libosd-dev also the comparison with OpenSubdiv
# make bench    speed and memory; with libosd-dev beside OpenSubdiv. MESHES="a.obj:5 b.obj:4:loop"
# make check    the header under every compiler, standard and sanitizer that is installed
# make clean

CC      ?= cc
CXX     ?= c++
CFLAGS  ?= -O2
WARN    = -Wall -Wextra -Wpedantic
FLAGS   = -std=c99 $(CFLAGS) $(WARN) -ffp-contract=off -I.
THREADS = -pthread

TESTS    = masks order invariants patches evaluate limit exact stencils recorded creases check obj \
           errors uv partial_uvs tessellate exact_oracle memory
EXAMPLES = 01_hello 02_cube_by_hand 03_creases 04_uv_seams 05_animate 06_limit_normals \
           07_threads 08_tessellate 09_stencils 10_spines make_cages

all: build/subdiv

build/subdiv: examples/subdiv_cli.c subdiv.h | build
	$(CC) $(FLAGS) $(THREADS) $< -o $@ -lm

build/demo: examples/demo.c examples/render.c examples/picture.c examples/render.h subdiv.h | build
	$(CC) $(FLAGS) $(filter %.c,$^) -o $@ -lm

build/%: examples/%.c subdiv.h | build
	$(CC) $(FLAGS) $(THREADS) $< -o $@ -lm

build/test_%: tests/test_%.c $(wildcard tests/*.h) subdiv.h | build
	$(CC) $(FLAGS) $(THREADS) $< -o $@ -lm

build/opensubdiv: tests/opensubdiv.cpp $(wildcard tests/*.h) subdiv.h | build
	$(CXX) -std=c++14 $(CFLAGS) -I. $< -o $@ -losdCPU

# With OpenSubdiv where it is installed.
HAVE_OSD = $(shell printf '\043include <opensubdiv/far/primvarRefiner.h>\n' | \
             $(CXX) -x c++ -fsyntax-only - 2> /dev/null && echo yes)
BENCH    = -O3 -DBENCH_FLAGS='"-O3"' examples/bench.c

build/bench: examples/bench.c examples/bench.h examples/bench_opensubdiv.cpp subdiv.h | build
ifeq ($(HAVE_OSD),yes)
	$(CC) $(FLAGS) -DBENCH_PEER $(BENCH) -c -o build/bench.o
	$(CXX) -std=c++14 -O3 $(WARN) -I. -c examples/bench_opensubdiv.cpp -o build/bench_opensubdiv.o
	$(CXX) build/bench.o build/bench_opensubdiv.o -o $@ -losdCPU $(THREADS) -lm
else
	$(CC) $(FLAGS) $(BENCH) -o $@ $(THREADS) -lm
endif

build/bench_obj: examples/bench_obj.c subdiv.h | build
	$(CC) $(FLAGS) -O3 $< -o $@ -lm

build:
	mkdir -p build

demo: build/demo
	build/demo examples/cages build

examples: $(EXAMPLES:%=build/%)

test: build/subdiv examples $(TESTS:%=build/test_%)
	CC="$(CC)" CXX="$(CXX)" sh tests/run.sh $(TESTS:%=build/test_%)

bench: build/bench build/bench_obj
	build/bench $(MESHES)
	build/bench_obj

check:
	sh tests/check.sh

clean:
	rm -rf build

.PHONY: all demo examples test bench check clean
