// The whole test harness. A test is a function without arguments; RUN counts it as passed when none
// of its checks failed. main returns test_end(), which prints the line that the Makefile adds up.
#ifndef TEST_H
#define TEST_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int test_passed, test_failed, test_bad;      // test_bad: failed checks of the running test
static const char *test_context = "";               // set it to say which case a check is about

#define RUN(test) do {                                                                  \
        test_bad = 0; test_context = "";                                                \
        test();                                                                         \
        if (test_bad) { test_failed++; printf("FAILED  %s\n", #test); } else test_passed++; \
    } while (0)

// TEST_STOP: the first failure ends the program.
#ifdef TEST_STOP
#define TEST_END exit(1)
#else
#define TEST_END (void)0
#endif

#define TEST_REPORT(...) do {                                                           \
        if (test_bad++ < 5) {                                                           \
            printf("%s:%d: %s%s", __FILE__, __LINE__, test_context, *test_context ? ": " : ""); \
            printf(__VA_ARGS__); printf("\n"); TEST_END;                                \
        }                                                                               \
    } while (0)

#define CHECK(condition) do { if (!(condition)) TEST_REPORT("%s", #condition); } while (0)

#define CHECK_EQUAL(a, b) do {                                                          \
        long long test_a = (long long)(a), test_b = (long long)(b);                     \
        if (test_a != test_b) TEST_REPORT("%s is %lld, %s is %lld", #a, test_a, #b, test_b); \
    } while (0)

#define CHECK_NEAR(a, b, tolerance) do {                                                \
        double test_x = (double)(a), test_y = (double)(b);                              \
        if (!(fabs(test_x - test_y) <= (tolerance)))                                    \
            TEST_REPORT("%s is %.9g, %s is %.9g", #a, test_x, #b, test_y);              \
    } while (0)

#define CHECK_TEXT(a, b) do {                                                           \
        const char *test_s = (a), *test_t = (b);                                        \
        if (strcmp(test_s, test_t) != 0) TEST_REPORT("\"%s\" is not \"%s\"", test_s, test_t); \
    } while (0)

static int test_end(const char *name)
{
    printf("%-24s %4d passed, %d failed\n", name, test_passed, test_failed);
    return test_failed != 0;
}

#endif
