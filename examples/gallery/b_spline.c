// The cubic B-spline: an edge gets its midpoint (odd), a vertex moves to 1/8, 6/8, 1/8 (even).
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const titles[] = {"odd points", "even points", "two steps", "the limit"};
    const float corners[] = {20, 180, 60, 40, 130, 60, 150, 180, 210, 70};
    float p[10], curve[2 * 300];
    if (!svg_begin(argc, argv, "b_spline", 920, 260)) return 1;
    for (int column = 0; column < 4; column++) {
        int levels = column < 2 ? 1 : column < 3 ? 2 : 6;
        int count = subdiv_curve_point_count(SUBDIV_CURVE_B_SPLINE, SUBDIV_ENDS_KEPT, 5, levels);
        for (int i = 0; i < 10; i++) p[i] = corners[i] + (i % 2 ? 0 : 230.0f * (float)column);
        subdiv_curve(SUBDIV_CURVE_B_SPLINE, SUBDIV_ENDS_KEPT, levels, 2, 5, p, 0, curve, 0, NULL);
        svg_curve(p, 5, 0, 1.5, GREY);
        for (int i = 0; i < 5; i++) svg_dot((double)p[2 * i], (double)p[2 * i + 1], 4, GREY);
        if (column > 1) svg_curve(curve, count, 0, 2.5, CORAL);
        for (int i = 0; i < count && column < 3; i++)
            if (column == 2 || i % 2 == (column == 0))
                svg_dot((double)curve[2 * i], (double)curve[2 * i + 1], column < 2 ? 6 : 4,
                        i % 2 ? TEAL : CORAL);
        if (column == 0) svg_label(60, 40, "1/2", TEAL), svg_label(130, 60, "1/2", TEAL);
        if (column == 1) {
            svg_label((double)p[2], (double)p[3], "1/8", CORAL);
            svg_label((double)p[4], (double)p[5] - 18, "6/8", CORAL);
            svg_label((double)p[6], (double)p[7], "1/8", CORAL);
        }
        svg_text(115 + 230 * column, 238, 14, INK, titles[column]);
    }
    return svg_end();
}
