// Chaikin's corner cutting step by step: each vertex becomes two, at 1/4 and 3/4 of its edges.
#include "gallery.h"

int main(int argc, char **argv)
{
    static const char *const titles[] = {"control polygon", "one step", "two steps", "the limit"};
    const float corners[] = {30, 190, 50, 60, 150, 30, 190, 120, 110, 200};
    float polygon[10], curve[5 << 8];
    if (!svg_begin(argc, argv, "corner_cutting", 920, 260)) return 1;
    for (int column = 0; column < 4; column++) {
        int levels = column < 3 ? column : 6;
        int count = subdiv_curve_point_count(SUBDIV_CURVE_CHAIKIN, SUBDIV_ENDS_CLOSED, 5, levels);
        for (int i = 0; i < 10; i++) polygon[i] = corners[i] + (i % 2 ? 0 : 230.0f * (float)column);
        subdiv_curve(SUBDIV_CURVE_CHAIKIN, SUBDIV_ENDS_CLOSED, levels, 2, 5, polygon, 0, curve, 0,
                     NULL);
        svg_curve(polygon, 5, 1, 1.5, column ? GREY : INK);
        if (column) svg_curve(curve, count, 1, 2.5, CORAL);
        for (int i = 0; i < count && column < 3; i++)
            svg_dot((double)curve[2 * i], (double)curve[2 * i + 1], column ? 4 : 5,
                    column ? CORAL : INK);
        svg_text(115 + 230 * column, 238, 14, INK, titles[column]);
    }
    svg_label(50 + 230, 60, "3/4", TEAL);                // of one point on the edge at the top
    svg_label(150 + 230, 30, "1/4", TEAL);
    svg_dot(75 + 230, 52.5, 6, TEAL);
    return svg_end();
}
