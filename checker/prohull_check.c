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

/* ---- Numbers: the same formulas are rounded, with a bound of the error, and exact where that does not decide ---- */

enum { LIMBS = 640, UNSURE = 2 };
typedef const double* Point;
typedef struct {
  double value, error; /* if not `exactly` */
  int n;               /* limbs in use: at most 597, for nine differences of 2,098 bits */
  uint32_t d[LIMBS];   /* a multiple of 2^unit, as two's complement, the lowest limb first */
} Number;

static int exactly, unit = 1024;
static const Number zero = {0, 0, 1, {0}};

static double size_of(double x) { return x < 0 ? -x : x; }

/* |x| = mantissa 2^low, with an odd mantissa, or 0. */
static uint64_t parts_of(double x, int* low) {
  uint64_t bits, mantissa;
  memcpy(&bits, &x, sizeof bits);
  *low = (int)(bits >> 52 & 2047), mantissa = bits & 0xFFFFFFFFFFFFF;
  if (*low) mantissa |= UINT64_C(1) << 52, --*low;
  for (*low -= 1074; mantissa && !(mantissa & 255); mantissa >>= 8) *low += 8;
  for (; mantissa && !(mantissa & 1); mantissa >>= 1) ++*low;
  return mantissa;
}

/* Makes x a multiple of the unit. False if it is not finite. */
static int fit(double x) {
  int low;
  if (parts_of(x, &low) && low < unit) unit = low;
  return x - x == 0;
}

static uint32_t extension(const Number* a) { return a->d[a->n - 1] >> 31 ? NONE : 0; }

static void trim(Number* a) {
  while (a->n > 1 && a->d[a->n - 1] == (a->d[a->n - 2] >> 31 ? NONE : 0)) --a->n;
}

/* r = a + b, or a - b if sign < 0. */
static void add(Number* r, const Number* a, const Number* b, int sign) {
  if (!exactly) {
    r->value = a->value + sign * b->value;
    r->error = (a->error + b->error + 1.2e-16 * size_of(r->value)) * (1 + 1e-15);
    return;
  }
  const uint32_t a_rest = extension(a), b_rest = extension(b), flip = sign < 0 ? NONE : 0;
  const int an = a->n, bn = b->n;
  uint64_t carry = sign < 0;
  r->n = (an > bn ? an : bn) + 1;
  for (int i = 0; i < r->n; ++i, carry >>= 32)
    r->d[i] = (uint32_t)(carry += (uint64_t)(i < an ? a->d[i] : a_rest) + ((i < bn ? b->d[i] : b_rest) ^ flip));
  trim(r);
}

/* r = x 2^-at, which is whole. */
static void set(Number* r, double x, int at) {
  int low;
  r->value = x, r->error = 0;
  if (!exactly) return;
  const uint64_t m = parts_of(x, &low);
  const int shift = m ? low - at : 0;
  const uint64_t first = (m & NONE) << shift % 32, second = (m >> 32) << shift % 32;
  const uint32_t limbs[4] = {(uint32_t)first, (uint32_t)(first >> 32 | second), (uint32_t)(second >> 32), 0};
  r->n = shift / 32 + 4;
  memset(r->d, 0, (size_t)r->n * sizeof *r->d), memcpy(r->d + shift / 32, limbs, sizeof limbs), trim(r);
  if (x < 0) add(r, &zero, r, -1);
}

/* r = a b; r is neither of them. What underflows is less than 1e-300. */
static void multiply(Number* r, const Number* a, const Number* b) {
  if (!exactly) {
    const double x = size_of(a->value), y = size_of(b->value), lost = x + a->error > 0 && y + b->error > 0 ? 1e-300 : 0;
    r->value = a->value * b->value;
    r->error = (x * b->error + y * a->error + a->error * b->error + 1.2e-16 * (x * y) + lost) * (1 + 1e-15);
    return;
  }
  r->n = a->n + b->n, spend((uint64_t)(a->n * b->n));
  memset(r->d, 0, (size_t)r->n * sizeof *r->d);
  for (int i = 0; i < a->n; ++i) {
    uint64_t carry = 0;
    for (int j = 0; j < b->n; ++j, carry >>= 32)
      r->d[i + j] = (uint32_t)(carry += (uint64_t)a->d[i] * b->d[j] + r->d[i + j]);
    r->d[i + b->n] = (uint32_t)carry;
  }
  for (int k = 0; k < 2; ++k) { /* the highest limb of a negative factor counts 2^(32 n) less */
    const Number *of = k ? b : a, *other = k ? a : b;
    uint64_t carry = 1;
    for (int i = 0; i < other->n && extension(of); ++i, carry >>= 32)
      r->d[of->n + i] = (uint32_t)(carry += (uint64_t)r->d[of->n + i] + (uint32_t)~other->d[i]);
  }
  trim(r);
}

static int sign_of(const Number* a) {
  if (exactly) return extension(a) ? -1 : a->n > 1 || a->d[0];
  return a->value > a->error ? 1 : a->value < -a->error ? -1 : a->value == 0 && a->error == 0 ? 0 : UNSURE;
}

/* r = u v */
static void dot(Number* r, const Number u[3], const Number v[3]) {
  Number product;
  multiply(r, &u[0], &v[0]);
  for (int i = 1; i < 3; ++i) multiply(&product, &u[i], &v[i]), add(r, r, &product, 1);
}

/* r = v x w */
static void cross(Number r[3], const Number v[3], const Number w[3]) {
  Number product;
  for (int i = 0; i < 3; ++i) {
    multiply(&r[i], &v[(i + 1) % 3], &w[(i + 2) % 3]), multiply(&product, &v[(i + 2) % 3], &w[(i + 1) % 3]);
    add(&r[i], &r[i], &product, -1);
  }
}

/* r = p - q; most differences need no rounding. */
static void set_way(Number r[3], Point p, Point q) {
  Number other;
  for (int k = 0; k < 3; ++k) {
    const double d = p[k] - q[k], back = p[k] - d, lost = (back - q[k]) + (p[k] - (d + back));
    if (lost == 0) set(&r[k], d, unit);
    if (lost != 0) set(&r[k], p[k], unit), set(&other, q[k], unit), add(&r[k], &r[k], &other, -1);
  }
}

/* n = (a - a0) x (b - b0) */
static void set_normal(Number n[3], Point a, Point a0, Point b, Point b0) {
  Number u[3], v[3];
  set_way(u, a, a0), set_way(v, b, b0), cross(n, u, v);
}

/* det(p0 - p1, p2 - p3, p4 - p5), rounded, and a bound of the error. It is below (7 + 56 2^-53) 2^-53 of the sum of the
   products' sizes, as Shewchuk counts, and so below 1e-15 of that; what underflows is less than 1e-200, as differences
   are below 1e90. Where they are not, the bound is infinite. */
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
  return *error = LARGEST * size, 0;
}

/* The sign of det(a - a0, b - b0, q - c), where q is the middle of n points with positive weights. */
static int sign_at(Point a, Point a0, Point b, Point b0, int n, const Point* q, const Number* weight, Point c) {
  Number normal[3], way[3], sum, part, product;
  double value = 0, lost = 1e-290;
  for (int i = 0; i < n; ++i) {
    const Point p[6] = {a, a0, b, b0, q[i], c};
    const double w = size_of(weight[i].value), doubt = weight[i].error;
    double error;
    const double x = w + doubt > 0 ? rounded(p, &error) : (error = 0);
    value += weight[i].value * x, lost += 1.01 * (w + doubt) * error + (1.01 * doubt + 1e-15 * w) * size_of(x);
  }
  int sign = value > lost ? 1 : value < -lost ? -1 : UNSURE;
  for (int pass = 0; sign == UNSURE; ++pass) {
    exactly = pass, sum = zero, set_normal(normal, a, a0, b, b0);
    for (int i = 0; i < n; ++i)
      set_way(way, q[i], c), dot(&part, normal, way), multiply(&product, &part, &weight[i]),
          add(&sum, &sum, &product, 1);
    sign = sign_of(&sum);
  }
  return sign;
}

static const Number one = {1, 0, 1, {1}};

static int det(Point a, Point a0, Point b, Point b0, Point c, Point c0) {
  return sign_at(a, a0, b, b0, 1, &c, &one, c0);
}

static const double origin[3] = {0, 0, 0}, axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* ---- Points, and sums of triangles ---- */

typedef struct {
  uint64_t key[3];
  int64_t value;
} Slot;
typedef struct {
  Slot* slot; /* a free one has the key FREE; no float64 that is finite has these bits */
  size_t size, used;
} Map;

static const uint64_t FREE = UINT64_MAX;
static double (*points)[3];
static size_t point_count;

static uint64_t mixed(uint64_t x) {
  x = (x ^ x >> 32) * UINT64_C(0xD6E8FEB86659FD93);
  x = (x ^ x >> 29) * UINT64_C(0x9E3779B97F4A7C15);
  return x ^ x >> 32;
}

static size_t home(const Map* m, const uint64_t k[3]) {
  return mixed(k[0] ^ mixed(k[1] ^ mixed(k[2]))) & (m->size - 1);
}

/* The slot of a key: with the value 0 if it is new. */
static Slot* slot_at(Map* m, uint64_t a, uint64_t b, uint64_t c) {
  const uint64_t key[3] = {a, b, c};
  if (2 * m->used >= m->size) {
    const Map old = *m;
    m->size = old.size ? 4 * old.size : 1024, m->used = 0, m->slot = filled(m->size, sizeof *m->slot, 255);
    for (const Slot* s = old.slot; s < old.slot + old.size; ++s)
      if (s->key[0] != FREE) *slot_at(m, s->key[0], s->key[1], s->key[2]) = *s;
    free(old.slot);
  }
  size_t i = home(m, key);
  for (; m->slot[i].key[0] != FREE; i = (i + 1) & (m->size - 1), spend(1))
    if (!memcmp(m->slot[i].key, key, sizeof key)) return &m->slot[i];
  memcpy(m->slot[i].key, key, sizeof key), m->slot[i].value = 0, ++m->used;
  return &m->slot[i];
}

/* Adds to a term of a sum, which goes if it is 0 then: the slots behind it move up. */
static void add_term(Map* m, uint64_t a, uint64_t b, uint64_t c, int times) {
  Slot* const s = slot_at(m, a, b, c);
  if ((s->value += times)) return;
  size_t hole = (size_t)(s - m->slot);
  for (size_t i = (hole + 1) & (m->size - 1); m->slot[i].key[0] != FREE; i = (i + 1) & (m->size - 1), spend(1))
    if (((i - home(m, m->slot[i].key)) & (m->size - 1)) >= ((i - hole) & (m->size - 1)))
      m->slot[hole] = m->slot[i], hole = i;
  m->slot[hole].key[0] = FREE, --m->used;
}

/* The number of the point at p: equal positions have one number. NONE if p is not finite. */
static uint32_t point_at(double x, double y, double z) {
  static Map map;
  const double at[3] = {x + 0.0, y + 0.0, z + 0.0}; /* no -0 */
  uint64_t bits[3];
  if (!fit(x) || !fit(y) || !fit(z)) return NONE;
  memcpy(bits, at, sizeof bits);
  int64_t* const number = &slot_at(&map, bits[0], bits[1], bits[2])->value;
  if (*number) return (uint32_t)(*number - 1);
  if (point_count >= NONE / 2) end(2, "more than 2^31 points");
  points = room(points, point_count, sizeof *points), memcpy(points[point_count], at, sizeof at);
  *number = (int64_t)++point_count;
  return (uint32_t)(point_count - 1);
}

static void add_edges(Map* sum, const uint32_t t[3], int sign) {
  for (int k = 0; k < 3; ++k) {
    const uint32_t a = t[k], b = t[(k + 1) % 3];
    if (a != b) add_term(sum, a < b ? a : b, a < b ? b : a, NONE, a < b ? sign : -sign);
  }
}

static void add_triangle(Map* sum, uint32_t a, uint32_t b, uint32_t c, int sign) {
  uint32_t k[3] = {a, b, c};
  if (a == b || b == c || c == a) return;
  for (int i = 0; i < 3; ++i) {
    const uint32_t x = k[i % 2];
    if (x > k[i % 2 + 1]) k[i % 2] = k[i % 2 + 1], k[i % 2 + 1] = x, sign = -sign;
  }
  add_term(sum, k[0], k[1], k[2], sign);
}

/* ---- Files ---- */

typedef enum { ASCII, LITTLE, BIG } Encoding;
typedef enum { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE } Type;
typedef struct {
  const char* name;
  unsigned char *begin, *at, *end; /* a 0 follows */
  Encoding encoding;
} File;
typedef struct {
  uint32_t (*t)[3], *vertex; /* points; NONE for a vertex that is not finite */
  size_t n, vertices, first; /* finite triangles; first: the first vertex of the file that is read */
  uint64_t *face, faces;     /* of each triangle */
  size_t infinite, corners;  /* triangles that are left out; corners of the face that is read */
  uint32_t corner[2];        /* the first and the last one, or the last two of a strip */
  double scale;
} Mesh;

NO_RETURN static void unreadable(const File* f, const char* what) {
  unsigned long line = 1;
  for (const unsigned char* p = f->begin; p < f->at; ++p) line += *p == '\n';
  end(2, "%s, byte %lu, line %lu: %s", f->name, COUNT(f->at - f->begin), line, what);
}

static File opened(const char* name) {
  File f = {name, NULL, NULL, NULL, ASCII};
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

/* Goes to the next word, of this line or of any. False if there is none. Comments are passed; a backslash joins lines.
 */
static int next_word(File* f, int any_line) {
  for (; f->at < f->end; ++f->at)
    if (*f->at == '#')
      while (f->at + 1 < f->end && f->at[1] != '\n') ++f->at;
    else if (*f->at == '\\' && (f->at[1] == '\n' || (f->at[1] == '\r' && f->at[2] == '\n')))
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
  if (f->encoding == ASCII) {
    next_word(f, 1);
    const char* const word = (char*)f->at;
    x = decimal(f, 1);
    return type == FLOAT ? strtof(word, NULL) : x;
  }
  if (f->end - f->at < size) unreadable(f, "the file ends here");
  for (int i = 0; i < size; ++i) bits |= (uint64_t)*f->at++ << 8 * (f->encoding == BIG ? size - 1 - i : i);
  const uint32_t word = (uint32_t)bits;
  if (type == FLOAT) return memcpy(&y, &word, sizeof y), y;
  if (type == DOUBLE) return memcpy(&x, &bits, sizeof x), x;
  return type % 2 == 0 && bits >> (8 * size - 1) ? -(double)((UINT64_C(1) << 8 * size) - bits) : (double)bits;
}

/* Numbers of certificates */
static uint64_t number(File* f, uint64_t below) {
  uint64_t x = 0;
  unsigned char* const from = f->at;
  for (int shift = 0; shift < 64 && f->at < f->end && (shift < 63 || *f->at < 2); shift += 7) {
    x |= (uint64_t)(*f->at & 127) << shift;
    if (*f->at++ & 128) continue;
    if (x < below) return x;
    break;
  }
  f->at = from;
  unreadable(f, "this number is missing or too large");
}

static double real(File* f, double least) {
  const double x = value(f, DOUBLE);
  if (!fit(x) || x < least) unreadable(f, "this number is not finite or too small");
  return x;
}

static void keep_triangle(Mesh* m, uint32_t a, uint32_t b, uint32_t c) {
  m->t = room(m->t, m->n, sizeof *m->t), m->face = room(m->face, m->n, sizeof *m->face);
  m->face[m->n] = m->faces, m->t[m->n][0] = m->vertex[a], m->t[m->n][1] = m->vertex[b], m->t[m->n][2] = m->vertex[c];
  if (m->t[m->n][0] == NONE || m->t[m->n][1] == NONE || m->t[m->n][2] == NONE)
    ++m->infinite;
  else if (++m->n >= NONE / 2)
    end(2, "more than 2^31 triangles");
}

static uint32_t vertex(const Mesh* m, const File* f, double x) {
  x += x >= 0 ? (double)m->first : 0;
  if (!(x >= 0 && x < (double)m->vertices && x < NONE) || x != (double)(uint32_t)x)
    unreadable(f, "the face has no such vertex");
  return (uint32_t)x;
}

/* A face is the fan of its first corner; one with fewer than three corners repeats the last. */
static void add_corner(Mesh* m, const File* f, double x) {
  const uint32_t v = vertex(m, f, x);
  if (!m->corners) m->corner[0] = v;
  if (m->corners > 1) keep_triangle(m, m->corner[0], m->corner[1], v);
  m->corner[1] = v, ++m->corners;
}

/* Every second triangle of a strip is turned; -1 begins the next strip. */
static void add_to_strip(Mesh* m, const File* f, double x) {
  const uint32_t a = m->corner[0], b = m->corner[1], v = x == -1 || x == NONE ? NONE : vertex(m, f, x),
                 odd = m->corners % 2;
  if (m->corners > 1 && v != NONE && a != b && b != v && v != a) keep_triangle(m, odd ? b : a, odd ? a : b, v);
  m->corner[0] = b, m->corner[1] = v, m->corners = v == NONE ? 0 : m->corners + 1, ++m->faces;
}

static void end_face(Mesh* m) {
  if (m->corners == 1 || m->corners == 2) keep_triangle(m, m->corner[0], m->corner[1], m->corner[1]);
  m->corners = 0, ++m->faces;
}

static void add_vertex(Mesh* m, double x, double y, double z) {
  m->vertex = room(m->vertex, m->vertices, sizeof *m->vertex);
  m->vertex[m->vertices++] = point_at(x * m->scale, y * m->scale, z * m->scale);
}

/* A vertex, and a corner if it is one of a facet. */
static void read_vertex(File* f, Mesh* m, Type type, int is_corner) {
  double x[3];
  for (int k = 0; k < 3; ++k) x[k] = f->encoding == ASCII ? decimal(f, is_corner) : value(f, type);
  add_vertex(m, x[0], x[1], x[2]);
  if (is_corner) add_corner(m, f, (double)(m->vertices - 1 - m->first));
}

static void read_stl(File* f, Mesh* m) {
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
    else if (pass(f, "vertex"))
      read_vertex(f, m, FLOAT, 1);
    else if (pass(f, "facet") || pass(f, "endfacet"))
      m->corners % 3 || m->corners > 3 ? unreadable(f, "a facet has three corners") : end_face(m);
    else
      pass_word(f);
  if (m->corners) unreadable(f, "the file ends within a facet");
}

static void read_obj(File* f, Mesh* m) {
  for (; next_word(f, 1); pass_line(f), end_face(m)) {
    if (pass(f, "v")) read_vertex(f, m, DOUBLE, 0);
    if (!pass(f, "f") && !pass(f, "fo")) continue;
    while (next_word(f, 0)) {
      const double x = decimal(f, 0);
      add_corner(m, f, x < 0 ? x + (double)(m->vertices - m->first) : x - 1);
      while (*f->at > ' ') ++f->at;
    }
  }
}

static void read_off(File* f, Mesh* m) {
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

static void read_ply(File* f, Mesh* m) {
  static const char* const names[] = {"x", "y", "z", "vertex_indices", "vertex_index"};
  enum { OTHER, VERTEX, FACE, STRIPS, CORNERS = 3 };
  struct {
    double count;
    size_t end;
    int kind, roles;
  }* element = NULL;
  struct {
    int is_list, role; /* 0, 1, 2: x, y, z of a vertex; 3: corners of a face; -1: not read */
    Type length, type;
  }* property = NULL;
  size_t elements = 0, properties = 0, p = 0;
  Encoding encoding = ASCII;
  for (pass_line(f); next_word(f, 1) && !pass(f, "end_header"); pass_line(f))
    if (pass(f, "format")) {
      encoding = pass(f, "ascii") ? ASCII : pass(f, "binary_little_endian") ? LITTLE : BIG;
      if (encoding == BIG && !pass(f, "binary_big_endian")) unreadable(f, "this format is not known");
    } else if (pass(f, "element")) {
      element = room(element, elements, sizeof *element), element[elements].roles = 0,
      element[elements].end = properties;
      element[elements].kind = pass(f, "vertex")      ? VERTEX
                               : pass(f, "face")      ? FACE
                               : pass(f, "tristrips") ? STRIPS
                                                      : OTHER;
      if (element[elements].kind == OTHER) pass_word(f);
      element[elements++].count = decimal(f, 0);
    } else if (pass(f, "property")) {
      if (!elements) unreadable(f, "a property without an element");
      property = room(property, properties, sizeof *property);
      property[properties].is_list = pass(f, "list"), property[properties].role = -1;
      if (property[properties].is_list) property[properties].length = read_type(f);
      property[properties].type = read_type(f);
      for (int i = 0; i < 5; ++i)
        if (pass(f, names[i]) && element[elements - 1].kind != OTHER &&
            (element[elements - 1].kind != VERTEX) == i / 3 && property[properties].is_list == i / 3)
          property[properties].role = i < 3 ? i : CORNERS, ++element[elements - 1].roles;
      element[elements - 1].end = ++properties;
    }
  f->at += *f->at == '\r', f->at += *f->at == '\n', f->encoding = encoding;
  for (size_t e = 0; e < elements; p = element[e++].end) {
    const int kind = element[e].kind;
    if (element[e].count > 0 && kind != OTHER && element[e].roles != (kind == VERTEX ? 3 : 1))
      unreadable(f, "x, y, z or vertex_indices are missing");
    for (; element[e].count > 0 && element[e].end > p; --element[e].count) {
      double x[3] = {0, 0, 0};
      for (size_t k = p; k < element[e].end; ++k)
        for (double n = property[k].is_list ? value(f, property[k].length) : 1; n > 0; --n) {
          const double read = value(f, property[k].type);
          if (property[k].role == CORNERS) (kind == FACE ? add_corner : add_to_strip)(m, f, read);
          if (property[k].role >= 0 && property[k].role < CORNERS) x[property[k].role] = read;
        }
      if (kind == VERTEX) add_vertex(m, x[0], x[1], x[2]);
      if (kind == STRIPS) m->corners = 0;
      end_face(m);
    }
  }
  free(element), free(property);
}

static int pass_mark(File* f, int mark) { return next_word(f, 0) && *f->at == mark && ++f->at; }

/* Collision spheres, after at most two names, each as - {center: [x, y, z], radius: r}, or without the braces and the
   comma, and the radius on the next line. */
static size_t read_balls(File f, double (**ball)[4]) {
  size_t n = 0;
  for (int names = 0; next_word(&f, 1);)
    if (pass_mark(&f, '-')) {
      const int braces = pass_mark(&f, '{');
      double b[4];
      int fits = pass(&f, "center:");
      for (int k = 0; k < 3 && (fits &= pass_mark(&f, k ? ',' : '[')); ++k) fits &= fit(b[k] = decimal(&f, 0));
      fits = fits && pass_mark(&f, ']') && (!braces || pass_mark(&f, ',')) && next_word(&f, 1) && pass(&f, "radius:");
      fits = fits && (b[3] = decimal(&f, 0)) > 0 && fit(b[3]) && (!braces || pass_mark(&f, '}'));
      if (!fits) unreadable(&f, "this is no ball");
      *ball = room(*ball, n, sizeof **ball), memcpy((*ball)[n++], b, sizeof b);
    } else if (!pass_word(&f) || f.at[-1] != ':' || next_word(&f, 0) || ++names > 2) {
      unreadable(&f, "this is not the list of balls of one link");
    }
  return n;
}

static int ends_in(const char* name, const char* suffix) {
  size_t n = strlen(suffix), all = strlen(name);
  while (all && n && (name[all - 1] | 32) == suffix[n - 1]) --all, --n;
  return !n;
}

static void read_mesh(const char* name, Mesh* m) {
  static const char* const suffixes[] = {".stl", ".obj", ".off", ".ply"};
  static void (*const readers[])(File*, Mesh*) = {read_stl, read_obj, read_off, read_ply};
  File f = opened(name);
  int i = 0;
  while (i < 4 && !ends_in(name, suffixes[i])) ++i;
  if (i == 4) end(2, "%s: the name of a mesh ends in .stl, .obj, .off or .ply", name);
  m->first = m->vertices, readers[i](&f, m);
  free(f.begin);
}

/* ---- Surfaces: triangles in a tree of boxes ---- */

typedef struct {
  double low[3], high[3];
} Box;
typedef struct {
  const char* name;
  uint32_t (*t)[3], *number; /* in order along a curve; their numbers in the mesh */
  size_t n,
      leaves; /* node 1 is the root, node i has the children 2 i and 2 i + 1; the last `leaves` nodes are leaves */
  Box* box;
} Surface;
typedef struct {
  uint64_t code;
  uint32_t face;
} Key;
typedef struct {
  uint32_t* i;
  size_t n;
} List;

static int by_code(const void* a, const void* b) {
  const Key *x = a, *y = b;
  return x->code != y->code ? (x->code < y->code ? -1 : 1) : (x->face > y->face) - (x->face < y->face);
}

static Box box_of(const uint32_t* corners, size_t n) {
  Box b = {{LARGEST, LARGEST, LARGEST}, {-LARGEST, -LARGEST, -LARGEST}};
  for (size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      const double x = points[corners[i]][k];
      if (x < b.low[k]) b.low[k] = x;
      if (x > b.high[k]) b.high[k] = x;
    }
  return b;
}

/* Where something is: in a box, and between two planes across n, as seen from a point of it. */
typedef struct {
  Box box;
  double n[3], length, from[3], low, high; /* length: of n, or somewhat more */
} Zone;

/* Widens the zone's two planes to all n(p - from) of the points p of the box. What underflows is less than 1e-290. */
static void widen(Zone* z, const Box* b) {
  double low = -1e-290, high = 1e-290, size = 0;
  for (int k = 0; k < 3; ++k) {
    const double x = z->n[k] * (b->low[k] - z->from[k]), y = z->n[k] * (b->high[k] - z->from[k]);
    low += x < y ? x : y, high += x < y ? y : x, size += 1e-15 * (size_of(x) + size_of(y));
  }
  if (!(low - size >= z->low)) z->low = low - size;
  if (!(high + size <= z->high)) z->high = high + size;
}

/* Of a triangle and its plane, about: any planes around it are right. */
static Zone zone_of(const uint32_t t[3]) {
  const double *a = points[t[0]], *b = points[t[1]], *c = points[t[2]];
  Zone z = {box_of(t, 3), {0, 0, 0}, 0, {a[0], a[1], a[2]}, LARGEST, -LARGEST};
  double size = 0, guess = 1e-250;
  for (int k = 0; k < 3; ++k) size += size_of(b[k] - a[k]) + size_of(c[k] - a[k]);
  for (int k = 0; k < 3 && size < 1e90; ++k) {
    const int x = (k + 1) % 3, y = (k + 2) % 3;
    z.n[k] = (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]), guess += 0.75 * size_of(z.n[k]);
  }
  for (int k = 0; k < 3; ++k) z.length += guess / 6 + z.n[k] * (z.n[k] / guess) / 2; /* a step of Heron's, from above */
  for (int i = 0; i < 3; ++i) {
    const Box corner = box_of(t + i, 1);
    widen(&z, &corner);
  }
  return z;
}

/* Whether the box is farther from the zone than the reach, for sure. */
static int are_apart(const Box* b, const Zone* z, double reach) {
  for (int k = 0; k < 3; ++k)
    if (b->low[k] - z->box.high[k] > reach || z->box.low[k] - b->high[k] > reach) return 1;
  Zone own = *z;
  own.low = LARGEST, own.high = -LARGEST, widen(&own, b);
  return own.low - z->high > reach * z->length || z->low - own.high > reach * z->length;
}

/* The triangles whose boxes may be within reach of the zone. */
static void find_near(const Surface* s, Zone zone, double reach, List* found) {
  size_t stack[128] = {1}, top = 1;
  for (found->n = 0, spend(1); top > 0;) {
    const size_t node = stack[--top], leaf = node - s->leaves;
    if (are_apart(&s->box[node], &zone, reach)) continue;
    if (node < s->leaves) stack[top++] = 2 * node, stack[top++] = 2 * node + 1;
    for (size_t i = leaf * s->n / s->leaves; node >= s->leaves && i < (leaf + 1) * s->n / s->leaves; ++i) {
      const Box own = box_of(s->t[i], 3);
      if (are_apart(&own, &zone, reach)) continue;
      found->i = room(found->i, found->n, sizeof *found->i), found->i[found->n++] = (uint32_t)i;
    }
  }
  spend(16 * found->n);
}

static int turn(int axis, const uint32_t t[3]) {
  return det(points[t[1]], points[t[0]], points[t[2]], points[t[0]], axes[axis], origin);
}

static int has_area(const uint32_t t[3]) { return turn(0, t) || turn(1, t) || turn(2, t); }

static Surface surface_of(const char* name, const Mesh* m, int flat_too) {
  Surface s = {name, resized(NULL, m->n, sizeof *s.t), resized(NULL, m->n, sizeof *s.number), 0, 1, NULL};
  Key* const keys = resized(NULL, m->n, sizeof *keys);
  const Box all = box_of(*m->t, 3 * m->n);
  for (uint32_t i = 0; i < m->n; ++i) {
    if (!flat_too && !has_area(m->t[i])) continue;
    keys[s.n].face = i, keys[s.n].code = 0;
    for (int k = 0; k < 3; ++k) {
      const double size = all.high[k] / 2 - all.low[k] / 2, at = points[m->t[i][0]][k] / 2 - all.low[k] / 2;
      const uint64_t bits = at < size ? (uint64_t)(at / size * 2097151) : 2097151;
      for (int b = 0; b < 21; ++b) keys[s.n].code |= (bits >> b & 1) << (3 * b + k);
    }
    ++s.n;
  }
  qsort(keys, s.n, sizeof *keys, by_code);
  for (size_t i = 0; i < s.n; ++i) s.number[i] = keys[i].face, memcpy(s.t[i], m->t[keys[i].face], sizeof *s.t);
  while (4 * s.leaves < s.n) s.leaves *= 2;
  s.box = resized(NULL, 2 * s.leaves, sizeof *s.box);
  for (size_t i = 2 * s.leaves; --i > 0;) {
    const size_t from = (i - s.leaves) * s.n / s.leaves;
    if (i >= s.leaves) s.box[i] = box_of(s.t[from], 3 * ((i - s.leaves + 1) * s.n / s.leaves - from));
    for (int k = 0; k < 3 && i < s.leaves; ++k) {
      const Box *a = &s.box[2 * i], *b = a + 1;
      s.box[i].low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
      s.box[i].high[k] = a->high[k] > b->high[k] ? a->high[k] : b->high[k];
    }
  }
  free(keys);
  return s;
}

/* A point within a triangle, with a weight for each corner. */
typedef struct {
  uint32_t (*t)[3];
  Number weight[3];
} Spot;

/* How often s winds around the spot, moved off s as the page says. The ray runs along the axis. */
static int winding(const Surface* s, const Spot* spot, int axis, int direction) {
  static List list;
  const Point q[3] = {points[(*spot->t)[0]], points[(*spot->t)[1]], points[(*spot->t)[2]]};
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const Number* const w = spot->weight;
  const double all = w[0].value + w[1].value + w[2].value, lost = w[0].error + w[1].error + w[2].error;
  Zone ray = {box_of(*spot->t, 3), {0, 0, 0}, 0, {0, 0, 0}, 0, 0};
  int result = 0;
  for (int k = 0; k < 3 && all > 2 * lost; ++k) {
    const double at = (w[0].value * q[0][k] + w[1].value * q[1][k] + w[2].value * q[2][k]) / all,
                 error = (8 * lost / all + 1e-14) * (size_of(q[0][k]) + size_of(q[1][k]) + size_of(q[2][k])) + 1e-300;
    if (at - at != 0) continue; /* products may overflow */
    if (at - error > ray.box.low[k]) ray.box.low[k] = at - error;
    if (at + error < ray.box.high[k]) ray.box.high[k] = at + error;
  }
  (direction > 0 ? ray.box.high : ray.box.low)[axis] = direction * LARGEST;
  for (find_near(s, ray, 0, &list); list.n-- > 0;) {
    const uint32_t* const g = s->t[list.i[list.n]];
    const Point f[3] = {points[g[0]], points[g[1]], points[g[2]]};
    int looks = 0, i = 0;
    for (; i < 3; ++i) {
      const Point from = f[i], to = f[(i + 1) % 3];
      int sign = sign_at(axes[axis], origin, to, from, 3, q, w, from);
      if (!sign) sign = to[y] != from[y] ? (to[y] < from[y] ? 1 : -1) : (to[x] > from[x]) - (to[x] < from[x]);
      if (!sign || sign == -looks) break;
      looks = sign;
    }
    if (i == 3 && sign_at(f[1], f[0], f[2], f[0], 3, q, w, f[0]) * looks * direction < 0) result += looks * direction;
  }
  return result;
}

/* The same beside its triangle, on the outer or inner side; or where that is, if it has no area. */
static int winding_beside(const Surface* s, const Spot* spot, int outer) {
  int k = 0, looks = 0;
  while (k < 3 && !(looks = turn(k, *spot->t))) ++k;
  return winding(s, spot, k % 3, (looks ? looks : 1) * (outer ? 1 : -1));
}

/* ---- Which sides of the triangles of one surface are free of another, and how often that winds there ---- */

enum { OUTER = 1, INNER = 2, BOTH = 3, UNKNOWN = -(1 << 30) };
typedef struct {
  const Surface *on, *of;
  unsigned char *blocked, *touched; /* sides of each triangle; whether each point may be on `of` */
  uint32_t* parent;                 /* of each point: those that `of` does not part */
  int* value;                       /* how often `of` winds around each point that is a root */
} Sides;

static uint32_t root(uint32_t* parent, uint32_t i) {
  for (; parent[i] != i; i = parent[i]) parent[i] = parent[parent[i]];
  return i;
}

static uint32_t* each_alone(size_t n) {
  uint32_t* const parent = resized(NULL, n, sizeof *parent);
  for (uint32_t i = 0; i < n; ++i) parent[i] = i;
  return parent;
}

static int has_corner(const uint32_t t[3], uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

/* The signs of the corners of f against the plane of t; returns the sides of t on which corners lie. */
static unsigned place(const uint32_t t[3], const uint32_t f[3], int sign[3]) {
  const Point a = points[t[0]];
  unsigned sides = 0;
  for (int i = 0; i < 3; ++i) {
    const uint32_t v = f[i];
    sign[i] = has_corner(t, v) ? 0 : det(points[t[1]], a, points[t[2]], a, points[v], a);
    if (sign[i]) sides |= sign[i] > 0 ? OUTER : INNER;
  }
  return sides;
}

/* The sides of t that f blocks, and in the next two bits the sides of f that t blocks. Notes corners that may be on
   the other triangle. A triangle without area is blocked, or free, as a whole, and blocks nothing. */
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
  if (!of_t && !has_area(t)) return BOTH;
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

static void join(Sides* s) {
  for (size_t i = 0; i < 3 * s->on->n; ++i) {
    const uint32_t a = s->on->t[i / 3][i % 3], b = s->on->t[i / 3][(i + 1) % 3];
    if (s->blocked[i / 3] != BOTH && !s->touched[a] && !s->touched[b])
      s->parent[root(s->parent, a)] = root(s->parent, b);
  }
}

/* How often `of` winds beside the triangle on a free side of it. */
static int winding_on(Sides* s, size_t i, int outer) {
  const uint32_t* const t = s->on->t[i];
  int k = 0;
  while (k < 3 && s->touched[t[k]]) ++k;
  int* const known = k < 3 ? &s->value[root(s->parent, t[k])] : NULL;
  if (known && *known != UNKNOWN) return *known;
  Spot middle = {s->on->t + i, {one, one, one}};
  if (!known) return winding_beside(s->of, &middle, outer);
  middle.weight[(k + 1) % 3] = middle.weight[(k + 2) % 3] = zero;
  return *known = winding(s->of, &middle, 0, 1);
}

/* ---- Sections of the certificate ---- */

enum { COVERS = 1, ENCLOSES = 2, GAP = 4, DISTANCE = 8 };
typedef struct {
  File file;
  int inner, claims;
  Mesh hull, original;
  double (*ball)[4], gap, distance;
  size_t balls, divided; /* divided: faces of the original */
} Case;

static int is_closed(const Mesh* m) {
  Map sum = {NULL, 0, 0};
  for (size_t i = 0; i < m->n; ++i) add_edges(&sum, m->t[i], 1);
  free(sum.slot);
  return !sum.used;
}

/* Of six times the volume of the component of triangle r, or of all, exactly. */
static int sign_of_volume(const Mesh* m, uint32_t* parent, uint32_t r, int all) {
  Number normal[3], way[3], part, sum = zero;
  const Point base = points[m->t[r][0]];
  exactly = 1, spend(m->n);
  for (uint32_t i = 0; i < m->n; ++i) {
    if (!all && root(parent, i) != r) continue;
    set_normal(normal, points[m->t[i][0]], base, points[m->t[i][1]], base), set_way(way, points[m->t[i][2]], base);
    dot(&part, normal, way), add(&sum, &sum, &part, 1);
  }
  return sign_of(&sum);
}

/* Turns the components of the named triangles, whose volumes must be negative; if all are named, their sum.
   Returns whether all are. */
static int turn_components(const Mesh* m, File* f, uint64_t count) {
  uint32_t* const parent = each_alone(m->n);
  double(*const volume)[2] = filled(m->n, sizeof *volume, 0); /* of each component, and its error */
  unsigned char* const named = filled(m->n, 1, 0);
  Map edges = {NULL, 0, 0};
  int all = 1;
  for (size_t i = 0; i < 3 * m->n; ++i) {
    const uint32_t a = m->t[i / 3][i % 3], b = m->t[i / 3][(i + 1) % 3];
    int64_t* const first = &slot_at(&edges, a < b ? a : b, a < b ? b : a, NONE)->value;
    if (!*first) *first = (int64_t)(i / 3 + 1);
    parent[root(parent, (uint32_t)*first - 1)] = root(parent, (uint32_t)(i / 3));
  }
  for (; count > 0; --count) named[root(parent, (uint32_t)number(f, m->n))] = 1;
  for (uint32_t i = 0; i < m->n; ++i) {
    uint32_t *const t = m->t[i], r = root(parent, i), x = t[1];
    const Point base = points[m->t[r][0]], p[6] = {points[t[0]], base, points[t[1]], base, points[t[2]], base};
    double error;
    if (!named[r]) continue;
    volume[r][0] += rounded(p, &error), volume[r][1] += 1.01 * error + 1e-15 * size_of(volume[r][0]);
    t[1] = t[2], t[2] = x;
  }
  for (uint32_t i = 0; i < m->n; ++i) all &= named[root(parent, i)];
  for (uint32_t i = 0, r = root(parent, 0); i < m->n && all; ++i)
    if (named[i] && i != r)
      volume[r][0] += volume[i][0], volume[r][1] += volume[i][1] + 1e-15 * size_of(volume[r][0]), named[i] = 0;
  for (uint32_t i = 0; i < m->n; ++i)
    if (named[i] && !(volume[i][0] < -volume[i][1]) && sign_of_volume(m, parent, i, all) <= 0) /* now that it is turned */
      end(1, "the volume of the component of triangle %u of the original is not negative", i);
  free(edges.slot), free(parent), free(volume), free(named);
  return all;
}

static void prove_tetrahedra(Case* c) {
  File* const f = &c->file;
  Mesh* const m = &c->original;
  const size_t left = (size_t)(f->end - f->at);
  Map sum = {NULL, 0, 0};
  if (!is_closed(m)) end(1, "the original is not closed");
  for (size_t i = 0; i < m->n; ++i) add_triangle(&sum, m->t[i][0], m->t[i][1], m->t[i][2], 1);
  for (uint64_t added = number(f, left / 24 + 1); added > 0; --added) {
    const double x = real(f, -LARGEST), y = real(f, -LARGEST), z = real(f, -LARGEST);
    m->vertex = room(m->vertex, m->vertices, sizeof *m->vertex), m->vertex[m->vertices++] = point_at(x, y, z);
  }
  for (uint64_t fans = number(f, left), fan = 0; fan < fans; ++fan) {
    const uint32_t apex = m->vertex[number(f, m->vertices)], centre = m->vertex[number(f, m->vertices)];
    uint32_t from = NONE;
    for (uint64_t count = number(f, left) + 1, i = 0; i < count; ++i) {
      const uint32_t to = m->vertex[number(f, m->vertices)];
      if (apex == NONE || centre == NONE || to == NONE) end(1, "fan %lu has a point that is not finite", COUNT(fan));
      if (i && det(points[from], points[centre], points[to], points[centre], points[apex], points[centre]) ==
                   (c->inner ? 1 : -1))
        end(1, "tetrahedron %lu of fan %lu lies on the wrong side", COUNT(i - 1), COUNT(fan));
      if (i) add_triangle(&sum, centre, from, to, -1), add_triangle(&sum, from, to, apex, 1);
      if (!i) add_triangle(&sum, centre, to, apex, 1);
      from = to;
    }
    add_triangle(&sum, centre, from, apex, -1);
  }
  for (size_t i = 0; i < c->hull.n; ++i) add_triangle(&sum, c->hull.t[i][0], c->hull.t[i][1], c->hull.t[i][2], -1);
  if (sum.used) end(1, "hull and original differ by %lu triangles from what the tetrahedra bound", COUNT(sum.used));
  free(sum.slot);
  c->claims |= ENCLOSES;
}

/* Whether triangle i of s, without area, lies on an edge or at a corner of one that has an area. */
static int is_on_edge(const Surface* s, size_t i) {
  static List list;
  const uint32_t* const t = s->t[i];
  for (find_near(s, zone_of(t), 0, &list); list.n-- > 0;)
    for (int e = 0; e < 3; ++e) {
      const uint32_t *const g = s->t[list.i[list.n]], u = t[e], v = t[(e + 1) % 3];
      const Point a = points[u], b = points[v], c = points[t[(e + 2) % 3]];
      int within = has_corner(g, u) && has_corner(g, v) && has_area(g);
      for (int k = 0; k < 3; ++k) within &= (a[k] <= c[k] && c[k] <= b[k]) || (b[k] <= c[k] && c[k] <= a[k]);
      if (within) return 1;
    }
  return 0;
}

typedef struct {
  Number at[3]; /* positive at the corners of the triangle that are on one side of a plane, 0 on it */
} Line;
typedef struct {
  const Surface *of, *by, *enclosed; /* enclosed: by `by`, so that beside a part either has to wind, or not; or NULL */
  size_t i, lines;                   /* the triangle that is cut */
  unsigned sides;                    /* of the triangle: those asked for */
  int is_flat;
  List blocking; /* triangles of `by`; those from `next` on, as below, may cross the part */
  Line* line;    /* the sides of the triangle, and cuts */
} Cut;

/* The line of a triangle's plane becomes the last of the lines. */
static void set_line(Cut* u, const uint32_t f[3]) {
  const Point a = points[f[0]];
  Number normal[3], way[3];
  set_normal(normal, points[f[1]], a, points[f[2]], a);
  for (int k = 0; k < 3; ++k) set_way(way, points[u->of->t[u->i][k]], a), dot(&u->line[u->lines].at[k], normal, way);
}

/* The signs of the corners of a part at the plane of f. Corner k is where line k meets the next one. Returns how many
   signs there are. */
static unsigned find_signs(Cut* u, const uint32_t* lines, size_t n, const uint32_t f[3], int* sign) {
  unsigned sides = 0, unsure = 1;
  for (size_t k = 0; k < n; ++k) sign[k] = UNSURE;
  for (int pass = 0; unsure; ++pass) {
    exactly = pass, unsure = 0, set_line(u, f);
    for (size_t k = 0; k < n; ++k) {
      Number at[3], sum;
      if (sign[k] != UNSURE) continue;
      cross(at, u->line[lines[k]].at, u->line[lines[(k + 1) % n]].at), dot(&sum, at, u->line[u->lines].at);
      sign[k] = sign_of(&sum);
      unsure |= sign[k] == UNSURE;
      if (sign[k] == 1 || sign[k] == -1) sides |= sign[k] > 0 ? OUTER : INNER;
    }
  }
  return sides;
}

/* Rounds weights that are at least 0 from their limbs, but for a factor that all have. */
static void round_weights(Number w[3]) {
  const int m = w[0].n > w[1].n ? w[0].n : w[1].n, top = m > w[2].n ? m : w[2].n;
  for (int i = 0; i < 3; ++i) {
    w[i].value = 0;
    for (int j = 0; j < top; ++j) w[i].value = w[i].value * 0x1p-32 + (j < w[i].n ? w[i].d[j] : 0);
    w[i].error = 1e-15 * w[i].value + 1e-290;
  }
}

/* No triangle of `by` crosses the part: the sides asked for are free. Lines are known but for a factor, which is
   another one where they are exact: rounded and exact corners, added up, would be two points. So one is rounded. */
static void prove_within(const Cut* u, const uint32_t* lines, size_t n) {
  Spot middle = {u->of->t + u->i, {zero, zero, zero}};
  Number at[3];
  exactly = 1, spend(10000);
  for (size_t k = 0; k < n; ++k) {
    cross(at, u->line[lines[k]].at, u->line[lines[(k + 1) % n]].at);
    for (int i = 0; i < 3; ++i) add(&middle.weight[i], &middle.weight[i], &at[i], 1);
  }
  round_weights(middle.weight);
  for (int w = OUTER; w <= INNER; ++w) {
    if (!(u->sides & (unsigned)w)) continue;
    const int within = winding_beside(u->by, &middle, w == OUTER) >= 1;
    if (within && !u->enclosed) return;
    if (!within && u->enclosed && winding_beside(u->enclosed, &middle, w == OUTER) >= 1)
      end(1, "%s leaves a hole in %s beside triangle %u", u->by->name, u->enclosed->name, u->of->number[u->i]);
  }
  if (!u->enclosed)
    end(1, "a part of triangle %u of %s lies outside of %s", u->of->number[u->i], u->of->name, u->by->name);
}

/* Cuts a part at the next blocking triangle that crosses it. Those that its plane parts from a half are left out. */
static void prove_cut(Cut* u, const uint32_t* lines, size_t n, size_t next, int depth) {
  int* const sign = resized(NULL, n, sizeof *sign);
  uint32_t* const half = resized(NULL, n + 1, sizeof *half);
  const uint32_t* f = NULL;
  const size_t last = u->blocking.n;
  unsigned sides = 0;
  for (; sides != BOTH && next < last; ++next) {
    spend(32 * n);
    sides = find_signs(u, lines, n, f = u->by->t[u->blocking.i[next]], sign);
    if (!sides && u->is_flat)
      end(1, "triangle %u of %s has no area and is on %s", u->of->number[u->i], u->of->name, u->by->name);
  }
  if (sides != BOTH) prove_within(u, lines, n);
  if (depth == 1000) end(1, "triangle %u of %s is crossed too often", u->of->number[u->i], u->of->name);
  for (int s = -1; s <= 1 && sides == BOTH; s += 2) {
    size_t m = 0;
    for (size_t k = 0; k < n; ++k) { /* side k runs from corner k - 1 to corner k */
      const int before = s * sign[(k + n - 1) % n], here = s * sign[k], after = s * sign[(k + 1) % n];
      if (before <= 0 && here <= 0) continue;
      half[m++] = lines[k];
      if (here < 0 || (here == 0 && after <= 0)) half[m++] = (uint32_t)u->lines;
    }
    for (exactly = 0; exactly < 2; ++exactly) {
      set_line(u, f);
      for (int k = 0; k < 3 && s < 0; ++k) add(&u->line[u->lines].at[k], &zero, &u->line[u->lines].at[k], -1);
    }
    spend(16 * (last - next));
    for (size_t i = next; i < last; ++i) {
      const uint32_t g = u->blocking.i[i];
      int signs[3];
      u->blocking.i = room(u->blocking.i, u->blocking.n, sizeof *u->blocking.i);
      if (place(f, u->by->t[g], signs) & (s > 0 ? OUTER : INNER)) u->blocking.i[u->blocking.n++] = g;
    }
    u->line = room(u->line, ++u->lines, sizeof *u->line), prove_cut(u, half, m, last, depth + 1), --u->lines;
    u->blocking.n = last;
  }
  free(sign), free(half);
}

/* Cuts triangle i of a at the triangles of b that block the sides asked for. */
static void prove_crossed(const Surface* a, size_t i, const Surface* b, const Surface* enclosed, unsigned sides) {
  static Cut u;
  static const uint32_t whole[3] = {0, 1, 2};
  size_t n = 0;
  u.of = a, u.by = b, u.enclosed = enclosed, u.i = i, u.lines = 3, u.is_flat = !has_area(a->t[i]);
  u.sides = u.is_flat ? OUTER : sides;
  if (!u.line) u.line = resized(NULL, 4, sizeof *u.line);
  for (int k = 0; k < 9; ++k) u.line[k / 3].at[k % 3] = k % 4 ? zero : one;
  find_near(b, zone_of(a->t[i]), 0, &u.blocking);
  for (size_t j = 0; j < u.blocking.n; ++j)
    if (blocked_sides(a->t[i], b->t[u.blocking.i[j]], NULL, NULL) & sides) u.blocking.i[n++] = u.blocking.i[j];
  u.blocking.n = n, prove_cut(&u, whole, 3, 0, 0);
}

static void prove_surfaces(Case* c) {
  const Mesh *in = c->inner ? &c->hull : &c->original, *out = c->inner ? &c->original : &c->hull;
  const Surface a = surface_of(c->inner ? "the hull" : "the original", in, 1),
                b = surface_of(c->inner ? "the original" : "the hull", out, 0);
  Sides on_a = sides_of(&a, &b), on_b = sides_of(&b, &a);
  const uint64_t claims = number(&c->file, 4);
  List list = {NULL, 0};
  if (claims != 1 && claims != 3) unreadable(&c->file, "this claim is not known");
  if (!is_closed(out)) end(1, "%s is not closed", b.name);
  for (size_t j = 0; j < b.n; ++j)
    for (find_near(&a, zone_of(b.t[j]), 0, &list); list.n-- > 0;) {
      const size_t i = list.i[list.n];
      const unsigned sides = blocked_sides(a.t[i], b.t[j], on_a.touched, on_b.touched);
      on_a.blocked[i] |= (unsigned char)(sides & BOTH), on_b.blocked[j] |= (unsigned char)(sides >> 2);
    }
  join(&on_a), join(&on_b);
  for (size_t i = 0; i < a.n; ++i) {
    if (!(on_a.blocked[i] & OUTER) && winding_on(&on_a, i, 1) >= 1) continue;
    if (!(on_a.blocked[i] & INNER) && winding_on(&on_a, i, 0) >= 1) continue;
    if (!on_a.blocked[i]) end(1, "triangle %u of %s lies outside of %s", a.number[i], a.name, b.name);
    if (has_area(a.t[i]) || !is_on_edge(&a, i)) prove_crossed(&a, i, &b, NULL, BOTH);
  }
  c->claims |= (int)claims;
  if (claims == 3 && !is_closed(in)) end(1, "%s is not closed", a.name);
  for (size_t i = 0; i < b.n && claims == 3; ++i) {
    unsigned sides = BOTH;
    for (int w = OUTER; w <= INNER; ++w)
      if (!(on_b.blocked[i] & w) && winding_on(&on_b, i, w == OUTER) < 1) sides ^= (unsigned)w;
    if (sides) prove_crossed(&b, i, &b, &a, sides);
  }
}

/* r = sum of w (p - base), for n <= 5 points; the weights are whole numbers. */
static void set_sum(Number r[3], int n, const Point* p, const double* w, Point base) {
  Number way[3], weight, product;
  for (int i = 0; i < n; ++i) {
    set_way(way, p[i], base), set(&weight, w[i], 0);
    for (int k = 0; k < 3; ++k) multiply(&product, &way[k], &weight), add(&r[k], i ? &r[k] : &zero, &product, 1);
  }
}

/* Whether |sum of w (p - base)| <= radius; the weights are multiples of 2^-50. */
static int is_within(Point base, double radius, int n, const Point* p, const double* w) {
  Number way[3], largest[3], square, sum;
  double whole[5];
  int sign = UNSURE;
  for (int i = 0; i < n; ++i) whole[i] = w[i] * 0x1p50;
  for (int pass = 0; sign == UNSURE; ++pass) {
    exactly = pass, set_sum(way, n, p, whole, base), dot(&square, way, way);
    set(&way[0], radius, unit), set(&way[1], 0x1p50, 0), multiply(&largest[0], &way[0], &way[1]);
    multiply(&sum, &largest[0], &largest[0]), add(&sum, &sum, &square, -1), sign = sign_of(&sum);
  }
  return sign >= 0;
}

static double product_of(Point p, Point p0, Point q, Point q0) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += (p[k] - p0[k]) * (q[k] - q0[k]);
  return sum;
}

/* The weights, multiples of 2^-50, of a point of t that is about nearest to p; and that point. */
static void find_nearest(Point p, const Point t[3], double weight[3], double at[3]) {
  double best = -1;
  for (int i = 0; i < 4; ++i) { /* on the edges, and inside */
    const Point a = t[i % 3], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const double bb = product_of(b, a, b, a), cc = product_of(c, a, c, a), bc = product_of(b, a, c, a),
                 pb = product_of(p, a, b, a), pc = product_of(p, a, c, a), area = bb * cc - bc * bc;
    double x = i < 3 ? pb / bb : (cc * pb - bc * pc) / area, y = i < 3 ? 0 : (bb * pc - bc * pb) / area, q[3];
    if (i == 3 && !(x >= 0 && y >= 0 && x + y <= 1)) continue;
    x = x > 0 ? (double)(int64_t)((x < 1 ? x : 1) * 0x1p50) * 0x1p-50 : 0, y = (double)(int64_t)(y * 0x1p50) * 0x1p-50;
    for (int k = 0; k < 3; ++k) q[k] = (1 - x - y) * a[k] + x * b[k] + y * c[k];
    const double distance = product_of(q, p, q, p);
    if (best >= 0 && !(distance < best)) continue;
    best = distance, memcpy(at, q, sizeof q);
    weight[i % 3] = 1 - x - y, weight[(i + 1) % 3] = x, weight[(i + 2) % 3] = y;
  }
}

/* Reads a tree of the part of t whose corners have these weights. A leaf names a ball or, if there is a distance, a
 * triangle. */
static void prove_parts(Case* c, const uint32_t t[3], double w[3][3], int depth, size_t face) {
  const uint64_t n = number(&c->file, 3 + (c->ball ? c->balls : c->original.n));
  Point p[5] = {points[t[0]], points[t[1]], points[t[2]]};
  for (int i = 0; i < 3 && n >= 3; ++i) {
    double weights[5] = {w[i][0], w[i][1], w[i][2], 0, 0}, at[3] = {0, 0, 0}, back[3], nearest[3];
    if (c->ball && !is_within(c->ball[n - 3], c->ball[n - 3][3], 3, p, weights))
      end(1, "a part of triangle %lu of the original is not in its ball", COUNT(face));
    if (c->ball) continue;
    const uint32_t* const o = c->original.t[n - 3];
    const Point target[3] = {points[o[0]], points[o[1]], points[o[2]]};
    for (int k = 0; k < 9; ++k) at[k % 3] += w[i][k / 3] * p[k / 3][k % 3];
    find_nearest(at, target, back, nearest);
    p[3] = target[1], p[4] = target[2], weights[3] = -back[1], weights[4] = -back[2];
    if (!is_within(target[0], c->distance, 5, p, weights))
      end(1, "a part of triangle %lu of the hull may be farther than the distance", COUNT(face));
  }
  if (n < 3 && depth == 50) unreadable(&c->file, "a tree is deeper than 50");
  for (int half = 1; half <= 2 && n < 3; ++half) {
    double part[3][3];
    memcpy(part, w, sizeof part);
    for (int k = 0; k < 3; ++k) part[(n + (unsigned)half) % 3][k] = (w[(n + 1) % 3][k] + w[(n + 2) % 3][k]) / 2;
    prove_parts(c, t, part, depth + 1, face);
  }
}

static void prove_trees(Case* c, const Mesh* m, int claim) {
  for (size_t i = 0; i < m->n; ++i) prove_parts(c, m->t[i], (double[3][3]){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, i);
  c->claims |= claim;
}

/* Whether n(p - q) >= gap |n| for all corners p of a and q of b; n is of whole numbers. */
static int is_slab(const Point a[3], const Point b[3], const double n[3], double gap) {
  Number normal[3], way[3], height[6], along, least, square, product;
  unsigned sure = 0;
  for (exactly = 0; exactly < 2 && sure != 511; ++exactly) {
    for (int k = 0; k < 3; ++k) set(&normal[k], n[k], 0);
    for (int i = 0; i < 6; ++i) set_way(way, (i < 3 ? a : b)[i % 3], b[0]), dot(&height[i], normal, way);
    dot(&square, normal, normal), set(&least, gap, unit), multiply(&product, &least, &least);
    multiply(&least, &product, &square);
    for (int i = 0; i < 9; ++i) {
      add(&along, &height[i / 3], &height[3 + i % 3], -1);
      multiply(&product, &along, &along), add(&product, &product, &least, -1);
      const int side = sign_of(&along), sign = sign_of(&product);
      if (side < 0 || sign < 0) return 0;
      sure |= (unsigned)(side < UNSURE && sign < UNSURE) << i;
    }
  }
  return 1;
}

/* Tries slabs across normals, products of edges, and ways from a corner to the other triangle. */
static void prove_apart(const Surface* hull, size_t at, const Surface* original, size_t other, double gap) {
  const uint32_t *t = hull->t[at], *o = original->t[other];
  const Point a[3] = {points[t[0]], points[t[1]], points[t[2]]}, b[3] = {points[o[0]], points[o[1]], points[o[2]]};
  for (int i = 16; i >= 0; --i) {
    const Point *u = i == 10 || i >= 14 ? b : a, *v = i == 9 || i >= 14 ? a : b;
    const int j = i < 9 ? i / 3 : 0, j1 = (j + 1) % 3, m = i < 9 ? i % 3 : 1, m1 = (m + 1) % 3;
    double n[3], w[3], q[3], size = 0, along = 0;
    if (i >= 11) find_nearest(u[(i - 11) % 3], v, w, q);
    for (int k = 0; k < 3; ++k) {
      const int x = (k + 1) % 3, y = (k + 2) % 3;
      n[k] = (u[j1][x] - u[j][x]) * (v[m1][y] - v[m][y]) - (u[j1][y] - u[j][y]) * (v[m1][x] - v[m][x]);
      if (i >= 11) n[k] = u[(i - 11) % 3][k] - q[k];
      size = size_of(n[k]) > size ? size_of(n[k]) : size, along += n[k] * (a[0][k] - b[0][k]);
    }
    if (!(size > 0 && size < 1e300)) continue;
    for (int k = 0; k < 3; ++k) n[k] = (double)(int64_t)(n[k] / (along < 0 ? -size : size) * 0x1p50);
    if (is_slab(a, b, n, gap)) return;
  }
  end(1, "triangle %u of the hull may be nearer than the gap to triangle %u of the original", hull->number[at],
      original->number[other]);
}

static void prove_gap(Case* c) {
  const Surface hull = surface_of("the hull", &c->hull, 1), original = surface_of("the original", &c->original, 1);
  List list = {NULL, 0};
  c->gap = real(&c->file, 5e-324);
  for (size_t i = 0; i < hull.n; ++i) {
    for (find_near(&original, zone_of(hull.t[i]), c->gap * (1 + 1e-9), &list); list.n-- > 0;)
      spend(20), prove_apart(&hull, i, &original, list.i[list.n], c->gap);
  }
  c->claims |= GAP;
}

static int64_t* side_at(Map* sides, uint32_t a, uint32_t b) {
  return &slot_at(sides, a < b ? a : b, a < b ? b : a, NONE)->value;
}

/* Whether the triangles have all sides of the face of which they take the fan's place. Corner x of a triangle of the
   fan is corner 3 - x of the next one, and x is 1 if the fan is turned, or else 2. `sides` is empty. */
static int has_all_sides(Map* sides, uint32_t (*t)[3], uint32_t (*fan)[3], size_t n) {
  int missing = 0, is_fan = 0;
  for (size_t i = 0; i < 3 * n; ++i) *side_at(sides, t[i / 3][i % 3], t[i / 3][(i + 1) % 3]) = 1;
  for (int x = 1; x <= 2; ++x) {
    size_t i = 0;
    while (i + 1 < n && fan[i][x] == fan[i + 1][3 - x]) ++i;
    if (i + 1 < n) continue;
    const uint32_t *const first = fan[0], *const last = fan[n - 1];
    is_fan = 1, missing |= !*side_at(sides, first[0], first[3 - x]) || !*side_at(sides, last[0], last[x]);
    for (i = 0; i < n; ++i) missing |= !*side_at(sides, fan[i][1], fan[i][2]);
  }
  return is_fan && !missing;
}

/* Divides faces of the original into other triangles, which have the same boundary and all sides of the face. */
static void divide_faces(Case* c) {
  const Mesh* const m = &c->original;
  c->divided = (size_t)number(&c->file, m->n + 1);
  for (size_t left = c->divided; left > 0; --left) {
    const size_t first = (size_t)number(&c->file, m->n);
    size_t n = 0;
    Map sum = {NULL, 0, 0};
    while (first + n < m->n && m->face[first + n] == m->face[first]) add_edges(&sum, m->t[first + n++], 1);
    uint32_t(*const fan)[3] = memcpy(resized(NULL, n, sizeof *fan), m->t + first, n * sizeof *fan);
    uint32_t(*const divided)[3] = m->t + first;
    for (size_t i = 0; i < 3 * n; ++i) {
      const size_t from = (size_t)number(&c->file, 3 * n);
      divided[i / 3][i % 3] = fan[from / 3][from % 3];
    }
    for (size_t i = 0; i < n; ++i) add_edges(&sum, divided[i], -1);
    if (sum.used) end(1, "the face of triangle %lu is divided into triangles that bound another one", COUNT(first));
    if (!has_all_sides(&sum, divided, fan, n))
      end(1, "the face of triangle %lu is divided into triangles that leave out sides of it", COUNT(first));
    free(fan), free(sum.slot);
  }
}

static void prove_section(Case* c, uint64_t kind) {
  if (kind == 1) prove_tetrahedra(c);
  if (kind == 2) prove_surfaces(c);
  if (kind == 3) prove_trees(c, &c->original, COVERS);
  if (kind == 4) prove_gap(c);
  if (kind == 5) c->distance = real(&c->file, 0), prove_trees(c, &c->hull, DISTANCE);
  if (kind == 6) divide_faces(c);
}

int main(int count, char** names) {
  Case c;
  memset(&c, 0, sizeof c);
  if (count < 4) end(2, "usage: prohull_check CERTIFICATE HULL... ORIGINAL");
  c.file = opened(names[1]), c.file.encoding = LITTLE;
  File* const f = &c.file;
  if (f->end - f->at < 8 || memcmp(f->at, "\x89PHCER\r\n", 8) != 0) unreadable(f, "this is no certificate");
  f->at += 8;
  if (number(f, UINT64_MAX) != 1) unreadable(f, "the version is not 1");
  c.inner = (int)number(f, 2);
  c.hull.scale = 1, c.original.scale = real(f, 5e-324);
  if (count == 4 && (ends_in(names[2], ".yaml") || ends_in(names[2], ".yml")))
    c.balls = read_balls(opened(names[2]), &c.ball);
  else
    for (int i = 2; i + 1 < count; ++i) read_mesh(names[i], &c.hull);
  read_mesh(names[count - 1], &c.original);
  if (c.hull.infinite) end(1, "the hull has coordinates that are not finite");
  if (!c.original.n || !(c.hull.n + c.balls)) end(1, "there is no triangle");
  if (number(f, UINT64_MAX) != c.hull.n + c.balls || number(f, UINT64_MAX) != c.original.n)
    end(1, "the certificate is for other meshes: hull and original have %lu and %lu triangles",
        COUNT(c.hull.n + c.balls), COUNT(c.original.n));
  const uint64_t turned = number(f, c.original.n + 1);
  const int all = turned && turn_components(&c.original, f, turned);
  for (unsigned seen = 1; !(c.claims && f->at == f->end);) {
    const uint64_t kind = number(f, 7);
    if (seen >> kind & 1 || (kind == 6 && seen > 1) || (kind < 6 && (c.ball != NULL) != (kind == 3)) ||
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
    if (c.claims & k & DISTANCE) printf("no point of the surface of the hull is farther than %.17g from the triangles", c.distance);
  }
  if (c.original.infinite) printf("; triangles of the original that are not finite: %lu", COUNT(c.original.infinite));
  if (turned) printf("; components of the original that are turned: %lu%s", COUNT(turned), all ? ", which are all" : "");
  if (c.divided) printf("; faces of the original that are divided in another way than as fans: %lu", COUNT(c.divided));
  if (c.original.scale != 1) printf("; the original is scaled by %.17g", c.original.scale);
  putchar('\n');
  return 0;
}
