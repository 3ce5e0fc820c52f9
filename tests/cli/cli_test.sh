#!/bin/sh
# Drives the command line as a user would: cli_test.sh PROHULL DIVISOR, with meshes of DIVISOR times fewer faces.
# Each check names what it defends; the last line counts them.
set -u
prohull=$1 divisor=$2
. "$(dirname "$0")/checks.sh"
engines="bvh kdop6 kdop14 kdop18 kdop26 kdop6-overlap kdop14-overlap kdop18-overlap kdop26-overlap brute"

# --- the main job ---
expect 0 "sample" $prohull sample asteroid -o rock.ply --faces $((20000 / divisor))
expect 0 "build" $prohull build rock.ply --faces 500 -o hull.stl --hierarchy rock.phull --report hull.json
says out "build tells the faces" "outer hull of 500 faces"
says out "build certifies" "certified: yes"
says hull.json "report: certified" '"certified": true'
says hull.json "report: stopped" '"stopped": "target_reached"'
says hull.json "report: void" '"void_ratio": 0.'
expect 0 "the mesh after --faces" $prohull build --faces 500,100 rock.ply -o "level_{faces}.obj"
expect 0 "verify two files" $prohull verify hull.stl rock.ply --report verify.json
says verify.json "report: encloses" '"certified": true'
expect 0 "verify a proof" $prohull verify rock.phull rock.ply
expect 1 "verify the wrong way round" $prohull verify rock.ply hull.stl --report verify.json
says out "verify names offenders" "outside"
says verify.json "report: offenders" '"point"'
expect 1 "a proof of another mesh" $prohull verify rock.phull hull.stl
expect 0 "info of a mesh" $prohull info rock.ply
says out "info" "closed 2-manifold"
expect 0 "info of a .phull" $prohull info rock.phull
says out "info of a .phull" "progressive hull"
expect 0 "lod" $prohull lod rock.phull --faces $((5000 / divisor)) -o level.obj
expect 0 "a level encloses" $prohull verify level.obj rock.ply
expect 0 "a level encloses the next" $prohull verify hull.stl level.obj
expect 0 "lod to float32" $prohull lod rock.phull --faces $((10000 / divisor)) -o level.stl
expect 0 "a float32 level encloses" $prohull verify level.stl rock.ply
expect 0 "the finest level" $prohull lod rock.phull --faces 20000000 -o finest.ply
checks=$((checks + 1))
cmp -s finest.ply rock.ply || fail "the finest level is the original, bit for bit"
expect 0 "the finest level, rounded" $prohull lod rock.phull --faces 20000000 -o finest.stl
expect 0 "it encloses" $prohull verify finest.stl rock.ply

expect 0 "inner hull" $prohull build rock.ply --side inner --faces 500 -o inner.obj --hierarchy inner.phull
says out "inner hull" "inner hull of 500 faces"
expect 0 "inner hull verified" $prohull verify inner.obj rock.ply --side inner
expect 0 "inner proof verified" $prohull verify inner.phull rock.ply
expect 1 "an inner hull does not enclose" $prohull verify inner.obj rock.ply

# --- gaps ---
expect 0 "a gap" $prohull build rock.ply --faces 300 --gap 1% -o away.ply --report away.json
says out "the gap is told" "gap: the least distance from the mesh is at least"
says away.json "report: gap" '"proof": "padding"'
expect 0 "a gap verified" $prohull verify away.ply rock.ply --gap 1%
says out "verify tells the gap" "and keeps a gap of"
expect 1 "a greater gap" $prohull verify away.ply rock.ply --gap 1.5% --report away.json
says out "faces that are too near" "too near; the nearest"
says away.json "report: near faces" '"original_face"'
says away.json "report: it encloses" '"encloses_solid": true'
says away.json "report: it is too near" '"certified": false'
$prohull sample asteroid -o pebble.ply --faces $((2000 / divisor)) >/dev/null
expect 0 "an inner gap" $prohull build pebble.ply --faces 300 --side inner --gap 1% -o core.ply
expect 0 "an inner gap verified" $prohull verify core.ply pebble.ply --side inner --gap 1%
expect 1 "no gap on the wrong side" $prohull verify core.ply pebble.ply --gap 1%
expect 2 "a gap below 0" $prohull verify away.ply rock.ply --gap -1%
expect 2 "a gap of levels" $prohull verify rock.phull rock.ply --gap 1%
says err "a gap of levels" "touch each other"
expect 3 "an inner gap without room" $prohull build pebble.ply --side inner --gap 70% -o core.ply
says err "an inner gap without room" "thicker than twice the gap"

# --- lengths with units: of a mesh in millimetres, and of others that say their unit, or not ---
awk '/^v / { printf "v %.17g %.17g %.17g\n", $2 * 1000, $3 * 1000, $4 * 1000; next } { print }' inner.obj >mm.obj
small="--faces 100 -o small.ply --report small.json"
expect 0 "a gap in millimetres" $prohull build mm.obj --unit mm $small --gap 0.25mm
says small.json "a gap in millimetres" '"padding": 0.00025'
expect 0 "the same gap in metres" $prohull build mm.obj --unit mm $small --gap 0.00025
expect 0 "a distance in feet" $prohull build mm.obj --unit mm $small --max-distance 2ft --seal-holes 1in
says small.json "a distance in feet" '"max_distance": 0.6096'
says small.json "holes in inches" '"seal_holes": 0.0254'
expect 0 "a distance in per cent" $prohull convex mm.obj --pieces 2 --max-distance 50% -o pieces.obj --report small.json
is "a distance in per cent" awk '/"diagonal"/ { d = $2 } /"max_distance"/ { m = $2 } END { exit !(m + 0 == 0.5 * d) }' small.json
expect 0 "a distance in centimetres" $prohull spheres mm.obj --unit mm --max-distance 30cm -o small.yaml --count 40
expect 0 "glTF is in metres" $prohull build inner.obj -o small.glb --faces 100
expect 0 "glTF is in metres" $prohull cage small.glb --gap 1mm -o small.obj --report small.json
says small.json "glTF is in metres" '"gap": 0.001'
expect 0 "GLB of a pipe is in metres" sh -c "$prohull cage - --gap 1mm -o small2.obj --report small.json <small.glb"
says small.json "GLB of a pipe is in metres" '"gap": 0.001'
for no_unit in "build rock.ply -o x.ply" "cage rock.ply -o x.ply" "verify rock.ply rock.ply"; do
  expect 2 "no unit: $no_unit" $prohull $no_unit --gap 1mm
  says err "no unit: $no_unit" "--gap 1mm: rock.ply does not say its unit; add --unit mm (lengths are then in metres), or"
done
for no_unit in "build rock.ply -o x.ply" "convex rock.ply -o x.obj" "spheres rock.ply -o x.yaml"; do
  expect 2 "no unit: $no_unit" $prohull $no_unit --max-distance 1ft
  says err "no unit: $no_unit" "--max-distance 1ft: rock.ply does not say its unit"
done
expect 2 "no unit: a scale" $prohull build small.glb --scale 2 --gap 1mm -o x.ply
says err "no unit: a scale" "with --scale, the unit of small.glb is not known"
for wrong in 1mmm 5km mm 1mm% nan; do
  expect 2 "no length: $wrong" $prohull build rock.ply --unit mm --seal-holes $wrong -o x.ply
  says err "no length: $wrong" "--seal-holes must be a number, or one with mm, cm, m, in, ft or % behind it, not '$wrong'"
done
expect 2 "no length: below 0" $prohull build rock.ply --unit mm --gap -1mm -o x.ply
says err "no length: below 0" "--gap must be greater than 0, not -1mm"

# --- the solid of a mesh ---
awk '/^f / { n++; if (n > 10 && n < 20 || n == 100) next } { print }' inner.obj >open.obj
expect 3 "no inside" $prohull distance open.obj --random 10 --signed
says err "no inside" "\`prohull repair\` closes it"
expect 0 "one solid" $prohull contains open.obj --random 1000
says out "one solid" "openings, the largest"
grep inside out >inside_of_open
expect 0 "repair" $prohull repair open.obj -o solid.ply --report solid.json
says out "repair: openings" "openings, the largest"
$prohull contains solid.ply --random 1000 | grep inside >inside_of_solid
is "one solid" cmp inside_of_open inside_of_solid
expect 0 "repair" $prohull repair open.obj -o solid.ply --report solid.json
says out "repair: certified" "certified: yes, the file as written covers every triangle of the original, and its inside with its openings closed by"
says solid.json "repair: report" '"largest": 0.'
says solid.json "repair: source" '"source": "mesh"'
expect 0 "repair: an inside" $prohull contains solid.ply --random 10
expect 0 "repair: verified" $prohull verify solid.ply open.obj
expect 0 "repair in float32" $prohull repair open.obj --spacing 2% -o solid.stl --report solid.json
says out "repair in float32" "it is another solid than the mesh: a wrap with a spacing of"
says out "repair in float32" "with float32 coordinates"
says solid.json "repair in float32" '"certified": true'
expect 0 "repair in float32: verified" $prohull verify solid.stl open.obj
printf 'OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n' >book.off
expect 0 "repair: a wrap" $prohull repair book.off --spacing 0.05 -o solid.off
says out "repair: a wrap" "bounds no solid:"
says out "repair: a wrap" "a wrap with a spacing of 0.05"
expect 0 "repair: a wrap verified" $prohull verify solid.off book.off
expect 2 "repair: no spacing" $prohull repair book.off --spacing 1mm -o solid.off

# --- the same mesh in metres and in millimetres ---
awk '/^v / { printf "v %.17g %.17g %.17g\n", $2 / 1000, $3 / 1000, $4 / 1000; next } { print }' inner.obj >metres.obj
expect 1 "another unit" $prohull verify metres.obj rock.ply
says out "another unit" "about 1,000 times smaller than the original"

expect 1 "a thousand times as large" $prohull verify hull.stl metres.obj --report verify.json
says out "a thousand times as large" "UNITS: hull.stl encloses metres.obj, exactly, but the hull is about 1,000 times as large as the original"
says verify.json "a thousand times as large: enclosed" '"certified": true'
says verify.json "a thousand times as large" '"units_doubtful": true'
expect 0 "a thousand times as large is meant" $prohull verify hull.stl metres.obj --any-scale
expect 0 "the same unit again" $prohull verify hull.stl metres.obj --scale 1000 --report verify.json
says verify.json "the same unit again" '"units_doubtful": false'
expect 1 "an inner hull of another unit" $prohull verify metres.obj rock.ply --side inner
says out "an inner hull of another unit" "the original is about 1,000 times as large as the hull"
expect 1 "pieces of another unit" $prohull verify --union hull.stl metres.obj
says out "pieces of another unit" "UNITS: the union of 1 piece encloses"
expect 0 "pieces of any scale" $prohull verify --union hull.stl metres.obj --any-scale

# --- at map coordinates ---
awk '/^v / { printf "v %.17g %.17g %.17g\n", $2 + 500000.3, $3 + 5400000.7, $4 - 30; next } { print }' inner.obj >utm.obj
expect 3 "map coordinates in float32" $prohull build utm.obj --faces 100 -o utm.stl
says err "map coordinates in float32" "utm.obj: float32 numbers, which the file has, are 0.5 apart"
says err "map coordinates in float32" "--recenter"
absent utm.stl "map coordinates in float32"
expect 0 "map coordinates in doubles" $prohull build utm.obj --faces 100 -o utm.ply
expect 0 "recentered" $prohull build utm.obj --faces 100 --recenter -o utm.stl --hierarchy utm.phull --report utm.json
offset=$(sed -n 's/.*verify --offset \(.*\))/\1/p' out)
says utm.json "report: recentered" "\"offset\": ["
for hull in utm.stl utm.phull; do
  expect 0 "recentered, verified" $prohull verify $hull utm.obj --offset "$offset"
  expect 1 "recentered, not moved" $prohull verify $hull utm.obj
done
checks=$((checks + 1))
case $offset in 50000[01],540000[01],-[23][019]) ;; *) fail "a short offset: '$offset'" ;; esac
expect 0 "recentered, all faces" $prohull build utm.obj --faces 1000000 --recenter -o moved.obj
awk -v offset="$offset" 'BEGIN { split(offset, o, ",") }
  /^v / { printf "v %.17g %.17g %.17g\n", $2 + o[1], $3 + o[2], $4 + o[3]; next } { print }' moved.obj >back.obj
expect 0 "moved back, it encloses the mesh" $prohull verify back.obj utm.obj
expect 0 "moved back, the mesh encloses it" $prohull verify utm.obj back.obj
expect 2 "an offset of two numbers" $prohull verify utm.stl utm.obj --offset 1,2
says err "an offset of two numbers" "'1,2' is no offset; it has 2 numbers, not 3"
expect 0 "nothing to recenter" $prohull build inner.obj --faces 100 --recenter -o utm.stl
says out "nothing to recenter" "not recentered"

# --- originals that are no solid ---
$prohull lod rock.phull --faces 20000000 -o finest.obj >/dev/null
sed '$d' finest.obj >open.obj
expect 0 "an open original" $prohull verify hull.stl open.obj --report verify.json
says out "an open original" "covers every triangle of open.obj, exactly"
says out "an open original" "the original is not closed"
says verify.json "report: an open original" '"original_closed": false'
expect 0 "an open original by a proof" $prohull verify rock.phull open.obj
says out "an open original by a proof" "covers every triangle of open.obj"
expect 0 "a closed original, its solid" $prohull verify hull.stl rock.ply --solid-only
says out "a closed original, its solid" "encloses the solid of rock.ply, exactly"
expect 0 "a proof, the solid" $prohull verify rock.phull rock.ply --solid-only
(cat open.obj && printf 'v 9 0 0\nf 1 2 -1\n') >stray.obj
for hull in hull.stl rock.phull; do
  expect 1 "a stray triangle" $prohull verify $hull stray.obj --report verify.json
  says out "a stray triangle" "1 face of stray.obj lies outside"
  says verify.json "report: a stray triangle" '"faces_outside": 1'
done
expect 3 "an inner hull of an open original" $prohull verify inner.obj open.obj --side inner
says err "an inner hull of an open original" "not closed"
expect 3 "an inner proof of an open original" $prohull verify inner.phull open.obj

for strategy in paper1 paper2; do
  expect 0 "$strategy" $prohull build rock.ply --strategy $strategy --faces 500 -o hull.off
  says out "$strategy certified" "certified: yes"
done

# --- self-intersections and tight hulls ---
$prohull sample knot -o knot.ply --faces 3000 >/dev/null
expect 0 "guarded" $prohull build knot.ply --faces 100 -o guarded.ply --report guarded.json
says out "guarded" "self-intersections: none"
says out "quality" "triangles: median compactness 0."
says guarded.json "report: self-intersections" '"self_intersections": 0'
says guarded.json "report: guarded by default" '"self_intersections": "refused"'
says guarded.json "report: quality" '"dihedral_degrees": {'
expect 0 "unguarded" $prohull build knot.ply --faces 100 -o loose.ply --self-intersections allowed --repair none --report loose.json
says out "unguarded" "pairs of faces (the mesh: 0; added: "
says loose.json "report: unguarded" '"self_intersections": "allowed"'
expect 0 "of a self-intersecting mesh" $prohull build loose.ply --faces 80 -o looser.ply
says out "of a self-intersecting mesh" "(the mesh: "
expect 0 "of a self-intersecting mesh, as it is" $prohull build loose.ply --faces 80 -o looser.ply --repair none
says out "of a self-intersecting mesh, as it is" "added: 0)"
expect 0 "paper1" $prohull build knot.ply --faces 100 --strategy paper1 --repair none -o hull.off
says out "paper1 is unguarded" "added: "
expect 0 "paper1, guarded" $prohull build knot.ply --faces 100 --strategy paper1 --self-intersections refused -o hull.off
says out "paper1, guarded" "self-intersections: none"
expect 2 "tight is guarded" $prohull build knot.ply -o x.ply --self-intersections allowed --tight
expect 2 "inner is guarded" $prohull build knot.ply -o x.ply --self-intersections allowed --side inner
says err "inner is guarded" "--self-intersections allowed is for outer hulls"
$prohull sample knot -o thread.ply --faces $((1500 / divisor)) >/dev/null
expect 0 "tight within a distance" $prohull build thread.ply --faces 50 --tight --max-distance 0.05 -o x.stl --report x.json
says out "tight within a distance" "self-intersections: none"
checks=$((checks + 1))
awk '/"distance_to_triangles"/ { inside = 1 } inside && /"upper"/ { inside = 0; near = $2 + 0 > 0 && $2 + 0 <= 0.05 } END { exit !near }' x.json || fail "farther than asked for"
rm x.stl
expect 0 "info of triangles" $prohull info knot.ply --report info.json
says out "info of triangles" "sharp          0 of 4,500 edges, below 135 degrees"
says info.json "report: triangles" '"compactness": {'

expect 0 "formats" $prohull build hull.stl --faces 100 -o out.obj
gzip -kf rock.ply
expect 0 "gzip" $prohull build rock.ply.gz --faces 500 -o from_gzip.stl
cmp -s from_gzip.stl hull.stl || fail "the same hull from a gzipped file"

# --- robots ---
for robot in arm gripper mobile-base; do
  expect 0 "sample $robot" $prohull sample $robot -o robots-$robot/
  says out "sample $robot" "robots-$robot/$robot.urdf: $robot with "
  expect 0 "a mesh of $robot" $prohull info "$(find robots-$robot -name '*.stl' | sort | head -n 1)"
done
expect 3 "a folder that is in use" $prohull sample gripper -o robots-arm
says err "a folder that is in use" "robots-arm: cannot write: it is there and is no empty folder elsewhere; name a new folder"
absent "robots-arm/gripper.urdf" "a folder that is in use"
expect 2 "a robot with --faces" $prohull sample arm --faces 100 -o robots-faces
says err "a robot with --faces" "leave --faces out"
expect 2 "a robot to standard output" $prohull sample arm -o -
says err "a robot to standard output" "name the folder, as in -o arm"
expect 3 "a robot in no folder" $prohull sample arm -o nowhere/arm
absent "robots-faces" "a robot that was refused"
absent ".robots-*" "unfinished robots"

# --- GLB and scenes ---
expect 0 "build GLB" $prohull build rock.ply --faces 500 -o hull.glb --hierarchy from_glb.phull
says out "build GLB" "certified: yes, the file as written encloses the original"
expect 0 "verify GLB" $prohull verify hull.glb rock.ply
expect 0 "a level as GLB" $prohull lod from_glb.phull --faces 2000 -o level.glb
expect 0 "verify a level as GLB" $prohull verify level.glb rock.ply
expect 0 "sample as GLB" $prohull sample torus -o torus.glb --faces 500
expect 0 "info of GLB" $prohull info torus.glb
expect 0 "render GLB" $prohull render torus.glb --size 16x16 -o torus.png
expect 0 "query GLB" $prohull query torus.glb --random 10 -o torus.csv
expect 2 "what is read only" $prohull build rock.ply -o out.dae
says err "what is read only" "out.dae: meshes are not written to .dae files; name the file .ply, .obj, .off, .stl or .glb"
head -c 1000 hull.glb >cut.glb
expect 3 "a GLB cut off" $prohull info cut.glb
says err "a GLB cut off" "the file ends within the binary chunk; it is truncated"
# An importer that never ends: Ctrl-C does not wait for it.
printf '#!/bin/sh\n: >sleeping\nexec sleep 100\n' >sleeper
chmod +x sleeper
echo x >part.dae
checks=$((checks + 1))
PROHULL_IMPORTER=./sleeper $prohull info part.dae >out 2>err &
for _ in $(seq 1200); do
  [ -e sleeping ] && break
  sleep 0.05
done
kill -INT $!
wait $!
[ $? -eq 130 ] || fail "Ctrl-C ends an import"
says err "Ctrl-C ends an import" "interrupted"

# --- pictures ---
# is_png FILE NAME WIDTH HEIGHT, in hexadecimal: the signature, and the first chunk with the size
is_png() {
  checks=$((checks + 1))
  [ "$(head -c 24 "$1" | od -A n -t x1 | tr -d ' \n')" = "89504e470d0a1a0a0000000d49484452$3$4" ] || fail "$2: no such PNG"
}
expect 0 "render" $prohull render rock.ply -o rock.png --size 160x120 --report render.json
says out "render tells what it drew" "rock.png: 160 x 120, $((20 / divisor)),"
says render.json "report: size" '"width": 160'
is_png rock.png "render" 000000a0 00000078
for threads in 1 2; do
  expect 0 "hull over mesh" $prohull render hull.stl --over rock.ply --wireframe --ground --threads $threads \
    --size 160x120 -o over$threads.png
done
checks=$((checks + 1))
cmp -s over1.png over2.png || fail "the same picture by any number of threads"
expect 0 "levels side by side" $prohull render rock.phull --faces original,2000 --size 200x100 -o levels.png
says out "levels side by side" " + 2,000 faces"
is_png levels.png "levels side by side" 000000c8 00000064
says_not out "levels side by side" "coarsest"
expect 0 "coarser than all levels" $prohull render rock.phull --faces 4 --size 200x100 -o coarse.png
says out "coarser than all levels" "rock.phull: no level has 4 faces or fewer; the coarsest one, of "
expect 0 "a palette" $prohull render rock.phull --faces original,2000 --size 200x100 --palette -o small.png
is_png small.png "a palette" 000000c8 00000064
checks=$((checks + 1))
[ "$(wc -c <small.png)" -lt "$(wc -c <levels.png)" ] || fail "a palette makes smaller files"
expect 0 "split" $prohull render rock.phull --split original --size 160x120 --background transparent -o split.png
expect 0 "refined along a segment" $prohull render rock.phull --segment 3,0.1,0.2,-3,0.1,0.2 --refine --zoom 2 \
  --center 1,0,0 --size 160x120 -o refined.png --report refined.json
says refined.json "crossings" '"found": ['
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n' >triangle.off
expect 0 "an open mesh" $prohull render triangle.off --size 16x16 -o open.png
$prohull sample gripper -o drawn >/dev/null
expect 0 "a robot beside a mesh" $prohull render drawn/gripper.urdf rock.ply --color orange --size 160x80 -o robot.png \
  --report robot.json
is_png robot.png "a robot beside a mesh" 000000a0 00000050
says robot.json "a robot within its collision geometry" '"faces_inside": '
expect 0 "over a robot" $prohull render rock.ply --over drawn/gripper.urdf --size 160x80 -o robot.png --report robot.json
says robot.json "over a robot" '"faces_inside": '
expect 3 "a robot that is none" sh -c "echo '<a/>' >none.urdf; $prohull render none.urdf -o none.png"
for option in "--over rock.ply" "--split rock.ply" "--refine --segment 3,0,0,-3,0,0"; do
  expect 2 "a robot $option" $prohull render drawn/gripper.urdf $option -o none.png
  says err "a robot $option" "within its own collision geometry"
done
expect 2 "levels of a robot" $prohull render drawn/gripper.urdf --faces 100 -o none.png
says err "levels of a robot" ".phull"
absent "none.png" "no picture of a robot"
expect 0 "from a pipe" sh -c "cat rock.ply | $prohull render /dev/stdin --size 16x16 -o pipe.png"

# --- what cannot be reached ---
$prohull sample box -o box.ply --faces $((2000 / divisor)) >/dev/null
expect 0 "the least face count" $prohull build box.ply --faces 4 --repair none -o least.ply
says out "tells why it stopped" "no legal collapse is left"
expect 1 "--strict" $prohull build box.ply --faces 4 --repair none -o least.ply --strict

# --- queries ---
# Two segments through the unit tetrahedron and one past it; its faces are 0: z = 0, 1: y = 0, 2: oblique, 3: x = 0.
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >unit.off
printf 'x0,y0,z0,x1,y1,z1\n0.25,0.25,-0.5,0.25,0.25,1.5\n5,5,5,6,6,6\n2,0.25,0.25,-2,0.25,0.25\n' >three.csv
same() {
  checks=$((checks + 1))
  cmp -s "$2" "$3" || fail "$1: $2 and $3 differ"
}
expect 0 "query" $prohull query unit.off --segments three.csv -o hits.csv --mode all --report query.json
printf 'segment,t,face,x,y,z,entering\n0,0.25,0,0.25,0.25,0,1\n0,0.5,2,0.25,0.25,0.5,0\n' >expected.csv
printf '2,0.375,2,0.5,0.25,0.25,1\n2,0.5,3,0,0.25,0.25,0\n' >>expected.csv
same "all hits" hits.csv expected.csv
says out "query tells hits" "4 hits; 2 of 3 segments hit"
says query.json "report: hits" '"hits": 4'
says query.json "report: seconds" '"query":'
expect 0 "first hits" $prohull query unit.off --segments three.csv -o hits.csv --mode first
grep -v ',0$' expected.csv >first.csv
same "first hits" hits.csv first.csv
expect 0 "any hits" $prohull query unit.off --segments three.csv -o hits.csv --mode any
says out "any hits" "2 hits; 2 of 3 segments hit"
printf '0.25,0.25,-0.5,0,0,2\n0.25,0.25,-0.5,0,0,-1\n' >rays.csv
expect 0 "rays" $prohull query unit.off --rays rays.csv -o hits.csv
printf 'ray,t,face,x,y,z,entering\n0,0.25,0,0.25,0.25,0,1\n' >expected.csv
same "rays" hits.csv expected.csv
cp expected.csv rays_expected.csv
printf '0.1,0.1,-1,0.2,0.1,1,0.1,0.2,1\n' >triangle.csv
expect 0 "triangles" $prohull query unit.off --triangles triangle.csv -o hits.csv
printf 'triangle,face\n0,0\n0,2\n' >expected.csv
same "triangles" hits.csv expected.csv
says out "triangles" "2 faces met; 1 of 1 triangles meet some"

expect 0 "random segments" $prohull query rock.ply --random 2000 --write-segments random.npy -o random.npz
says out "random segments" "2,000 random segments, seed 1"
expect 0 "segments by npy" $prohull query rock.ply --segments random.npy -o again.npz
same "random segments, written and read" random.npz again.npz
expect 0 "another seed" $prohull query rock.ply --random 2000 --seed 2 --write-segments random.csv
cmp -s random.npy random.csv && fail "another seed gives the same segments"
expect 0 "queries of a .phull" $prohull query rock.phull --random 2000 -o again.npz
same "queries of a .phull are those of its original" random.npz again.npz
for mode in first all; do
  expect 0 "one thread" $prohull query rock.ply --segments random.npy --mode $mode -o random.csv --threads 1
  expect 0 "two threads" $prohull query rock.ply --segments random.npy --mode $mode -o again.csv --threads 2
  same "threads" random.csv again.csv
  for engine in $engines; do
    expect 0 "engine $engine" $prohull query rock.phull --segments random.npy --mode $mode -o again.csv --engine $engine
    same "engine $engine, $mode hits" random.csv again.csv
    says out "engine $engine" "engine $engine, "
  done
done
for engine in walk filter auto; do
  expect 0 "two hulls, $engine" $prohull query rock.phull --inner inner.phull --segments random.npy --mode all -o again.csv --engine $engine
  same "two hulls, $engine" random.csv again.csv
done
for engine in walk paper-refinement; do
  expect 0 "missed hits: $engine" $prohull query rock.phull --segments random.npy --engine $engine --report missed.json
  says out "missed hits: $engine" "hits may be missing: the engine $engine does not find all of them; auto does"
  says missed.json "missed hits: $engine" '"may_miss_hits": true'
done
printf '0,0,0,1,0,0,0,1,0\n' >tool.csv
expect 0 "no face is missed by a tree" $prohull query rock.phull --triangles tool.csv --engine walk
says_not out "no face is missed by a tree" "may be missing"
expect 0 "points of the walk" $prohull contains rock.phull --random 99 --engine walk
for asked in contains "distance --signed"; do
  expect 2 "paper-refinement: $asked" $prohull $asked rock.phull --random 99 --engine paper-refinement
  says err "paper-refinement: $asked" "it cannot tell what is inside; take another one, such as auto"
done
expect 0 "an outer hull, asked alone" $prohull query rock.phull --random 2000 --conservative --report conservative.json
says out "an outer hull, asked alone" "none that hits the mesh is missed"
grep -q '"side": "outer"' conservative.json || fail "the report of --conservative has no side"
expect 0 "an inner hull, asked alone" $prohull query inner.phull --random 2000 --conservative
says out "an inner hull, asked alone" "all that are hits hit the mesh too"
expect 0 "info of a pipe" sh -c "cat rock.phull | $prohull info /dev/stdin"
says out "info of a pipe" "progressive hull"

# --- meshes against meshes ---
printf 'OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n' >octahedron.off
expect 0 "collide: free" $prohull collide octahedron.off octahedron.off --pose 5,0,0,1,0,0,0 --distance --report collide.json
says out "it says so" "free: octahedron.off and octahedron.off, exactly"
says out "the distance" "3 apart, proven between"
says collide.json "report: collide" '"colliding": 0'
expect 1 "collide: touching" $prohull collide octahedron.off octahedron.off --pose '2 0 0 1 0 0 0' -o pairs.csv
says out "the pairs" "meet in 16 pairs of faces"
says pairs.csv "rows of pairs" "pose,face_a,face_b"
printf 'x,y,z,qw,qx,qy,qz\n5,0,0,1,0,0,0\n0,0,1,0,0,0,1\n' >poses.csv
expect 1 "collide: many poses" $prohull collide octahedron.off octahedron.off --poses poses.csv --distance
says out "how many" "1 of 2 poses collide"
says out "the nearest" "nearest of those that are free, pose 0: 3 apart"
expect 0 "collide: conservative" $prohull collide rock.phull rock.phull --pose 1,0,0,100,0,1,0,0,0,0,1,0 --conservative
says out "certain" "free: rock.phull and rock.phull, for certain"
expect 1 "collide: may" $prohull collide rock.phull rock.phull --conservative
says out "not certain" "MAY COLLIDE"
expect 2 "collide: no pose" $prohull collide octahedron.off octahedron.off --pose 1,2,3
says err "what a pose is" "x,y,z,qw,qx,qy,qz"
expect 2 "collide: a mirror" $prohull collide octahedron.off octahedron.off --pose 1,0,0,0,0,1,0,0,0,0,-1,0
says err "rigid" "not rigid"
printf '1,0,0,1,0,0,0\n1,0,0,0,0,0,0\n' >bad.csv
echo x,y,z,qw,qx,qy,qz >names.csv
for file in /dev/null names.csv; do
  expect 3 "collide: no poses in $file" $prohull collide octahedron.off octahedron.off --poses $file
  says err "collide: no poses in $file" "$file: there are no poses"
done
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >leaf.off
expect 0 "collide: a sheet with itself" $prohull collide leaf.off leaf.off --pose 5,0,0,1,0,0,0
is "collide: a sheet with itself, one note" test "$(grep -c 'is not closed' out)" -eq 1
expect 2 "collide: inner hulls, conservatively" $prohull collide inner.phull rock.ply --conservative
says err "collide: inner hulls, conservatively" "inner.phull: it holds inner hulls"
expect 3 "collide: bad poses" $prohull collide octahedron.off octahedron.off --poses bad.csv
says err "the line" "bad.csv: line 2"

bad_query() {
  code=$1 name=$2 text=$3
  shift 3
  expect "$code" "$name" $prohull query "$@" -o bad_hits.csv
  says err "$name" "$text"
  checks=$((checks + 1))
  [ "$(wc -l <err)" -le 2 ] || fail "$name: more than two lines"
  absent "bad_hits*" "$name"
}
bad_query 2 "no hierarchy to go with an inner one" "needs a .phull file" rock.ply --inner inner.phull --random 10
bad_query 2 "two inner hulls" "the first must be an outer one" inner.phull --inner inner.phull --random 10
bad_query 2 "a mesh, conservatively" "needs a .phull file" rock.ply --conservative --random 10
bad_query 2 "one hull, to filter by" "an outer and an inner hull" rock.phull --engine filter --random 10
printf '0,0,0,1,1\n' >narrow.csv
bad_query 3 "wrong shape" "narrow.csv: line 1: there is no comma after y1" unit.off --segments narrow.csv
printf '0,0,0,1,1,1\n0,nan,0,1,1,1\n' >nan.csv
bad_query 3 "NaN" "nan.csv: line 2: y0 is nan" unit.off --segments nan.csv
printf '0,0,0,1,1,1\n1,2,3,1,2,3\n' >point.csv
bad_query 3 "no length" "point.csv: line 2: the segment's ends are equal" unit.off --segments point.csv
head -c 1000 random.npy >truncated.npy
bad_query 3 "truncated .npy" "truncated.npy: byte 128: the file ends after 18 of 2000 rows" unit.off --segments truncated.npy
for kind in segments rays triangles; do
  bad_query 3 "no $kind" "/dev/null: there are no $kind" unit.off --$kind /dev/null
done
bad_query 3 "missing segments" "nowhere.npy: cannot read" unit.off --segments nowhere.npy
bad_query 3 "unknown format of segments" "rock.phull: unknown format" unit.off --segments rock.phull
bad_query 3 "missing mesh" "nowhere.off: cannot read" nowhere.off --segments three.csv
printf 'OFF\n0 0 0\n' >empty.off
bad_query 3 "no faces" "empty.off: it has no faces" empty.off --segments three.csv
bad_query 2 "segments and rays" "--rays" unit.off --segments three.csv --rays rays.csv
bad_query 2 "no queries" "--random" unit.off
bad_query 2 "mode of triangles" "--mode" unit.off --triangles triangle.csv --mode all
bad_query 2 "seed without random" "--random" unit.off --segments three.csv --seed 3
bad_query 2 "unknown engine" "paper-refinement" unit.off --segments three.csv --engine fast
bad_query 2 "refinement of a mesh" "unit.off: this engine" unit.off --segments three.csv --engine refinement
expect 2 "hits over the segments" $prohull query unit.off --segments three.csv -o three.csv
says err "hits over the segments" "named twice"
expect 2 "hits in .txt" $prohull query unit.off --segments three.csv -o hits.txt
says err "hits in .txt" ".npz or .csv"
expect 3 "hits to no folder" $prohull query unit.off --segments three.csv -o nowhere/hits.csv
expect 0 "help of query" $prohull query --help
says out "help of query" "prohull query horse.ply"
says out "help of query has engines" "kdop26-overlap"

# --- points ---
printf 'x,y,z\n0.25,0.25,0.25\n0.25,0.25,-2\n3,0,0\n' >points.csv
printf 'point,inside\n0,1\n1,0\n2,0\n' >expected.csv
expect 0 "contains" $prohull contains unit.off --points points.csv -o inside.csv --report inside.json
same "contains" inside.csv expected.csv
says out "contains" "inside.csv: 1 of 3 points inside (33.33 %)"
says inside.json "report of contains" '"inside": 1'
gzip -kf points.csv
expect 0 "contains, piped" sh -c "$prohull contains unit.off --points - -o - --out-format csv <points.csv.gz >again.csv"
same "contains, piped" again.csv expected.csv
expect 0 "distance" $prohull distance unit.off --points points.csv -o distances.csv --report distances.json
says distances.csv "distance" "point,distance,lower,upper,face,x,y,z"
says distances.csv "distance" "1,2,1.9999"
says distances.csv "distance" ",0,0.25,0.25,0"
says distances.csv "distance" ",0,1,0,0"
says out "distance" "3 points at distances from 0.144338 to 2"
says distances.json "report of distance" '"greatest_distance": 2.0'
expect 0 "signed distance" $prohull distance unit.off --points points.csv -o distances.csv --signed
says distances.csv "signed distance" "0,-0.1443"
for command in contains distance; do
  expect 0 "$command of random points" $prohull $command rock.ply --random 3000 --write-points random.npy -o random.npz
  says out "$command of random points" "3,000 random points, seed 1"
  expect 0 "$command, one thread" $prohull $command rock.ply --points random.npy -o again.npz --threads 1
  same "$command, one thread" random.npz again.npz
  expect 0 "$command of a .phull" $prohull $command rock.phull --random 3000 -o again.npz
  same "$command of a .phull is that of its original" random.npz again.npz
  expect 2 "$command without points" $prohull $command unit.off -o bad_points.csv
  says err "$command without points" "--points"
  expect 3 "$command of no point" $prohull $command unit.off --points nan.csv -o bad_points.csv
  says err "$command of no point" "nan.csv: line 1: "
  expect 3 "$command of an empty file" $prohull $command unit.off --points /dev/null -o bad_points.csv
  says err "$command of an empty file" "/dev/null: there are no points"
  expect 2 "$command by a filter" $prohull $command rock.phull --random 10 --engine filter -o bad_points.csv
  says err "$command by a filter" "--engine must be auto, bvh, brute, refinement, paper-refinement or walk, not 'filter'"
  expect 3 "$command of no faces" $prohull $command empty.off --points points.csv -o bad_points.csv
  says err "$command of no faces" "empty.off: it has no faces"
done
sed '2s/4 4 0/4 3 0/; $d' unit.off >open.off
$prohull contains unit.off --points points.csv -o closed_points.csv >/dev/null
expect 0 "contains of an open mesh" $prohull contains open.off --points points.csv -o open_points.csv
says out "contains of an open mesh" "it is not closed, and the solid is asked that \`prohull repair\` makes of it: closed 1 opening"
is "contains of an open mesh" cmp closed_points.csv open_points.csv
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >leaf.off
expect 3 "contains of a leaf" $prohull contains leaf.off --points points.csv -o bad_points.csv
says err "contains of a leaf" "leaf.off: the mesh is not closed"
expect 3 "signed distance of an open mesh" $prohull distance open.off --points points.csv -o bad_points.csv --signed
expect 0 "distance of an open mesh" $prohull distance open.off --points points.csv
absent "bad_points.csv" "commands that ask points"

# --- wrong usage is 2 ---
expect 2 "no command" $prohull
says err "no command" "Commands:"
expect 2 "unknown command" $prohull biuld rock.ply -o x.ply
says err "unknown command" "unknown command 'biuld'; did you mean 'build'?"
expect 2 "unknown option" $prohull build rock.ply -o x.ply --face 10
says err "unknown option" "unknown option '--face' of build; did you mean '--faces'?"
expect 2 "a letter" $prohull build rock.ply -o x.ply -f 10
says err "a letter" "unknown option '-f' of build; did you mean '--faces'?"
expect 2 "a letter of nothing" $prohull build rock.ply -o x.ply -z
is "a letter of nothing: nothing is suggested" sh -c "! grep -q 'did you mean' err"
expect 2 "an option with =" $prohull build rock.ply -o x.ply --max-viod=10
says err "an option with =" "unknown option '--max-viod' of build; did you mean '--max-void'?"
expect 2 "an option before the command" $prohull --quiet info rock.ply
says err "an option before the command" "unknown option '--quiet'; options go behind the command"
expect 2 "nothing like it" $prohull frobnicate
says err "nothing like it" "unknown command 'frobnicate'"
checks=$((checks + 1))
grep -q "did you mean" err && fail "nothing like it: something is suggested"
expect 2 "one argument too many" $prohull info rock.ply hull.stl
says err "one argument too many" "'hull.stl' is one argument too many for info"
expect 2 "no mesh" $prohull build -o x.ply
says err "no mesh" "IN is missing"
expect 2 "a choice" $prohull build rock.ply -o x.ply --side iner
says err "a choice" "--side must be outer or inner, not 'iner'; did you mean 'inner'?"
expect 2 "a value left out" $prohull build rock.ply -o x.ply --faces
says err "a value left out" "--faces needs a value behind it"
expect 2 "no output" $prohull build rock.ply
expect 2 "too few faces" $prohull build rock.ply --faces 3 -o x.ply
says err "too few faces" "--faces must be at least 4, not 3"
expect 2 "too great a seed" $prohull build rock.ply -o x.ply --seed 1e20
says err "too great a seed" "--seed must be at most"
expect 2 "no number" $prohull build rock.ply --faces many -o x.ply
says err "no number" "--faces must be a whole number, not 'many'"
expect 2 "half a face" $prohull build rock.ply --faces 100.5 -o x.ply
says err "half a face" "--faces must be a whole number, not 100.5"
$prohull sample bracket --faces 500 -o bracket.ply >/dev/null
expect 0 "bounds ask for more faces" $prohull build bracket.ply --faces 50 --max-distance 0.001 -o x.ply --report x.json
says_not out "bounds ask for more faces" "no hull of the mesh itself"
says x.json "bounds ask for more faces" '"within_bounds": true'
says x.json "bounds ask for more faces" '"stopped": "bounds_reached"'
expect 2 "no distance" $prohull build rock.ply --max-distance 0 -o x.ply
says err "no distance" "--max-distance must be greater than 0, not 0"
expect 2 "too many degrees" $prohull build rock.ply --max-normal-deviation 91 -o x.ply
says err "too many degrees" "--max-normal-deviation must be between 0 and 90, not 91"
expect 0 "scientific notation" $prohull build rock.ply --faces 1e3,500 -o x_{faces}.ply --seed 18446744073709551615
says out "scientific notation" "x_1000.ply: outer hull of 1,000 faces"
rm x_*.ply
expect 2 "negative faces" $prohull build rock.ply --faces -5 -o x.ply
expect 2 "hierarchy over the input" $prohull build rock.phull -o x.ply --hierarchy rock.phull
says err "hierarchy over the input" "named twice"
expect 2 "output in .gz" $prohull build rock.ply -o x.ply.gz
expect 2 "a side by number" $prohull build rock.ply -o x.ply --side 1
says err "a side by number" "outer"
expect 2 "a picture of another kind" $prohull render rock.ply -o picture.jpg
says err "a picture of another kind" ".png"
for size in 0x10 10 10x 10x10x10 99999x10 ax10; do
  expect 2 "size $size" $prohull render rock.ply -o wrong.png --size $size
done
expect 2 "no colour" $prohull render rock.ply -o wrong.png --color mauve
says err "no colour" "orange"
expect 2 "no background" $prohull render rock.ply -o wrong.png --background none
expect 2 "no level" $prohull render rock.phull -o wrong.png --faces many
expect 0 "a number of faces with an exponent" $prohull render rock.phull -o level.png --faces 1e9 --size 64x64
expect 2 "levels of a mesh" $prohull render rock.ply -o wrong.png --faces 100
expect 2 "two zooms, three panels" $prohull render rock.ply rock.ply rock.ply -o wrong.png --zoom 1 --zoom 2
says err "two zooms, three panels" "--zoom is given 2 times"
expect 2 "no samples" $prohull render rock.ply -o wrong.png --samples 0
expect 2 "refined along nothing" $prohull render rock.phull -o wrong.png --refine
expect 2 "a mesh refined" $prohull render rock.ply -o wrong.png --refine --segment 3,0,0,-3,0,0
says err "a mesh refined" ".phull"
for segment in 1,2,3 1,2,3,4,5,6,7 1,2,3,4,5,nan 1,2,3,1,2,3 a,b,c,d,e,f; do
  expect 2 "segment $segment" $prohull render rock.ply -o wrong.png --segment $segment
done
expect 2 "more panels than pixels" $prohull render rock.ply rock.ply rock.ply -o wrong.png --size 2x2
expect 2 "picture and report in one" $prohull render rock.ply -o wrong.png --report wrong.png
absent "wrong.png" "wrong usage"
expect 2 "unknown sample" $prohull sample cow -o x.ply
says err "unknown sample" "sphere"
expect 0 "help" $prohull build --help
says out "help has examples" "prohull build"
cp out build_help
expect 0 "help of a command" $prohull help build
same "help of a command" out build_help
says out "help of a command: there is more" "\`prohull help build --all\` shows"
expect 0 "help of the program" $prohull help
says out "help of the program" "Commands:"
expect 2 "help of no command" $prohull help biuld
says err "help of no command" "did you mean 'build'?"
expect 0 "exclusions" env COLUMNS=1000 $prohull help build --all
says out "help --all: groups" "More for research:"
is "exclusions are told once" sh -c "! grep -q 'Not with.*Not with' out"
for command in "" build verify info lod query contains distance collide convex render sample completion manual help; do
  for columns in 40 80 132; do
    expect 0 "help in $columns columns" env COLUMNS=$columns $prohull help $command
    checks=$((checks + 1))  # names of options, lists of choices and examples are as long as they are
    grep -vE '^  +(prohull|curl|-)|[^ ]\|' out | awk -v most=$columns 'length > most { exit 1 }' ||
      fail "help $command: wider than $columns columns"
    checks=$((checks + 1))
    grep -qE '\b(TEXT|UINT|INT|FLOAT|BOOLEAN|ENUM)\b' out && fail "help $command: a type of C++"
  done
  [ -z "$command" ] && continue
  says out "help $command has examples" "Examples:"
  says out "help $command" "--quiet"
  says out "help $command" "--verbose"
done

# --- bad input is 3, one line, with an address ---
# bad NAME FILE SAYS [OPTIONS]
bad() {
  # shellcheck disable=SC2086
  expect 3 "$1" $prohull build "$2" -o bad_out.ply ${4:-}
  says err "$1" "$3"
  checks=$((checks + 1))
  [ "$(wc -l <err)" -eq 1 ] || fail "$1: not one line"
  absent "bad_out.ply*" "$1"
}
head -c 1000 rock.ply >truncated.ply
bad "truncated file" truncated.ply "truncated.ply: byte"
bad "missing file" nowhere.ply "nowhere.ply: cannot read: there is no such file; look at its name and its folder"
expect 3 "folder as file" $prohull info .
says err "folder as file" "cannot read: it is a folder; name a file in it"
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 nan 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >nan.off
bad "NaN" nan.off "not finite" "--repair none"
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 9\n3 1 2 3\n3 2 0 3\n' >index.off
bad "index out of range" index.off "line 8"
printf 'OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n' >open.off
printf 'OFF\n0 0 0\n' >empty.off
bad "empty mesh" empty.off "no faces"
bad "levels" rock.phull "\`prohull lod\` makes a mesh of any of its levels"
expect 3 "empty standard input" sh -c "$prohull build - -o x.ply </dev/null"
says err "empty standard input" "standard input: it is empty"
printf 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n' >flat.off
printf 'OFF\n4 4 0\n0 0 0\n1e200 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >huge.off
bad "open mesh" open.off "has 1 face" "--repair none"
bad "no volume" flat.off "no volume" "--repair none"
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >sheet.off
bad "no inside" sheet.off "no inner hull" "--side inner"
bad "huge coordinates" huge.off "scale the mesh"
bad "unknown format" hull.json "hull.json"
head -c 5000 rock.phull >truncated.phull
expect 3 "truncated .phull" $prohull info truncated.phull
says err "truncated .phull" "truncated"
expect 3 "a picture of nothing" $prohull render empty.off -o bad.png
says err "a picture of nothing" "no faces"
expect 3 "a picture of NaN" $prohull render nan.off -o bad.png
expect 3 "a picture of no file" $prohull render rock.ply --over nowhere.ply -o bad.png
says err "a picture of no file" "nowhere.ply"
absent "bad.png" "bad input"

# --- what is not closed is repaired or wrapped; several budgets; bounds ---
expect 0 "several budgets" $prohull build rock.ply --faces 400,100 -o rock_{faces}.stl --report levels.json
for faces in 400 100; do expect 0 "level of $faces" $prohull verify rock_$faces.stl rock.ply; done
says levels.json "report: several hulls" '"hulls": ['
expect 2 "several hulls, one name" $prohull build rock.ply --faces 400,100 -o rock_x.stl
says err "several hulls, one name" "{faces}"
absent "rock_x.stl" "several hulls, one name"
expect 0 "void" $prohull build rock.ply --faces 4 --max-void 5 -o tight_enough.ply --report void.json
says out "void" "void 4."
expect 2 "negative void" $prohull build rock.ply --max-void -5 -o x.ply
expect 0 "an open mesh" $prohull build open.off --faces 100 -o capped.stl --hierarchy capped.phull --report capped.json
says out "an open mesh" "closed 1 opening, 1.414 across"
says out "an open mesh" "its inside with its openings closed"
says out "an open mesh" "its finest level is the input after repairs, not the input itself"
says capped.json "report: repaired" '"repair": "repaired"'
says capped.json "report: its source" '"source": "mesh"'
expect 0 "its hull, verified" $prohull verify capped.stl open.off
says out "its hull, verified" "not closed"
expect 0 "an open shell" $prohull build open.off --open-shells keep --faces 100 -o shell.stl --report shell.json
says out "an open shell" "covers every triangle"
says shell.json "report: its openings" '"open_shells": "keep"'
expect 0 "an open shell, verified" $prohull verify shell.stl open.off
expect 0 "NaN" $prohull build nan.off --faces 100 -o wrapped.off --report wrapped.json
says out "NaN" "dropped 3 faces with a corner that is not finite"
says out "NaN" "the triangles are flat: the hull is one of a thin solid around them"
says wrapped.json "report: its source" '"source": "convex-hull"'
expect 0 "NaN, verified" $prohull verify wrapped.off nan.off --finite-only
says out "NaN, verified" "3 faces of the original are not finite"
expect 0 "a sheet, by levels" $prohull build sheet.off --faces 200 -o wrapped.ply --hierarchy wrapped.phull
says out "a sheet, by levels" "its finest level is a wrap of the input, not the input itself"
expect 0 "its levels, verified" $prohull verify wrapped.phull sheet.off
expect 0 "its levels, described" $prohull info wrapped.phull --report wrapped.json
says out "its levels, described" " vertices, volume "
says out "its levels, described" ": a wrap of the input, not the input itself"
says_not out "its levels, described" "original"
printf 'OFF\n5 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 9 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >unused.off
expect 0 "a vertex that no face uses" $prohull build unused.off -o used.ply --hierarchy used.phull
expect 0 "a vertex that no face uses" $prohull info used.phull
says out "a vertex that no face uses" "original       4 faces, 4 vertices, volume 0.166666667"
says wrapped.json "report: finest level" '"finest_level": "wrap"'
expect 0 "a wrap of a closed mesh, by levels" $prohull build knot.ply --repair wrap --faces 200 -o wrapped.ply --hierarchy wrapped_knot.phull --report wrapped.json
says out "a wrap of a closed mesh, by levels" "certified: yes"
says wrapped.json "report: a wrap" '"repair": "wrap"'
says wrapped.json "report: its source" '"source": "wrap"'
expect 0 "its levels, verified" $prohull verify wrapped_knot.phull knot.ply
expect 1 "its levels, of another mesh" $prohull verify wrapped_knot.phull rock.ply
expect 0 "its levels, asked" $prohull query wrapped.phull --random 10
says out "its levels, asked" "faces of a wrap of the input"
expect 0 "its levels, extracted" $prohull lod wrapped.phull -o level.ply
says out "its levels, extracted" "the finest level of the file is a wrap of the input"
expect 0 "the input by levels" $prohull info rock.phull --report rock.json
says rock.json "report: the input by levels" '"finest_level": "input"'
$prohull sample pony -o pony.ply --faces 2000 >/dev/null
expect 0 "no overhang" $prohull build pony.ply --faces 4 --max-overhang 0 --keep-guards --repair none -o x.ply --report x.json
says x.json "report: overhang" '"max_overhang": 0.0'
says out "no overhang" "would make a spike"
expect 2 "a negative overhang" $prohull build pony.ply --max-overhang -1 -o x.ply

$prohull sample sphere -o sphere.obj --faces 5000 >/dev/null
awk '/^v / { printf "v %.9e %.9e %.9e\n", $2 * 3.4e38, $3 * 3.4e38, $4 * 3.4e38; next } { print }' sphere.obj >edge.obj
expect 0 "at the edge of float32" $prohull build edge.obj -o edge.stl --faces 100
says out "at the edge of float32" "certified: yes"

# An inside-out mesh is turned, and the turned one is what the hull encloses.
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 3 0\n' >inside_out.off
expect 0 "inside out" $prohull build inside_out.off -o tetrahedron.ply
says out "inside out" "inside out"
expect 0 "inside out, verified" $prohull verify tetrahedron.ply inside_out.off
expect 1 "a hull that is inside out" $prohull verify inside_out.off tetrahedron.ply
says out "a hull that is inside out" "all faces of the hull look inwards"
awk 'NR > 2 && NF == 3 { print $1 "e200", $2, $3; next } { print }' inside_out.off >far.off
expect 3 "coordinates that overflow" $prohull verify tetrahedron.ply far.off
says err "coordinates that overflow" "coordinates of the original reach 1e+200; beyond 1e+100 volumes overflow"

# --- how much is told, and where ---
expect 0 "quiet" $prohull build rock.ply --faces 500 -o quiet.stl --quiet
checks=$((checks + 1))
[ -s out ] || [ -s err ] && fail "quiet: something is printed"
same "quiet" quiet.stl hull.stl
expect 3 "quiet, but wrong" $prohull info nowhere.ply --quiet
says err "quiet, but wrong" "nowhere.ply"
for command in "build rock.ply --faces 500 -o x.stl" "verify hull.stl rock.ply" "info rock.ply" "lod rock.phull -o x.stl" \
  "query rock.ply --random 10" "render rock.ply --size 16x16 -o x.png" "sample torus -o x.stl"; do
  expect 0 "quiet $command" $prohull $command -q
  checks=$((checks + 1))
  [ -s out ] && fail "quiet $command: something is printed"
  expect 0 "$command" $prohull $command
  lines=$(wc -l <out)
  expect 0 "verbose $command" $prohull $command -v
  checks=$((checks + 1))
  [ "$(wc -l <out)" -gt "$lines" ] || fail "verbose $command: nothing more is printed"
done
expect 2 "quiet and verbose" $prohull info rock.ply -q -v
expect 0 "verbose" $prohull build knot.ply --faces 100 -o x.ply --verbose
says out "verbose: refusals in words" "would make a triangle too thin"

# --- standard input and output ---
expect 0 "through pipes" sh -c "$prohull build - --faces 500 -o - --out-format stl <rock.ply >piped.stl"
says err "through pipes: the summary" "standard output: outer hull of 500 faces"
same "through pipes" piped.stl hull.stl
expect 0 "an input without magic bytes" sh -c "$prohull info - --in-format obj <finest.obj"
says out "an input without magic bytes" "standard input"
expect 0 "a mesh by another name" $prohull lod rock.phull -o level.tmp --out-format stl
expect 0 "a chain of pipes" sh -c "$prohull sample torus --faces 500 -o - --out-format off | $prohull query - --random 10 \
  -o - --out-format csv >piped.csv"
says piped.csv "a chain of pipes" "segment,t,face"
expect 0 "rays from a pipe" sh -c "$prohull query unit.off --rays - -o - --out-format csv <rays.csv >piped.csv"
same "rays from a pipe" piped.csv rays_expected.csv
expect 0 "a proof through pipes" sh -c "$prohull build rock.ply --faces 500 -o x.ply --hierarchy - | $prohull verify - rock.ply"
says out "a proof through pipes" "every level of standard input encloses rock.ply"
expect 0 "a picture through pipes" sh -c "$prohull render - --size 160x120 -o - <rock.ply >piped.png"
same "a picture through pipes" piped.png rock.png
expect 0 "a report to standard output" sh -c "$prohull info rock.ply --report - >piped.json"
says piped.json "a report to standard output" '"version":'
says err "a report to standard output: the summary" "closed 2-manifold"
expect 2 "an output without a format" $prohull build rock.ply -o -
says err "an output without a format" "add --out-format ply, obj, off, stl or glb"
expect 2 "name and format disagree" $prohull build rock.ply -o x.stl --out-format ply
expect 2 "two files in one output" $prohull build rock.ply -o - --out-format ply --report -
expect 2 "two files from one input" $prohull verify - -
for outputs in "build rock.ply -o x.txt" "build rock.ply -o x.ply --hierarchy x.ply2" "lod rock.phull -o x.txt" \
  "sample torus -o x" "render rock.ply -o x.jpg" "query rock.ply --random 10 -o x.npy" \
  "query rock.ply --random 10 --write-segments x.npz"; do
  expect 2 "unsuitable: $outputs" $prohull $outputs
  says err "unsuitable: $outputs" "; name the file ."
done

# --- units ---
awk '/^v / { printf "v %.9g %.9g %.9g\n", $2 * 1000, $3 * 1000, $4 * 1000; next } { print }' finest.obj >mm.obj
expect 0 "millimetres" $prohull build mm.obj --unit mm --faces 500 -o metres.ply --hierarchy metres.phull --report metres.json
says metres.json "report: scale" '"scale": 0.001'
expect 0 "millimetres, verified" $prohull verify metres.ply mm.obj --unit mm
expect 0 "millimetres, proven" $prohull verify metres.phull mm.obj --unit mm
expect 0 "millimetres, scaled" $prohull verify metres.ply mm.obj --scale 0.001
expect 1 "millimetres and metres" $prohull verify metres.ply mm.obj
says out "millimetres and metres" "the hull is about 1,000 times smaller than the original"
expect 1 "metres and millimetres" $prohull verify mm.obj metres.ply
says out "metres and millimetres" "UNITS: mm.obj encloses metres.ply, exactly, but the hull is about 1,000 times as large"
says out "metres and millimetres" "the hull is about 1,000 times larger than the original"
expect 0 "inches" $prohull info unit.off --unit in
says out "inches" "(0.0254, 0.0254, 0.0254)"
expect 0 "a query in metres" $prohull query unit.off --scale 2 --rays rays.csv
says out "a query in metres" "1 hit;"
expect 2 "a scale of nothing" $prohull info unit.off --scale 0
expect 2 "scale and unit" $prohull info unit.off --scale 2 --unit mm
expect 2 "a .phull has its unit" $prohull info rock.phull --unit mm

# --- info and build agree ---
cat >agree_unit.off <unit.off
for mesh in rock.ply open.off sheet.off nan.off inside_out.off flat.off empty.off huge.off; do
  expect 0 "info of $mesh" $prohull info $mesh
  possible=$(grep -c 'hull possible  yes' out)
  $prohull build $mesh --faces 100 -o agreed.ply >out 2>err
  got=$?
  checks=$((checks + 1))
  [ $got -eq $((possible ? 0 : 3)) ] || fail "info and build of $mesh: possible is $possible, build exits with $got"
done
expect 0 "info of a mesh to be wrapped" $prohull info sheet.off
says out "info of a mesh to be wrapped" "of a wrap or of the convex hull"

# --- openings ---
expect 0 "info of an open mesh" $prohull info open.off --report open.json
says out "info of an open mesh" "openings       1: "
says open.json "report: openings" '"diameter": 1.414213'
expect 0 "info of a closed mesh" $prohull info rock.ply --report closed.json
says closed.json "report: no openings" '"largest": []'

# --- what was mixed up ---
expect 3 "a mesh is no .phull" $prohull lod rock.ply -o x.ply
says err "a mesh is no .phull" "this is not a .phull file"
printf '0.25;0.25;-0.5;0;0;2\n' >semicolons.csv
expect 0 "semicolons" $prohull query unit.off --rays semicolons.csv
says out "semicolons" "1 hit; 1 of 1 rays hit"

# --- nothing half-written ---
expect 3 "no such folder" $prohull build rock.ply --faces 500 -o nowhere/hull.ply
says err "no such folder" "nowhere/hull.ply"
if [ -d /proc/self ]; then
  expect 3 "a folder that takes no files" $prohull build rock.ply --faces 500 -o /proc/x.stl
  says err "a folder that takes no files" "choose another"
fi
if [ "$(id -u)" -ne 0 ]; then
  mkdir read_only && chmod a-w read_only
  expect 3 "read-only folder" $prohull build rock.ply --faces 500 -o read_only/hull.ply
  says err "read-only folder" "read_only/hull.ply"
fi
$prohull sample asteroid -o big.ply --faces $((400000 / divisor)) >/dev/null
most_ms=2000  # a second, and as much where tests run beside each other
# interrupted NAME SECONDS COMMAND...: Ctrl-C so long after it listens ends it soon, with 130, and leaves nothing named
# interrupted
interrupted() {
  name=$1 seconds=$2
  shift 2
  "$@" >out 2>err &
  # A background job of a shell ignores Ctrl-C, signal 2, unless the program asks for it, as prohull does.
  for _ in $(seq 200); do
    grep -q '^SigCgt:.*[2367abef]$' /proc/$!/status && break
    sleep 0.05
  done
  sleep "$seconds"
  since=$(date +%s%N)
  kill -INT $! 2>/dev/null
  wait $!
  code=$?
  took=$((($(date +%s%N) - since) / 1000000))
  checks=$((checks + 2))
  [ $took -lt $most_ms ] || fail "$name: answers after $took ms"
  [ $code -eq 130 ] || fail "$name: exit code $code, expected 130"
  says err "$name" "interrupted"
  absent "interrupted* .interrupted*" "$name"
}
interrupted "Ctrl-C" 0.3 $prohull build big.ply --faces 500 -o interrupted.ply --hierarchy interrupted.phull
interrupted "Ctrl-C of a query" 0.5 $prohull query big.ply --random 100000 --engine brute -o interrupted.csv
interrupted "Ctrl-C of a picture" 0.5 $prohull render big.ply --size 4000x3000 --samples 256 -o interrupted.png
interrupted "Ctrl-C of a tight hull" 0.5 $prohull build big.ply --faces 500 --tight -o interrupted.stl --report interrupted.json
interrupted "Ctrl-C of many queries" 0.5 $prohull query big.ply --random 5e7 --mode all -o interrupted.npz
interrupted "Ctrl-C of a verification" 0.5 $prohull verify rock.ply big.ply --report interrupted.json
interrupted "Ctrl-C of a sample" 0.5 $prohull sample knot --faces 3e7 -o interrupted.stl
interrupted "Ctrl-C of a wrap" 0.5 $prohull build big.ply --repair wrap --faces 5000 -o interrupted.stl
mkfifo pipe
sleep 60 >pipe &  # who writes into it and never ends
writer=$!
for command in "info pipe" "build pipe -o interrupted.stl" "lod pipe -o interrupted.stl" "verify pipe rock.ply" \
  "render pipe -o interrupted.png" "query rock.ply --rays pipe -o interrupted.csv"; do
  # shellcheck disable=SC2086
  interrupted "Ctrl-C of $command" 0.2 $prohull $command
done
kill $writer

count_checks
