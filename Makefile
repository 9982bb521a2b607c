# make          build/subdiv, the command line
# make examples runs the numbered examples and compares what they print
# make demo     refines the cages of examples/cages: OBJ files and pictures in build/
# make gallery  the pictures of examples/README.md, in build/gallery
# make playground   build/playground.html, a page to play on: see examples/playground/build.sh
# make test     all tests; with a C++ compiler and libosd-dev also the comparison with OpenSubdiv
# make bench    speed and memory; with libosd-dev beside OpenSubdiv. MESHES="a.obj:5 b.obj:4:loop".
#               And how long it takes to compile; with libstb-dev beside stb_image.h
# make check    the header under every compiler, standard and sanitizer that is installed
# make platforms    the same bits on other platforms, with all cross compilers and emulators that
#               are installed
# make fuzz     the fuzzers under clang's sanitizers, each for SECONDS=60, with what they found before;
#               SEED=0 makes other inputs each time
# make coverage what the tests reach of the header, with gcc and gcov
# make mutate   what the tests notice of changes to the header; an hour or two
# make clean
#
# Every program here holds the implementation, as a user would write it, and compiles alone: its
# first comment says how. To save time, the implementation is compiled once, as an object, and
# SUBDIV_IMPLEMENTED leaves it out of the programs that are linked with that.

CC      ?= cc
CXX     ?= c++
CFLAGS  ?= -O2
WARN    = -Wall -Wextra -Wpedantic
FLAGS   = -std=c99 $(CFLAGS) $(WARN) -ffp-contract=off -I.
THREADS = -pthread
SHARED  = -DSUBDIV_IMPLEMENTED
OUT     = build

# On all cores, unless told otherwise by -j.
CORES   := $(shell nproc 2> /dev/null || getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)
ifeq ($(MAKELEVEL)$(filter -j% --jobserver%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(CORES)
endif

# Tests that look inside or bring an allocator compile the implementation themselves. The compiler
# takes longer for tests than they run, so they are optimised less.
TEST_FLAGS = $(subst -O2,-O1,$(FLAGS)) $(THREADS)
OWN      = evaluate memory exact obj_numbers
PLAIN    = doors tessellate stencils exact_oracle patches limit obj_read obj_write masks order invariants \
           recorded creases check errors uv partial_uvs vertex_rules normals threads stack \
           limits curves conventions locations buffers
TESTS    = $(OWN) $(PLAIN) growth
DRAWINGS = corner_cutting b_spline masks split valences boundary
RENDERINGS = sharpness features vertex_rules schemes limit reflection
GALLERY  = $(DRAWINGS) $(RENDERINGS)
SHOWING  = $(OUT)/gallery/gallery.o $(OUT)/gallery/render.o $(OUT)/gallery/picture.o
EXAMPLES = 00_lecture 01_hello 02_cube_by_hand 03_creases 04_uv_seams 05_animate \
           06_limit_normals 07_threads 08_tessellate 09_stencils 10_spines 11_gpu_buffer \
           12_usd_mesh 13_fit
HELPERS  = $(wildcard tests/lib/*.h)

all: $(OUT)/subdiv

# ------------------------------------------------------------------------- the implementation, once

$(OUT)/plain.o: subdiv.h | $(OUT)
	$(CC) $(FLAGS) -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o $@

$(OUT)/fast.o: subdiv.h | $(OUT)
	$(CC) $(FLAGS) -O3 -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o $@

$(OUT):
	mkdir -p $@

# --------------------------------------------------------------------------------------- examples

CLI = examples/subdiv_cli.c $(wildcard examples/cli/*.c) examples/demo/render.c \
      examples/demo/picture.c

$(OUT)/subdiv: $(CLI) $(OUT)/plain.o examples/cli/cli.h examples/demo/render.h
	$(CC) $(FLAGS) $(THREADS) $(SHARED) $(filter-out %.h,$^) -o $@ -lm

$(EXAMPLES:%=$(OUT)/%): $(OUT)/%: examples/%.c $(OUT)/plain.o
	$(CC) $(FLAGS) $(THREADS) $(SHARED) $^ -o $@ -lm

$(OUT)/make_cages: examples/demo/make_cages.c | $(OUT)
	$(CC) $(FLAGS) $< -o $@ -lm

$(OUT)/demo: examples/demo/demo.c examples/demo/render.c examples/demo/picture.c $(OUT)/plain.o \
             examples/demo/render.h
	$(CC) $(FLAGS) $(SHARED) $(filter-out %.h,$^) -o $@ -lm

examples: $(OUT)/examples.log $(OUT)/make_cages

demo: $(OUT)/demo
	$(OUT)/demo examples/cages $(OUT)

$(OUT)/gallery/gallery.o: examples/gallery/gallery.c examples/gallery/gallery.h
$(OUT)/gallery/render.o: examples/demo/render.c
$(OUT)/gallery/picture.o: examples/demo/picture.c
$(SHOWING): examples/demo/render.h
	@mkdir -p $(OUT)/gallery
	$(CC) $(FLAGS) -Iexamples/demo -c $(filter %.c,$^) -o $@

$(GALLERY:%=$(OUT)/gallery/%): $(OUT)/gallery/%: examples/gallery/%.c $(SHOWING) $(OUT)/plain.o
	$(CC) $(FLAGS) $(SHARED) $^ -o $@ -lm

$(OUT)/gallery/%.svg $(OUT)/gallery/%.png: $(OUT)/gallery/%
	$< $(OUT)/gallery

gallery: $(DRAWINGS:%=$(OUT)/gallery/%.svg) $(RENDERINGS:%=$(OUT)/gallery/%.png)

$(OUT)/playground.html: $(wildcard examples/playground/* examples/cages/*) subdiv.h
	sh examples/playground/build.sh $@

playground: $(OUT)/playground.html

# ------------------------------------------------------------------------------------------ tests

$(OWN:%=$(OUT)/test_%): $(OUT)/test_%: tests/test_%.c $(HELPERS) subdiv.h | $(OUT)
	$(CC) $(TEST_FLAGS) -DSUBDIV_STATIC $< -o $@ -lm

$(filter-out %_threads,$(PLAIN:%=$(OUT)/test_%)): $(OUT)/test_%: tests/test_%.c $(OUT)/plain.o \
		$(HELPERS)
	$(CC) $(TEST_FLAGS) $(SHARED) $< $(OUT)/plain.o -o $@ -lm

# With small jobs, so that small cages take several.
$(OUT)/test_threads: tests/test_threads.c $(OUT)/fuzzed.o $(HELPERS)
	$(CC) $(TEST_FLAGS) $(SHARED) $< $(OUT)/fuzzed.o -o $@ -lm

# Its implementation reports each block of code that runs, and what it copies and clears.
$(OUT)/counted.o: subdiv.h | $(OUT)
	$(CC) $(TEST_FLAGS) -fsanitize-coverage=trace-pc -U_FORTIFY_SOURCE -Dmemcpy=counted_memcpy \
		-Dmemset=counted_memset -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o $@

$(OUT)/test_growth: tests/test_growth.c $(OUT)/counted.o $(HELPERS)
	$(CC) $(FLAGS) $< $(OUT)/counted.o -o $@ -lm

# The fuzzers on their seeds and on mutations of these, with any compiler: see make fuzz.
FUZZERS      = $(patsubst tests/fuzz/%.c,%,$(wildcard tests/fuzz/*.c))
FUZZ_HELPERS = $(wildcard tests/fuzz/*.h) $(HELPERS)
MUTATIONS    = 1000

$(OUT)/fuzzed.o: subdiv.h tests/fuzz/heap.h | $(OUT)
	$(CC) $(FLAGS) -O0 -include tests/fuzz/heap.h -DSUBDIV_IMPLEMENTATION -x c -c subdiv.h -o $@

$(filter-out %differential,$(FUZZERS:%=$(OUT)/fuzz_%)): $(OUT)/fuzz_%: tests/fuzz/%.c \
		$(OUT)/fuzzed.o $(FUZZ_HELPERS)
	$(CC) $(FLAGS) -O0 $(SHARED) $< $(OUT)/fuzzed.o -o $@ -lm

$(OUT)/fuzz_differential: tests/fuzz/differential.c $(OUT)/plain.o $(FUZZ_HELPERS)
	$(CC) $(TEST_FLAGS) $(SHARED) $< $(OUT)/plain.o -o $@ -lm

$(OUT)/opensubdiv: $(wildcard tests/opensubdiv/*) $(OUT)/plain.o $(HELPERS)
	$(CXX) -std=c++14 $(CFLAGS) $(SHARED) -I. tests/opensubdiv/opensubdiv.cpp $(OUT)/plain.o \
		-o $@ -losdCPU

# What a test says goes to a log, so that several can run at once; it is shown when the test ends.
RUN = @sh tests/lib/run.sh $@

$(TESTS:%=$(OUT)/%.log): $(OUT)/%.log: $(OUT)/test_% FORCE
	$(RUN) $<

$(OUT)/fuzz_differential.log: MUTATIONS = 500
$(FUZZERS:%=$(OUT)/fuzz_%.log): $(OUT)/fuzz_%.log: $(OUT)/fuzz_% FORCE
	$(RUN) $< $(MUTATIONS) $(wildcard tests/fuzz/seeds/$*/*)

# Drawings take no time; all programs are compiled.
$(OUT)/gallery.log: $(GALLERY:%=$(OUT)/gallery/%) $(DRAWINGS:%=$(OUT)/gallery/%.svg) FORCE
	$(RUN) sh tests/gallery.sh $(DRAWINGS)

# The page, if make playground has built it.
$(OUT)/playground.log: $(OUT)/subdiv FORCE
	$(RUN) sh tests/playground.sh $(OUT)/playground.html $<

# Pages of --html, with what make playground has installed.
$(OUT)/viewer.log: $(OUT)/subdiv FORCE
	$(RUN) sh tests/viewer.sh $<

$(OUT)/cli.log: $(OUT)/subdiv FORCE
	$(RUN) sh tests/test_cli.sh $<

$(OUT)/plain.log $(OUT)/docs.log: $(OUT)/%.log: $(OUT)/plain.o FORCE
	$(RUN) env CC="$(CC)" CXX="$(CXX)" sh tests/$*.sh $<

$(OUT)/compile.log $(OUT)/edited.log: $(OUT)/%.log: FORCE | $(OUT)
	$(RUN) env CC="$(CC)" CXX="$(CXX)" sh tests/$*.sh

$(OUT)/examples.log: $(EXAMPLES:%=$(OUT)/%) FORCE
	$(RUN) sh tests/examples.sh $(EXAMPLES:%=$(OUT)/%)

$(OUT)/opensubdiv.log: $(OUT)/opensubdiv FORCE
	$(RUN) $< --continuity --random $(CAGES) tests/oracle/*.obj examples/cages/*.obj

# The longest first.
CAGES   ?= 1000
HAVE_OSD := $(shell printf '\043include <opensubdiv/far/primvarRefiner.h>\n' | \
              $(CXX) -x c++ -fsyntax-only - 2> /dev/null && echo yes)
ifeq ($(HAVE_OSD),yes)
TEST_LOGS = $(OUT)/opensubdiv.log
endif
TEST_LOGS += $(OUT)/compile.log $(OUT)/edited.log $(OUT)/docs.log $(TESTS:%=$(OUT)/%.log) \
             $(FUZZERS:%=$(OUT)/fuzz_%.log) $(OUT)/plain.log $(OUT)/cli.log $(OUT)/examples.log \
             $(OUT)/gallery.log $(OUT)/playground.log $(OUT)/viewer.log

test: $(TEST_LOGS) $(OUT)/make_cages
ifneq ($(HAVE_OSD),yes)
	@echo "The comparison with OpenSubdiv was SKIPPED: it needs a C++ compiler and libosd-dev."
endif
	@sh tests/lib/sum.sh $(TEST_LOGS)

# The sanitizers share the tests: those that take an implementation of their own go to the first
# compiler, the others to the last, of which clang also finds unsigned numbers that overflow and
# arithmetic on NULL: so that of wrong arguments is one of them. The sanitizers have a stack of their
# own.
COMPILERS := $(foreach c,gcc clang,$(if $(shell command -v $c 2> /dev/null),$c))
CHECK     = $(OUT)/check
SANITIZE  = -g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all
INTEGER   = -fsanitize=integer -fsanitize-ignorelist=tests/lib/integer.txt
SANITIZED_LOGS = $(MAKE) --no-print-directory logs
OWN_TESTS   = $(filter-out memory,$(OWN))
PLAIN_TESTS = memory $(filter-out exact_oracle stack,$(PLAIN))
SANITIZED = $(OWN_TESTS:%=$(CHECK)/own/%.log) $(PLAIN_TESTS:%=$(CHECK)/plain/%.log)
BITS      = $(COMPILERS) $(shell command -v tcc > /dev/null && echo tcc)
CHECK_LOGS = $(BITS:%=$(CHECK)/bits_%.log) $(CHECK)/growth.log $(COMPILERS:%=$(CHECK)/%.log) \
             $(CHECK)/threads.log $(CHECK)/lint.log

sanitize_own:
	@+$(SANITIZED_LOGS) OUT=$(CHECK)/own CC=$(firstword $(COMPILERS)) TESTS="$(OWN_TESTS)" \
		CFLAGS="$(SANITIZE)"

sanitize_plain:
	@+$(SANITIZED_LOGS) OUT=$(CHECK)/plain CC=$(lastword $(COMPILERS)) TESTS="$(PLAIN_TESTS)" \
		CFLAGS="$(SANITIZE) $(if $(filter clang,$(COMPILERS)),$(INTEGER))"

logs: $(TESTS:%=$(OUT)/%.log)

$(COMPILERS:%=$(CHECK)/%.log): $(CHECK)/%.log: FORCE
	$(RUN) sh tests/check.sh $*

$(CHECK)/threads.log: $(CHECK)/%.log: FORCE
	$(RUN) env CC="$(CC)" CXX="$(CXX)" sh tests/$*.sh

$(CHECK)/lint.log: FORCE | $(OUT)
	$(RUN) sh tests/lint.sh

$(OUT)/bits.txt: tests/bits.c $(OUT)/plain.o $(HELPERS)
	$(CC) $(FLAGS) $(SHARED) $< $(OUT)/plain.o -o $(OUT)/bits.exe -lm
	$(OUT)/bits.exe examples/cages/*.obj > $@

$(CHECK)/bits_%.log: $(OUT)/bits.txt FORCE
	$(RUN) sh tests/bits.sh $< $*

$(CHECK)/growth.log: $(OUT)/test_growth FORCE
	$(RUN) $< 11

check: $(CHECK_LOGS) sanitize_own sanitize_plain
	@sh tests/lib/sum.sh $(SANITIZED) $(CHECK_LOGS)

PLATFORMS = aarch64 armhf s390x i686 windows wasm32 wasm32-simd

platforms: $(PLATFORMS:%=$(CHECK)/bits_%.log)
	@sh tests/lib/sum.sh $^

# ------------------------------------------------------------------------------------------- fuzz

SECONDS   = 60
FUZZ      = $(OUT)/fuzz
FUZZ_CC   = clang -g -O1 -DLIBFUZZER -fno-sanitize-recover=all -I. -fsanitize=address,undefined
FUZZ_LOGS = $(FUZZERS:%=$(FUZZ)/%.log)

$(FUZZ)/subdiv.o: subdiv.h tests/fuzz/heap.h
	mkdir -p $(FUZZ)
	$(FUZZ_CC),fuzzer-no-link -fno-sanitize-coverage=trace-cmp -include tests/fuzz/heap.h -DSUBDIV_IMPLEMENTATION -x c -c $< -o $@

$(FUZZERS:%=$(FUZZ)/%): $(FUZZ)/%: tests/fuzz/%.c $(FUZZ)/subdiv.o $(FUZZ_HELPERS)
	$(FUZZ_CC),fuzzer $(SHARED) $< $(FUZZ)/subdiv.o -o $@ -lm

$(FUZZ_LOGS): $(FUZZ)/%.log: $(FUZZ)/% FORCE
	$(RUN) sh tests/fuzz/fuzz.sh $< $(SECONDS) $(wildcard tests/fuzz/seeds/$*)

fuzz: $(FUZZ_LOGS)
	@sh tests/lib/sum.sh $(FUZZ_LOGS)

# --------------------------------------------------------------------- what the tests are worth

# What the tests reach: lines, branches, and what they do not reach. gcc alone; functions that are
# forced inline are counted once.
COVER    = $(OUT)/coverage
COVERAGE = -O0 --coverage -Dalways_inline=unused "-DSUBDIV_ASSERT(c)="

coverage:
	@+$(MAKE) --no-print-directory logs $(COVER)/subdiv OUT=$(COVER) CC=gcc \
		CFLAGS='$(COVERAGE)' TESTS="$(OWN) $(PLAIN)"
	@sh tests/coverage/coverage.sh $(COVER)

# Are the tests good? Mutants of the header that no test notices. MUTANTS=n, SEED=n, JOBS=n.
mutate:
	@sh tests/mutate/mutate.sh

# ------------------------------------------------------------------------------------------ bench

BENCH = $(FLAGS) -O3 $(SHARED)

$(OUT)/bench: $(wildcard examples/bench/*) $(OUT)/fast.o
ifeq ($(HAVE_OSD),yes)
	$(CC) $(BENCH) -DBENCH_FLAGS='"-O3"' -DBENCH_PEER -c examples/bench/bench.c -o $@.o
	$(CXX) -std=c++14 -O3 $(WARN) -I. -c examples/bench/opensubdiv.cpp -o $@_opensubdiv.o
	$(CXX) $@.o $@_opensubdiv.o $(OUT)/fast.o -o $@ -losdCPU $(THREADS) -lm
else
	$(CC) $(BENCH) -DBENCH_FLAGS='"-O3"' examples/bench/bench.c $(OUT)/fast.o -o $@ $(THREADS) -lm
endif

$(OUT)/bench_obj: examples/bench/obj.c $(OUT)/fast.o
	$(CC) $(BENCH) $^ -o $@ -lm

bench: $(OUT)/bench $(OUT)/bench_obj
	$(OUT)/bench $(MESHES)
	$(OUT)/bench_obj
	sh examples/bench/compile.sh

clean:
	rm -rf $(OUT)

.PHONY: all demo gallery playground examples test logs check sanitize_own sanitize_plain platforms \
        fuzz coverage mutate bench clean FORCE
