// Small vectors.
#ifndef VECTOR_H
#define VECTOR_H

#include <cmath>

#include "reference.h"

struct Vector {
    double p[3];
};

static Vector minus(const Point &a, const Point &b)
{
    return { { a.p[0] - b.p[0], a.p[1] - b.p[1], a.p[2] - b.p[2] } };
}

static Vector cross(const Vector &a, const Vector &b)
{
    return { { a.p[1] * b.p[2] - a.p[2] * b.p[1], a.p[2] * b.p[0] - a.p[0] * b.p[2],
               a.p[0] * b.p[1] - a.p[1] * b.p[0] } };
}

static double length(const Vector &a)
{
    return std::sqrt(a.p[0] * a.p[0] + a.p[1] * a.p[1] + a.p[2] * a.p[2]);
}

static Vector vector_of(const float *p)
{
    return { { (double)p[0], (double)p[1], (double)p[2] } };
}

static double angle_between(const Vector &a, const Vector &b)
{
    const double d = a.p[0] * b.p[0] + a.p[1] * b.p[1] + a.p[2] * b.p[2];
    return std::atan2(length(cross(a, b)), d) * 57.29577951308232;
}

#endif
