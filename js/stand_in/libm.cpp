#include <cmath>

// musl's functions are off by up to one unit in the last place, and so differ from glibc's in one of ten to thirty
// numbers. Rounded from those of 113 bits they differ in one of 700. Nothing calls them often.
extern "C" {

double cos(double x) { return static_cast<double>(cosl(x)); }
double sin(double x) { return static_cast<double>(sinl(x)); }
double acos(double x) { return static_cast<double>(acosl(x)); }
double atan2(double y, double x) { return static_cast<double>(atan2l(y, x)); }
double hypot(double x, double y) { return static_cast<double>(hypotl(x, y)); }
}
