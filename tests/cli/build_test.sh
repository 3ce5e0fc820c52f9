# Drives `prohull build`, and what verifies and extracts its hulls, as a user would

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

# --- the strategies of the paper ---
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
expect 0 "gzip" $prohull build rock.ply.gz --faces 500 -o from_gzip.stl --hierarchy from_gzip.phull
cmp -s from_gzip.stl hull.stl || fail "the same hull from a gzipped file"

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

# --- what cannot be reached ---
$prohull sample box -o box.ply --faces $((2000 / divisor)) >/dev/null
expect 0 "the least face count" $prohull build box.ply --faces 4 --repair none -o least.ply
says out "tells why it stopped" "no legal collapse is left"
expect 1 "--strict" $prohull build box.ply --faces 4 --repair none -o least.ply --strict
