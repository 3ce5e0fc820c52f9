# Lengths, scales and places of meshes, in options of several commands
make_rock
make_inner
make_unit
make_rays

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

# --- the same mesh in metres and in millimetres ---
awk '/^v / { printf "v %.17g %.17g %.17g\n", $2 / 1000, $3 / 1000, $4 / 1000; next } { print }' inner.obj >metres.obj
expect 1 "another unit" $prohull verify metres.obj rock.ply
says out "another unit" " times smaller than the original: perhaps one of them is in metres"

expect 1 "a thousand times as large" $prohull verify hull.stl metres.obj --report verify.json
says out "a thousand times as large" "UNITS: hull.stl encloses metres.obj, exactly, but the hull is 1"
says verify.json "a thousand times as large: enclosed" '"certified": true'
says verify.json "a thousand times as large" '"units_doubtful": true'
expect 0 "a thousand times as large is meant" $prohull verify hull.stl metres.obj --any-scale
expect 0 "the same unit again" $prohull verify hull.stl metres.obj --scale 1000 --report verify.json
says verify.json "the same unit again" '"units_doubtful": false'
expect 1 "an inner hull of another unit" $prohull verify metres.obj rock.ply --side inner
says out "an inner hull of another unit" " times as large as the hull: are their units different?"
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
printf 'v 0 0 0\nv 1.0000000000000002 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >near.obj
sed 's/1.0000000000000002/1/' near.obj | awk '/^v / { print "v", $2 - 1000, $3 - 1000, $4 - 1000; next } { print }' >beside.obj
expect 2 "an offset that rounds" $prohull verify beside.obj near.obj --offset 1000,1000,1000
says err "an offset that rounds" "1.0000000000000002 - 1000 is rounded"
expect 2 "an offset of two numbers" $prohull verify utm.stl utm.obj --offset 1,2
says err "an offset of two numbers" "'1,2' is no offset; it has 2 numbers, not 3"
expect 0 "nothing to recenter" $prohull build inner.obj --faces 100 --recenter -o utm.stl
says out "nothing to recenter" "not recentered"

$prohull lod rock.phull --faces 20000000 -o finest.obj >/dev/null
# --- units ---
awk '/^v / { printf "v %.9g %.9g %.9g\n", $2 * 1000, $3 * 1000, $4 * 1000; next } { print }' finest.obj >mm.obj
expect 0 "millimetres" $prohull build mm.obj --unit mm --faces 500 -o metres.ply --hierarchy metres.phull --report metres.json
says metres.json "report: scale" '"scale": 0.001'
expect 0 "millimetres, verified" $prohull verify metres.ply mm.obj --unit mm
expect 0 "millimetres, proven" $prohull verify metres.phull mm.obj --unit mm
expect 0 "millimetres, scaled" $prohull verify metres.ply mm.obj --scale 0.001
expect 1 "millimetres and metres" $prohull verify metres.ply mm.obj
says out "millimetres and metres" " times smaller than the original: perhaps"
expect 1 "metres and millimetres" $prohull verify mm.obj metres.ply
says out "metres and millimetres" "UNITS: mm.obj encloses metres.ply, exactly, but the hull is 9"
says out "metres and millimetres" " times larger than the original: perhaps"
expect 0 "inches" $prohull info unit.off --unit in
says out "inches" "(0.0254, 0.0254, 0.0254)"
expect 0 "a query in metres" $prohull query unit.off --scale 2 --rays rays.csv
says out "a query in metres" "1 hit;"
expect 2 "a scale of nothing" $prohull info unit.off --scale 0
expect 2 "scale and unit" $prohull info unit.off --scale 2 --unit mm
expect 2 "a .phull has its unit" $prohull info rock.phull --unit mm
