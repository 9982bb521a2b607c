// The numbers in OBJ files: what the reader makes of every way to write them, beside strtof, and
// that the writer needs no digit less.
//
//     cc -I. tests/test_obj_numbers.c -o build/test_obj_numbers -lm && build/test_obj_numbers

#include <float.h>
#include <limits.h>
#include <stdlib.h>

#define SUBDIV_IMPLEMENTATION
#include "subdiv.h"
#include "lib/obj.h"
#include "lib/test.h"

// ----------------------------------------------------------------------------- reading numbers

enum { NUMBERS = 3 * 4096, NUMBER_LENGTH = 1024 };

static char  number_text[NUMBERS * NUMBER_LENGTH / 8];
static size_t number_size;
static float number_value[NUMBERS];
static int   number_count;

static void check_numbers(void)
{
    subdiv_mesh mesh = {0};
    for (; number_count % 3; number_count++) {
        append(number_text, &number_size, " 0");
        number_value[number_count] = 0;
    }
    CHECK_EQUAL(subdiv_load_obj_memory(&mesh, number_text, number_size, NULL), SUBDIV_OK);
    CHECK_EQUAL(mesh.vertex_count, number_count / 3);
    for (int i = 0; i < 3 * mesh.vertex_count; i++)
        if (to_bits(mesh.positions[i]) != to_bits(number_value[i]))
            TEST_REPORT("read %.9g (%08x), not %.9g (%08x)", (double)mesh.positions[i],
                        to_bits(mesh.positions[i]), (double)number_value[i],
                        to_bits(number_value[i]));
    subdiv_mesh_free(&mesh);
    number_count = 0;
    number_size = 0;
}

static void expect_number(const char *text, float value)
{
    append(number_text, &number_size, number_count % 3 ? " " : "\nv ");
    append(number_text, &number_size, text);
    number_value[number_count++] = value;
    if (number_count == NUMBERS || number_size > sizeof number_text - 8 * NUMBER_LENGTH)
        check_numbers();
}

// As strtof reads it; what is too large for a float is tested elsewhere.
static void expect_as_strtof(const char *text)
{
    float value = strtof(text, NULL);
    if (value - value == 0) expect_number(text, value);
}

static void test_read_random_numbers(void)
{
    char text[NUMBER_LENGTH];
    for (int i = 0; i < 100000; i++) {
        float f = random_float();
        snprintf(text, sizeof text, "%.9g", (double)f);
        expect_number(text, f);
        snprintf(text, sizeof text, "%.17g", (double)f);
        expect_number(text, f);
        double between = (double)f * (1 + (double)random_bits() * 0x1p-56);
        snprintf(text, sizeof text, "%.*e", (int)(random_bits() % 30), between);
        expect_as_strtof(text);
    }
    check_numbers();
}

// Digits without an exponent, as people and programs write them.
static void test_read_plain_numbers(void)
{
    char text[NUMBER_LENGTH];
    for (int i = 0; i < 50000; i++) {
        double x = ((double)random_bits() - 0x1p31) / (double)(1u << random_bits() % 32);
        snprintf(text, sizeof text, "%.*f", (int)(random_bits() % 25), x);
        expect_as_strtof(text);
        snprintf(text, sizeof text, "%u%u.%u%u", random_bits(), random_bits(), random_bits(),
                 random_bits());
        expect_as_strtof(text);
        snprintf(text, sizeof text, ".%0*u", (int)(random_bits() % 40), random_bits());
        expect_as_strtof(text);
        snprintf(text, sizeof text, "%ue%d", random_bits(), (int)(random_bits() % 90) - 60);
        expect_as_strtof(text);
    }
    check_numbers();
}

// Changes the digits of %e text (mantissa, then e) to a number a little nearer to zero.
static void lower(char *text)
{
    char *last = strchr(text, 'e') - 1;
    while (*last == '0' || *last == '.') last--;
    *last = (char)(*last - 1);
    for (char *p = last + 1; *p != 'e'; p++)
        if (*p == '0') *p = '9';
}

// Exactly between two neighbours a number goes to the even one; however late a digit decides, it
// decides. Both neighbours and the middle are exact in double.
static void test_read_halfway(void)
{
    char text[NUMBER_LENGTH], above[2 * NUMBER_LENGTH];
    for (int i = 0; i < 20000; i++) {
        unsigned bits = random_bits() & 0x7fffffffu;
        if (i % 8 == 0) bits &= 0x007fffffu;        // denormals
        if (i % 8 == 1) bits &= 0x7f800000u;        // powers of two
        if (bits >= 0x7f7fffffu) continue;
        float low = from_bits(bits), high = from_bits(bits + 1);
        double middle = ((double)low + (double)high) / 2;
        snprintf(text, sizeof text, "%.180e", middle);
        expect_number(text, bits % 2 ? high : low);
        snprintf(above, sizeof above, "%s%s", "-", text);
        expect_number(above, bits % 2 ? -high : -low);
        size_t mantissa = strcspn(text, "e");
        snprintf(above, sizeof above, "%.*s%0*d1%s", (int)mantissa, text,
                 (int)(1 + random_bits() % 100), 0, text + mantissa);
        expect_number(above, high);
        lower(text);
        expect_number(text, low);
    }
    check_numbers();
}

static void test_read_special_numbers(void)
{
    expect_number("7.038531e-26", from_bits(0x15ae43fdu));
    expect_number("3.4028235e38", FLT_MAX);
    expect_number("3.40282346638528859811704183484516925440e+38", FLT_MAX);
    expect_number("340282356779733661637539395458142568447", FLT_MAX);
    expect_number("-340282356779733661637539395458142568447.9999", -FLT_MAX);
    expect_number("1.17549435e-38", FLT_MIN);
    expect_number("1.1754942e-38", from_bits(0x007fffffu));
    expect_number("1e-45", from_bits(1));
    expect_number("1.4e-45", from_bits(1));
    expect_number("7.0064923216240854e-46", from_bits(1));
    expect_number("7.0064923216240853e-46", 0.0f);
    expect_number("7e-46", 0.0f);
    expect_number("1e-400", 0.0f);
    expect_number("-1e-400", -0.0f);
    expect_number("1e-99999999999999999999", 0.0f);
    expect_number("1e-18446744073709551617", 0.0f);
    expect_number("-0", -0.0f);
    expect_number("-0.0e5", -0.0f);
    expect_number("0e99999999999999999999", 0.0f);
    expect_number("16777217", 16777216.0f);
    expect_number("16777219", 16777220.0f);
    expect_number("16777217.000000000000000000000000001", 16777218.0f);
    expect_number("1e10", 1e10f);
    expect_number("1e11", 1e11f);
    expect_number("9007199254740993", 9007199254740992.0f);
    expect_number("18446744073709551616", 18446744073709551616.0f);
    expect_number("0.000000000000000000000000000000000000000000001e45", 1.0f);
    expect_number("1000000000000000000000000000000000000000000000e-45", 1.0f);
    check_numbers();
}

static void expect_long_number(char *text, size_t length, const char *ending, float value)
{
    subdiv_mesh mesh = {0};
    size_t size = 4 + length;
    memcpy(text, "v 0 ", 4);
    append(text, &size, ending);
    append(text, &size, " 7\n");
    CHECK_EQUAL(subdiv_load_obj_memory(&mesh, text, size, NULL), SUBDIV_OK);
    if (mesh.vertex_count == 1) {
        CHECK_EQUAL(to_bits(mesh.positions[1]), to_bits(value));
        CHECK(mesh.positions[2] == 7);
    }
    subdiv_mesh_free(&mesh);
}

static void test_read_100000_digits(void)
{
    enum { DIGITS = 100000 };
    char *text = (char *)malloc(DIGITS + 64), *number = text + 4;
    memset(number, '0', DIGITS);
    number[0] = '1';
    expect_long_number(text, DIGITS, "e-99999", 1.0f);
    number[0] = '0';
    number[1] = '.';
    expect_long_number(text, DIGITS - 1, "1e99998", 1.0f);
    expect_long_number(text, DIGITS, "", 0.0f);
    memset(number, '3', DIGITS);
    number[1] = '.';
    expect_long_number(text, DIGITS, "", 10.0f / 3);
    memset(number, '9', DIGITS);
    expect_long_number(text, DIGITS, "e-99962", 1e38f);
    // A 1 after so many zeros still lifts the number above the middle of two floats.
    memset(number, '0', DIGITS);
    memcpy(number, "16777217.", 9);
    expect_long_number(text, DIGITS, "1", 16777218.0f);
    expect_long_number(text, DIGITS, "0", 16777216.0f);
    free(text);
}

// ----------------------------------------------------------------------------- writing numbers

// Digits of a number from the first to the last that is not 0.
static int count_digits(const char *text)
{
    int count = 0, significant = 0;
    for (; *text && *text != 'e' && *text != 'E'; text++) {
        if (*text < '0' || *text > '9') continue;
        if (*text != '0' || count) count++;
        if (*text != '0') significant = count;
    }
    return significant;
}

// Does a number with so many digits read back as f? Besides the nearest one, which can lie outside
// where the gap below f is half the gap above, its two neighbours.
static int digits_suffice(float f, int digits)
{
    char text[64], nearest[64];
    snprintf(nearest, sizeof nearest, "%.*e", digits - 1, fabs((double)f));
    long mantissa = 0;
    for (const char *p = nearest; *p != 'e'; p++)
        if (*p != '.') mantissa = 10 * mantissa + *p - '0';
    int exponent = atoi(strchr(nearest, 'e') + 1) - (digits - 1);
    for (long m = mantissa - 1; m <= mantissa + 1; m++) {
        snprintf(text, sizeof text, "%lde%d", m, exponent);
        if (strtof(text, NULL) == fabsf(f)) return 1;
    }
    return 0;
}

// Writes the numbers and takes the text apart again.
static void check_written(float *values, int count)
{
    subdiv_mesh mesh = {0}, back = {0};
    size_t size;
    mesh.vertex_count = count / 3;
    mesh.positions = values;
    char *text = save_text(&mesh, &size, NULL);
    CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
    CHECK_EQUAL(back.vertex_count, mesh.vertex_count);
    int i = 0;
    for (char *token = strtok(text, " \n"); token; token = strtok(NULL, " \n")) {
        if (strcmp(token, "v") == 0) continue;
        if (i >= count) break;
        float f = values[i];
        if (to_bits(strtof(token, NULL)) != to_bits(f) || to_bits(back.positions[i]) != to_bits(f))
            TEST_REPORT("%.9g is written as %s", (double)f, token);
        int digits = count_digits(token);
        if (digits > 1 && digits_suffice(f, digits - 1))
            TEST_REPORT("%.9g is written as %s, but %d digits suffice", (double)f, token,
                        digits - 1);
        i++;
    }
    CHECK_EQUAL(i, count);
    subdiv_mesh_free(&back);
    free(text);
}

static void test_write_random_numbers(void)
{
    enum { COUNT = 3 * 20000 };
    float *values = (float *)malloc(COUNT * sizeof *values);
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < COUNT; i++) {
            values[i] = random_float();
            if (round == 1) values[i] = from_bits(random_bits() & 0x807fffffu);     // denormals
            if (round == 2) values[i] = (float)((int)random_bits() / 1000) / 1000;
        }
        check_written(values, COUNT);
    }
    free(values);
}

static void test_write_special_numbers(void)
{
    enum { COUNT = 3 * 1024 };
    static float values[COUNT];
    int n = 0;
    for (unsigned exponent = 0; exponent < 255; exponent++)         // powers of two, neighbours
        for (int k = -1; k <= 1; k++)
            if (exponent || k >= 0) values[n++] = from_bits((exponent << 23) + (unsigned)k);
    for (unsigned bits = 0; bits < 24; bits++) values[n++] = from_bits(1u << bits);
    for (int k = -45; k <= 38; k++) {
        char text[16];
        snprintf(text, sizeof text, "1e%d", k);
        values[n++] = strtof(text, NULL);
        values[n++] = -0.9f * strtof(text, NULL);
    }
    for (int k = 0; k <= 100; k++) values[n++] = (float)k / 10;
    values[n++] = FLT_MAX;
    values[n++] = -FLT_MAX;
    values[n++] = -0.0f;
    values[n++] = 16777216.0f;
    values[n++] = from_bits(0x15ae43fdu);
    CHECK(n <= COUNT - 3);
    check_written(values, n - n % 3 + 3);
}

static void test_write_indices(void)
{
    sdv_figures *figures = (sdv_figures *)malloc(sizeof *figures);
    sdv_make_figures(figures);
    for (unsigned i = 0; i < 300000; i++) {
        char text[64], expected[32];
        int number = i < 120000 ? (int)i : (int)(random_bits() >> (1 + i % 31));
        *sdv_write_index(figures, text, i == 299999 ? INT_MAX : number) = 0;
        snprintf(expected, sizeof expected, "%d", i == 299999 ? INT_MAX : number);
        CHECK_TEXT(text, expected);
    }
    free(figures);
}

// Every so many bit patterns: written, they are what strtof makes of the text, and what we read.
// OBJ_SWEEP=1 in the environment looks at all of them.
static void test_sweep(void)
{
    enum { COUNT = 3 * 100000 };
    const char *setting = getenv("OBJ_SWEEP");
    unsigned long long step = setting && atoi(setting) > 0 ? (unsigned)atoi(setting) : 2039;
    float *values = (float *)malloc(COUNT * sizeof *values);
    for (unsigned long long bits = 0; bits >> 32 == 0 && !test_bad;) {
        subdiv_mesh mesh = {0}, back;
        size_t size;
        int count = 0;
        for (; count < COUNT && bits >> 32 == 0; bits += step) {
            values[count] = from_bits((unsigned)bits);
            count += values[count] - values[count] == 0;            // finite
        }
        while (count % 3) values[count++] = 0;
        mesh.vertex_count = count / 3;
        mesh.positions = values;
        if (count == 0) break;
        char *text = save_text(&mesh, &size, NULL), *p = text;
        CHECK_EQUAL(subdiv_load_obj_memory(&back, text, size, NULL), SUBDIV_OK);
        for (int i = 0; i < count && back.vertex_count == count / 3; i++) {
            if (i % 3 == 0) p += strspn(p, "v\n");
            float f = strtof(p, &p);
            if (to_bits(f) != to_bits(values[i]) || to_bits(back.positions[i]) != to_bits(f))
                TEST_REPORT("%08x is written as %08x and read as %08x", to_bits(values[i]),
                            to_bits(f), to_bits(back.positions[i]));
        }
        subdiv_mesh_free(&back);
        free(text);
    }
    free(values);
}

// What a reader sees matters too: small numbers without an exponent, nothing superfluous.
static void test_write_short_texts(void)
{
    static float P[] = {0, 1, -1, 0.5f, 10, 0.1f, 1e20f, 100, -2.25f};
    subdiv_mesh mesh = {0};
    size_t size;
    mesh.vertex_count = 3;
    mesh.positions = P;
    char *text = save_text(&mesh, &size, NULL);
    CHECK(strstr(text, "v 0 1 -1\n") != NULL);
    CHECK(strstr(text, "v 0.5 10 0.1\n") != NULL || strstr(text, "v .5 10 .1\n") != NULL);
    CHECK(strstr(text, " 100 -2.25\n") != NULL);
    free(text);
}

int main(void)
{
    RUN(test_read_random_numbers);
    RUN(test_read_plain_numbers);
    RUN(test_read_halfway);
    RUN(test_read_special_numbers);
    RUN(test_read_100000_digits);
    RUN(test_write_random_numbers);
    RUN(test_write_special_numbers);
    RUN(test_write_short_texts);
    RUN(test_write_indices);
    RUN(test_sweep);
    return test_end("obj_numbers");
}
