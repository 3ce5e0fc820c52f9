#!/bin/sh
# Writes certificates by the command line, and asks the checker about them: certificate_test.sh PROHULL CHECKER.c
# Each check names what it defends; the last line counts them.
set -u
prohull=$1
. "$(dirname "$0")/../cli/checks.sh"
is "the checker compiles" "${CC:-cc}" -std=c99 -O1 -o prohull_check "$2" -lm
$prohull sample bracket --faces 1500 -o bracket.stl >/dev/null
$prohull sample bracket --faces 1500 -o bracket.ply >/dev/null
$prohull sample torus --faces 800 -o torus.obj >/dev/null
$prohull sample knot --faces 1000 -o knot.off >/dev/null

# proves NAME ORIGINAL HULL OPTIONS...: the checker accepts the certificate of what `prohull build` makes
proves() {
  name=$1 original=$2 hull=$3
  shift 3
  expect 0 "$name" $prohull build "$original" -o "$hull" --certificate c "$@"
  expect 0 "$name: the checker" ./prohull_check c "$hull" "$original"
}

# --- hulls ---
proves "a hull" bracket.stl hull.stl --faces 200
says out "a hull: what is proven" "encloses the solid"
says out "a hull: how far it is" "no point of the surface of the hull is farther than"
proves "doubles" bracket.ply hull.ply --faces 400
proves "float32 from doubles" torus.obj hull.stl --faces 100
proves "an inner hull" knot.off hull.obj --faces 300 --side inner
proves "a tight hull" bracket.ply hull.off --faces 150 --tight
proves "a wrap" torus.obj hull.ply --faces 200 --repair wrap
proves "a gap" torus.obj hull.ply --faces 200 --gap 0.02
says out "a gap is proven" "keeps a gap of at least 0.0"
proves "a gap within" torus.obj hull.ply --faces 200 --gap 0.02 --side inner
proves "a distance" bracket.ply hull.ply --faces 100 --max-distance 0.5
says out "a distance is proven as it was asked for" "farther than 0.5 from"
proves "a scale" bracket.stl hull.ply --faces 200 --scale 0.001
proves "levels" bracket.stl hull.ply --faces 200 --hierarchy h.phull

# --- a hull that intersects itself ---
proves "a hull that intersects itself" knot.off hull.ply --faces 60 --strategy paper1 --repair none
says out "a hull that intersects itself encloses" "encloses the solid"
is "its certificate is small" test "$(wc -c <c)" -lt 10000
proves "of an STL file" bracket.stl hull.stl --faces 80 --strategy paper1 --repair none

{ echo OFF; echo 16 24 0; corners='0 0 0,1 0 0,1 1 0,0 1 0,0 0 1,1 0 1,1 1 1,0 1 1'
  sides='3 0 2 1,3 0 3 2,3 4 5 6,3 4 6 7,3 0 1 5,3 0 5 4,3 1 2 6,3 1 6 5,3 2 3 7,3 2 7 6,3 3 0 4,3 3 4 7'
  echo "$corners" | tr , '\n'; echo "$corners" | tr , '\n' | awk '{ print $1 + 0.5, $2 + 0.5, $3 + 0.5 }'
  echo "$sides" | tr , '\n'; echo "$sides" | tr , '\n' | awk '{ print 3, $2 + 8, $3 + 8, $4 + 8 }'; } >two.off
proves "parts that overlap" two.off hull.off --faces 24
says out "parts that overlap are enclosed" "encloses the solid"
awk 'NR == 2 { print 16, 23, 0 } NR != 2 && NR != 19' two.off >open_two.off
proves "parts that overlap and are open" open_two.off hull.off --faces 24
says out "parts that overlap and are open" "the hull covers every finite triangle"

# --- what is not clean ---
awk 'NR == 2 { print $1, $2 - 40, $3 } NR != 2 && !(NF == 4 && ++n <= 40)' knot.off >open.off
proves "open" open.off hull.ply --faces 200 --open-shells keep
says out "open: every triangle" "covers every finite triangle"
{ echo OFF; echo 8 12 0; echo "$corners" | tr , '\n'
  echo "$sides" | tr , '\n'; } >cube.off
proves "the mesh itself" cube.off hull.off --faces 12
awk 'NR == 2 { print $1 + 1, $2 + 1, 0 } NR != 2' knot.off >nan.off
awk -v n="$(sed -n 2p knot.off | cut -d ' ' -f 1)" 'NR == n + 3 { print "nan 0 0"; print 3, 0, 1, n } 1' nan.off >not_finite.off
proves "not finite" not_finite.off hull.off --faces 200
sed '3,$s/^3 \(.*\) \(.*\) \(.*\)/3 \1 \3 \2/' cube.off >inside_out.off
proves "inside out" inside_out.off hull.off --faces 12

awk 'NR == 2 { print $1 + 3, $2 + 1, 0; next } { print } NR == 10 { print 0.25, 0, 0; print 0.5, 0, 0; print 0.75, 0, 0 }
  END { print 3, 8, 9, 10 }' cube.off >flat.off
expect 0 "a triangle without area on the hull" $prohull build flat.off -o hull.off --faces 12 --certificate c
says out "a triangle without area on the hull" "may not prove it: 1 triangle without area lies on the hull"
expect 1 "a triangle without area on the hull: the checker" ./prohull_check c hull.off flat.off
expect 0 "pieces with such a triangle" $prohull convex flat.off -o pieces.obj --pieces 1 --certificate c
says out "pieces with such a triangle" "may not prove it: 1 triangle without area lies on the hull"
expect 1 "pieces with such a triangle: the checker" ./prohull_check c pieces.obj flat.off
sed 's/^0.25 0 0$/0 0 0/; s/^0.75 0 0$/1 0 0/' flat.off >on_edge.off
expect 0 "a triangle without area on an edge" $prohull build on_edge.off -o hull.off --faces 12 --certificate c
says_not out "a triangle without area on an edge" "may not prove"
expect 0 "a triangle without area on an edge: the checker" ./prohull_check c hull.off on_edge.off

# --- what is not so ---
proves "the mesh itself" cube.off hull.off --faces 12
sed 's/^1 1 1$/1 1 0.9999999999999999/' hull.off >moved.off
is "a vertex moves by one unit in the last place" test "$(cmp moved.off hull.off | wc -l)" -eq 1
expect 1 "a vertex that is moved inwards" ./prohull_check c moved.off cube.off
proves "a hull of the knot" knot.off hull.ply --faces 60 --strategy paper1 --repair none
expect 0 "another hull" $prohull build knot.off -o other.ply --faces 60
expect 1 "the certificate of another hull" ./prohull_check c other.ply knot.off

# --- pieces and spheres ---
for out in pieces.obj pieces.ply pieces.urdf; do
  expect 0 "$out" $prohull convex torus.obj --pieces 6 -o "$out" --certificate c
  says out "$out: what is claimed" "cover every finite triangle, enclose the solid"
  files=$out
  [ $out = pieces.obj ] || files=$(echo pieces_*)
  expect 0 "$out: the checker" ./prohull_check c $files torus.obj
  says out "$out: what is proven" "the hull covers every finite triangle; the hull encloses the solid"
  rm -f pieces_*
done
expect 0 "pieces of triangles that are open" $prohull convex open.off --pieces 6 -o pieces.obj --certificate c
says out "pieces of triangles that are open: no solid" "(cover every finite triangle)"
expect 0 "pieces of triangles that are open: the checker" ./prohull_check c pieces.obj open.off
expect 1 "pieces of another mesh" ./prohull_check c pieces.obj knot.off
expect 0 "one piece" $prohull convex knot.off --pieces 1 -o pieces.obj --certificate c
expect 0 "one piece: the checker" ./prohull_check c pieces.obj knot.off
says out "one piece: what is proven" "the hull encloses the solid"
expect 0 "pieces of what is inside out" $prohull convex inside_out.off --pieces 2 -o pieces.obj --certificate c
expect 0 "pieces of what is inside out: the checker" ./prohull_check c pieces.obj inside_out.off
says out "pieces of what is inside out: what is proven" "the hull encloses the solid; components of the original that are turned: 1"
expect 0 "spheres" $prohull spheres bracket.stl --count 30 -o spheres.yaml --certificate c
expect 0 "spheres: the checker" ./prohull_check c spheres.yaml bracket.stl
awk '$1 == "f" { print "f", $2, $4, $3; next } 1' torus.obj >inside_out.obj
expect 0 "spheres around what is inside out" $prohull spheres inside_out.obj --count 30 -o around.yaml --certificate around
expect 0 "spheres around what is inside out: the checker" ./prohull_check around around.yaml inside_out.obj
awk '/center/ && !n++ { sub(/radius: [0-9.e-]*/, "radius: 0.0001") } 1' spheres.yaml >smaller.yaml
expect 1 "a smaller sphere" ./prohull_check c smaller.yaml bracket.stl

# --- cages ---
expect 0 "a cage" $prohull cage torus.obj --faces 200 -o outer.ply --inner inner.ply --certificate 'cage_{side}'
expect 0 "a cage: the outer hull" ./prohull_check cage_outer outer.ply torus.obj
expect 0 "a cage: the inner hull" ./prohull_check cage_inner inner.ply torus.obj
says out "a cage keeps a gap" "keeps a gap"

# --- what cannot be checked is refused ---
expect 0 "several hulls" $prohull build bracket.stl --faces 400,200 -o 'h_{faces}.ply' --certificate 'c_{faces}'
says out "the summary has the command" "prohull_check c_400 h_400.ply bracket.stl"
expect 0 "several hulls: the checker" ./prohull_check c_400 h_400.ply bracket.stl
expect 2 "several hulls and one certificate" $prohull build bracket.stl --faces 400,200 -o 'h_{faces}.ply' --certificate c
expect 2 "standard input" $prohull build - -o hull.ply --certificate c <bracket.stl
says err "standard input" "save it and name the file"
expect 2 "another format" $prohull build bracket.stl -o hull.glb --certificate c
says err "another format" "write .stl, .obj, .ply or .off"
expect 0 "GLB" $prohull build bracket.stl -o bracket.glb
expect 2 "an original of another format" $prohull build bracket.glb -o hull.ply --certificate c
says err "an original of another format" "save the mesh as one of these"
expect 2 "an offset" $prohull build bracket.stl -o hull.ply --certificate c --recenter
expect 2 "capsules" $prohull convex torus.obj -o pieces.urdf --shape capsule --certificate c
expect 2 "spheres as JSON" $prohull spheres bracket.stl -o spheres.json --certificate c
gzip -k bracket.ply
expect 0 "gzip" $prohull build bracket.ply.gz -o hull.ply --faces 200 --certificate c
says out "gzip" "once that is unpacked"
expect 0 "gzip: the checker" ./prohull_check c hull.ply bracket.ply

count_checks
