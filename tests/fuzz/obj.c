// Any bytes as an OBJ file. Read as a whole and in pieces of any size they give the same mesh or
// the same error; what was read is refined, written, and read again as the same mesh. What becomes
// of the text follows from a hash of it, so that the seeds are OBJ files.
//
//     clang -g -O1 -DLIBFUZZER -fsanitize=fuzzer,address,undefined -I. tests/fuzz/obj.c
//     cc -I. tests/fuzz/obj.c -o fuzz_obj -lm && ./fuzz_obj 300 tests/fuzz/seeds/obj/*

#include "fuzz.h"

static uint64_t state;                    // of a generator that begins with the hash

static size_t draw(size_t count)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (size_t)(state >> 33) % count;
}

typedef struct text {
    const uint8_t *bytes;
    size_t size, at, piece;               // piece: the most that one read hands out
    size_t left;                          // bytes until it fails
} text;

static size_t read_piece(void *user, void *to, size_t size)
{
    text *t = (text *)user;
    size_t count = 1 + draw(t->piece);
    REQUIRE(size > 0);
    if (count > size) count = size;
    if (count > t->size - t->at) count = t->size - t->at;
    if (count > t->left) return (size_t)-1;
    if (count) memcpy(to, t->bytes + t->at, count);
    t->at += count;
    t->left -= count;
    return count;
}

static size_t write_piece(void *user, const void *from, size_t size)
{
    text *t = (text *)user;
    if (size > t->left) return t->left;
    REQUIRE(size <= t->size - t->at && memcmp(t->bytes + t->at, from, size) == 0);
    t->at += size;
    t->left -= size;
    return size;
}

// Writes a mesh to memory of just the size that it takes.
static text save(const subdiv_mesh *mesh)
{
    subdiv_options opt = fresh_options();
    text t = { NULL, 0, 0, 0, SIZE_MAX };
    size_t size;
    REQUIRE(settled(subdiv_save_obj_memory(mesh, NULL, 0, &t.size, &opt)) && t.size);
    uint8_t *bytes = (uint8_t *)need(t.size);
    opt = fresh_options();
    REQUIRE(t.size == 1 || subdiv_save_obj_memory(mesh, bytes, 1 + draw(t.size - 1), &size, &opt) ==
            SUBDIV_ERROR_TOO_LARGE);
    REQUIRE(t.size == 1 || !settled(error.code));
    REQUIRE(settled(subdiv_save_obj_memory(mesh, bytes, t.size, &size, &opt)) && size == t.size);
    t.bytes = bytes;
    return t;
}

// How many face-vertices have UVs: all of a face or none.
static size_t count_uvs(const subdiv_mesh *mesh)
{
    size_t sum = mesh->uv_count ? face_vertex_sum(mesh) : 0, count = 0;
    for (size_t i = 0; i < sum; i++) count += mesh->face_uvs[i] >= 0;
    return count;
}

// Written and read again, a mesh is the same; but for its scheme and rule for vertices, which OBJ
// does not know, and UVs that no face has.
static void check_saved(const subdiv_mesh *mesh)
{
    subdiv_options opt = fresh_options();
    subdiv_mesh again;
    text t = save(mesh), short_text = t;
    memset(&again, 0x55, sizeof again);
    REQUIRE(settled_mesh(subdiv_load_obj_memory(&again, t.bytes, t.size, &opt), &again));
    size_t uvs = count_uvs(mesh);
    REQUIRE(error.warning_count == (uvs > 0 && uvs < face_vertex_sum(mesh)));
    subdiv_mesh same = *mesh;
    same.scheme = again.scheme;
    if (uvs == 0) same.uv_count = 0;
    REQUIRE(same_mesh(&again, &same));
    subdiv_mesh_free(&again);

    opt = fresh_options();
    short_text.left = draw(t.size + 1);
    int fits = short_text.left == t.size;
    REQUIRE(settled(subdiv_save_obj_callback(mesh, write_piece, &short_text, &opt)) == fits);
    REQUIRE(fits || error.code == SUBDIV_ERROR_IO);
    free((void *)t.bytes);
}

// Streamed, in one or more parts, a result has the text that it has as a mesh.
static void check_stream(const subdiv_mesh *cage, int levels, const subdiv_options *how)
{
    subdiv_options opt = *how;
    subdiv_surface *surface;
    subdiv_mesh fine;
    REQUIRE(settled(subdiv_prepare(&surface, cage, levels, &opt)));
    REQUIRE(settled_mesh(subdiv_surface_mesh(&fine, surface, cage->positions, &opt), &fine));
    text t = save(&fine);
    opt.part_count = (int)draw(4);
    do {
        REQUIRE(settled(subdiv_stream_obj_callback(surface, cage->positions, write_piece, &t,
                                                   &opt)));
    } while (++opt.part < opt.part_count);
    REQUIRE(t.at == t.size);
    free((void *)t.bytes);
    subdiv_mesh_free(&fine);
    subdiv_surface_free(surface);
}

static void refine(subdiv_mesh *cage)
{
    int levels = (int)draw(4);
    subdiv_options opt = fresh_options();
    subdiv_mesh fine;
    memset(&fine, 0x55, sizeof fine);
    if (!all_within(cage->uvs, 2 * (size_t)cage->uv_count, 1e35f)) return;
    if (cage->colors && !all_within(cage->colors, 3 * (size_t)cage->vertex_count, 1e35f)) return;
    while (levels && face_vertex_sum(cage) << 2 * levels > 10000) levels--;
    cage->scheme = (subdiv_scheme)draw(3);
    opt.triangulate = draw(4) > 0;
    opt.keep_holes = (int)draw(2);
    opt.limit = (int)draw(2);
    if (settled_mesh(subdiv_refine(&fine, cage, levels, &opt), &fine)) {
        check_saved(&fine);
        check_stream(cage, levels, &opt);
    } else REQUIRE(error.code == SUBDIV_ERROR_NOT_TRIANGLE && !opt.triangulate);
    subdiv_mesh_free(&fine);
}

// The writer keeps what sharpness means: none below 0, no more than forever.
static void clamp(float *sharpness, int count)
{
    for (int i = 0; i < count; i++) sharpness[i] = fmaxf(0, fminf(sharpness[i], SUBDIV_INFINITE));
}

// A read that fails before the end is an error, whatever came before it.
static void check_failing_read(text t)
{
    subdiv_options opt = fresh_options();
    subdiv_mesh mesh;
    memset(&mesh, 0x55, sizeof mesh);
    t.left = t.size ? draw(t.size) : 0;
    if (t.size == 0) return;
    REQUIRE(!settled_mesh(subdiv_load_obj_callback(&mesh, read_piece, &t, &opt), &mesh));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    subdiv_mesh mesh, pieces;
    subdiv_options opt = fresh_options();
    memset(&mesh, 0x55, sizeof mesh);
    memset(&pieces, 0x55, sizeof pieces);
    for (size_t i = state = 0; i < size; i++) state = (state ^ data[i]) * 1099511628211u;
    text t = { data, size, 0, 1 + draw(draw(2) ? 8 : 4096), SIZE_MAX };
    heap_most = 1u << 20 | size << 10;    // what memory a file takes is in proportion to it

    int fine = settled_mesh(subdiv_load_obj_memory(&mesh, data, size, &opt), &mesh);
    subdiv_error whole = error;
    check_failing_read(t);
    opt = fresh_options();
    REQUIRE(settled_mesh(subdiv_load_obj_callback(&pieces, read_piece, &t, &opt), &pieces) == fine);
    REQUIRE(memcmp(&whole, &error, sizeof error) == 0);
    REQUIRE(whole.code != SUBDIV_ERROR_MEMORY && whole.code != SUBDIV_ERROR_ARGUMENT);
    if (fine) {
        REQUIRE(same_mesh(&mesh, &pieces));
        heap_most = 1u << 28;
        clamp(mesh.crease_sharpness, mesh.crease_count);
        clamp(mesh.corner_sharpness, mesh.corner_count);
        check_saved(&mesh);
        refine(&mesh);
    }
    subdiv_mesh_free(&mesh);
    subdiv_mesh_free(&pieces);
    REQUIRE(heap_live == 0);
    return 0;
}

#include "replay.h"
