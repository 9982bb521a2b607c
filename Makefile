# make          build/subdiv, the command line
# make demo     refines the cages of examples/cages: OBJ files and pictures in build/
# make test     all tests; with a C++ compiler and libosd-dev also the comparison with OpenSubdiv
# make check    the header under every compiler, standard and sanitizer that is installed
# make clean

CC      ?= cc
CXX     ?= c++
CFLAGS  ?= -O2
WARN    = -Wall -Wextra -Wpedantic
FLAGS   = -std=c99 $(CFLAGS) $(WARN) -I.

TESTS    = masks order invariants recorded obj errors memory
EXAMPLES = 01_hello 02_cube_by_hand 03_creases make_cages

all: build/subdiv

build/subdiv: examples/subdiv_cli.c subdiv.h | build
	$(CC) $(FLAGS) $< -o $@ -lm

build/demo: examples/demo.c examples/render.c examples/picture.c examples/render.h subdiv.h | build
	$(CC) $(FLAGS) $(filter %.c,$^) -o $@ -lm

build/%: examples/%.c subdiv.h | build
	$(CC) $(FLAGS) $< -o $@ -lm

build/test_%: tests/test_%.c $(wildcard tests/*.h) subdiv.h | build
	$(CC) $(FLAGS) $< -o $@ -lm

build/opensubdiv: tests/opensubdiv.cpp $(wildcard tests/*.h) subdiv.h | build
	$(CXX) -std=c++14 $(CFLAGS) -I. $< -o $@ -losdCPU

build:
	mkdir -p build

demo: build/demo
	build/demo examples/cages build

examples: $(EXAMPLES:%=build/%)

test: build/subdiv examples $(TESTS:%=build/test_%)
	CC="$(CC)" CXX="$(CXX)" sh tests/run.sh $(TESTS:%=build/test_%)

check:
	sh tests/check.sh

clean:
	rm -rf build

.PHONY: all demo examples test check clean
