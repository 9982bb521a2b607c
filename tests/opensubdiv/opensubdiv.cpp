// Compares subdiv_refine with OpenSubdiv, level by level: the faces and their order, the holes, the
// map to the cage, the sharpness that is left, the positions, UVs, and up to level 3 the limit.
// Needs libosd-dev.
//
//     c++ -std=c++14 -O2 -I. tests/opensubdiv/opensubdiv.cpp -o build/opensubdiv -losdCPU
//
//     opensubdiv [--continuity] [--random N] [--seed S] [--levels a-b]
//                [--scheme catmull-clark|loop|bilinear] [file.obj ...]
//     opensubdiv --record DIR
//
// A file's scheme is that of its name, loop_ or bilinear_ in front, unless --scheme says otherwise.
// Each file is compared as it is and with every other boundary, creasing and triangle rule in turn.
// --continuity prints how smooth both are at extraordinary vertices. --record writes what OpenSubdiv
// makes of the cages in DIR, for tests/test_recorded.c.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <opensubdiv/version.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "../lib/order.h"
#include "../lib/random_cage.h"
#include "../lib/test.h"
#include "continuity.h"
#include "limit.h"
#include "reference.h"
#include "result.h"

static const long long largest_result = 2000000;  // faces

// -------------------------------------------------------------------------------------- Cages

static void compare_level(const Reference &ref, const subdiv_mesh &cage, int l, bool keep_holes)
{
    subdiv_mesh fine = {};
    subdiv_error error = {};
    subdiv_options opt = {};
    order o;
    opt.keep_holes = keep_holes;
    opt.error = &error;
    if (!order_make(&o, &cage, l, keep_holes ? nullptr : ref.hidden.data()))
        TEST_REPORT("no memory");
    else if (subdiv_refine(&fine, &cage, l, &opt))
        TEST_REPORT("subdiv_refine fails: %s", error.message);
    else
        compare_result(ref, o, l, fine, keep_holes);
    if (!test_bad && l <= 3) compare_limit(ref, o, l, cage);
    if (test_bad) printf("    at level %d%s\n", l, keep_holes ? ", holes kept" : "");
    order_free(&o);
    subdiv_mesh_free(&fine);
}

// All levels of one cage, which counts as one test. Even levels keep the faces of holes.
static void compare_cage(const subdiv_mesh &cage, int first, int last, const std::string &name)
{
    Reference ref;
    test_bad = 0;
    test_context = name.c_str();
    if (const char *reason = make_reference(ref, cage, last)) {
        totals.skips[reason]++;
        return;
    }
    totals.cages++;
    totals.hidden += std::count(ref.hidden.begin(), ref.hidden.end(), 1);
    totals.put_right += ref.put_right;
    totals.blocked += ref.blocked;
    for (int l = first; l <= last && !test_bad; l++) compare_level(ref, cage, l, l % 2 == 0);
    if (test_bad) test_failed++;
    else test_passed++;
}

static const char *file_part(const std::string &path)
{
    const size_t slash = path.find_last_of('/');
    return path.c_str() + (slash == std::string::npos ? 0 : slash + 1);
}

static subdiv_scheme scheme_of_name(const std::string &path)
{
    if (strncmp(file_part(path), "loop_", 5) == 0) return SUBDIV_LOOP;
    if (strncmp(file_part(path), "bilinear_", 9) == 0) return SUBDIV_BILINEAR;
    return SUBDIV_CATMULL_CLARK;
}

static bool load(subdiv_mesh &cage, const std::string &path)
{
    subdiv_error error = {};
    subdiv_options opt = {};
    opt.error = &error;
    if (subdiv_load_obj(&cage, path.c_str(), &opt)) {
        printf("%s\n", error.message);
        return false;
    }
    return true;
}

// The levels that keep the result in bounds.
static int last_level(const subdiv_mesh &cage, int last)
{
    long long faces = cage.face_count;
    int level = 0;
    while (level < last && faces * 4 <= largest_result) {
        faces *= 4;
        level++;
    }
    return level;
}

static void compare_file(const std::string &path, int scheme, int first, int last)
{
    subdiv_mesh cage = {};
    if (!load(cage, path)) {
        test_failed++;
        return;
    }
    cage.scheme = scheme >= 0 ? (subdiv_scheme)scheme : scheme_of_name(path);
    last = last_level(cage, last);
    compare_cage(cage, first, last, path);
    const subdiv_mesh original = cage;
    for (int b = 0; b < 3; b++) {
        cage.boundary = (subdiv_boundary)b;
        if (cage.boundary != original.boundary)
            compare_cage(cage, first, last, path + ", boundary " + std::to_string(b));
    }
    cage.boundary = original.boundary;
    cage.creasing = original.creasing == SUBDIV_CREASING_CHAIKIN ? SUBDIV_CREASING_UNIFORM
                                                                 : SUBDIV_CREASING_CHAIKIN;
    if (cage.crease_count)
        compare_cage(cage, first, last, path + ", creasing " + std::to_string(cage.creasing));
    cage.creasing = original.creasing;
    cage.triangles = original.triangles == SUBDIV_TRIANGLES_SMOOTH ? SUBDIV_TRIANGLES_CATMULL_CLARK
                                                                   : SUBDIV_TRIANGLES_SMOOTH;
    if (cage.scheme == SUBDIV_CATMULL_CLARK)
        compare_cage(cage, first, last, path + ", triangles " + std::to_string(cage.triangles));
    cage.triangles = original.triangles;
    for (int r = SUBDIV_UV_CORNERS_ONLY; r <= SUBDIV_UV_NONE && cage.uv_count; r++) {
        cage.uv_rule = (subdiv_uv_rule)r;
        compare_cage(cage, first, last, path + ", UV rule " + std::to_string(r));
    }
    subdiv_mesh_free(&cage);
}

static void compare_random(unsigned seed, int first, int last)
{
    random_cage *random = random_cage_new(seed, RANDOM_ALL);
    if (!random) {
        test_failed++;
        return;
    }
    compare_cage(random->mesh, first, last, "seed " + std::to_string(seed));
    random_cage_free(random);
}

// ---------------------------------------------------------------------------------- Recording

static const int recorded_level = 2;

static void write_record(FILE *file, const Reference &ref, const subdiv_mesh &cage)
{
    order o;
    CHECK(order_make(&o, &cage, recorded_level, ref.hidden.data()));
    const std::vector<int> ours = match_vertices(ref, o, recorded_level);
    const Level &level = ref.levels[(size_t)recorded_level];
    std::vector<Point> points(ours.size());
    for (size_t v = 0; v < ours.size(); v++) points[(size_t)ours[v]] = level.points[v];

    fprintf(file, "vertices %zu\n", points.size());
    for (const Point &q : points) fprintf(file, "%.9g %.9g %.9g\n", q.p[0], q.p[1], q.p[2]);
    const Creases creases = their_creases(ref, recorded_level, ours, false);
    fprintf(file, "creases %zu\n", creases.size());
    for (const auto &c : creases)
        fprintf(file, "%d %d %.9g\n", c.first.first, c.first.second, (double)c.second);
    const Corners corners = their_corners(ref, recorded_level, ours);
    fprintf(file, "corners %zu\n", corners.size());
    for (const auto &c : corners) fprintf(file, "%d %.9g\n", c.first, (double)c.second);
    fprintf(file, "hidden %d\n", (int)std::count(ref.hidden.begin(), ref.hidden.end(), 1));
    for (size_t f = 0; f < ref.hidden.size(); f++)
        if (ref.hidden[f]) fprintf(file, "%zu\n", f);

    std::vector<Point> t1, t2;
    const Level limit = find_limit(*ref.refiner, level.points, recorded_level, cage.scheme, t1, t2);
    for (size_t v = 0; v < ours.size(); v++) {
        points[(size_t)ours[v]] = limit.points[v];
        if (cage.scheme != SUBDIV_BILINEAR && fades(ref.refiner->GetLevel(recorded_level), (int)v))
            for (double &x : points[(size_t)ours[v]].p) x = NAN;
    }
    fprintf(file, "limit %zu\n", points.size());
    for (const Point &q : points) fprintf(file, "%.9g %.9g %.9g\n", q.p[0], q.p[1], q.p[2]);
    order_free(&o);
}

static bool record_cage(const std::string &directory, const std::string &name)
{
    subdiv_mesh cage = {};
    Reference ref;
    if (!load(cage, directory + "/" + name + ".obj")) return false;
    cage.scheme = scheme_of_name(name);
    test_context = name.c_str();
    bool done = !make_reference(ref, cage, recorded_level) && ref.put_right == 0;
    FILE *file = done ? fopen((directory + "/" + name + ".txt").c_str(), "w") : nullptr;
    if (file) write_record(file, ref, cage);
    done = file && fclose(file) == 0 && !test_bad;
    if (!done) printf("%s: not recorded\n", name.c_str());
    subdiv_mesh_free(&cage);
    return done;
}

// DIR/list.txt names the cages, one a line.
static int record(const std::string &directory)
{
    FILE *list = fopen((directory + "/list.txt").c_str(), "r");
    char name[64];
    int count = 0;
    bool done = list != nullptr;
    while (done && fscanf(list, "%63s", name) == 1) {
        done = record_cage(directory, name);
        count += done;
    }
    if (list) fclose(list);
    printf("%d cages recorded from OpenSubdiv %d.%d.%d\n", count, OPENSUBDIV_VERSION_MAJOR,
           OPENSUBDIV_VERSION_MINOR, OPENSUBDIV_VERSION_PATCH);
    return !done;
}

// --------------------------------------------------------------------------------------- main

static void ignore_warning(const char *)
{
}

static int usage(void)
{
    printf("opensubdiv [--continuity] [--random N] [--seed S] [--levels a-b] "
           "[--scheme catmull-clark|loop|bilinear] [file.obj ...]\n"
           "opensubdiv --record DIR\n");
    return 2;
}

static int report(void)
{
    printf("%lld cages compared: %lld vertices, %lld faces, %lld creases, %lld corners, %lld faces hidden, "
           "largest error %.3g of the extent\n", totals.cages, totals.vertices,
           totals.faces, totals.creases, totals.corners, totals.hidden, totals.largest_error);
    printf("%lld limit points, largest error %.3g of the extent; %lld that fade or are darts, where "
           "OpenSubdiv's differ; %lld normals, %lld beside creases where OpenSubdiv's differ or are "
           "not to be had; %lld are 0\n", totals.limit_points, totals.largest_limit_error,
           totals.fading_limits, totals.limit_normals, totals.odd_sides, totals.no_normals);
    printf("%lld edge points of OpenSubdiv put right, Chaikin weights above 1; %lld vertices that "
           "it is told are sharp\n", totals.put_right, totals.blocked);
    for (const auto &skip : totals.skips)
        printf("skipped: %ld %s\n", skip.second, skip.first.c_str());
    return test_end("opensubdiv");
}

int main(int argc, char **argv)
{
    const char *schemes[] = { "catmull-clark", "loop", "bilinear" };
    int random_count = 0, scheme = -1, first = 0, last = 0;
    unsigned seed = 1;
    bool continuity = false;
    std::vector<std::string> files;
    Far::SetWarningCallback(ignore_warning);
    for (int i = 1; i < argc; i++) {
        const std::string arg = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
        if (arg.compare(0, 2, "--") != 0) {
            files.push_back(arg);
            continue;
        }
        if (arg == "--continuity") {
            continuity = true;
            continue;
        }
        if (arg == "--record") {
            return record(value);
        } else if (arg == "--random") {
            random_count = atoi(value.c_str());
        } else if (arg == "--seed") {
            seed = (unsigned)strtoul(value.c_str(), nullptr, 10);
        } else if (arg == "--levels") {
            if (sscanf(value.c_str(), "%d-%d", &first, &last) != 2 || first < 1 || last < first)
                return usage();
        } else if (arg == "--scheme") {
            for (int k = 0; k < 3; k++) if (value == schemes[k]) scheme = k;
            if (scheme < 0) return usage();
        } else {
            return usage();
        }
        i++;
    }
    if (random_count == 0 && files.empty() && !continuity) return usage();
    if (continuity) compare_continuity();
    for (int k = 0; k < random_count; k++)
        compare_random(seed + (unsigned)k, first ? first : 1, last ? last : 3);
    for (const std::string &path : files)
        compare_file(path, scheme, first ? first : 1, last ? last : 4);
    return report();
}
