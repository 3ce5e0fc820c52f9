/* prohull_check CERTIFICATE HULL... ORIGINAL decides again, from the files alone, what prohull says of a hull.
   docs/certificate.md says what the files hold, what is computed here, and why that is a proof. Exit code 0: proven; 1:
   not proven; 2: a file cannot be read. */
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
#define LARGEST 1.7976931348623157e308
#define NONE 0xFFFFFFFFu
#define COUNT(i) ((unsigned long)(i))

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

static void* filled(size_t count, size_t size, int byte) {
  return memset(resized(NULL, count, size), byte, count * size);
}

/* Real files need far less. Files that were made to take for ever end here. */
static void spend(uint64_t steps) {
  static uint64_t spent;
  if ((spent += steps) > UINT64_C(40000000000)) end(1, "this would take too long");
}

/* ---- Exact signs ----
   Numbers are multiples of 2^unit. A number takes at most 2,098 bits, and a product of nine differences 597 limbs. */

typedef const double* Point;
typedef struct {
  uint32_t d[640]; /* the lowest limb first, negative numbers as two's complement; `width` limbs are in use */
} Int;

static int unit, width;

static double size_of(double x) { return x < 0 ? -x : x; }

/* |x| = mantissa 2^low, with an odd mantissa, and |x| < 2^high; 0 has the mantissa 0. */
static uint64_t parts_of(double x, int* low, int* high) {
  uint64_t bits, mantissa;
  memcpy(&bits, &x, sizeof bits);
  *low = (int)(bits >> 52 & 2047), mantissa = bits & 0xFFFFFFFFFFFFF;
  if (*low) mantissa |= UINT64_C(1) << 52, --*low;
  *high = *low - 1021, *low -= 1074;
  for (; mantissa && !(mantissa & 255); mantissa >>= 8) *low += 8;
  for (; mantissa && !(mantissa & 1); mantissa >>= 1) ++*low;
  return mantissa;
}

/* Makes room for sums of products of so many differences of coordinates, and `more` bits. */
static void fit(int degree, int more, int n, const Point* p) {
  int top = -2000, low, high;
  unit = 2000;
  for (int i = 0; i < 3 * n; ++i)
    if (parts_of(p[i / 3][i % 3], &low, &high)) unit = low < unit ? low : unit, top = high > top ? high : top;
  if (top < unit) unit = top = 0;
  width = (degree * (top - unit + 2) + 12 + more) / 32 + 4;
}

/* r = a + b, or a - b if sign < 0. */
static void add(Int* r, const Int* a, const Int* b, int sign) {
  uint64_t carry = sign < 0;
  for (int i = 0; i < width; ++i, carry >>= 32)
    r->d[i] = (uint32_t)(carry += (uint64_t)a->d[i] + (sign < 0 ? ~b->d[i] : b->d[i]));
}

static void clear(Int* r) { memset(r->d, 0, (size_t)width * sizeof *r->d); }

/* r = x / 2^at, which is whole. */
static void set(Int* r, double x, int at) {
  int low, high;
  const uint64_t m = parts_of(x, &low, &high);
  const int shift = m ? low - at : 0;
  const uint64_t first = (m & NONE) << shift % 32, second = (m >> 32) << shift % 32;
  const uint32_t limbs[3] = {(uint32_t)first, (uint32_t)(first >> 32 | second), (uint32_t)(second >> 32)};
  Int zero;
  clear(r);
  memcpy(r->d + shift / 32, limbs, sizeof limbs);
  if (x < 0) clear(&zero), add(r, &zero, r, -1);
}

/* r = x - y */
static void set_difference(Int* r, double x, double y) {
  Int other;
  set(r, x, unit), set(&other, y, unit), add(r, r, &other, -1);
}

/* r += a b, or r -= a b if sign < 0. */
static void multiply_add(Int* r, const Int* a, const Int* b, int sign) {
  const Int* of[2] = {a, b};
  Int turned[2], product;
  int n[2];
  clear(&product);
  for (int k = 0; k < 2; ++k) {
    n[k] = width;
    if (of[k]->d[width - 1] >> 31)
      clear(&turned[k]), add(&turned[k], &turned[k], of[k], -1), of[k] = &turned[k], sign = -sign;
    while (n[k] > 0 && !of[k]->d[n[k] - 1]) --n[k];
  }
  for (int i = 0; i < n[0]; ++i) {
    uint64_t carry = 0;
    for (int j = 0; (j < n[1] || carry) && i + j < width; ++j, carry >>= 32)
      product.d[i + j] = (uint32_t)(carry += (uint64_t)of[0]->d[i] * of[1]->d[j] + product.d[i + j]);
  }
  add(r, r, &product, sign);
}

/* r += w (x - y) 2^50, with a weight that is a multiple of 2^-50 */
static void add_weighted(Int* r, double w, double x, double y) {
  Int difference, weight;
  set_difference(&difference, x, y), set(&weight, w, -50), multiply_add(r, &difference, &weight, 1);
}

static int sign_of(const Int* a) {
  int i = width;
  if (a->d[width - 1] >> 31) return -1;
  while (i > 0 && !a->d[i - 1]) --i;
  return i > 0;
}

/* r = v x w */
static void cross(Int r[3], const Int* v, const Int* w) {
  for (int i = 0; i < 3; ++i) {
    clear(&r[i]);
    multiply_add(&r[i], &v[(i + 1) % 3], &w[(i + 2) % 3], 1);
    multiply_add(&r[i], &v[(i + 2) % 3], &w[(i + 1) % 3], -1);
  }
}

/* r += u v */
static void add_product(Int* r, const Int u[3], const Int v[3]) {
  for (int i = 0; i < 3; ++i) multiply_add(r, &u[i], &v[i], 1);
}

static void add_exact(Int* r, const Point p[6]) {
  Int d[3][3], normal[3];
  for (int i = 0; i < 9; ++i) set_difference(&d[i / 3][i % 3], p[i / 3 * 2][i % 3], p[i / 3 * 2 + 1][i % 3]);
  spend((uint64_t)(width * width));
  cross(normal, d[1], d[2]), add_product(r, d[0], normal);
}

/* det(p0 - p1, p2 - p3, p4 - p5), rounded, and a bound of the error. It is below (7 + 56 2^-53) 2^-53 of the sum of the
   products' sizes, as Shewchuk counts, and so below 1e-15 of that; what underflows is less than 1e-200, as differences
   are below 1e90. */
static double rounded(const Point p[6], double* error) {
  double d[3][3], size = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) d[i][k] = p[2 * i][k] - p[2 * i + 1][k], size += size_of(d[i][k]);
  const double a = d[1][1] * d[2][2], b = d[1][2] * d[2][1], c = d[1][2] * d[2][0], e = d[1][0] * d[2][2],
               f = d[1][0] * d[2][1], g = d[1][1] * d[2][0];
  *error = 1e-15 * (size_of(d[0][0]) * (size_of(a) + size_of(b)) + size_of(d[0][1]) * (size_of(c) + size_of(e)) +
                    size_of(d[0][2]) * (size_of(f) + size_of(g))) +
           1e-200;
  if (size < 1e90) return d[0][0] * (a - b) + d[0][1] * (c - e) + d[0][2] * (f - g);
  return 0;
}

typedef struct {
  Int of[3]; /* weights of the corners of a triangle, at this unit and width: a point within it */
  int unit, width;
} Weights;

/* The sign of the sum of det(a - a0, b - b0, t - c) over n <= 4 points t; or over three with weights. */
static int sign_of_sum(Point a, Point a0, Point b, Point b0, int n, const Point* t, Point c, const Weights* weights) {
  Point p[9] = {a, a0, b, b0, c, c};
  double value = 0, size = 0, error = 0, e;
  Int sum, part;
  if (weights) {
    unit = weights->unit, width = weights->width, clear(&sum);
    for (int i = 0; i < 3; ++i)
      p[4] = t[i], clear(&part), add_exact(&part, p), multiply_add(&sum, &part, &weights->of[i], 1);
    return sign_of(&sum);
  }
  for (int i = 0; i < n; ++i) {
    p[4] = t[i];
    const double x = rounded(p, &e);
    value += x, size += size_of(x), error += e;
  }
  if (size_of(value) > error + 1e-15 * size) return value > 0 ? 1 : -1;
  for (int k = 0; k < 3 && n == 1; ++k)
    if (a[k] == a0[k] && b[k] == b0[k] && t[0][k] == c[k]) return 0;
  for (int i = 0; i < n; ++i) p[i ? 5 + i : 4] = t[i];
  fit(3, 0, 5 + n, p);
  clear(&sum);
  for (int i = 0; i < n; ++i) p[4] = t[i], add_exact(&sum, p);
  return sign_of(&sum);
}

static int det(Point a, Point a0, Point b, Point b0, Point c, Point c0) {
  return c == c0 ? 0 : sign_of_sum(a, a0, b, b0, 1, &c, c0, NULL);
}

static const double origin[3] = {0, 0, 0}, axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* The sign of the normal of (a, b, c) along an axis. */
static int turn(int axis, Point a, Point b, Point c) { return det(b, a, c, a, axes[axis], origin); }

/* ---- Points, and sums of triangles ---- */

typedef struct {
  uint32_t (*t)[3]; /* numbers of points */
  size_t n;
} Mesh;

static double (*points)[3];
static uint32_t* point_slot;
static size_t point_count, point_slots = 1024;

static uint64_t mixed(uint64_t x) {
  x = (x ^ x >> 32) * UINT64_C(0xD6E8FEB86659FD93);
  x = (x ^ x >> 29) * UINT64_C(0x9E3779B97F4A7C15);
  return x ^ x >> 32;
}

/* The number of the point at p: equal positions have one number. NONE if p is not finite. */
static uint32_t point_at(Point p) {
  const double at[3] = {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}; /* no -0 */
  uint64_t bits[3], i;
  if (at[0] - at[0] + (at[1] - at[1]) + (at[2] - at[2]) != 0) return NONE;
  memcpy(bits, at, sizeof bits);
  for (i = mixed(bits[0] ^ mixed(bits[1] ^ mixed(bits[2])));; ++i, spend(1)) {
    uint32_t* const slot = &point_slot[i & (point_slots - 1)];
    if (*slot == NONE) return memcpy(points[point_count], at, sizeof at), *slot = (uint32_t)point_count++;
    if (!memcmp(points[*slot], at, sizeof at)) return *slot;
  }
}

/* A sum of oriented triangles (a, b, c), or of edges (a, b, NONE). */
typedef struct {
  uint32_t key[3];
  int32_t times; /* 0: empty */
} Term;
typedef struct {
  Term* term;
  size_t size, used;
} Sum;

/* Sorts the key, and returns the sign of the permutation. */
static int sort_key(uint32_t k[3]) {
  int sign = 1;
  for (int i = 0; i < 3; ++i) {
    const uint32_t x = k[i % 2];
    if (x > k[i % 2 + 1]) k[i % 2] = k[i % 2 + 1], k[i % 2 + 1] = x, sign = -sign;
  }
  return sign;
}

static size_t home(const Sum* s, const uint32_t k[3]) {
  return mixed(((uint64_t)k[0] << 32 | k[1]) ^ mixed(k[2])) & (s->size - 1);
}

/* The term of this sorted key; with `make`, an empty one where there is none. */
static Term* term_of(Sum* s, const uint32_t k[3], int make) {
  size_t i;
  if (2 * s->used >= s->size) {
    const Sum old = *s;
    s->size = old.size ? 2 * old.size : 1024, s->used = 0;
    s->term = filled(s->size, sizeof *s->term, 0);
    for (i = 0; i < old.size; ++i)
      if (old.term[i].times) *term_of(s, old.term[i].key, 1) = old.term[i];
    free(old.term);
  }
  for (i = home(s, k); s->term[i].times; i = (i + 1) & (s->size - 1), spend(1))
    if (!memcmp(s->term[i].key, k, sizeof s->term[i].key)) return &s->term[i];
  if (make) memcpy(s->term[i].key, k, sizeof s->term[i].key), ++s->used;
  return &s->term[i];
}

static void add_term(Sum* s, uint32_t a, uint32_t b, uint32_t c, int times) {
  uint32_t k[3] = {a, b, c};
  if (a == b || b == c || c == a) return;
  times *= sort_key(k);
  Term* const t = term_of(s, k, 1);
  if (t->times > 1 << 30 || t->times < -(1 << 30)) end(1, "a triangle occurs too often");
  if ((t->times += times)) return;
  --s->used; /* the terms behind it move up */
  for (size_t hole = (size_t)(t - s->term), i = (hole + 1) & (s->size - 1); s->term[i].times;
       i = (i + 1) & (s->size - 1))
    if (((i - home(s, s->term[i].key)) & (s->size - 1)) >= ((i - hole) & (s->size - 1)))
      s->term[hole] = s->term[i], s->term[i].times = 0, hole = i;
}

static int is_closed(Mesh m) {
  Sum sum = {NULL, 0, 0};
  for (size_t i = 0; i < 3 * m.n; ++i) add_term(&sum, m.t[i / 3][i % 3], m.t[i / 3][(i + 1) % 3], NONE, 1);
  free(sum.term);
  return !sum.used;
}

static uint32_t root(uint32_t* parent, uint32_t i) {
  for (; parent[i] != i; i = parent[i]) parent[i] = parent[parent[i]];
  return i;
}

static uint32_t* each_alone(size_t n) {
  uint32_t* const parent = resized(NULL, n, sizeof *parent);
  for (uint32_t i = 0; i < n; ++i) parent[i] = i;
  return parent;
}

/* ---- Files ---- */

typedef enum { ASCII, LITTLE, BIG } Encoding;
typedef enum { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE } Type;
typedef struct {
  const char* name;
  unsigned char *begin, *at, *end; /* a 0 follows */
  Encoding encoding;
  int joins; /* whether a backslash joins lines */
} File;
typedef struct {
  double (*vertex)[3];
  uint32_t (*t)[3], *face, corner[2]; /* face: the first triangle of the face of each; corner: the first and the last of
                                         the one that is read */
  size_t vertices, first, n, corners; /* first: the first vertex of the file that is read */
} Raw;

NO_RETURN static void unreadable(const File* f, const char* what) {
  unsigned long line = 1;
  for (const unsigned char* p = f->begin; p < f->at; ++p) line += *p == '\n';
  end(2, "%s, byte %lu, line %lu: %s", f->name, COUNT(f->at - f->begin), line, what);
}

static File opened(const char* name) {
  File f = {name, NULL, NULL, NULL, ASCII, 0};
  FILE* const stream = fopen(name, "rb");
  size_t size = 0, space = 1 << 16, got;
  if (!stream) end(2, "%s cannot be opened", name);
  for (f.begin = resized(NULL, space, 1); (got = fread(f.begin + size, 1, space - size - 1, stream)) > 0;)
    if ((size += got) + 1 == space) f.begin = resized(f.begin, space *= 2, 1);
  if (ferror(stream)) end(2, "%s cannot be read", name);
  fclose(stream);
  f.at = f.begin, f.end = f.begin + size, *f.end = 0;
  return f;
}

/* Goes to the next word, of this line or of any. False if there is none. Comments are passed. */
static int next_word(File* f, int any_line) {
  for (; f->at < f->end; ++f->at)
    if (*f->at == '#')
      while (f->at + 1 < f->end && f->at[1] != '\n') ++f->at;
    else if (f->joins && *f->at == '\\' && (f->at[1] == '\n' || (f->at[1] == '\r' && f->at[2] == '\n')))
      f->at += f->at[1] == '\n' ? 1 : 2;
    else if (*f->at > ' ' || (*f->at == '\n' && !any_line))
      return *f->at != '\n';
  return 0;
}

static int pass_word(File* f) {
  if (!next_word(f, 0)) return 0;
  while (*f->at > ' ') ++f->at;
  return 1;
}

static void pass_line(File* f) {
  while (pass_word(f)) {
  }
}

/* Passes the next word of this line if it is this one, in any case. */
static int pass(File* f, const char* word) {
  size_t n = 0;
  if (!next_word(f, 0)) return 0;
  while (word[n] && (f->at[n] | 32) == (word[n] | 32)) ++n;
  if (word[n] || f->at[n] > ' ') return 0;
  f->at += n;
  return 1;
}

static double decimal(File* f, int any_line) {
  char* rest;
  uint32_t whole = 0;
  if (!next_word(f, any_line)) unreadable(f, "a number is missing");
  const unsigned char* p = f->at;
  while (p - f->at < 9 && *p >= '0' && *p <= '9') whole = 10 * whole + (*p++ - 48u);
  if (p > f->at && *p <= ' ') return f->at += p - f->at, whole;
  const double x = strtod((char*)f->at, &rest);
  if (rest == (char*)f->at || ((unsigned char)*rest > ' ' && !strchr("/,]}", *rest)))
    unreadable(f, "this is no number");
  f->at = (unsigned char*)rest;
  return x;
}

static double value(File* f, Type type) {
  const int size = type == DOUBLE ? 8 : type >= INT32 ? 4 : type >= INT16 ? 2 : 1;
  uint64_t bits = 0;
  double x;
  float y;
  if (f->encoding == ASCII) return type == FLOAT ? (float)decimal(f, 1) : decimal(f, 1);
  if (f->end - f->at < size) unreadable(f, "the file ends here");
  for (int i = 0; i < size; ++i) bits |= (uint64_t)*f->at++ << 8 * (f->encoding == BIG ? size - 1 - i : i);
  const uint32_t word = (uint32_t)bits;
  if (type == FLOAT) return memcpy(&y, &word, sizeof y), y;
  if (type == DOUBLE) return memcpy(&x, &bits, sizeof x), x;
  return type % 2 == 0 && bits >> (8 * size - 1) ? -(double)((UINT64_C(1) << 8 * size) - bits) : (double)bits;
}

static void add_vertex(Raw* m, double x, double y, double z) {
  m->vertex = room(m->vertex, m->vertices, sizeof *m->vertex);
  m->vertex[m->vertices][0] = x, m->vertex[m->vertices][1] = y, m->vertex[m->vertices++][2] = z;
}

static void add_triangle(Raw* m, uint32_t a, uint32_t b, uint32_t c, int begins_face) {
  m->t = room(m->t, m->n, sizeof *m->t), m->face = room(m->face, m->n, sizeof *m->face);
  m->face[m->n] = begins_face ? (uint32_t)m->n : m->face[m->n - 1];
  m->t[m->n][0] = a, m->t[m->n][1] = b, m->t[m->n++][2] = c;
}

static uint32_t vertex(const Raw* m, const File* f, double x) {
  x += x >= 0 ? (double)m->first : 0;
  if (!(x >= 0 && x < (double)m->vertices && x < NONE) || x != (double)(uint32_t)x)
    unreadable(f, "the face has no such vertex");
  return (uint32_t)x;
}

/* A face is the fan of its first corner; one with fewer than three corners repeats the last. */
static void add_corner(Raw* m, const File* f, double x) {
  const uint32_t v = vertex(m, f, x);
  if (!m->corners) m->corner[0] = v;
  if (m->corners > 1) add_triangle(m, m->corner[0], m->corner[1], v, m->corners == 2);
  m->corner[1] = v, ++m->corners;
}

/* Every second triangle of a strip is turned; -1 begins the next strip. */
static void add_to_strip(Raw* m, const File* f, double x) {
  const uint32_t a = m->corner[0], b = m->corner[1], v = x == -1 || x == NONE ? NONE : vertex(m, f, x),
                 odd = m->corners % 2;
  if (m->corners > 1 && v != NONE && a != b && b != v && v != a) add_triangle(m, odd ? b : a, odd ? a : b, v, 1);
  m->corner[0] = b, m->corner[1] = v, m->corners = v == NONE ? 0 : m->corners + 1;
}

static void end_face(Raw* m) {
  if (m->corners == 1 || m->corners == 2) add_triangle(m, m->corner[0], m->corner[1], m->corner[1], 1);
  m->corners = 0;
}

/* A vertex, and a corner if it is one of a facet. */
static void read_vertex(File* f, Raw* m, Type type, int is_corner) {
  double x[3];
  for (int k = 0; k < 3; ++k) x[k] = f->encoding == ASCII ? decimal(f, is_corner) : value(f, type);
  add_vertex(m, x[0], x[1], x[2]);
  if (is_corner) add_corner(m, f, (double)(m->vertices - 1 - m->first));
}

static void read_stl(File* f, Raw* m) {
  const int text = next_word(f, 1) && pass(f, "solid");
  double count = 0;
  f->at = f->begin;
  if (f->end - f->begin >= 84) f->encoding = LITTLE, f->at += 80, count = value(f, UINT32);
  if (f->encoding == LITTLE && (!text || (double)(f->end - f->begin) == 84 + 50 * count)) {
    for (; count > 0; --count, f->at += 2, end_face(m)) {
      if (f->end - f->at < 50) unreadable(f, "the file ends within a triangle");
      f->at += 12;
      for (int k = 0; k < 3; ++k) read_vertex(f, m, FLOAT, 1);
    }
    return;
  }
  if (!text) unreadable(f, "this is no STL file");
  for (f->encoding = ASCII, f->at = f->begin; next_word(f, 1);)
    if (pass(f, "solid") || pass(f, "endsolid"))
      pass_line(f);
    else if (pass(f, "normal"))
      pass_word(f), pass_word(f), pass_word(f);
    else if (pass(f, "vertex"))
      read_vertex(f, m, FLOAT, 1);
    else if (pass(f, "endfacet") && m->corners == 3)
      end_face(m);
    else if (!pass(f, "facet") && !pass(f, "outer") && !pass(f, "loop") && !pass(f, "endloop"))
      unreadable(f, "this does not belong here");
  if (m->corners) unreadable(f, "the file ends within a facet");
}

static void read_obj(File* f, Raw* m) {
  for (f->joins = 1; next_word(f, 1); pass_line(f)) {
    if (pass(f, "v"))
      read_vertex(f, m, DOUBLE, 0);
    else if (pass(f, "f") || pass(f, "fo"))
      while (next_word(f, 0)) {
        const double x = decimal(f, 0);
        add_corner(m, f, x < 0 ? x + (double)(m->vertices - m->first) : x - 1);
        while (*f->at > ' ') ++f->at;
      }
    end_face(m);
  }
}

static void read_off(File* f, Raw* m) {
  double vertices, faces;
  if (next_word(f, 1) && !pass(f, "OFF") && !pass(f, "COFF") && !pass(f, "NOFF") && !pass(f, "CNOFF"))
    unreadable(f, "OFF is missing");
  for (vertices = decimal(f, 1), faces = decimal(f, 0), pass_line(f); vertices > 0; --vertices, pass_line(f))
    next_word(f, 1), read_vertex(f, m, DOUBLE, 0);
  for (; faces > 0; --faces, pass_line(f), end_face(m))
    for (double n = decimal(f, 1); n > 0; --n) add_corner(m, f, decimal(f, 0));
}

static Type read_type(File* f) {
  static const char* const names[] = {"char", "int8",  "uchar", "uint8",  "short", "int16",   "ushort", "uint16",
                                      "int",  "int32", "uint",  "uint32", "float", "float32", "double", "float64"};
  for (int i = 0; i < 16; ++i)
    if (pass(f, names[i])) return (Type)(i / 2);
  unreadable(f, "this type is not known");
}

/* Roles of properties: 0, 1, 2 are x, y, z of a vertex, 3 is the list of corners of a face, and -1 is not read. */
static void read_ply(File* f, Raw* m) {
  static const char* const names[] = {"x", "y", "z", "vertex_indices", "vertex_index"};
  enum { VERTEX, FACE, STRIPS, OTHER };
  struct {
    int kind, roles;
    double count;
    size_t end;
  }* element = NULL;
  struct {
    int list, role;
    Type length, type;
  }* property = NULL;
  size_t elements = 0, properties = 0, p = 0;
  Encoding encoding = ASCII;
  for (pass_line(f); next_word(f, 1) && !pass(f, "end_header"); pass_line(f))
    if (pass(f, "format")) {
      encoding = pass(f, "ascii") ? ASCII : pass(f, "binary_little_endian") ? LITTLE : BIG;
      if (encoding == BIG && !pass(f, "binary_big_endian")) unreadable(f, "this format is not known");
    } else if (pass(f, "element")) {
      element = room(element, elements, sizeof *element);
      element[elements].kind = pass(f, "vertex")      ? VERTEX
                               : pass(f, "face")      ? FACE
                               : pass(f, "tristrips") ? STRIPS
                                                      : OTHER;
      if (element[elements].kind == OTHER) pass_word(f);
      element[elements].count = decimal(f, 0), element[elements].roles = 0, element[elements++].end = properties;
    } else if (pass(f, "property")) {
      if (!elements) unreadable(f, "a property without an element");
      property = room(property, properties, sizeof *property);
      property[properties].list = pass(f, "list"), property[properties].role = -1;
      if (property[properties].list) property[properties].length = read_type(f);
      property[properties].type = read_type(f);
      for (int i = 0; i < 5; ++i)
        if (pass(f, names[i]) && element[elements - 1].kind != OTHER &&
            (element[elements - 1].kind == VERTEX) == (i < 3) && property[properties].list == i / 3)
          property[properties].role = i < 3 ? i : 3, ++element[elements - 1].roles;
      element[elements - 1].end = ++properties;
    }
  f->at += *f->at == '\r', f->at += *f->at == '\n', f->encoding = encoding;
  for (size_t e = 0; e < elements; p = element[e++].end) {
    if (element[e].count > 0 && element[e].kind != OTHER && element[e].roles != (element[e].kind == VERTEX ? 3 : 1))
      unreadable(f, "x, y, z or vertex_indices are missing");
    for (; element[e].count > 0 && element[e].end > p; --element[e].count, end_face(m)) {
      double x[3] = {0, 0, 0};
      for (size_t k = p; k < element[e].end; ++k)
        for (double n = property[k].list ? value(f, property[k].length) : 1; n > 0; --n) {
          const double number = value(f, property[k].type);
          if (property[k].role == 3 && element[e].kind == FACE)
            add_corner(m, f, number);
          else if (property[k].role == 3)
            add_to_strip(m, f, number);
          else if (property[k].role >= 0)
            x[property[k].role] = number;
        }
      if (element[e].kind == VERTEX) add_vertex(m, x[0], x[1], x[2]);
      if (element[e].kind == STRIPS) m->corners = 0;
    }
  }
  free(element), free(property);
}

static int pass_mark(File* f, int mark) { return next_word(f, 0) && *f->at == mark && ++f->at; }

/* Collision spheres, after at most two names, each as - {center: [x, y, z], radius: r}, or without the braces and the
   comma, and the radius on the next line. */
static void read_balls(File* f, double (**ball)[4], size_t* count) {
  for (int names = 0; next_word(f, 1);)
    if (pass_mark(f, '-')) {
      const int braces = pass_mark(f, '{');
      double b[4];
      if (!pass(f, "center:")) unreadable(f, "center: is missing");
      for (int k = 0; k < 3; ++k) {
        if (!pass_mark(f, k ? ',' : '[')) unreadable(f, "[ or , is missing");
        b[k] = decimal(f, 0);
      }
      if (!pass_mark(f, ']') || (braces && !pass_mark(f, ',')) || !next_word(f, 1) || !pass(f, "radius:"))
        unreadable(f, "] or radius: is missing");
      b[3] = decimal(f, 0);
      if (braces && !pass_mark(f, '}')) unreadable(f, "} is missing");
      if (!(b[3] > 0) || b[0] - b[0] + (b[1] - b[1]) + (b[2] - b[2]) + (b[3] - b[3]) != 0)
        unreadable(f, "this is no ball");
      *ball = room(*ball, *count, sizeof **ball);
      memcpy((*ball)[(*count)++], b, sizeof b);
    } else if (!pass_word(f) || f->at[-1] != ':' || next_word(f, 0) || ++names > 2) {
      unreadable(f, "this is not the list of balls of one link");
    }
}

static int ends_in(const char* name, const char* suffix) {
  size_t n = strlen(suffix), all = strlen(name);
  while (all && n && (name[all - 1] | 32) == suffix[n - 1]) --all, --n;
  return !n;
}

static void read_mesh(const char* name, Raw* m) {
  File f = opened(name);
  m->first = m->vertices;
  if (ends_in(name, ".stl"))
    read_stl(&f, m);
  else if (ends_in(name, ".obj"))
    read_obj(&f, m);
  else if (ends_in(name, ".off"))
    read_off(&f, m);
  else if (ends_in(name, ".ply"))
    read_ply(&f, m);
  else
    end(2, "%s: the name of a mesh ends in .stl, .obj, .off or .ply", name);
  free(f.begin);
}

/* ---- Surfaces: triangles, and a tree of boxes around them ---- */

typedef struct {
  double low[3], high[3];
} Box;
typedef struct {
  const char* name;
  uint32_t (*t)[3], *number; /* in order along a curve; their numbers in the mesh */
  size_t n,
      leaves; /* node 1 is the root, node i has the children 2 i and 2 i + 1; the last `leaves` nodes are leaves */
  Box* box;
  double gap;
} Surface;
typedef struct {
  uint64_t code;
  uint32_t face;
} Key;

static int by_code(const void* a, const void* b) {
  const Key *x = a, *y = b;
  return x->code != y->code ? (x->code < y->code ? -1 : 1) : (x->face > y->face) - (x->face < y->face);
}

static void extend(Box* b, Point low, Point high) {
  for (int k = 0; k < 3; ++k)
    b->low[k] = low[k] < b->low[k] ? low[k] : b->low[k], b->high[k] = high[k] > b->high[k] ? high[k] : b->high[k];
}

static Box box_of(uint32_t (*t)[3], size_t n) {
  Box b = {{LARGEST, LARGEST, LARGEST}, {-LARGEST, -LARGEST, -LARGEST}};
  for (size_t i = 0; i < 3 * n; ++i) extend(&b, points[t[i / 3][i % 3]], points[t[i / 3][i % 3]]);
  return b;
}

static int are_apart(const Box* a, const Box* b, double reach) {
  for (int k = 0; k < 3; ++k)
    if (a->low[k] - b->high[k] > reach || b->low[k] - a->high[k] > reach) return 1;
  return 0;
}

/* The triangles whose boxes may be within reach of the box. */
static size_t near(const Surface* s, const Box* box, double reach, uint32_t** list) {
  size_t stack[128] = {1}, top = 1, n = 0;
  for (spend(1); top > 0;) {
    const size_t node = stack[--top], leaf = node - s->leaves;
    if (are_apart(&s->box[node], box, reach)) continue;
    if (node < s->leaves) stack[top++] = 2 * node, stack[top++] = 2 * node + 1;
    for (size_t i = leaf * s->n / s->leaves; node >= s->leaves && i < (leaf + 1) * s->n / s->leaves; ++i) {
      const Box own = box_of(s->t + i, 1);
      if (!are_apart(&own, box, reach)) *list = room(*list, n, sizeof **list), (*list)[n++] = (uint32_t)i;
    }
  }
  spend(16 * n);
  return n;
}

/* Visits all pairs of triangles whose boxes may be within reach of each other. */
static void visit_pairs(const Surface* a, const Surface* b, double reach, void (*visit)(void*, size_t, size_t),
                        void* context) {
  uint32_t* list = NULL;
  Box* others = NULL;
  for (size_t first = 0; first < a->n; first += 16) {
    const size_t end = a->n - first < 16 ? a->n : first + 16;
    const Box all = box_of(a->t + first, end - first);
    const size_t n = near(b, &all, reach, &list);
    others = resized(others, n, sizeof *others);
    for (size_t j = 0; j < n; ++j) others[j] = box_of(b->t + list[j], 1);
    for (size_t i = first; i < end; ++i) {
      const Box box = box_of(a->t + i, 1);
      for (size_t j = 0; j < n; ++j)
        if (!are_apart(&box, &others[j], reach)) spend(20), visit(context, i, list[j]);
    }
  }
  free(list), free(others);
}

static int has_area(const uint32_t t[3]) {
  for (int k = 0; k < 3; ++k)
    if (turn(k, points[t[0]], points[t[1]], points[t[2]])) return 1;
  return 0;
}

static Surface surface_of(const char* name, Mesh m, int flat_too) {
  Surface s = {name, resized(NULL, m.n, sizeof *s.t), resized(NULL, m.n, sizeof *s.number), 0, 1, NULL, 0};
  Key* const keys = resized(NULL, m.n, sizeof *keys);
  const Box all = box_of(m.t, m.n);
  for (uint32_t i = 0; i < m.n; ++i) {
    if (!flat_too && !has_area(m.t[i])) continue;
    keys[s.n].face = i, keys[s.n].code = 0;
    for (int k = 0; k < 3; ++k) {
      const double size = all.high[k] / 2 - all.low[k] / 2, at = points[m.t[i][0]][k] / 2 - all.low[k] / 2;
      const uint64_t bits = at < size ? (uint64_t)(at / size * 2097151) : 2097151;
      for (int b = 0; b < 21; ++b) keys[s.n].code |= (bits >> b & 1) << (3 * b + k);
    }
    ++s.n;
  }
  qsort(keys, s.n, sizeof *keys, by_code);
  for (size_t i = 0; i < s.n; ++i) s.number[i] = keys[i].face, memcpy(s.t[i], m.t[keys[i].face], sizeof *s.t);
  while (4 * s.leaves < s.n) s.leaves *= 2;
  s.box = resized(NULL, 2 * s.leaves, sizeof *s.box);
  for (size_t i = 2 * s.leaves; --i > 0;) {
    const size_t from = (i - s.leaves) * s.n / s.leaves;
    s.box[i] = i < s.leaves ? s.box[2 * i] : box_of(s.t + from, (i - s.leaves + 1) * s.n / s.leaves - from);
    if (i < s.leaves) extend(&s.box[i], s.box[2 * i + 1].low, s.box[2 * i + 1].high);
  }
  free(keys);
  return s;
}

/* The weights divided by their sum; the error is below 1e-15. */
static void shares_of(const Weights* weights, double share[3]) {
  Int sum = weights->of[0];
  int top = width = weights->width;
  double all = 0;
  add(&sum, &sum, &weights->of[1], 1), add(&sum, &sum, &weights->of[2], 1);
  while (top > 4 && !sum.d[top - 1]) --top;
  for (int i = 0; i < 3; ++i) {
    share[i] = 0;
    for (int k = top - 4; k < top; ++k) share[i] = share[i] * 0x1p-32 + weights->of[i].d[k];
    all += share[i];
  }
  for (int i = 0; i < 3; ++i) share[i] /= all;
}

/* How often s winds around a point within t, that with these weights or (2, 1, 1), moved off s as the page says. The
   ray runs along the axis. */
static int winding(const Surface* s, const uint32_t t[3], int axis, int direction, const Weights* weights) {
  static uint32_t* list;
  const Point q[4] = {points[t[0]], points[t[1]], points[t[2]], points[t[0]]};
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  int result = 0;
  double share[3] = {0.5, 0.25, 0.25};
  Box box;
  if (weights) shares_of(weights, share);
  for (int k = 0; k < 3; ++k) {
    const double a = q[0][k] * share[0], b = q[1][k] * share[1], c = q[2][k] * share[2],
                 error = 1e-14 * (size_of(q[0][k]) + size_of(q[1][k]) + size_of(q[2][k])) + 1e-300;
    box.low[k] = a + b + c - error, box.high[k] = a + b + c + error;
  }
  (direction > 0 ? box.high : box.low)[axis] = direction * LARGEST;
  for (size_t n = near(s, &box, 0, &list); n-- > 0;) {
    const uint32_t* const g = s->t[list[n]];
    const Point f[3] = {points[g[0]], points[g[1]], points[g[2]]};
    int looks = 0, i = 0;
    for (; i < 3; ++i) {
      const Point from = f[i], to = f[(i + 1) % 3];
      int sign = sign_of_sum(axes[axis], origin, to, from, 4, q, from, weights);
      if (!sign) sign = to[y] != from[y] ? (to[y] < from[y] ? 1 : -1) : (to[x] > from[x]) - (to[x] < from[x]);
      if (!sign || sign == -looks) break;
      looks = sign;
    }
    if (i == 3 && sign_of_sum(f[1], f[0], f[2], f[0], 4, q, f[0], weights) * looks * direction < 0)
      result += looks * direction;
  }
  return result;
}

/* The same beside t, on its outer or inner side. */
static int winding_at(const Surface* s, const uint32_t t[3], int outer, const Weights* weights) {
  int k = 0, looks = 0;
  while (k < 3 && !(looks = turn(k, points[t[0]], points[t[1]], points[t[2]]))) ++k;
  return looks ? winding(s, t, k, outer ? looks : -looks, weights) : 0;
}

/* ---- Which sides of the triangles of one surface are free of another, and how often that winds there ---- */

enum { OUTER = 1, INNER = 2, BOTH = 3, UNKNOWN = -(1 << 30) };
typedef struct {
  const Surface *on, *of;
  unsigned char *blocked, *touched; /* sides of each triangle; whether each point may be on `of` */
  uint32_t* parent;                 /* of each point: those that `of` does not part */
  int* value;                       /* how often `of` winds around each point that is a root */
} Sides;

/* The signs of the corners of f against the plane of t; returns the sides of t on which corners lie. */
static unsigned place(const uint32_t t[3], const uint32_t f[3], int sign[3]) {
  const Point a = points[t[0]];
  unsigned sides = 0;
  for (int i = 0; i < 3; ++i) {
    const uint32_t v = f[i];
    sign[i] = v == t[0] || v == t[1] || v == t[2] ? 0 : det(points[t[1]], a, points[t[2]], a, points[v], a);
    if (sign[i]) sides |= sign[i] > 0 ? OUTER : INNER;
  }
  return sides;
}

/* The sides of t that f blocks, and in the next two bits the sides of f that t blocks. Notes corners that may be on
 * the other triangle. */
static unsigned blocked_sides(const uint32_t t[3], const uint32_t f[3], unsigned char* t_touched,
                              unsigned char* f_touched) {
  int tf[3], ft[3];
  unsigned of_f = place(f, t, tf), of_t;
  if (tf[0] && tf[0] == tf[1] && tf[1] == tf[2]) return 0;
  of_t = place(t, f, ft);
  if (ft[0] && ft[0] == ft[1] && ft[1] == ft[2]) return 0;
  for (int i = 0; i < 3; ++i) {
    if (!tf[i] && t_touched) t_touched[t[i]] = 1;
    if (!ft[i] && f_touched) f_touched[f[i]] = 1;
  }
  const int f_parts = of_f == OUTER || of_f == INNER, t_parts = of_t == OUTER || of_t == INNER;
  if (t_parts) of_f = 0; /* the plane of t parts them, and does not hold f */
  if (f_parts) of_t = 0;
  for (int e = 0; e < 9 && (of_t || of_f); ++e) {
    const Point a = points[t[e % 3]], b = points[t[(e + 1) % 3]], c = points[f[e / 3]], d = points[f[(e / 3 + 1) % 3]];
    const int x = det(b, a, d, c, points[t[(e + 2) % 3]], a), y = det(b, a, d, c, c, a),
              z = det(b, a, d, c, points[f[(e / 3 + 2) % 3]], a);
    if (x * y > 0 || x * z > 0 || y * z < 0) continue;
    if (x || (y && z)) of_t = 0;
    if (y || z) of_f = 0;
  }
  return of_t | of_f << 2;
}

static Sides sides_of(const Surface* on, const Surface* of) {
  Sides s = {on, of, filled(on->n, 1, 0), filled(point_count, 1, 0), each_alone(point_count), NULL};
  s.value = resized(NULL, point_count, sizeof *s.value);
  for (size_t i = 0; i < point_count; ++i) s.value[i] = UNKNOWN;
  return s;
}

static void note_blocked(void* context, size_t i, size_t j) {
  Sides* const s = context; /* of a on b, and of b on a */
  const unsigned sides = blocked_sides(s[0].on->t[i], s[1].on->t[j], s[0].touched, s[1].touched);
  s[0].blocked[i] |= (unsigned char)(sides & BOTH), s[1].blocked[j] |= (unsigned char)(sides >> 2);
}

static void join(Sides* s) {
  for (size_t i = 0; i < 3 * s->on->n; ++i) {
    const uint32_t a = s->on->t[i / 3][i % 3], b = s->on->t[i / 3][(i + 1) % 3];
    if (s->blocked[i / 3] != BOTH && !s->touched[a] && !s->touched[b])
      s->parent[root(s->parent, a)] = root(s->parent, b);
  }
}

/* How often `of` winds beside the triangle, on a free side of it. */
static int winding_beside(Sides* s, size_t i, int outer) {
  const uint32_t* const t = s->on->t[i];
  for (int k = 0; k < 3; ++k)
    if (!s->touched[t[k]]) {
      const uint32_t r = root(s->parent, t[k]), at[3] = {t[k], t[k], t[k]};
      if (s->value[r] == UNKNOWN) s->value[r] = winding(s->of, at, 0, 1, NULL);
      return s->value[r];
    }
  return winding_at(s->of, t, outer, NULL);
}

/* ---- Sections of the certificate ---- */

enum { COVERS = 1, ENCLOSES = 2, GAP = 4, DISTANCE = 8 };
typedef struct {
  File file;
  int inner, claims;
  Raw raw; /* the original */
  Mesh hull, original;
  double (*ball)[4], gap, distance;
  size_t balls;
} Case;

static uint64_t number(File* f, uint64_t below) {
  uint64_t x = 0;
  unsigned char* const from = f->at;
  for (int shift = 0; shift < 64 && f->at < f->end; shift += 7) {
    x |= (uint64_t)(*f->at & 127) << shift;
    if (shift == 63 && *f->at > 1) break;
    if (*f->at++ & 128) continue;
    if (x < below) return x;
    break;
  }
  f->at = from;
  unreadable(f, "this number is missing or too large");
}

/* Turns the components of the named triangles, whose volumes must be negative. */
static void turn_components(Mesh m, File* f, uint64_t count) {
  uint32_t* const parent = each_alone(m.n);
  double* const volume = filled(2 * m.n, sizeof *volume, 0); /* of each component, and its error */
  unsigned char* const named = filled(m.n, 1, 0);
  Sum edges = {NULL, 0, 0};
  for (size_t i = 0; i < 3 * m.n; ++i) {
    uint32_t key[3] = {m.t[i / 3][i % 3], m.t[i / 3][(i + 1) % 3], NONE};
    sort_key(key);
    Term* const t = term_of(&edges, key, 1);
    if (!t->times) t->times = (int32_t)(i / 3 + 1);
    parent[root(parent, (uint32_t)t->times - 1)] = root(parent, (uint32_t)(i / 3));
  }
  for (; count > 0; --count) named[root(parent, (uint32_t)number(f, m.n))] = 1;
  for (uint32_t i = 0; i < m.n; ++i) {
    uint32_t *const t = m.t[i], r = root(parent, i), x = t[1];
    const Point base = points[m.t[r][0]], p[6] = {points[t[0]], base, points[t[1]], base, points[t[2]], base};
    double error;
    if (!named[r]) continue;
    volume[2 * r] += rounded(p, &error), volume[2 * r + 1] += 1.01 * error + 1e-15 * size_of(volume[2 * r]);
    t[1] = t[2], t[2] = x;
  }
  for (uint32_t i = 0; i < m.n; ++i)
    if (named[i] && !(volume[2 * i] < -volume[2 * i + 1]))
      end(1, "the volume of the component of triangle %u of the original is not negative", i);
  free(edges.term), free(parent), free(volume), free(named);
}

static double real(File* f, double least) {
  const double x = value(f, DOUBLE);
  if (x - x != 0 || x < least) unreadable(f, "this number is not finite or too small");
  return x;
}

static void prove_tetrahedra(Case* c) {
  File* const f = &c->file;
  const size_t left = (size_t)(f->end - f->at), added = (size_t)number(f, left / 24 + 1), all = c->raw.vertices + added;
  uint32_t* const p = resized(NULL, all, sizeof *p);
  Sum sum = {NULL, 0, 0};
  for (size_t i = 0; i < all; ++i) {
    double x[3];
    for (int k = 0; k < 3 && i >= c->raw.vertices; ++k) x[k] = real(f, -LARGEST);
    p[i] = point_at(i < c->raw.vertices ? c->raw.vertex[i] : x);
  }
  if (!is_closed(c->original)) end(1, "the original is not closed");
  for (size_t i = 0; i < c->original.n; ++i)
    add_term(&sum, c->original.t[i][0], c->original.t[i][1], c->original.t[i][2], 1);
  for (uint64_t fans = number(f, left), fan = 0; fan < fans; ++fan) {
    const uint32_t apex = p[number(f, all)], centre = p[number(f, all)];
    uint32_t from = NONE;
    for (uint64_t count = number(f, left) + 1, i = 0; i < count; ++i) {
      const uint32_t to = p[number(f, all)];
      if (apex == NONE || centre == NONE || to == NONE) end(1, "fan %lu has a point that is not finite", COUNT(fan));
      if (i && det(points[from], points[centre], points[to], points[centre], points[apex], points[centre]) ==
                   (c->inner ? 1 : -1))
        end(1, "tetrahedron %lu of fan %lu lies on the wrong side", COUNT(i - 1), COUNT(fan));
      if (i) add_term(&sum, centre, from, to, -1), add_term(&sum, from, to, apex, 1);
      if (!i) add_term(&sum, centre, to, apex, 1);
      from = to;
    }
    add_term(&sum, centre, from, apex, -1);
  }
  for (size_t i = 0; i < c->hull.n; ++i) add_term(&sum, c->hull.t[i][0], c->hull.t[i][1], c->hull.t[i][2], -1);
  if (sum.used) end(1, "hull and original differ by %lu triangles from what the tetrahedra bound", COUNT(sum.used));
  c->claims |= ENCLOSES;
  free(sum.term), free(p);
}

/* The segment or point that a triangle without area is: its first and its last corner in the order of coordinates. */
static Term* ends_of(Sum* sum, const uint32_t t[3]) {
  uint32_t key[3] = {t[0], t[0], NONE};
  for (int i = 1; i < 3; ++i)
    for (int k = 0; k < 2; ++k) {
      const Point p = points[t[i]], q = points[key[k]];
      const double d = p[0] != q[0] ? p[0] - q[0] : p[1] != q[1] ? p[1] - q[1] : p[2] - q[2];
      if (k ? d > 0 : d < 0) key[k] = t[i];
    }
  sort_key(key);
  return term_of(sum, key, 1);
}

/* Triangles without area: the ends are corners of one triangle of `inner`, or no triangle is near and `outer` winds
 * around it. */
static void prove_flat(Mesh m, const Surface* inner, const Surface* outer) {
  static uint32_t* list;
  Sum ends = {NULL, 0, 0};
  for (size_t i = 0; i < m.n && inner->n < m.n; ++i)
    if (!has_area(m.t[i])) ends_of(&ends, m.t[i])->times = 1;
  for (size_t i = 0; i < 6 * inner->n && ends.used; ++i) {
    uint32_t key[3] = {inner->t[i / 6][i % 3], inner->t[i / 6][(i % 6 / 3 + i) % 3], NONE};
    sort_key(key);
    Term* const t = term_of(&ends, key, 0);
    if (t->times) t->times = 2;
  }
  for (size_t i = 0; i < m.n && ends.used; ++i) {
    const uint32_t at[3] = {m.t[i][0], m.t[i][0], m.t[i][0]};
    const Box box = box_of(m.t + i, 1);
    if (has_area(m.t[i]) || ends_of(&ends, m.t[i])->times == 2) continue;
    for (size_t n = near(outer, &box, 0, &list); n-- > 0;) {
      int sign[3];
      place(outer->t[list[n]], m.t[i], sign);
      if ((!sign[0] || sign[0] != sign[1] || sign[1] != sign[2]))
        end(1, "triangle %lu of %s has no area and is near %s", COUNT(i), inner->name, outer->name);
    }
    if (winding(outer, at, 0, 1, NULL) < 1)
      end(1, "triangle %lu of %s lies outside of %s", COUNT(i), inner->name, outer->name);
  }
  free(ends.term);
}

typedef Int Line[3]; /* in barycentric coordinates of a triangle: its values at the corners */
typedef struct {
  const char* name;
  size_t number; /* of the triangle that is cut */
  const uint32_t* t;
  uint32_t (*planes)[3]; /* that triangle, and those whose planes may cut it */
  const Surface* around; /* or NULL: a part is in a piece */
  uint32_t* blocking;    /* of `around` */
  size_t blocks, lines;
  Line *line, *corner; /* corner: those of the part that is looked at, as far as they are known */
  size_t corners;
  int unit, width;
  File* file; /* with trees */
  size_t pieces;
  const size_t* first; /* triangle of the hull, of each piece and of none */
} Cut;

static Cut cut_of(void) {
  Cut u;
  Point* const all = resized(NULL, point_count + 3, sizeof *all);
  memset(&u, 0, sizeof u);
  for (size_t i = 0; i < point_count; ++i) all[i] = points[i];
  for (size_t i = 0; i < 3; ++i) all[point_count + i] = axes[i];
  fit(9, 40, (int)point_count + 3, all);
  u.unit = unit, u.width = width, u.lines = 3, u.line = filled(4, sizeof *u.line, 0);
  for (int k = 0; k < 3; ++k) set(&u.line[k][k], 1, 0);
  free(all);
  return u;
}

/* The line of a triangle's plane becomes the last of the lines. */
static void set_line(Cut* u, const uint32_t f[3]) {
  const Point a = points[f[0]];
  Int d[3][3], normal[3];
  unit = u->unit, width = u->width;
  for (int i = 0; i < 6; ++i) set_difference(&d[i / 3][i % 3], points[f[1 + i / 3]][i % 3], a[i % 3]);
  cross(normal, d[0], d[1]);
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) set_difference(&d[2][i], points[u->t[k]][i], a[i]);
    clear(&u->line[u->lines][k]), add_product(&u->line[u->lines][k], d[2], normal);
  }
}

/* The point where two lines meet within the triangle. */
static void meet(const Cut* u, uint32_t i, uint32_t j, Int at[3]) {
  Int sum;
  unit = u->unit, width = u->width;
  cross(at, u->line[i], u->line[j]), add(&sum, &at[0], &at[1], 1), add(&sum, &sum, &at[2], 1);
  if (sign_of(&sum) < 0) cross(at, u->line[j], u->line[i]);
}

/* The signs of the last line at the corners of a part with n sides, which lie on these lines in turn; how often there
   is each; and whether the line crosses the part. */
static int count_signs(Cut* u, const uint32_t* lines, size_t n, int* sign, int any[3]) {
  any[0] = any[1] = any[2] = 0, spend((uint64_t)(u->width * u->width) * n);
  if (!u->corners) u->corner = resized(u->corner, n, sizeof *u->corner);
  for (size_t k = 0; k < n; ++k) {
    Int s;
    if (k == u->corners) meet(u, lines[k], lines[(k + 1) % n], u->corner[u->corners++]);
    unit = u->unit, width = u->width, clear(&s), add_product(&s, u->corner[k], u->line[u->lines]);
    ++any[1 + (sign[k] = sign_of(&s))];
  }
  return any[0] && any[2];
}

static void prove_in_piece(Cut* u, const uint32_t* lines, size_t n, int* sign, uint64_t leaf) {
  int signs[3], any[3];
  for (size_t i = u->first[leaf - 1]; i < u->first[leaf] && n > 0; ++i) {
    if (!(place(u->planes[i], u->t, signs) & OUTER)) continue;
    set_line(u, u->planes[i]), count_signs(u, lines, n, sign, any);
    if (any[2]) end(1, "a part of triangle %lu of the original is not in piece %lu", COUNT(u->number), COUNT(leaf - 1));
  }
}

/* No triangle of the surface crosses the part: either side of it is free. */
static void prove_within(const Cut* u, const uint32_t* lines, size_t n) {
  Weights middle;
  Int at[3];
  for (int i = 0; i < 3; ++i) width = u->width, clear(&middle.of[i]);
  for (size_t k = 0; k < n; ++k) {
    meet(u, lines[k], lines[(k + 1) % n], at);
    for (int i = 0; i < 3; ++i) add(&middle.of[i], &middle.of[i], &at[i], 1);
  }
  middle.unit = u->unit, middle.width = u->width;
  if (winding_at(u->around, u->t, 1, &middle) < 1 && winding_at(u->around, u->t, 0, &middle) < 1)
    end(1, "a part of triangle %lu of %s lies outside of %s", COUNT(u->number), u->name, u->around->name);
}

/* Cuts a part, which is empty if n is 0: as the tree says, or at the next blocking triangle that crosses it. */
static void prove_cut(Cut* u, const uint32_t* lines, size_t n, size_t next, int depth) {
  int *sign = resized(NULL, n + 1, sizeof *sign), any[3], is_leaf = 1;
  uint32_t* const half = resized(NULL, n + 1, sizeof *half);
  spend(n + 1), u->corners = 0;
  if (u->around) {
    for (; is_leaf && next < u->blocks; ++next)
      set_line(u, u->around->t[u->blocking[next]]), is_leaf = !count_signs(u, lines, n, sign, any);
    if (is_leaf) prove_within(u, lines, n);
  } else {
    const uint64_t leaf = number(u->file, u->pieces + 1);
    is_leaf = leaf != 0;
    if (is_leaf)
      prove_in_piece(u, lines, n, sign, leaf);
    else
      set_line(u, u->planes[number(u->file, u->first[u->pieces])]), count_signs(u, lines, n, sign, any);
  }
  if (!is_leaf) {
    if (depth == 1000 && u->around) end(1, "triangle %lu of %s is crossed too often", COUNT(u->number), u->name);
    if (depth == 1000) unreadable(u->file, "a tree is deeper than 1,000");
    u->line = room(u->line, ++u->lines, sizeof *u->line);
    for (int s = -1; s <= 1; s += 2) {
      size_t m = 0;
      for (size_t k = 0; k < n && (any[1 + s] || !any[1 - s]); ++k) { /* side k runs from corner k - 1 to corner k */
        const int before = s * sign[(k + n - 1) % n], here = s * sign[k], after = s * sign[(k + 1) % n],
                  kept = before > 0 || here > 0;
        if (!any[1 - s] || kept) half[m++] = lines[k];
        if (any[1 - s] && kept && (here < 0 || (here == 0 && after <= 0))) half[m++] = (uint32_t)u->lines - 1;
      }
      prove_cut(u, half, m, next, depth + 1);
    }
    --u->lines;
  }
  free(sign), free(half);
}

static const uint32_t whole[3] = {0, 1, 2};

/* Cuts triangle i of a at the triangles of b that block it. */
static void prove_crossed(Cut* u, const Surface* a, size_t i, const Surface* b) {
  static uint32_t* list;
  const Box box = box_of(a->t + i, 1);
  if (!u->line) *u = cut_of();
  u->name = a->name, u->number = a->number[i], u->t = a->t[i], u->around = b, u->blocks = 0;
  for (size_t n = near(b, &box, 0, &list); n-- > 0;) {
    if (!(blocked_sides(a->t[i], b->t[list[n]], NULL, NULL) & BOTH)) continue;
    u->blocking = room(u->blocking, u->blocks, sizeof *u->blocking), u->blocking[u->blocks++] = list[n];
  }
  prove_cut(u, whole, 3, 0, 0);
}

static void prove_surfaces(Case* c) {
  const Mesh in = c->inner ? c->hull : c->original, out = c->inner ? c->original : c->hull;
  const Surface a = surface_of(c->inner ? "the hull" : "the original", in, 0),
                b = surface_of(c->inner ? "the original" : "the hull", out, 0);
  Sides s[2] = {sides_of(&a, &b), sides_of(&b, &a)};
  const uint64_t claims = number(&c->file, 4);
  uint32_t* list = NULL;
  Cut cut = {.line = NULL};
  if (claims != 1 && claims != 3) unreadable(&c->file, "this claim is not known");
  if (!is_closed(out)) end(1, "%s is not closed", b.name);
  visit_pairs(&a, &b, 0, note_blocked, s);
  join(&s[0]), join(&s[1]);
  for (size_t i = 0; i < a.n; ++i) {
    if (!(s[0].blocked[i] & OUTER) && winding_beside(&s[0], i, 1) >= 1) continue;
    if (!(s[0].blocked[i] & INNER) && winding_beside(&s[0], i, 0) >= 1) continue;
    if (!s[0].blocked[i]) end(1, "triangle %u of %s lies outside of %s", a.number[i], a.name, b.name);
    prove_crossed(&cut, &a, i, &b);
  }
  prove_flat(in, &a, &b);
  c->claims |= (int)claims;
  if (claims == 3 && !is_closed(in)) end(1, "%s is not closed", a.name);
  for (size_t i = 0; i < b.n && claims == 3; ++i)
    for (int w = OUTER; w <= INNER; ++w) {
      const Box box = box_of(b.t + i, 1);
      unsigned self = 0;
      if (!(s[1].blocked[i] & w) && winding_beside(&s[1], i, w == OUTER) < 1) continue;
      for (size_t n = near(&b, &box, 0, &list); n-- > 0;)
        if (list[n] != i) self |= blocked_sides(b.t[i], b.t[list[n]], NULL, NULL);
      if (self & (unsigned)w)
        end(1, "triangle %u of %s is crossed by others of it, and there may be a hole", b.number[i], b.name);
      if (winding_at(&b, b.t[i], w == OUTER, NULL) < 1)
        end(1, "%s leaves a hole in %s beside triangle %u", b.name, a.name, b.number[i]);
    }
}

static void prove_pieces(Case* c) {
  const size_t pieces = (size_t)number(&c->file, c->hull.n + 1);
  size_t* const first = filled(pieces + 1, sizeof *first, 0);
  Cut u = cut_of();
  int signs[3];
  for (size_t p = 0; p < pieces; ++p) {
    const Mesh m = {c->hull.t + first[p], (size_t)number(&c->file, c->hull.n - first[p] + 1)};
    unsigned sides = 0;
    first[p + 1] = first[p] + m.n;
    for (size_t i = 0; i < m.n * m.n; ++i) spend(1), sides |= place(m.t[i / m.n], m.t[i % m.n], signs);
    if (!is_closed(m) || sides != INNER) end(1, "piece %lu is not closed, convex and outwards", COUNT(p));
  }
  if (first[pieces] != c->hull.n) end(1, "a triangle of the hull is in no piece");
  u.planes = c->hull.t, u.file = &c->file, u.pieces = pieces, u.first = first;
  for (u.number = 0; u.number < c->original.n; ++u.number) u.t = c->original.t[u.number], prove_cut(&u, whole, 3, 0, 0);
  c->claims |= COVERS;
  free(first), free(u.line);
}

/* Whether |sum of w (p - base)| <= radius, for n <= 5 points; the weights are multiples of 2^-50 of size 1 at most. */
static int is_within(Point base, double radius, int n, const Point* p, const double* w) {
  const double largest[3] = {radius, radius, radius};
  Point all[7] = {base, largest};
  double square = 0;
  Int sum, coordinate;
  for (int k = 0; k < 3; ++k) {
    double d = 0, size = 0; /* d has at most 7 roundings of 2^-53 of size */
    for (int i = 0; i < n; ++i) d += w[i] * (p[i][k] - base[k]), size += size_of(w[i] * (p[i][k] - base[k]));
    square += (size_of(d) + 1e-15 * size) * (size_of(d) + 1e-15 * size);
  }
  if (radius > 1e-140 && square * (1 + 2e-15) <= radius * radius) return 1;
  for (int i = 0; i < n; ++i) all[2 + i] = p[i];
  fit(2, 110, n + 2, all);
  clear(&sum), clear(&coordinate);
  add_weighted(&coordinate, 1, radius, 0), multiply_add(&sum, &coordinate, &coordinate, 1);
  for (int k = 0; k < 3; ++k) {
    clear(&coordinate);
    for (int i = 0; i < n; ++i) add_weighted(&coordinate, w[i], p[i][k], base[k]);
    multiply_add(&sum, &coordinate, &coordinate, -1);
  }
  return sign_of(&sum) >= 0;
}

/* The weights, multiples of 2^-40, of a point of t that is about nearest to p. */
static void nearest(Point p, const Point t[3], double weights[3]) {
  double best = -1, n[3], inside[3] = {0, 0, 0}, nn = 0;
  for (int k = 0; k < 3; ++k) {
    const int x = (k + 1) % 3, y = (k + 2) % 3;
    n[k] = (t[1][x] - t[0][x]) * (t[2][y] - t[0][y]) - (t[1][y] - t[0][y]) * (t[2][x] - t[0][x]), nn += n[k] * n[k];
  }
  for (int i = 0; i < 3; ++i) {
    const Point a = t[i], b = t[(i + 1) % 3];
    double along = 0, length = 0, distance = 0;
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      along += (p[k] - a[k]) * (b[k] - a[k]), length += (b[k] - a[k]) * (b[k] - a[k]);
      inside[(i + 2) % 3] += n[k] * ((b[x] - a[x]) * (p[y] - a[y]) - (b[y] - a[y]) * (p[x] - a[x])) / nn;
    }
    along = along > 0 ? along < length ? along / length : 1 : 0;
    for (int k = 0; k < 3; ++k)
      distance += (p[k] - a[k] - along * (b[k] - a[k])) * (p[k] - a[k] - along * (b[k] - a[k]));
    if (i && distance >= best) continue;
    best = distance, weights[i] = 1 - along, weights[(i + 1) % 3] = along, weights[(i + 2) % 3] = 0;
  }
  if (inside[0] > 0 && inside[1] > 0 && inside[2] > 0) memcpy(weights, inside, sizeof inside);
  for (int i = 1; i < 3; ++i)
    weights[i] = weights[i] > 0 && weights[i] <= 1 ? (double)(uint64_t)(weights[i] * 0x1p40) * 0x1p-40 : 0;
  if (weights[1] + weights[2] > 1) weights[2] = 1 - weights[1];
  weights[0] = 1 - weights[1] - weights[2];
}

/* Reads a tree of the part of t whose corners have these weights. A leaf names a ball or, if there is a distance, a
 * triangle. */
static void prove_parts(Case* c, const uint32_t t[3], double w[3][3], int depth, size_t face) {
  const int of_hull = !c->ball;
  const uint64_t n = number(&c->file, 3 + (of_hull ? c->original.n : c->balls));
  Point p[5] = {points[t[0]], points[t[1]], points[t[2]]};
  for (int i = 0; i < 3 && n >= 3; ++i) {
    double weights[5] = {w[i][0], w[i][1], w[i][2], 0, 0}, at[3] = {0, 0, 0}, back[3];
    if (of_hull) {
      const uint32_t* const o = c->original.t[n - 3];
      const Point target[3] = {points[o[0]], points[o[1]], points[o[2]]};
      for (int k = 0; k < 9; ++k) at[k % 3] += w[i][k / 3] * p[k / 3][k % 3];
      nearest(at, target, back);
      p[3] = target[1], p[4] = target[2], weights[3] = -back[1], weights[4] = -back[2];
      if (is_within(target[0], c->distance, 5, p, weights)) continue;
      end(1, "a part of triangle %lu of the hull may be farther than the distance", COUNT(face));
    }
    if (!is_within(c->ball[n - 3], c->ball[n - 3][3], 3, p, weights))
      end(1, "a part of triangle %lu of the original is not in its ball", COUNT(face));
  }
  if (n < 3 && depth == 50) unreadable(&c->file, "a tree is deeper than 50");
  for (int half = 1; half <= 2 && n < 3; ++half) {
    double part[3][3];
    memcpy(part, w, sizeof part);
    for (int k = 0; k < 3; ++k) part[(n + (unsigned)half) % 3][k] = (w[(n + 1) % 3][k] + w[(n + 2) % 3][k]) / 2;
    prove_parts(c, t, part, depth + 1, face);
  }
}

static void prove_trees(Case* c, Mesh m, int claim) {
  for (size_t i = 0; i < m.n; ++i) prove_parts(c, m.t[i], (double[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, i);
  c->claims |= claim;
}

/* Whether n(p - q) >= gap |n| for all corners p of a and q of b, or <= -gap |n|. */
static int is_slab(const uint32_t a[3], const uint32_t b[3], const double n[3], double gap, int exactly) {
  const double reach[3] = {gap, gap, gap};
  const Point all[7] = {reach, points[a[0]], points[a[1]], points[a[2]], points[b[0]], points[b[1]], points[b[2]]};
  double least = LARGEST, most = -LARGEST, square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  Int low, high, sum, x, y;
  for (int i = 0; i < 9; ++i) {
    double d = 0, size = 0;
    for (int k = 0; k < 3; ++k) {
      const double term = n[k] * (all[1 + i / 3][k] - all[4 + i % 3][k]);
      d += term, size += 1e-15 * size_of(term);
    }
    least = d - size < least ? d - size : least, most = d + size > most ? d + size : most;
  }
  least = -most > least ? -most : least;
  if (least > 1e-140 && gap > 1e-140 && least * least >= gap * gap * square * (1 + 1e-14)) return 1;
  if (!exactly) return 0;
  fit(2, 110, 7, all);
  for (int i = 0; i < 9; ++i) {
    clear(&sum);
    for (int k = 0; k < 3; ++k) add_weighted(&sum, n[k], all[1 + i / 3][k], all[4 + i % 3][k]);
    if (!i) low = high = sum;
    add(&x, &sum, &low, -1), add(&y, &sum, &high, -1);
    if (sign_of(&x) < 0) low = sum;
    if (sign_of(&y) > 0) high = sum;
  }
  if (sign_of(&low) <= 0 && sign_of(&high) >= 0) return 0;
  if (sign_of(&low) <= 0) low = high;
  clear(&sum), multiply_add(&sum, &low, &low, 1);
  for (int k = 0; k < 3; ++k) clear(&low), add_weighted(&low, n[k], gap, 0), multiply_add(&sum, &low, &low, -1);
  return sign_of(&sum) >= 0;
}

static void see_to_gap(void* context, size_t at, size_t other) {
  const Surface* const s = context;
  const uint32_t *a = s[0].t[at], *b = s[1].t[other];
  const Point p[6] = {points[a[0]], points[a[1]], points[a[2]], points[b[0]], points[b[1]], points[b[2]]};
  for (int i = 0; i < 34; ++i) { /* twice: normals, products of edges, ways from a corner to the other triangle */
    const int c = i % 17;
    double n[3], w[3], size = 0;
    if (c < 11) {
      const int u = c < 2 ? 3 * c : (c - 2) / 3, v = c < 2 ? u + 1 : 3 + (c - 2) % 3;
      const Point u0 = p[u], u1 = p[c < 2 ? u + 1 : (u + 1) % 3], v0 = p[v], v1 = p[c < 2 ? u + 2 : 3 + (v - 2) % 3];
      for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        n[k] = (u1[x] - u0[x]) * (v1[y] - v0[y]) - (u1[y] - u0[y]) * (v1[x] - v0[x]);
      }
    } else {
      const Point* const t = c < 14 ? p + 3 : p;
      nearest(p[c - 11], t, w);
      for (int k = 0; k < 3; ++k) n[k] = p[c - 11][k] - w[0] * t[0][k] - w[1] * t[1][k] - w[2] * t[2][k];
    }
    for (int k = 0; k < 3; ++k) size = size_of(n[k]) > size ? size_of(n[k]) : size;
    for (int k = 0; k < 3 && size > 0; ++k) n[k] = size < 1e300 ? (double)(int64_t)(n[k] / size * 0x1p50) * 0x1p-50 : 0;
    if (size > 0 && is_slab(a, b, n, s[0].gap, i >= 17)) return;
  }
  end(1, "triangle %u of the hull may be nearer than the gap to triangle %u of the original", s[0].number[at],
      s[1].number[other]);
}

static void prove_gap(Case* c) {
  Surface s[2] = {surface_of("the hull", c->hull, 1), surface_of("the original", c->original, 1)};
  s[0].gap = c->gap = real(&c->file, 5e-324);
  visit_pairs(&s[0], &s[1], c->gap * (1 + 1e-9), see_to_gap, s);
  c->claims |= GAP;
}

/* The finite triangles of a mesh file. */
static Mesh mesh_of(Raw* raw) {
  Mesh m = {resized(NULL, raw->n, sizeof *m.t), 0};
  uint32_t* const p = resized(NULL, raw->vertices, sizeof *p);
  for (size_t i = 0; i < raw->vertices; ++i) p[i] = point_at(raw->vertex[i]);
  for (size_t i = 0; i < raw->n; ++i) {
    for (int k = 0; k < 3; ++k) m.t[m.n][k] = p[raw->t[i][k]];
    raw->face[m.n] = raw->face[i];
    m.n += m.t[m.n][0] != NONE && m.t[m.n][1] != NONE && m.t[m.n][2] != NONE;
  }
  free(p);
  return m;
}

/* Divides faces of the original into other triangles, which have the same boundary. */
static void divide_faces(Case* c) {
  const Mesh m = c->original;
  for (uint64_t left = number(&c->file, m.n + 1); left > 0; --left) {
    const size_t first = (size_t)number(&c->file, m.n);
    Mesh fan = {NULL, 0};
    Sum sum = {NULL, 0, 0};
    while (first + fan.n < m.n && c->raw.face[first + fan.n] == c->raw.face[first]) ++fan.n;
    fan.t = memcpy(resized(NULL, fan.n, sizeof *fan.t), m.t + first, fan.n * sizeof *fan.t);
    for (size_t i = 0; i < 3 * fan.n; ++i) add_term(&sum, fan.t[i / 3][i % 3], fan.t[i / 3][(i + 1) % 3], NONE, 1);
    if (sum.used != fan.n + 2) end(1, "the face of triangle %lu is no polygon", COUNT(first));
    for (size_t i = 0; i < 3 * fan.n; ++i) {
      const size_t from = (size_t)number(&c->file, 3 * fan.n);
      m.t[first + i / 3][i % 3] = fan.t[from / 3][from % 3];
    }
    for (size_t i = 3 * first; i < 3 * (first + fan.n); ++i)
      add_term(&sum, m.t[i / 3][i % 3], m.t[i / 3][(i + 1) % 3], NONE, -1);
    if (sum.used) end(1, "the face of triangle %lu is divided into triangles that bound another one", COUNT(first));
    free(sum.term), free(fan.t);
  }
}

static void prove_section(Case* c, uint64_t kind) {
  if ((kind == 3 || kind == 4) && number(&c->file, 2) != 1) unreadable(&c->file, "this claim is not known");
  if (kind == 1) prove_tetrahedra(c);
  if (kind == 2) prove_surfaces(c);
  if (kind == 3) prove_pieces(c);
  if (kind == 4) prove_trees(c, c->original, COVERS);
  if (kind == 5) prove_gap(c);
  if (kind == 7) divide_faces(c);
  if (kind == 6) c->distance = real(&c->file, 0), prove_trees(c, c->hull, DISTANCE);
}

int main(int count, char** names) {
  Case c;
  memset(&c, 0, sizeof c);
  Raw hull = c.raw;
  if (count < 4) end(2, "usage: prohull_check CERTIFICATE HULL... ORIGINAL");
  c.file = opened(names[1]), c.file.encoding = LITTLE;
  File* const f = &c.file;
  if (count == 4 && (ends_in(names[2], ".yaml") || ends_in(names[2], ".yml"))) {
    File balls = opened(names[2]);
    read_balls(&balls, &c.ball, &c.balls);
  } else {
    for (int i = 2; i + 1 < count; ++i) read_mesh(names[i], &hull);
  }
  read_mesh(names[count - 1], &c.raw);
  if (f->end - f->at < 8 || memcmp(f->at, "\x89PHCER\r\n", 8) != 0) unreadable(f, "this is no certificate");
  f->at += 8;
  if (number(f, UINT64_MAX) != 1) unreadable(f, "the version is not 1");
  c.inner = (int)number(f, 2);
  const double scale = real(f, 5e-324);
  for (size_t i = 0; i < 3 * c.raw.vertices && scale != 1; ++i) c.raw.vertex[i / 3][i % 3] *= scale;
  const size_t most = c.raw.vertices + hull.vertices + (size_t)(f->end - f->begin) / 24 + 1;
  if (most >= NONE / 2 || c.raw.n >= NONE / 2 || hull.n >= NONE / 2) end(2, "more than 2^31 points or triangles");
  while (point_slots < 2 * most) point_slots *= 2;
  points = resized(NULL, most, sizeof *points), point_slot = filled(point_slots, sizeof *point_slot, 255);
  c.original = mesh_of(&c.raw), c.hull = mesh_of(&hull);
  if (c.hull.n != hull.n) end(1, "the hull has coordinates that are not finite");
  if (!c.original.n || !(c.hull.n + c.balls)) end(1, "there is no triangle");
  if (number(f, UINT64_MAX) != c.hull.n + c.balls || number(f, UINT64_MAX) != c.original.n)
    end(1, "the certificate is for other meshes: hull and original have %lu and %lu triangles",
        COUNT(c.hull.n + c.balls), COUNT(c.original.n));
  const uint64_t turned = number(f, c.original.n + 1);
  if (turned) turn_components(c.original, f, turned);
  for (unsigned seen = 1; !(c.claims && f->at == f->end);) {
    const uint64_t kind = number(f, 8);
    if (seen >> kind & 1 || (kind == 7 && seen > 1) || (c.ball ? kind != 4 && kind != 7 : kind == 4) ||
        (c.inner && kind == 3))
      unreadable(f, "this section does not belong here");
    seen |= 1u << kind;
    prove_section(&c, kind);
  }
  printf("proven");
  for (int k = COVERS; k <= DISTANCE; k *= 2) {
    if (c.claims & k) printf(c.claims & (k - 1) ? "; " : ": ");
    if (c.claims & k & COVERS)
      printf(c.inner ? "the original covers every triangle of the hull" : "the hull covers every finite triangle");
    if (c.claims & k & ENCLOSES) printf(c.inner ? "the solid encloses the hull" : "the hull encloses the solid");
    if (c.claims & k & GAP) printf("the hull keeps a gap of at least %.17g", c.gap);
    if (c.claims & k & DISTANCE) printf("no point of the hull is farther than %.17g from the triangles", c.distance);
  }
  if (c.raw.n > c.original.n) printf("; %lu triangles of the original are not finite", COUNT(c.raw.n - c.original.n));
  if (turned) printf("; %lu components of the original are turned", COUNT(turned));
  if (scale != 1) printf("; the original is scaled by %.17g", scale);
  putchar('\n');
  return 0;
}
