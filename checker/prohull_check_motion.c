/* prohull_check_motion CERTIFICATE decides again which bodies of a robot never meet, or are apart all along a path.
   docs/certificate.md says what the file holds, what is computed here, and why that is a proof. Exit code 0: proven; 1:
   not proven; 2: a file cannot be read. */
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define NO_RETURN __attribute__((noreturn))
#else
#define NO_RETURN
#endif
#define NONE SIZE_MAX
#define MOST_BYTES (1 << 30)
#define COUNT(i) ((unsigned long)(i))

/* No formula here loses more of the sizes of its terms than ROUND: each has at most 40 operations, of 2^-53 each. A
   rotation about an axis is wrong by less than TURN. */
static const double ROUND = 1e-14, TURN = 2e-14, FARTHEST = 1e6, TINY = 1e-150; /* the squares of less may underflow */

NO_RETURN static void end(int code, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  fputs(code == 1 ? "not proven: " : "unreadable: ", stdout);
  vprintf(format, arguments);
  putchar('\n');
  exit(code);
}

static void* resized(void* array, size_t count, size_t size) {
  void* result = count > SIZE_MAX / 2 / size ? NULL : realloc(array, (count ? count : 1) * size);
  if (!result) end(2, "not enough memory");
  return result;
}

/* Room for one more element than n: the array doubles where n is a power of 2. */
static void* room(void* array, size_t n, size_t size) {
  return n && (n & (n - 1)) ? array : resized(array, n ? 2 * n : 1, size);
}

/* Real files need far less. Files that were made to take for ever end here. */
static void spend(size_t steps) {
  static uint64_t spent;
  if ((spent += steps) > UINT64_C(4000000000)) end(1, "this would take too long");
}

/* ---- The file ---- */

static const char *file_name, *begin_of_file;
static char* at;

NO_RETURN static void unreadable(const char* what) {
  unsigned long line = 1;
  for (const char* p = begin_of_file; p < at; ++p) line += *p == '\n' || *p == 0;
  end(2, "%s, line %lu: %s", file_name, line, what);
}

/* All bytes of a file, and a 0 behind them. */
static char* bytes_of(const char* name, size_t* size) {
  FILE* const stream = fopen(name, "rb");
  size_t space = 1 << 16, got;
  if (!stream) end(2, "%s cannot be opened", name);
  char* bytes = resized(NULL, space, 1);
  for (*size = 0; (got = fread(bytes + *size, 1, space - *size - 1, stream)) > 0;)
    if ((*size += got) + 1 == space) {
      if (space > MOST_BYTES) end(2, "%s is too large", name);
      bytes = resized(bytes, space *= 2, 1);
    }
  if (ferror(stream)) end(2, "%s cannot be read", name);
  fclose(stream), bytes[*size] = 0, spend(*size);
  return bytes;
}

static void skip_space(void) { at += strspn(at, " \t\r\n"); }

static int pass(const char* word) {
  skip_space();
  const size_t n = strlen(word);
  if (strncmp(at, word, n) != 0 || (unsigned char)at[n] > ' ') return 0;
  return at += n, 1;
}

static double real(double least, double most) {
  skip_space();
  char* rest = at;
  const double x = strtod(at, &rest);
  if (rest == at || (unsigned char)*rest > ' ' || !(x >= least && x <= most))
    unreadable("a number is missing, or too small or too large");
  return at = rest, x;
}

static size_t count(size_t below) {
  const double x = real(0, 1e9);
  if (x != (double)(size_t)x || (size_t)x >= below) unreadable("this number names nothing");
  return (size_t)x;
}

static void reals(double* x, int n, double most) {
  for (int i = 0; i < n; ++i) x[i] = real(-most, most) + 0.0; /* no -0 */
}

/* The rest of the line. */
static char* rest_of_line(void) {
  char* const name = at += *at == ' ';
  at += strcspn(at, "\n");
  if (*at) *at++ = 0;
  for (char* c = name; *c; ++c)
    if ((unsigned char)*c < ' ') *c = '?';
  return name;
}

/* ---- Points and poses ---- */

static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double length(const double* a) { return sqrt(dot(a, a)); }
static double larger(double a, double b) { return a > b ? a : b; }

static void subtract(double* r, const double* a, const double* b) {
  for (int k = 0; k < 3; ++k) r[k] = a[k] - b[k];
}

static void cross(double* r, const double* a, const double* b) {
  for (int k = 0; k < 3; ++k) r[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* A rotation, the rows of which are r, and then a move by t; the true ones differ, as maps, by at most `turn` and
   `shift`. */
typedef struct {
  double r[3][3], t[3], turn, shift;
} Pose;

static void place(double* out, const Pose* p, const double* x, int is_way) {
  for (int k = 0; k < 3; ++k) out[k] = dot(p->r[k], x) + (is_way ? 0 : p->t[k]);
}

/* How far a point that is placed is from where it truly is, at most, if it is that far from the origin. */
static double doubt_of(const Pose* p, double distance) {
  return p->turn * distance + p->shift + ROUND * (distance + length(p->t)) + TINY;
}

static Pose composed(const Pose* a, const Pose* b) {
  Pose c;
  for (int i = 0; i < 9; ++i)
    c.r[i / 3][i % 3] =
        a->r[i / 3][0] * b->r[0][i % 3] + a->r[i / 3][1] * b->r[1][i % 3] + a->r[i / 3][2] * b->r[2][i % 3];
  place(c.t, a, b->t, 0);
  c.turn = a->turn + b->turn + a->turn * b->turn + ROUND, c.shift = b->shift + doubt_of(a, length(b->t));
  if (!(c.turn < 1e-3)) end(1, "a rotation is too far from a rotation");
  return c;
}

static Pose inverse(const Pose* a) {
  Pose c = *a;
  for (int i = 0; i < 9; ++i) c.r[i / 3][i % 3] = a->r[i % 3][i / 3];
  for (int k = 0; k < 3; ++k) c.t[k] = -dot(c.r[k], a->t);
  c.shift += (a->turn + ROUND) * length(a->t);
  return c;
}

/* Within 2e-15 for |x| <= 1e6: x less its multiple of pi/2, which is the sum of two numbers, and Taylor's series. */
static void find_sine(double x, double* sine, double* cosine) {
  const double k = floor(x * 0.63661977236758134 + 0.5), y = (x - k * 0x1.921FB544p+0) - k * 0x1.0B4611A626331p-34;
  double s = y, c = 1, s_term = y, c_term = 1;
  for (int i = 1; i < 10; ++i) {
    c_term *= -y * y / ((2 * i - 1) * (2 * i)), s_term *= -y * y / ((2 * i) * (2 * i + 1));
    c += c_term, s += s_term;
  }
  const int quarter = (int)(k - 4 * floor(k / 4));
  *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
  *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
}

/* ---- Bodies: triangles in a tree of boxes ---- */

typedef struct {
  double p[3][3];
  size_t component;
} Triangle;
typedef struct {
  double center[3], half[3];
} Box;
typedef struct {
  const char* name;
  size_t frame, n, components;
  Triangle* t;
  Box* box;      /* node 1 is the root; node i of n triangles has the children 2 i, of the first n / 2, and 2 i + 1 */
  double radius; /* no corner is farther from the origin */
  size_t* some;  /* of each component: a triangle */
  char* is_open; /* of each component */
} Body;

static int axis_of_order;

static int by_middle(const void* a, const void* b) {
  const double(*p)[3] = ((const Triangle*)a)->p, (*q)[3] = ((const Triangle*)b)->p;
  const int k = axis_of_order;
  const double x = p[0][k] + p[1][k] + p[2][k], y = q[0][k] + q[1][k] + q[2][k];
  return (x > y) - (x < y);
}

static void build_tree(Body* b, size_t node, size_t first, size_t n) {
  Box* const box = b->box + node;
  for (int k = 0; k < 3; ++k) {
    double low = b->t[first].p[0][k], high = low;
    for (size_t i = 3 * first; i < 3 * (first + n); ++i) {
      const double x = b->t[i / 3].p[i % 3][k];
      low = x < low ? x : low, high = x > high ? x : high;
    }
    box->center[k] = low / 2 + high / 2, box->half[k] = high / 2 - low / 2;
  }
  if (n == 1) return;
  axis_of_order = box->half[0] > box->half[1] ? 0 : 1;
  if (box->half[2] > box->half[axis_of_order]) axis_of_order = 2;
  qsort(b->t + first, n, sizeof *b->t, by_middle);
  build_tree(b, 2 * node, first, n / 2), build_tree(b, 2 * node + 1, first + n / 2, n - n / 2);
}

typedef struct {
  double x[3];
  size_t corner;
} Corner;
typedef struct {
  size_t low, high, triangle;
  int sign;
} Edge;

static size_t open_bodies;

static int by_place(const void* a, const void* b) {
  const Corner *p = a, *q = b;
  int order = 0;
  for (int k = 0; k < 3 && !order; ++k) order = (p->x[k] > q->x[k]) - (p->x[k] < q->x[k]);
  return order;
}

static int by_ends(const void* a, const void* b) {
  const Edge *p = a, *q = b;
  return p->low != q->low ? (p->low > q->low) - (p->low < q->low) : (p->high > q->high) - (p->high < q->high);
}

static size_t root_of(size_t* above, size_t i) {
  while (above[i] != i) i = above[i] = above[above[i]];
  return i;
}

/* What hangs together by edges is a component. It is open unless its edges cancel each other out. */
static void find_components(Body* b) {
  Corner* const corner = resized(NULL, 3 * b->n, sizeof *corner);
  Edge* const edge = resized(NULL, 3 * b->n, sizeof *edge);
  size_t *const point = resized(NULL, 3 * b->n, sizeof *point), *const above = resized(NULL, b->n, sizeof *above),
                *const number = resized(NULL, b->n, sizeof *number);
  size_t points = 0;
  for (size_t i = 0; i < 3 * b->n; ++i)
    memcpy(corner[i].x, b->t[i / 3].p[i % 3], sizeof corner->x), corner[i].corner = i;
  qsort(corner, 3 * b->n, sizeof *corner, by_place);
  for (size_t i = 0; i < 3 * b->n; ++i) {
    points += i > 0 && by_place(corner + i - 1, corner + i) != 0;
    point[corner[i].corner] = points;
  }
  for (size_t i = 0; i < 3 * b->n; ++i) {
    const size_t from = point[i], to = point[i % 3 == 2 ? i - 2 : i + 1];
    edge[i] = (Edge){from < to ? from : to, from < to ? to : from, i / 3, from < to ? 1 : from > to ? -1 : 0};
  }
  qsort(edge, 3 * b->n, sizeof *edge, by_ends);
  for (size_t i = 0; i < b->n; ++i) above[i] = i, number[i] = NONE;
  for (size_t i = 1; i < 3 * b->n; ++i)
    if (by_ends(edge + i - 1, edge + i) == 0)
      above[root_of(above, edge[i].triangle)] = root_of(above, edge[i - 1].triangle);
  for (size_t i = 0; i < b->n; ++i) {
    size_t* const of = number + root_of(above, i);
    if (*of == NONE) {
      b->some = room(b->some, b->components, sizeof *b->some), b->is_open = room(b->is_open, b->components, 1);
      b->is_open[b->components] = 0, *of = b->components++;
    }
    b->t[i].component = *of;
  }
  long sum = 0;
  int has_open = 0;
  for (size_t i = 0; i < 3 * b->n; ++i) {
    sum += edge[i].sign;
    if (i + 1 < 3 * b->n && by_ends(edge + i, edge + i + 1) == 0) continue;
    if (sum) b->is_open[b->t[edge[i].triangle].component] = 1, has_open = 1;
    sum = 0;
  }
  open_bodies += (size_t)has_open;
  free(corner), free(edge), free(point), free(above), free(number);
}

static void finish(Body* b) {
  if (!b->n) end(1, "%s has no triangles", b->name);
  spend(100 * b->n);
  b->box = resized(NULL, 4 * b->n, sizeof *b->box);
  find_components(b), build_tree(b, 1, 0, b->n);
  for (size_t i = 0; i < b->n; ++i) b->some[b->t[i].component] = i;
  for (size_t i = 0; i < 3 * b->n; ++i) b->radius = larger(b->radius, length(b->t[i / 3].p[i % 3]));
}

/* A binary STL file, whose name is as seen from the certificate. */
static void read_stl(Body* b, const char* name) {
  const char* const slash = strrchr(file_name, '/');
  const size_t folder = slash && *name != '/' ? (size_t)(slash - file_name) + 1 : 0, n = strlen(name);
  char* const whole = resized(NULL, folder + n + 1, 1);
  size_t size;
  memcpy(whole, file_name, folder), memcpy(whole + folder, name, n + 1);
  unsigned char* const bytes = (unsigned char*)bytes_of(whole, &size);
  for (size_t i = 80; i < 84 && size >= 84; ++i) b->n |= (size_t)bytes[i] << 8 * (i - 80);
  if (size < 84 || (size - 84) / 50 != b->n || (size - 84) % 50) end(2, "%s is no binary STL file", whole);
  b->t = resized(NULL, b->n, sizeof *b->t);
  for (size_t i = 0; i < 9 * b->n; ++i) {
    const unsigned char* const word = bytes + 84 + 50 * (i / 9) + 12 + 4 * (i % 9);
    const uint32_t bits = word[0] | (uint32_t)word[1] << 8 | (uint32_t)word[2] << 16 | (uint32_t)word[3] << 24;
    float x;
    memcpy(&x, &bits, sizeof x), b->t[i / 9].p[i % 9 / 3][i % 3] = (double)x + 0.0;
    if (!(x >= -1e9F && x <= 1e9F)) end(2, "%s: a corner is too far away, or not finite", whole);
  }
  free(whole), free(bytes);
}

static void read_triangles(Body* b) {
  const size_t vertices = count(NONE), triangles = count(NONE);
  double(*v)[3] = NULL;
  for (size_t i = 0; i < vertices; ++i) v = room(v, i, sizeof *v), reals(v[i], 3, 1e9);
  for (; b->n < triangles; ++b->n) {
    b->t = room(b->t, b->n, sizeof *b->t);
    for (int k = 0; k < 3; ++k) memcpy(b->t[b->n].p[k], v + count(vertices), sizeof *v);
  }
  free(v);
}

static Body* bodies;
static size_t body_count, frame_count;

/* ---- Frames: each is moved against its parent by a joint ---- */

typedef enum { ROOT, FIXED, TURNS, SLIDES, LOOSE, KINDS } Kind;
typedef struct {
  const char* name;
  int kind;
  size_t parent, master, freedom; /* NONE: there is none */
  Pose origin;
  double anchor[3], axis[3], low, high, factor, offset; /* follows the master: factor * its position + offset */
} Frame;
typedef struct {
  size_t frame;
  int climbs; /* from child to parent */
} Hinge;

static Frame* frames;
static Hinge* hinges; /* from the first body of a pair to the second */
static size_t hinge_count, freedom_count;
static double *lows, *highs, *middles, *halves; /* of the freedoms */

/* A matrix differs from the rotation that is closest to it by less than its product with its transpose from 1. */
static void read_origin(Pose* p) {
  double across[3], sum = 0;
  for (int i = 0; i < 3; ++i) reals(p->r[i], 3, 2);
  reals(p->t, 3, FARTHEST), cross(across, p->r[0], p->r[1]);
  for (int i = 0; i < 9; ++i) {
    const double d = dot(p->r[i / 3], p->r[i % 3]) - (i % 4 == 0);
    sum += d * d;
  }
  p->turn = sqrt(sum) * (1 + ROUND) + ROUND;
  if (!(p->turn < 1e-5) || !(dot(across, p->r[2]) > 0)) unreadable("this matrix is no rotation");
}

static void read_frame(void) {
  static const char* const kinds[KINDS] = {"root", "fixed", "turns", "slides", "loose"};
  Frame f;
  memset(&f, 0, sizeof f), f.parent = f.master = f.freedom = NONE;
  while (f.kind < KINDS && !pass(kinds[f.kind])) ++f.kind;
  if (f.kind == KINDS) unreadable("this kind of frame is not known");
  if (f.kind != ROOT) f.parent = count(frame_count), read_origin(&f.origin);
  if (f.kind == TURNS || f.kind == SLIDES) {
    reals(f.anchor, 3, FARTHEST), reals(f.axis, 3, 2), f.low = real(-INFINITY, INFINITY),
                                                       f.high = real(-INFINITY, INFINITY);
    if (!(fabs(length(f.axis) - 1) < 1e-6)) unreadable("the axis has not the length 1");
    if (f.low > f.high) unreadable("the lower limit is above the upper one");
    if (!pass("free")) f.master = count(NONE), f.factor = real(-1e6, 1e6), f.offset = real(-1e6, 1e6);
  }
  f.name = rest_of_line();
  frames = room(frames, frame_count, sizeof *frames), frames[frame_count++] = f;
}

static void read_body(void) {
  Body b;
  memset(&b, 0, sizeof b), b.frame = count(frame_count), b.name = rest_of_line();
  if (pass("stl"))
    read_stl(&b, rest_of_line());
  else if (pass("triangles"))
    read_triangles(&b);
  else
    unreadable("the triangles of a body are missing");
  finish(&b);
  bodies = room(bodies, body_count, sizeof *bodies), bodies[body_count++] = b;
}

/* The joint that moves freely and that this one follows; `whole` where only by whole factors. */
static size_t leader_of(size_t j, int* whole) {
  for (int steps = 0; frames[j].master != NONE; j = frames[j].master) {
    *whole = *whole && frames[j].factor == floor(frames[j].factor);
    if (++steps > 100 || frames[j].master >= frame_count || frames[frames[j].master].kind == FIXED)
      end(1, "joint %s follows one that is not known", frames[j].name);
  }
  if (frames[j].kind != TURNS && frames[j].kind != SLIDES)
    end(1, "%s moves in a way that is not known", frames[j].name);
  return j;
}

static void find_chain(size_t x, size_t y) {
  size_t last = frame_count;
  hinges = resized(hinges, frame_count, sizeof *hinges), hinge_count = 0;
  while (x != y) {
    size_t* const lower = x > y ? &x : &y;
    if (frames[*lower].kind == ROOT) end(1, "no joints connect %s to %s", frames[x].name, frames[y].name);
    *(x > y ? hinges + hinge_count++ : hinges + --last) = (Hinge){*lower, x > y};
    *lower = frames[*lower].parent;
  }
  memmove(hinges + hinge_count, hinges + last, (frame_count - last) * sizeof *hinges);
  hinge_count += frame_count - last;
  for (size_t h = 0; h < hinge_count; ++h) {
    int whole = 1;
    if (frames[hinges[h].frame].kind != FIXED) leader_of(hinges[h].frame, &whole);
  }
  spend(frame_count + 100 * hinge_count);
}

/* Cuts the limits of a freedom to where those that follow it are within theirs, rounded outwards. */
static void cut_limits(size_t freedom, double* low, double* high) {
  *low = frames[freedom].low, *high = frames[freedom].high;
  for (size_t j = 0; j < frame_count; ++j) {
    double ends[2] = {frames[j].low, frames[j].high};
    size_t at = j;
    for (int steps = 0; steps < 100 && at < frame_count && frames[at].master != NONE; at = frames[at].master, ++steps) {
      const double factor = frames[at].factor, offset = frames[at].offset;
      if (factor == 0) break;
      const double from = nextafter(ends[0] - offset, -INFINITY) / factor,
                   to = nextafter(ends[1] - offset, INFINITY) / factor;
      ends[0] = nextafter(factor < 0 ? to : from, -INFINITY), ends[1] = nextafter(factor < 0 ? from : to, INFINITY);
    }
    if (j == freedom || at != freedom) continue;
    if (ends[0] > *low) *low = ends[0];
    if (ends[1] < *high) *high = ends[1];
  }
}

/* Whether all positions of a freedom are like one of these: within the limits, or a whole turn. */
static int suffices(size_t freedom, double low, double high) {
  const Frame* const f = frames + freedom;
  double least, most;
  spend(100 * (hinge_count + frame_count));
  if (f->master != NONE || !(low <= high)) return 0;
  cut_limits(freedom, &least, &most);
  if (low <= least && most <= high) return 1;
  for (size_t h = 0; h < hinge_count; ++h) {
    int whole = 1;
    if (frames[hinges[h].frame].kind == FIXED || leader_of(hinges[h].frame, &whole) != freedom) continue;
    if (!whole || frames[hinges[h].frame].kind != TURNS) return 0;
  }
  return high - low > 6.28318530718;
}

/* The middle of the positions of a joint, and how far they are from it. */
static void find_reach(size_t j, double* middle, double* half) {
  const Frame* const f = frames + j;
  if (f->master != NONE) {
    find_reach(f->master, middle, half);
    const double scaled = f->factor * *middle;
    *half = fabs(f->factor) * *half * (1 + ROUND) + ROUND * (fabs(scaled) + fabs(f->offset)),
    *middle = scaled + f->offset;
  } else if (f->freedom != NONE) {
    *middle = middles[f->freedom], *half = halves[f->freedom];
  } else {
    *middle = f->low, *half = 0;
    if (f->low != f->high) end(1, "nothing says where joint %s is", f->name);
  }
  if (!(fabs(*middle) <= FARTHEST)) end(1, "joint %s goes too far", f->name);
}

static Pose joint_pose(const Frame* f, double position) {
  Pose m = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, 0, 0};
  double s, c, moved[3];
  if (f->kind == TURNS) {
    const double size = length(f->axis), k[3] = {f->axis[0] / size, f->axis[1] / size, f->axis[2] / size};
    find_sine(position, &s, &c);
    for (int i = 0; i < 3; ++i) {
      const int x = (i + 1) % 3, y = (i + 2) % 3;
      m.r[i][i] = c + (1 - c) * k[i] * k[i];
      m.r[i][x] = (1 - c) * k[i] * k[x] - s * k[y], m.r[i][y] = (1 - c) * k[i] * k[y] + s * k[x];
    }
    place(moved, &m, f->anchor, 1), subtract(m.t, f->anchor, moved);
    m.turn = TURN, m.shift = (TURN + 2 * ROUND) * length(f->anchor);
  }
  for (int k = 0; k < 3 && f->kind == SLIDES; ++k) m.t[k] = f->axis[k] * position;
  if (f->kind == SLIDES) m.shift = ROUND * length(m.t);
  return composed(&f->origin, &m);
}

/* ---- How far bodies are apart, and how much motion changes that ---- */

typedef struct {
  double point[3], way[3], point_doubt, way_doubt; /* the way has the length 1 */
} Axis;

/* The largest distance of a corner from an axis, which is at least `best`. */
static double arm_in(const Body* b, const Axis* axis, size_t node, size_t first, size_t n, double best) {
  double way[3], across[3];
  spend(1);
  subtract(way, b->box[node].center, axis->point), cross(across, way, axis->way);
  if (!(length(across) + length(b->box[node].half) > best)) return best;
  for (int k = 0; k < 3 && n == 1; ++k)
    subtract(way, b->t[first].p[k], axis->point), cross(across, way, axis->way), best = larger(best, length(across));
  if (n == 1) return best;
  best = arm_in(b, axis, 2 * node, first, n / 2, best);
  return arm_in(b, axis, 2 * node + 1, first + n / 2, n - n / 2, best);
}

/* The lever arm of a body about an axis, or more. */
static double arm_of(const Body* b, const Axis* axis) {
  const double size = b->radius + length(axis->point);
  return arm_in(b, axis, 1, 0, b->n, 0) + axis->point_doubt + (axis->way_doubt + 2 * ROUND) * size;
}

/* Of a frame that is there. */
static Axis axis_at(const Pose* p, const Frame* f) {
  Axis axis;
  place(axis.point, p, f->anchor, 0), place(axis.way, p, f->axis, 1);
  const double size = length(axis.way);
  for (int k = 0; k < 3; ++k) axis.way[k] /= size;
  axis.point_doubt = doubt_of(p, length(f->anchor)), axis.way_doubt = 2 * p->turn + 2 * ROUND;
  return axis;
}

static Axis moved_axis(const Pose* p, const Axis* axis) {
  Axis moved;
  place(moved.point, p, axis->point, 0), place(moved.way, p, axis->way, 1);
  moved.point_doubt = doubt_of(p, length(axis->point)) + axis->point_doubt;
  moved.way_doubt = p->turn + axis->way_doubt + ROUND;
  return moved;
}

/* The pose of b in the frame of a where all freedoms are in their middles; and of each hinge how far it goes from
   there, and its axis in the frame of a. */
static Pose middle_pose(double* reach, Axis* axes) {
  Pose p = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, 0, 0};
  for (size_t h = 0; h < hinge_count; ++h) {
    const Frame* const f = frames + hinges[h].frame;
    double position = 0;
    reach[h] = 0;
    if (f->kind != FIXED) find_reach(hinges[h].frame, &position, &reach[h]);
    Pose step = joint_pose(f, position);
    if (hinges[h].climbs && f->kind != FIXED) axes[h] = axis_at(&p, f);
    if (hinges[h].climbs) step = inverse(&step);
    p = composed(&p, &step);
    if (!hinges[h].climbs && f->kind != FIXED) axes[h] = axis_at(&p, f);
  }
  return p;
}

/* A joint that moves a body, as far as `reach` either way, seen from the body; and how far points may be from the axis,
   more or less than it seems. */
typedef struct {
  double point[3], way[3], reach, blur;
  int turns;
  size_t freedom;
} Move;

typedef struct {
  const Body *a, *b;
  Pose p, back;        /* of b in the frame of a, and of a in that of b */
  double least, doubt; /* bodies have to be farther apart; what rounding may do to that */
  double main[2][3];   /* directions between two triangles that are near, and between the middles of the bodies */
  double n[3];         /* the direction, of length 1, that told the last two triangles or boxes apart */
  Move* moves[2];      /* of a and of b: the joint that is closest to the body comes first */
  size_t count[2];
} Sight;

static void add_move(Sight* s, int which, const Axis* axis, size_t frame, double reach, double turn) {
  const Frame* const f = frames + frame;
  const Body* const b = which ? s->b : s->a;
  Move* const m = s->moves[which] + s->count[which]++;
  memcpy(m->point, axis->point, sizeof m->point), memcpy(m->way, axis->way, sizeof m->way);
  m->turns = f->kind == TURNS, m->reach = m->turns ? reach : reach * length(f->axis);
  while (frames[frame].master != NONE) frame = frames[frame].master;
  m->freedom = frames[frame].freedom;
  m->blur = axis->point_doubt + (axis->way_doubt + turn + 4 * ROUND) * (b->radius + length(axis->point));
}

/* Finds the pose in the middle, and what moves the bodies from there. The first hinges count as moving a, the others b,
   and how many do is free: here, such that both bodies, each as a whole, move least. */
static void find_moves(Sight* s) {
  static Axis* axes;
  static double *reach, *rest; /* rest: of a hinge and those behind it */
  axes = resized(axes, hinge_count, sizeof *axes), reach = resized(reach, hinge_count, sizeof *reach);
  rest = resized(rest, hinge_count + 1, sizeof *rest), rest[hinge_count] = 0, spend(10 * hinge_count);
  static Move* moves[2];
  for (int i = 0; i < 2; ++i) s->moves[i] = moves[i] = resized(moves[i], hinge_count, sizeof **moves), s->count[i] = 0;
  s->p = middle_pose(reach, axes), s->back = inverse(&s->p);
  for (size_t h = hinge_count; h-- > 0;) {
    const Frame* const f = frames + hinges[h].frame;
    double arm = f->kind == SLIDES ? length(f->axis) : 0;
    if (f->kind == TURNS && reach[h] > 0) {
      const Axis of_b = moved_axis(&s->back, axes + h);
      arm = arm_of(s->b, &of_b);
    }
    rest[h] = rest[h + 1] + reach[h] * arm;
  }
  double least = rest[0], first = 0;
  size_t of_a = 0;
  for (size_t h = 0; h < hinge_count && first < least; ++h) {
    const Frame* const f = frames + hinges[h].frame;
    if (reach[h] > 0) first += reach[h] * (f->kind == SLIDES ? length(f->axis) : arm_of(s->a, axes + h));
    if (first + rest[h + 1] < least) least = first + rest[h + 1], of_a = h + 1;
  }
  for (size_t h = 0; h < of_a; ++h)
    if (reach[h] > 0) add_move(s, 0, axes + h, hinges[h].frame, reach[h], 0);
  for (size_t h = hinge_count; h-- > of_a;) {
    if (!(reach[h] > 0)) continue;
    const Axis of_b = moved_axis(&s->back, axes + h);
    add_move(s, 1, &of_b, hinges[h].frame, reach[h], s->p.turn);
  }
}

/* More than sums over the joints of a body lose: each joint adds a term, and a few operations to those of others. */
static double sum_rounding(const Sight* s, int which) {
  return 1 + 10 * ROUND * (double)(1 + s->count[which]);
}

/* How far points of body `which` move that are within `radius` of x: any way, and along a direction, that part which is
   of second order. The second derivative of where a point is by two joints is at most the derivative by the one that is
   closer to the body if the other turns, and 0 otherwise. */
static void find_drift(const Sight* s, int which, const double* x, double radius, double* any_way, double* bend) {
  double moved = 0, way[3], across[3];
  *any_way = *bend = 0;
  for (size_t i = 0; i < s->count[which]; ++i) {
    const Move* const m = s->moves[which] + i;
    double derivative = 1;
    if (m->turns) {
      subtract(way, x, m->point), cross(across, way, m->way);
      const double arm = length(across) + radius + m->blur;
      *any_way += (m->reach < 2 ? m->reach : 2) * arm; /* a chord is at most a diameter */
      derivative = arm + moved, *bend += m->reach * (moved + m->reach * derivative / 2);
    } else {
      *any_way += m->reach;
    }
    moved += m->reach * derivative;
  }
  *any_way *= sum_rounding(s, which), *bend *= sum_rounding(s, which);
}

/* The part of first order along n, which is seen from the body, of the points whose coordinates are within `half`. */
static double straight(const Sight* s, int which, const double* n, const double* x, const double* half) {
  double sum = 0, way[3], lever[3];
  for (size_t i = 0; i < s->count[which]; ++i) {
    const Move* const m = s->moves[which] + i;
    if (!m->turns) {
      sum += m->reach * (fabs(dot(n, m->way)) + m->blur);
      continue;
    }
    cross(lever, m->way, n), subtract(way, x, m->point);
    double spread = m->blur;
    for (int k = 0; k < 3 && half; ++k) spread += half[k] * fabs(lever[k]);
    sum += m->reach * (fabs(dot(way, lever)) + spread);
  }
  return sum * sum_rounding(s, which);
}

/* Sets n, and what it is as seen from b. */
static int set_direction(Sight* s, const double* way, double* of_b) {
  const double size = length(way);
  if (!(size > 1e-100 && size < 1e100)) return 0;
  for (int k = 0; k < 3; ++k) s->n[k] = way[k] / size;
  place(of_b, &s->back, s->n, 1);
  return 1;
}

static void find_gaps(double gaps[3], const Pose* p, const Box* a, const Box* b) {
  double c[3];
  place(c, p, b->center, 0);
  for (int k = 0; k < 3; ++k) {
    const double *r = p->r[k], half = fabs(r[0]) * b->half[0] + fabs(r[1]) * b->half[1] + fabs(r[2]) * b->half[2];
    const double from = c[k] - a->center[k], gap = fabs(from) - a->half[k] - half;
    gaps[k] = gap > 0 ? (from > 0 ? gap : -gap) : 0;
  }
}

/* Whether what is in the boxes stays apart along a direction. */
static int is_gap(Sight* s, const double* way, const Box* a, const Box* b, double least) {
  double c[3], of_b[3];
  if (!set_direction(s, way, of_b)) return 0;
  place(c, &s->p, b->center, 0), subtract(c, c, a->center);
  double gap = fabs(dot(s->n, c));
  for (int k = 0; k < 3; ++k) gap -= fabs(s->n[k]) * a->half[k] + fabs(of_b[k]) * b->half[k];
  return gap > least &&
         gap - straight(s, 0, s->n, a->center, a->half) - straight(s, 1, of_b, b->center, b->half) > least;
}

static int boxes_apart(Sight* s, const Box* a, const Box* b) {
  double gaps[3], others[3], any_a, any_b, bend_a, bend_b, way[3], old[3];
  const double least = s->least + s->doubt;
  find_drift(s, 0, a->center, length(a->half), &any_a, &bend_a);
  find_drift(s, 1, b->center, length(b->half), &any_b, &bend_b);
  find_gaps(gaps, &s->p, a, b), find_gaps(others, &s->back, b, a);
  if (larger(length(gaps), length(others)) > least + any_a + any_b) return 1;
  const double bent = least + bend_a + bend_b;
  memcpy(old, s->n, sizeof old);
  if (is_gap(s, s->main[0], a, b, bent) || is_gap(s, s->main[1], a, b, bent) || is_gap(s, old, a, b, bent)) return 1;
  place(way, &s->p, others, 1);
  if (is_gap(s, length(gaps) > length(others) ? gaps : way, a, b, bent)) return 1;
  memcpy(s->n, old, sizeof old);
  return 0;
}

/* Two triangles, and what of the drift of their corners does not hang on a direction. */
typedef struct {
  double (*a)[3], (*b)[3], (*of_b)[3]; /* of_b: seen from b */
  double bend[2][3], any_way;
} Two;

/* Whether two planes across the way, farther apart than they have to be, stay between the triangles. */
static int is_slab(Sight* s, const double* way, const Two* two) {
  double n[3], ends[2] = {-INFINITY, -INFINITY}, begins[2] = {INFINITY, INFINITY}, low[2] = {INFINITY, INFINITY},
               high[2] = {-INFINITY, -INFINITY};
  if (!set_direction(s, way, n)) return 0;
  for (int i = 0; i < 6; ++i) {
    const int which = i / 3, k = i % 3;
    const double x = dot(s->n, which ? two->b[k] : two->a[k]);
    const double drift =
        straight(s, which, which ? n : s->n, which ? two->of_b[k] : two->a[k], NULL) + two->bend[which][k];
    low[which] = x < low[which] ? x : low[which], high[which] = larger(high[which], x);
    begins[which] = x - drift < begins[which] ? x - drift : begins[which], ends[which] = larger(ends[which], x + drift);
  }
  const double least = s->least + s->doubt;
  return larger(low[1] - high[0], low[0] - high[1]) > least + two->any_way ||
         larger(begins[1] - ends[0], begins[0] - ends[1]) > least;
}

/* The way to x from the point of t that is about nearest to it. */
static void find_way(double way[3], const double* x, double t[3][3]) {
  double best = INFINITY, n[3], e[3], f[3], d[3], across[3];
  subtract(e, t[1], t[0]), subtract(f, t[2], t[0]), cross(n, e, f);
  int is_within = 1;
  for (int i = 0; i < 3; ++i) {
    subtract(e, t[(i + 1) % 3], t[i]), subtract(d, x, t[i]), cross(across, n, e);
    double s = dot(d, e) / dot(e, e);
    is_within &= dot(across, d) > 0, s = s > 0 ? (s < 1 ? s : 1) : 0;
    for (int k = 0; k < 3; ++k) d[k] -= s * e[k];
    const double rest = s > 0 && s < 1 ? dot(d, e) / dot(e, e) : 0; /* what rounding left along the edge */
    for (int k = 0; k < 3; ++k) d[k] -= rest * e[k];
    if (dot(d, d) < best) best = dot(d, d), memcpy(way, d, sizeof d);
  }
  const double s = dot(d, n) / dot(n, n);
  for (int k = 0; k < 3 && is_within && s != 0; ++k) way[k] = s * n[k];
}

/* Tries planes across the last direction, ways from a corner to the other triangle, products of edges, and normals. */
static int triangles_apart(Sight* s, double a[3][3], double of_b[3][3]) {
  double b[3][3], e[3], f[3], way[3], any[2] = {0, 0};
  Two two = {a, b, of_b, {{0}}, 0};
  for (int i = 0; i < 6; ++i) {
    double any_way;
    find_drift(s, i / 3, i < 3 ? a[i] : of_b[i - 3], 0, &any_way, &two.bend[i / 3][i % 3]);
    any[i / 3] = larger(any[i / 3], any_way);
  }
  two.any_way = any[0] + any[1];
  for (int k = 0; k < 3; ++k) place(b[k], &s->p, of_b[k], 0);
  memcpy(way, s->n, sizeof way);
  if (is_slab(s, s->main[0], &two) || is_slab(s, s->main[1], &two) || is_slab(s, way, &two)) return 1;
  for (int i = 0; i < 17; ++i) {
    double(*const u)[3] = i < 3 || i == 15 ? a : b, (*const v)[3] = i < 3 ? b : a;
    if (i < 6) {
      find_way(way, u[i % 3], v);
    } else {
      const int j = i < 15 ? (i - 6) / 3 : 0, k = i < 15 ? i % 3 : 1;
      double(*const w)[3] = i < 15 ? a : u;
      subtract(e, u[(k + 1) % 3], u[k]), subtract(f, w[(j + 1) % 3], w[j]), cross(way, e, f);
    }
    if (is_slab(s, way, &two)) return 1;
  }
  return 0;
}

static double box_distance(const Sight* s, size_t i, size_t j) {
  double gaps[3], others[3], c[3];
  find_gaps(gaps, &s->p, s->a->box + i, s->b->box + j), find_gaps(others, &s->back, s->b->box + j, s->a->box + i);
  place(c, &s->p, s->b->box[j].center, 0), subtract(c, c, s->a->box[i].center);
  return larger(length(gaps), length(others)) + 1e-6 * length(c);
}

/* Goes down to two triangles that are near, and takes the way between them; and the one between the middles. */
static void find_main(Sight* s) {
  size_t i = 1, first = 0, n = s->a->n, j = 1, other = 0, m = s->b->n;
  while (n > 1 || m > 1) {
    if (m == 1 || (n > 1 && length(s->a->box[i].half) > length(s->b->box[j].half))) {
      const int is_second = box_distance(s, 2 * i + 1, j) < box_distance(s, 2 * i, j);
      i = 2 * i + (size_t)is_second, first += is_second ? n / 2 : 0, n = is_second ? n - n / 2 : n / 2;
    } else {
      const int is_second = box_distance(s, i, 2 * j + 1) < box_distance(s, i, 2 * j);
      j = 2 * j + (size_t)is_second, other += is_second ? m / 2 : 0, m = is_second ? m - m / 2 : m / 2;
    }
  }
  double b[3][3], way[3], best = INFINITY;
  for (int k = 0; k < 3; ++k) place(b[k], &s->p, s->b->t[other].p[k], 0);
  for (int k = 0; k < 6; ++k) {
    find_way(way, k < 3 ? s->a->t[first].p[k] : b[k - 3], k < 3 ? b : s->a->t[first].p);
    if (length(way) < best) best = length(way), memcpy(s->main[0], way, sizeof way);
  }
  place(way, &s->p, s->b->box[1].center, 0), subtract(s->main[1], way, s->a->box[1].center);
}

/* Whether the triangles of two nodes are farther apart than they have to be. */
static int are_apart(Sight* s, size_t i, size_t first, size_t n, size_t j, size_t other, size_t m) {
  const Box *const a = s->a->box + i, *const b = s->b->box + j;
  spend(1);
  if (boxes_apart(s, a, b)) return 1;
  if (n == 1 && m == 1) return spend(10), triangles_apart(s, s->a->t[first].p, s->b->t[other].p);
  if (m == 1 || (n > 1 && length(a->half) > length(b->half)))
    return are_apart(s, 2 * i, first, n / 2, j, other, m) &&
           are_apart(s, 2 * i + 1, first + n / 2, n - n / 2, j, other, m);
  return are_apart(s, i, first, n, 2 * j, other, m / 2) &&
         are_apart(s, i, first, n, 2 * j + 1, other + m / 2, m - m / 2);
}

/* ---- Whether one body is inside of the other ---- */

/* The sign of det(a, b, c), or 0 if rounding hides it. */
static int sign_of(const double* a, const double* b, const double* c) {
  double product[3], size = 0;
  cross(product, b, c);
  for (int k = 0; k < 3; ++k)
    size += fabs(a[k]) * (fabs(b[(k + 1) % 3] * c[(k + 2) % 3]) + fabs(b[(k + 2) % 3] * c[(k + 1) % 3]));
  const double value = dot(a, product);
  return value > ROUND * size + 1e-200 ? 1 : value < -ROUND * size - 1e-200 ? -1 : 0;
}

static int is_point(const Triangle* t) {
  return memcmp(t->p[0], t->p[1], sizeof *t->p) == 0 && memcmp(t->p[1], t->p[2], sizeof *t->p) == 0;
}

/* Whether no closed component winds around x: the triangles that a ray crosses, counted by their sides. */
static int is_outside(const double* x, const Body* b) {
  unsigned random = 1;
  for (int k = 0; k < 3; ++k)
    if (fabs(x[k] - b->box[1].center[k]) > b->box[1].half[k]) return 1;
  for (int attempt = 0; attempt < 100; ++attempt) {
    double ray[3], way[3][3];
    long sum = 0;
    size_t i = 0;
    for (int k = 0; k < 3; ++k) random = random * 1664525 + 1013904223, ray[k] = (double)(random >> 8) / 8388608 - 1;
    for (spend(b->n); i < b->n; ++i) {
      if (b->is_open[b->t[i].component] || is_point(b->t + i)) continue;
      for (int k = 0; k < 3; ++k) subtract(way[k], b->t[i].p[k], x);
      const int p = sign_of(ray, way[0], way[1]), q = sign_of(ray, way[1], way[2]), r = sign_of(ray, way[2], way[0]);
      if (p * q < 0 || q * r < 0 || r * p < 0) continue;
      const int side = p && q && r ? sign_of(way[0], way[1], way[2]) : 0;
      if (!side) break;
      sum += side == p ? side : 0;
    }
    if (i == b->n) return sum == 0;
  }
  return 0;
}

static int is_beside(const Body* a, const Body* b, const Pose* back) {
  double x[3];
  for (size_t i = 0; i < a->components; ++i) {
    place(x, back, a->t[a->some[i]].p[0], 0);
    if (!is_outside(x, b)) return 0;
  }
  return 1;
}

/* ---- Trees of cells ---- */

static Sight sight;
static size_t leaves, cells; /* of the tree; that were proven, of parts of leaves, too */
static double gap;

/* Whether it is proven that two bodies are apart while all freedoms stay within their reaches. */
static int is_cell_free(void) {
  Sight* const s = &sight;
  const int is_first = cells == 0;
  spend(50);
  find_moves(s), find_main(s);
  s->least = gap;
  s->doubt = larger(doubt_of(&s->p, s->b->radius) + ROUND * s->a->radius,
                    doubt_of(&s->back, s->a->radius) + ROUND * s->b->radius);
  if (is_first) s->least += s->doubt; /* so that points that are placed have not passed through the other surface */
  if (!are_apart(s, 1, 0, s->a->n, 1, 0, s->b->n)) return 0;
  ++cells;
  if (is_first && !(is_beside(s->a, s->b, &s->back) && is_beside(s->b, s->a, &s->p)))
    end(1, "one of %s and %s may be inside of the other", s->a->name, s->b->name);
  return 1;
}

static void give_up(void) {
  end(1, "%s and %s may be too close in cell %lu of their tree", sight.a->name, sight.b->name, COUNT(leaves));
}

/* What is proven barely may be seen otherwise here: then in parts. */
enum { MOST_HALVINGS = 10 };

/* The freedom that moves the middles of the bodies most. */
static size_t widest_freedom(void) {
  double most = -1, parts[26] = {0}, way[3], across[3];
  size_t widest = 0;
  for (int which = 0; which < 2; ++which)
    for (size_t i = 0; i < sight.count[which]; ++i) {
      const Move* const m = sight.moves[which] + i;
      const Box* const box = (which ? sight.b : sight.a)->box + 1;
      subtract(way, box->center, m->point), cross(across, way, m->way);
      if (m->freedom >= 26) continue;
      parts[m->freedom] += m->reach * (m->turns ? length(across) + length(box->half) : 1);
      if (parts[m->freedom] > most) most = parts[m->freedom], widest = m->freedom;
    }
  return widest;
}

static void prove_box(int halvings) {
  for (size_t i = 0; i < freedom_count; ++i)
    middles[i] = lows[i] / 2 + highs[i] / 2,
    halves[i] = larger(highs[i] - middles[i], middles[i] - lows[i]) * (1 + ROUND);
  if (is_cell_free()) return;
  if (halvings == 0 || freedom_count == 0) give_up();
  const size_t f = widest_freedom();
  const double low = lows[f], high = highs[f], middle = low / 2 + high / 2;
  highs[f] = middle, prove_box(halvings - 1), highs[f] = high;
  lows[f] = middle, prove_box(halvings - 1), lows[f] = low;
}

/* The next node of a tree: the number of the freedom that is halved, or NONE. */
static size_t next_node(int depth, size_t freedoms) {
  skip_space();
  if (depth == 1000) unreadable("the tree is deeper than 1000");
  const char c = *at;
  if (c != '.' && !(c >= 'a' && c <= 'z' && (size_t)(c - 'a') < freedoms)) unreadable("this is no tree");
  return ++at, c == '.' ? NONE : (size_t)(c - 'a');
}

/* Of a box of positions. */
static void prove_positions(int depth) {
  const size_t f = next_node(depth, freedom_count);
  if (f == NONE) {
    ++leaves, prove_box(MOST_HALVINGS);
    return;
  }
  const double low = lows[f], high = highs[f], middle = low / 2 + high / 2;
  if (!(low <= middle && middle <= high)) end(1, "a cell is too small to be halved");
  highs[f] = middle, prove_positions(depth + 1), highs[f] = high;
  lows[f] = middle, prove_positions(depth + 1), lows[f] = low;
}

/* ---- Paths ---- */

static size_t rows, path_joints;
static double (*curves)[6]; /* of each segment, of each joint: Bezier control points */
static int* degrees;        /* of each segment */

static void add_segment(double* const row[2], const double* time, const int* kind) {
  const double h = time[1] - time[0];
  const int degree = 2 * (kind[0] < kind[1] ? kind[0] : kind[1]) + 1;
  if (!(h > 0)) unreadable("times do not increase");
  degrees = room(degrees, rows - 1, sizeof *degrees), degrees[rows - 1] = degree;
  for (size_t k = 0; k < path_joints; ++k) {
    const double *const a = row[0] + 3 * k, *const b = row[1] + 3 * k, v = h * a[1], w = h * b[1];
    double* const c =
        (curves = room(curves, (rows - 1) * path_joints + k, sizeof *curves))[(rows - 1) * path_joints + k];
    c[0] = a[0], c[degree] = b[0];
    if (degree == 3) c[1] = a[0] + v / 3, c[2] = b[0] - w / 3;
    if (degree == 5)
      c[1] = a[0] + v / 5, c[2] = a[0] + 2 * v / 5 + h * h * a[2] / 20, c[3] = b[0] - 2 * w / 5 + h * h * b[2] / 20,
      c[4] = b[0] - w / 5;
  }
}

static void read_path(void) {
  double *row[2], time[2] = {0, 0};
  int kind[2] = {0, 0};
  if (rows) unreadable("there is a path already");
  const size_t all = count(NONE);
  path_joints = freedom_count = count(frame_count), row[0] = row[1] = NULL;
  for (size_t k = 0; k < path_joints; ++k) {
    Frame* const f = frames + count(frame_count);
    if ((f->kind != TURNS && f->kind != SLIDES) || f->master != NONE || f->freedom != NONE)
      unreadable("this joint does not move freely, or is there already");
    f->freedom = k;
  }
  for (int i = 0; i < 2; ++i) row[i] = resized(NULL, 3 * path_joints, sizeof **row);
  for (; rows < all; ++rows) {
    double* const before = row[0];
    row[0] = row[1], row[1] = before, time[0] = time[1], kind[0] = kind[1];
    time[1] = real(-1e12, 1e12), kind[1] = (int)count(3);
    for (size_t i = 0; i < 3 * path_joints; ++i) row[1][i] = (int)(i % 3) <= kind[1] ? real(-1e6, 1e6) : 0;
    if (rows > 0) add_segment(row, time, kind);
    if (all == 1) curves = resized(NULL, path_joints, sizeof *curves), degrees = resized(NULL, 1, sizeof *degrees);
    for (size_t k = 0; k < path_joints && all == 1; ++k) curves[k][0] = curves[k][1] = row[1][3 * k], degrees[0] = 1;
  }
  if (!rows) unreadable("the path has no rows");
  free(row[0]), free(row[1]);
}

/* The blossom of a curve: the part from u to v has the control points with 0, 1, ... times v. */
static double blossom(const double* curve, int degree, double u, double v, int times) {
  double c[6];
  memcpy(c, curve, sizeof c);
  for (int step = 0; step < degree; ++step)
    for (int i = 0; i < degree - step; ++i)
      c[i] = (1 - (step < times ? v : u)) * c[i] + (step < times ? v : u) * c[i + 1];
  return c[0];
}

/* Where joint k is in the middle of a piece of the path, and how far from there it goes in the piece. */
static void find_path_reach(size_t k, double begin, double middle, double stop) {
  const size_t last = rows > 1 ? rows - 2 : 0;
  size_t i = (size_t)middle < last ? (size_t)middle : last;
  const double u = middle - (double)i;
  middles[k] = blossom(curves[i * path_joints + k], degrees[i], u, u, 0), halves[k] = 0;
  for (i = (size_t)begin < last ? (size_t)begin : last; i <= last && (double)i <= stop; ++i, spend(10)) {
    const double* const c = curves[i * path_joints + k];
    const double from = begin > (double)i ? begin - (double)i : 0, to = stop < (double)i + 1 ? stop - (double)i : 1;
    double largest = 0;
    for (int j = 0; j <= degrees[i]; ++j) largest = larger(largest, fabs(c[j]));
    for (int j = 0; j <= degrees[i]; ++j) { /* rounding: of the control points, and of de Casteljau's steps */
      const double way = fabs(blossom(c, degrees[i], from, to, j) - middles[k]) + 4 * ROUND * largest;
      halves[k] = larger(halves[k], way * (1 + ROUND));
    }
  }
}

static double middle_of(double begin, double stop) {
  const double row = floor((begin + stop) / 2);
  return begin < row && row < stop ? row : (begin + stop) / 2;
}

static void prove_leaf(double begin, double stop, int halvings) {
  const double middle = middle_of(begin, stop);
  for (size_t k = 0; k < path_joints; ++k) find_path_reach(k, begin, middle, stop);
  if (is_cell_free()) return;
  if (halvings == 0 || !(begin < middle && middle < stop)) give_up();
  prove_leaf(begin, middle, halvings - 1), prove_leaf(middle, stop, halvings - 1);
}

static void prove_piece(double begin, double stop, int depth) {
  const double middle = middle_of(begin, stop);
  if (next_node(depth, 1) == NONE) {
    ++leaves, prove_leaf(begin, stop, MOST_HALVINGS);
    return;
  }
  if (!(begin <= middle && middle <= stop)) end(1, "a piece is too small to be halved");
  prove_piece(begin, middle, depth + 1), prove_piece(middle, stop, depth + 1);
}

/* ---- The certificate ---- */

static void make_room(size_t freedoms) {
  double** const all[4] = {&lows, &highs, &middles, &halves};
  for (int i = 0; i < 4; ++i) *all[i] = resized(*all[i], freedoms, sizeof **all[i]);
}

static size_t (*pairs)[2], pair_count; /* the lower number of a body comes first */

/* A pair that stood twice would count twice. */
static void note_pair(size_t a, size_t b) {
  const size_t low = a < b ? a : b, high = a < b ? b : a;
  spend(pair_count);
  for (size_t i = 0; i < pair_count; ++i)
    if (pairs[i][0] == low && pairs[i][1] == high) unreadable("this pair is there already");
  pairs = room(pairs, pair_count, sizeof *pairs), pairs[pair_count][0] = low, pairs[pair_count++][1] = high;
}

static void prove_pair(void) {
  const size_t i_of_a = count(body_count), i_of_b = count(body_count);
  const Body *const a = bodies + i_of_a, *const b = bodies + i_of_b;
  note_pair(i_of_a, i_of_b);
  memset(&sight, 0, sizeof sight), sight.a = a, sight.b = b, leaves = cells = 0;
  find_chain(a->frame, b->frame);
  if (rows) {
    make_room(path_joints), prove_piece(0, (double)(rows - 1), 0);
    return;
  }
  freedom_count = count(27), make_room(freedom_count);
  size_t freedoms[26];
  for (size_t i = 0; i < freedom_count; ++i) {
    freedoms[i] = count(frame_count), lows[i] = real(-FARTHEST, FARTHEST), highs[i] = real(-FARTHEST, FARTHEST);
    if (frames[freedoms[i]].freedom != NONE || !suffices(freedoms[i], lows[i], highs[i]))
      end(1, "%s and %s: these are not all positions of %s", a->name, b->name, frames[freedoms[i]].name);
    frames[freedoms[i]].freedom = i;
  }
  prove_positions(0);
  for (size_t i = 0; i < freedom_count; ++i) frames[freedoms[i]].freedom = NONE;
}

int main(int arguments, char** names) {
  size_t size, gaps = 0;
  if (arguments != 2 || names[1][0] == '-') end(2, "usage: prohull_check_motion CERTIFICATE");
  file_name = names[1], begin_of_file = at = bytes_of(file_name, &size);
  if (!pass("prohull-motion") || !pass("1")) unreadable("this is no certificate of motion of version 1");
  while (!pass("end"))
    if (pass("frame"))
      read_frame();
    else if (pass("body"))
      read_body();
    else if (pass("gap") && !pair_count && !gaps++)
      gap = real(0, FARTHEST);
    else if (pass("path") && !pair_count)
      read_path();
    else if (pass("pair"))
      prove_pair();
    else
      unreadable("this belongs not here, or the end is missing");
  skip_space();
  if (at != begin_of_file + size) unreadable("the certificate goes on behind its end");
  if (!pair_count) end(1, "the certificate has no pairs");
  printf("proven: %lu pair%s %s", COUNT(pair_count), pair_count == 1 ? "" : "s",
         rows ? "apart at every moment of the path" : "that never meet");
  if (gap > 0) printf(", by more than %.17g", gap);
  if (open_bodies) printf("; of %lu, what is not closed counts by its triangles only", COUNT(open_bodies));
  putchar('\n');
  if (fflush(stdout) || ferror(stdout)) return 2;
  return 0;
}
