#!/bin/sh
# Drives `prohull verify --union` as a user would: cover_test.sh PROHULL
# Each check names what it defends; the last line counts them.
set -u
prohull=$1
. "$(dirname "$0")/checks.sh"

# slab FILE FROM TO FIRST: a box [FROM, TO] x [0, 1] x [0, 1] as OBJ; FIRST is the number before its first vertex
slab() {
  for z in 0 1; do for y in 0 1; do for x in $2 $3; do echo "v $x $y $z"; done; done; done >>"$1"
  for face in "1 3 4 2" "5 6 8 7" "1 2 6 5" "3 7 8 4" "1 5 7 3" "2 4 8 6"; do
    set -- "$1" "$2" "$3" "$4" $face
    echo "f $(($4 + $5)) $(($4 + $6)) $(($4 + $7)) $(($4 + $8))"
  done >>"$1"
}
slab part.obj 0 1 0
slab left.obj 0 0.3 0
slab right.obj 0.3 1 0
slab away.obj 0.30000000000000004 1 0
slab both.obj 0 0.3 0
slab both.obj 0.3 1 8

# --- pieces ---
expect 0 "several files" $prohull verify --union left.obj right.obj part.obj --report report.json
says out "several files" "yes: 2 pieces cover every triangle and the inside of part.obj, exactly"
says report.json "report: the verdict" '"covers": true'
says report.json "report: the pieces" '"pieces": 2'
says report.json "report: the reach" '"upper"'
expect 0 "one file of two components" $prohull verify --union both.obj part.obj
says out "one file of two components" "2 pieces cover"
expect 0 "files mixed" $prohull verify --union both.obj left.obj part.obj
says out "files mixed" "3 pieces cover"
expect 1 "a slit of one ulp" $prohull verify --union left.obj away.obj part.obj --report report.json
says out "a slit of one ulp" "NO: 2 pieces do not cover"
says out "a slit of one ulp: offenders" "8 faces of part.obj lie outside"
says report.json "report: offenders" '"point"'
expect 1 "one piece alone" $prohull verify --union left.obj part.obj
says out "one piece alone" "NO: 1 piece does not cover"
expect 0 "the solid alone" $prohull verify --union both.obj part.obj --solid-only
says out "the solid alone" "the solid of part.obj"
sed '$d' left.obj >open.obj
expect 3 "a piece that is not closed" $prohull verify --union right.obj open.obj part.obj
says err "a piece that is not closed" "piece 2: the piece's mesh is not closed"
expect 0 "an original that is not closed" $prohull verify --union right.obj left.obj open.obj
says out "an original that is not closed" "every triangle of open.obj"

# --- spheres ---
cat >spheres.yaml <<'YAML'
collision_spheres:
  part:
    - center: [0.5, 0.5, 0.5]
      radius: 0.9
YAML
expect 0 "spheres" $prohull verify --union spheres.yaml part.obj --inside --report report.json
says out "spheres" "yes: 1 sphere covers every triangle and the inside of part.obj, exactly"
says report.json "report: the spheres" '"spheres": 1'
expect 0 "the surface alone" $prohull verify --union spheres.yaml part.obj
says out "the surface alone" "covers every triangle of part.obj"
sed 's/0.9/0.8/' spheres.yaml >small.yaml
expect 1 "spheres that are too small" $prohull verify --union small.yaml part.obj
says out "spheres that are too small" "outside"

# --- wrong usage ---
expect 2 "spheres and meshes" $prohull verify --union spheres.yaml left.obj part.obj
says err "spheres and meshes" "both spheres and meshes"
expect 2 "several files without --union" $prohull verify left.obj right.obj part.obj
says err "several files without --union" "with --union the last one is ORIGINAL"
expect 2 "--inside without --union" $prohull verify both.obj part.obj --inside
expect 2 "--union and --side" $prohull verify --union both.obj part.obj --side inner
expect 2 "--union with one file" $prohull verify --union part.obj
expect 0 "help" $prohull verify --help
says out "help" "--union"

count_checks
