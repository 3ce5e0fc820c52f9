# Hulls that are their own mirror image

# A torus whose faces are mirrored at x = 0.
awk 'function v(i, j) { return 1 + (i + 2 * n) % (2 * n) * m + j % m }
     function face(i, a, j, b, k, c) {
       printf "f %d %d %d\nf %d %d %d\n", v(i, a), v(j, b), v(k, c), v(-i, a), v(-k, c), v(-j, b)
     }
     BEGIN {
       n = 24; m = 16; pi = atan2(0, -1)
       for (i = 0; i < 2 * n; ++i) {
         side = i <= n ? i : 2 * n - i
         x = side == n ? 0 : sin(pi * side / n) * (i <= n ? 1 : -1)
         for (j = 0; j < m; ++j) {
           r = 2 + 0.7 * cos(2 * pi * j / m)
           printf "v %.6f %.6f %.6f\n", r * x, r * cos(pi * side / n), 0.7 * sin(2 * pi * j / m)
         }
       }
       for (i = 0; i < n; ++i) for (j = 0; j < m; ++j) {
         face(i, j, i + 1, j, i + 1, j + 1)
         face(i, j, i + 1, j + 1, i, j + 1)
       }
     }' >torus.obj

# asymmetric_vertices OBJ: how many vertices have no mirror image, by their text
asymmetric_vertices() {
  awk '/^v / { print $2, $3, $4 }' "$1" | sort >vertices
  awk '{ x = $1 ~ /^-/ ? substr($1, 2) : $1 == 0 ? $1 : "-" $1; print x, $2, $3 }' vertices | sort >images
  comm -23 vertices images | wc -l
}

# symmetric OBJ NAME
symmetric() {
  checks=$((checks + 1))
  [ "$(asymmetric_vertices "$1")" -eq 0 ] || fail "$2: not symmetric"
}

expect 0 "symmetric" $prohull build torus.obj --faces 200 --mirror x -o hull.obj --hierarchy hull.phull --report hull.json
says out "symmetric: said" "symmetric: exactly its own mirror image in the plane x = 0"
says hull.json "symmetric: reported" '"mirror": "x"'
symmetric hull.obj "a hull"
expect 0 "symmetric: the hull encloses" $prohull verify hull.obj torus.obj
expect 0 "symmetric: all levels enclose" $prohull verify hull.phull torus.obj
checks=$((checks + 1)) asymmetric=0
for faces in 300 302 304 306 308 310 312 314; do
  expect 0 "symmetric: a level" $prohull lod hull.phull --faces $faces --mirror x -o level.obj
  symmetric level.obj "a level of $faces faces"
  expect 0 "symmetric: any level" $prohull lod hull.phull --faces $faces -o level.obj
  [ "$(asymmetric_vertices level.obj)" -eq 0 ] || asymmetric=$((asymmetric + 1))
done
[ $asymmetric -gt 0 ] || fail "--mirror of lod made no difference"
expect 2 "symmetric: rounded" $prohull lod hull.phull --faces 300 --mirror x -o level.stl
says err "symmetric: rounded" "level.stl: the file keeps float32 coordinates, and rounded to them the level is not symmetric"
absent level.stl "symmetric: rounded"
expect 0 "symmetric: float32 levels" $prohull build torus.obj --faces 300 --mirror x -o hull.stl --hierarchy float32.phull
expect 0 "symmetric: a float32 level" $prohull lod float32.phull --faces 310 --mirror x -o level.stl
expect 0 "symmetric: inner" $prohull build torus.obj --faces 300 --side inner --mirror x -o inner.obj
symmetric inner.obj "an inner hull"
expect 0 "symmetric: the inner hull is enclosed" $prohull verify inner.obj torus.obj --side inner
expect 0 "symmetric: several" $prohull build torus.obj --faces 400,203 --mirror x --best-of 3 -o 'hull_{faces}.obj'
symmetric hull_400.obj "a hull of several"
symmetric hull_203.obj "a hull of several"
expect 0 "symmetric: bounds" $prohull build torus.obj --faces 20 --mirror x --max-distance 0.2 -o hull.obj
symmetric hull.obj "a hull within bounds"

expect 1 "symmetric: too few faces" $prohull build torus.obj --faces 8 --mirror x --strict -o hull.obj
says out "symmetric: too few faces" "no legal collapse is left above the 8 faces asked for"

# --- what is refused ---
expect 3 "not symmetric" $prohull build torus.obj --faces 200 --mirror z -o none.obj
says err "not symmetric" "the mesh is not exactly symmetric: face 0 at "
says err "not symmetric: where" "has no mirror image in the plane z = 0; in all, 1,536 faces have none"
absent none.obj "not symmetric"
expect 2 "lod: not built symmetric" $prohull lod hull.phull --faces 300 --mirror y -o none.obj
for other in --tight "--gap 0.1" "--tolerance torus.obj"; do
  # shellcheck disable=SC2086
  expect 2 "with $other" $prohull build torus.obj --mirror x $other -o none.obj
  says err "with $other" "cannot be used together with"
done
expect 2 "with wraps" $prohull build torus.obj --mirror x --repair wrap -o none.obj
says err "with wraps" "a wrap is not symmetric"
# Moved by a third, the coordinates of the two halves are rounded differently.
awk '/^v / { printf "v %.17g %.17g %.17g\n", $2 + 1 / 3, $3, $4; next } { print }' torus.obj >moved.obj
expect 3 "moved" $prohull build moved.obj --faces 200 --mirror x -o none.obj
says err "moved" "with the plane between them at x = 0"
