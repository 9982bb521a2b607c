// A picture: its backdrop, its text, and the PNG file it becomes.
#include "render.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float paper[3] = {0.9647f, 0.9569f, 0.9412f};

int render_picture_new(render_picture *picture, int width, int height)
{
    picture->width = width;
    picture->height = height;
    picture->rgb = malloc(3 * sizeof(float) * (size_t)width * (size_t)height);
    if (!picture->rgb) return 0;
    for (int i = 0; i < 3 * width * height; i++) picture->rgb[i] = paper[i % 3];
    return 1;
}

void render_picture_free(render_picture *picture)
{
    free(picture->rgb);
    picture->rgb = NULL;
}

// ---------------------------------------------------------------------------------- text

// A glyph is a few strokes; a stroke is a control polygon: a list of x, y on a grid with the
// baseline at y = 2, small letters up to 6, tall ones up to 8. Corner cutting rounds it. Where a
// point stands twice it stays sharp; a stroke that ends where it began is closed.
static const char *const glyphs[] = {
    "a 0232360602 3632", "b 0232360602 0802", "c 353606023233", "d 0232360602 3832",
    "e 04343436060232", "f 281812 0626", "g 0232360602 363000", "h 0802 04063632",
    "i 0602 0808", "j 161000 1818", "k 0802 36040432", "l 0802", "m 0602 04062622 24264642",
    "n 0602 04063632", "o 0232360602", "p 0232360602 0600", "q 0232360602 3630", "r 0602 040626",
    "s 360604343202", "t 181232 0626", "u 06023234 3632", "v 06222246", "w 06121226263232 3246",
    "x 0632 0236", "y 06023234 363000", "z 0636360232", "- 0434", ". 0202", ", 1201",
    "0 0232380802", "1 06181812", "2 0708383502020232", "3 08383515 15353202", "4 28040434 2522",
    "5 380808050535320202", "6 380803 0232350502", "7 08383812", "8 0535380805 0232350502",
    "9 373202 0535380805", "C 373808023233", "D 02023238080802", "L 08020232", "S 380805353202"
};

enum { MAX_POINTS = 128 };        // of a stroke after three rounds of corner cutting

// One round of corner cutting: the subdivision of a curve. Returns the new number of points.
static int cut_corners(float (*p)[2], int count, int closed)
{
    float q[MAX_POINTS][2];
    int n = 0;
    for (int i = 0; i + 1 < count; i++) {
        for (int k = 0; k < 2; k++) {
            int keep_start = !closed && i == 0, keep_end = !closed && i + 2 == count;
            q[n][k] = keep_start ? p[i][k] : 0.75f * p[i][k] + 0.25f * p[i + 1][k];
            q[n + 1][k] = keep_end ? p[i + 1][k] : 0.25f * p[i][k] + 0.75f * p[i + 1][k];
        }
        n += 2;
    }
    if (closed) memcpy(q[n++], q[0], sizeof q[0]);
    memcpy(p, q, (size_t)n * sizeof *q);
    return n;
}

// Darkens the pixels near the segment from a to b.
static void ink(render_picture *picture, const float *a, const float *b, float thickness)
{
    float dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy + 1e-9f;
    int x0 = (int)(fminf(a[0], b[0]) - 2), x1 = (int)(fmaxf(a[0], b[0]) + 2);
    int y0 = (int)(fminf(a[1], b[1]) - 2), y1 = (int)(fmaxf(a[1], b[1]) + 2);
    for (int y = y0 < 0 ? 0 : y0; y <= y1 && y < picture->height; y++) {
        for (int x = x0 < 0 ? 0 : x0; x <= x1 && x < picture->width; x++) {
            float px = (float)x - a[0], py = (float)y - a[1];
            float s = fmaxf(0, fminf(1, (px * dx + py * dy) / length2));
            float ex = px - s * dx, ey = py - s * dy;
            float cover = fmaxf(0, fminf(1, thickness / 2 + 0.5f - sqrtf(ex * ex + ey * ey)));
            float *pixel = picture->rgb + 3 * (y * picture->width + x);
            for (int k = 0; k < 3; k++) pixel[k] = fminf(pixel[k], paper[k] - 0.66f * cover);
        }
    }
}

// Draws one stroke if picture is given. Returns the largest x of its control points.
static float stroke(render_picture *picture, const char *text, int length, float x, float y,
                    float unit)
{
    float p[MAX_POINTS][2], widest = 0;
    int count = length / 2;
    for (int i = 0; i < count; i++) {
        widest = fmaxf(widest, (float)(text[2 * i] - '0'));
        p[i][0] = x + unit * (float)(text[2 * i] - '0');
        p[i][1] = y - unit * (float)(text[2 * i + 1] - '2');
    }
    int closed = count > 2 && !memcmp(p[0], p[count - 1], sizeof p[0]);
    for (int i = 0; i < 3; i++) count = cut_corners(p, count, closed);
    for (int i = 0; i + 1 < count && picture; i++) ink(picture, p[i], p[i + 1], 0.75f * unit);
    return widest;
}

static float text_line(render_picture *picture, float x, float y, float unit, const char *text)
{
    for (; *text; text++) {
        float widest = *text == ' ' ? 1.2f : 0;
        for (size_t g = 0; g < sizeof glyphs / sizeof *glyphs; g++) {
            if (glyphs[g][0] != *text) continue;
            for (const char *s = glyphs[g] + 1; *s; ) {
                int length = (int)strcspn(++s, " ");
                widest = fmaxf(widest, stroke(picture, s, length, x, y, unit));
                s += length;
            }
        }
        x += unit * (widest + 1.7f);
    }
    return x;
}

void render_text(render_picture *picture, float x, float y, float size, const char *text)
{
    float unit = size / 6, width = text_line(NULL, 0, 0, unit, text) - 1.7f * unit;
    text_line(picture, x - width / 2, y, unit, text);
}

// ------------------------------------------------------------------ PNG: bytes and checksums

typedef struct bytes { unsigned char *data; size_t size, room; int failed; } bytes;

static void put(bytes *b, unsigned value)
{
    if (b->size == b->room) {
        size_t room = b->room ? 2 * b->room : 4096;
        unsigned char *data = realloc(b->data, room);
        if (!data) { b->failed = 1; return; }
        b->data = data;
        b->room = room;
    }
    b->data[b->size++] = (unsigned char)(value & 255);
}

static void put32(bytes *b, unsigned long value)
{
    for (int shift = 24; shift >= 0; shift -= 8) put(b, (unsigned)(value >> shift & 255));
}

static unsigned long crc32_of(const unsigned char *data, size_t size)
{
    unsigned long crc = 0xffffffffUL;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int k = 0; k < 8; k++) crc = crc & 1 ? crc >> 1 ^ 0xedb88320UL : crc >> 1;
    }
    return crc ^ 0xffffffffUL;
}

static unsigned long adler32_of(const unsigned char *data, size_t size)
{
    unsigned long a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

static void put_chunk(bytes *b, const char *type, const unsigned char *data, size_t size)
{
    put32(b, (unsigned long)size);
    size_t start = b->size;
    for (int i = 0; i < 4; i++) put(b, (unsigned)type[i]);
    for (size_t i = 0; i < size; i++) put(b, data[i]);
    if (!b->failed) put32(b, crc32_of(b->data + start, b->size - start));
}

// ---------------------------------------------------------------------------- PNG: deflate

// Blocks of dynamic Huffman codes [RFC 1951]. A token is a literal byte, or a copy: its
// length + 512 * its distance.
enum { LITERALS = 286, DISTANCES = 30, MAX_CODE = 15, WINDOW = 32768, HASH = 1 << 15,
       BLOCK = 1 << 15 };             // tokens in a block

static const int length_base[] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43,
                                  51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258, 259};
static const int length_bits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4,
                                  4, 4, 5, 5, 5, 5, 0};
static const int distance_base[] = {1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257,
                                    385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289,
                                    16385, 24577, 32769};
static const int distance_bits[] = {0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9,
                                    9, 10, 10, 11, 11, 12, 12, 13, 13};

typedef struct coder { bytes *out; unsigned long bits; int count; } coder;

static void put_bits(coder *c, unsigned value, int count)
{
    c->bits |= (unsigned long)value << c->count;
    for (c->count += count; c->count >= 8; c->count -= 8, c->bits >>= 8) {
        put(c->out, (unsigned)(c->bits & 255));
    }
}

static int slot_of(const int *base, int value)
{
    int slot = 0;
    while (base[slot + 1] <= value) slot++;
    return slot;
}

// Code lengths from frequencies: joins the two rarest trees until one is left. If a code comes out
// too long, the frequencies are levelled and it starts again.
static void code_lengths(int *length, const long *frequency, int count)
{
    long weight[LITERALS];
    int tree[LITERALS], longest = MAX_CODE + 1;
    for (int flatten = 0; longest > MAX_CODE; flatten++) {
        longest = 0;
        for (int i = 0; i < count; i++) {
            weight[i] = frequency[i] ? (frequency[i] >> flatten) + 1 : 0;
            tree[i] = i;
            length[i] = 0;
        }
        for (;;) {
            int a = -1, b = -1;       // the rarest and the second rarest
            for (int i = 0; i < count; i++) {
                if (!weight[i]) continue;
                if (a < 0 || weight[i] < weight[a]) { b = a; a = i; }
                else if (b < 0 || weight[i] < weight[b]) b = i;
            }
            if (b < 0) break;
            weight[a] += weight[b];
            weight[b] = 0;
            for (int i = 0; i < count; i++) {
                if (tree[i] == b) tree[i] = a;
                else if (tree[i] != a) continue;
                if (frequency[i] && ++length[i] > longest) longest = length[i];
            }
        }
    }
}

// The canonical codes of these lengths, each with its bits turned around, as deflate sends them.
static void make_codes(unsigned *code, const int *length, int count)
{
    unsigned next = 0;
    for (int bits = 1; bits <= MAX_CODE; bits++, next <<= 1) {
        for (int i = 0; i < count; i++) {
            if (length[i] != bits) continue;
            code[i] = 0;
            for (int k = 0; k < bits; k++) code[i] |= (next >> k & 1) << (bits - 1 - k);
            next++;
        }
    }
}

// Replaces repetitions by copies. Returns the number of tokens.
static size_t make_tokens(int *tokens, const unsigned char *data, int size, int *head, int *chain)
{
    size_t count = 0;
    for (int i = 0; i < HASH; i++) head[i] = -1;
    for (int i = 0, ahead = 0; i < size; i++) {
        int best = 0, distance = 0;
        if (i + 3 > size) { if (i >= ahead) tokens[count++] = data[i]; continue; }
        unsigned hash = (data[i] * 2654435761U + data[i + 1] * 40503U + data[i + 2] * 69069U);
        int *slot = head + (hash >> 7) % HASH, tries = 24;
        for (int j = *slot; i >= ahead && j >= 0 && i - j < WINDOW && tries-- > 0;
             j = chain[j % WINDOW]) {
            int n = 0;
            while (n < 258 && i + n < size && data[i + n] == data[j + n]) n++;
            if (n > best) { best = n; distance = i - j; }
            if (n == 258) break;
        }
        chain[i % WINDOW] = *slot;
        *slot = i;
        if (i < ahead) continue;
        ahead = i + (best > 3 ? best : 1);
        tokens[count++] = best > 3 ? best + 512 * distance : data[i];
    }
    return count;
}

static void put_block(coder *c, const int *tokens, size_t count, int last)
{
    long frequency[LITERALS] = {0}, distances[DISTANCES] = {1, 1};   // at least two codes
    int lengths[LITERALS + DISTANCES];
    unsigned codes[LITERALS], distance_codes[DISTANCES];
    frequency[256] = 1;
    for (size_t i = 0; i < count; i++) {
        int copied = tokens[i] % 512, distance = tokens[i] / 512;
        frequency[distance ? 257 + slot_of(length_base, copied) : tokens[i]]++;
        if (distance) distances[slot_of(distance_base, distance)]++;
    }
    code_lengths(lengths, frequency, LITERALS);
    code_lengths(lengths + LITERALS, distances, DISTANCES);
    make_codes(codes, lengths, LITERALS);
    make_codes(distance_codes, lengths + LITERALS, DISTANCES);
    put_bits(c, last ? 5 : 4, 3);     // with dynamic codes
    put_bits(c, LITERALS - 257, 5);
    put_bits(c, DISTANCES - 1, 5);
    put_bits(c, 15, 4);
    for (int i = 0; i < 19; i++) put_bits(c, i < 3 ? 0 : 4, 3);   // a length 0 to 15 takes 4 bits,
    for (int i = 0; i < LITERALS + DISTANCES; i++) {              // itself, turned around
        unsigned n = (unsigned)lengths[i];
        put_bits(c, (n & 1) << 3 | (n & 2) << 1 | (n & 4) >> 1 | n >> 3, 4);
    }
    for (size_t i = 0; i <= count; i++) {
        int copied = i < count ? tokens[i] % 512 : 0, distance = i < count ? tokens[i] / 512 : 0;
        int symbol = i == count ? 256 : distance ? 257 + slot_of(length_base, copied) : tokens[i];
        put_bits(c, codes[symbol], lengths[symbol]);
        if (!distance) continue;
        int s = slot_of(length_base, copied), d = slot_of(distance_base, distance);
        put_bits(c, (unsigned)(copied - length_base[s]), length_bits[s]);
        put_bits(c, distance_codes[d], lengths[LITERALS + d]);
        put_bits(c, (unsigned)(distance - distance_base[d]), distance_bits[d]);
    }
}

static void compress(bytes *out, const unsigned char *data, size_t size)
{
    int *tokens = calloc(size + 1, sizeof *tokens), *tables = calloc(HASH + WINDOW, sizeof *tables);
    coder c = {out, 0, 0};
    out->failed |= !tokens || !tables;
    if (!out->failed) {
        put(out, 0x78);
        put(out, 0x01);
        size_t count = make_tokens(tokens, data, (int)size, tables, tables + HASH);
        for (size_t i = 0, n; i < count; i += n) {
            n = count - i < BLOCK ? count - i : BLOCK;
            put_block(&c, tokens + i, n, i + n == count);
        }
        put_bits(&c, 0, 7);           // fills the last byte
        put32(out, adler32_of(data, size));
    }
    free(tokens);
    free(tables);
}

// ------------------------------------------------------------------------------ PNG: file

// Filter 4 of PNG: the neighbour that is nearest to left + above - upper left.
static int paeth(int left, int above, int corner)
{
    int a = abs(above - corner), b = abs(left - corner), c = abs(left + above - 2 * corner);
    return a <= b && a <= c ? left : b <= c ? above : corner;
}

static unsigned char *filtered(const render_picture *picture, size_t *size)
{
    int row = 3 * picture->width;
    unsigned char *above = calloc((size_t)row + 3, 2), *here = above ? above + row + 3 : NULL;
    *size = (size_t)picture->height * ((size_t)row + 1);
    unsigned char *result = malloc(*size), *out = result;
    for (int y = 0; y < picture->height && above && result; y++) {
        const float *rgb = picture->rgb + y * row;
        *out++ = 4;
        for (int i = 0; i < row; i++) {       // the first three bytes stand left of the picture
            float value = fmaxf(0, fminf(1, rgb[i]));
            here[i + 3] = (unsigned char)(2 * (int)(value * 127 + 0.5f));   // 7 bits: 1/6 smaller
            *out++ = (unsigned char)(here[i + 3] - paeth(here[i], above[i + 3], above[i]));
        }
        memcpy(above, here, (size_t)row + 3);
    }
    if (!above) { free(result); result = NULL; }
    free(above);
    return result;
}

int render_write_png(const render_picture *picture, FILE *stream)
{
    static const unsigned char signature[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10};
    bytes file = {0}, header = {0}, body = {0};
    size_t size = 0;
    unsigned char *data = filtered(picture, &size);
    file.failed = !data;
    for (int i = 0; i < 8; i++) put(&file, signature[i]);
    put32(&header, (unsigned long)picture->width);
    put32(&header, (unsigned long)picture->height);
    put32(&header, 0x08020000UL);     // 8 bits, RGB, deflate
    put(&header, 0);
    if (data) compress(&body, data, size);
    put_chunk(&file, "IHDR", header.data, header.size);
    put_chunk(&file, "IDAT", body.data, body.size);
    put_chunk(&file, "IEND", NULL, 0);
    int ok = !file.failed && !header.failed && !body.failed;
    ok = ok && fwrite(file.data, 1, file.size, stream) == file.size;
    free(file.data);
    free(header.data);
    free(body.data);
    free(data);
    return ok;
}

int render_save_png(const render_picture *picture, const char *path)
{
    FILE *file = fopen(path, "wb");
    int ok = file && render_write_png(picture, file);
    if (file && fclose(file)) ok = 0;
    return ok;
}
