# Small meshes of which summaries said what was not true. Each check names the sentence.

corners='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n'
bottom='f 1 3 2\nf 2 3 4\n'
walls='f 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n'
top='f 5 6 7\nf 6 8 7\n'
printf "$corners$bottom$top$walls" >cube.obj
printf "$corners${bottom}f 1 3 2\n$top$walls" >twice.obj
printf "$corners$walls" >tube.obj
printf "${corners}v nan 0 0\n$bottom$top${walls}f 1 2 9\n" >nan.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n' >sheet.obj
{
  grep '^v' cube.obj
  awk '/^v / { print "v", 0.2 + 0.6 * $2, 0.2 + 0.6 * $3, 0.2 + 0.6 * $4 }' cube.obj
  grep '^f' cube.obj
  awk '/^f / { print "f", $2 + 8, $3 + 8, $4 + 8 }' cube.obj
} >nested.obj
$prohull sample asteroid -o rock.ply --faces 500 >out
$prohull sample asteroid -o stone.obj --faces 500 >out

# --- what does not exist ---
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >triangle.obj
expect 0 "no edge between faces" $prohull info triangle.obj --report info.json
says_not out "no edge between faces" "dihedral"
says_not out "no edge between faces" "of 0 edges"
says info.json "no edge between faces" '"dihedral_degrees": null'
for command in "build cube.obj" "sample box" "sample arm" "view cube.obj"; do
  expect 2 "no name: $command" $prohull $command -o ''
  says err "no name: $command" "the name of the output is empty; name a file"
done
expect 2 "no name of a report" $prohull info cube.obj --report ''
for command in "build cube.obj -o h.obj" "convex cube.obj -o h.obj" "spheres cube.obj -o h.yaml" "cage cube.obj -o h.obj" "motion arm.urdf path.csv"; do
  expect 2 "no name of a certificate: $command" $prohull $command --certificate ''
  says err "no name of a certificate: $command" "the name of the output is empty; name a file"
done
for output in "build cube.obj -o h.obj --hierarchy" "cage cube.obj -o h.obj --inner" "motion arm.urdf path.csv --curve" \
  "motion arm.urdf path.csv --page" "urdf arm.urdf --check --html" "urdf arm.urdf --check --junit" "urdf arm.urdf --write-budgets" \
  "query cube.obj -o hits.csv --random 9 --write-segments" "contains cube.obj -o in.csv --random 9 --write-points"; do
  expect 2 "no name: $output" $prohull $output ''
  says err "no name: $output" "the name of the output is empty; name a file"
done
expect 2 "a robot is no file" $prohull sample arm -o arm.urdf
says err "a robot is no file" "name the folder, as in -o arm"
absent arm.urdf "a robot is no file"
cp cube.obj ./-cube.obj
expect 0 "behind -- are files" $prohull build -o hull.obj -- -cube.obj
expect 2 "behind -- are no options" $prohull info -- -cube.obj -v
says err "behind -- are no options" "'-v' is one argument too many for info; options go before --"
expect 2 "-- is no option" $prohull query -o - -- -cube.obj
says_not err "-- is no option" "'--'"

# --- what a hull is built from ---
expect 0 "no collapse" $prohull build cube.obj --faces 12 -o hull.obj
says out "the mesh itself" "the mesh has no more faces than were asked for: the hull is the mesh itself"
expect 0 "a polytope" $prohull build cube.obj --faces 8 -o hull.obj
says_not out "a polytope is not the convex hull, which has 12 faces" ", of the convex hull,"
says out "a polytope" "outer hull of 8 faces, of a convex solid, "
printf "$corners$bottom$walls" >bucket.obj
expect 0 "a target that is not reached" $prohull build bucket.obj --faces 8 -o hull.obj --hierarchy hull.phull
says_not out "nothing collapsed" "shape guards relaxed"
expect 0 "a name of a level" $prohull lod hull.phull -o 'level_{faces}.obj'
is "a name of a level" test -s level_12.obj
expect 0 "guards that were relaxed" $prohull build rock.ply --faces 10 -o relaxed.obj --hierarchy relaxed.phull
says out "guards that were relaxed" "shape guards relaxed to reach it: normals may turn by"
gzip -k hull.phull
expect 3 "a gzipped hierarchy" $prohull lod hull.phull.gz -o level.obj
says err "a gzipped hierarchy" "it is gzipped"
for changed in twice tube nested; do
  expect 0 "repaired: $changed" $prohull build $changed.obj --faces 12 -o hull.obj
  says out "repaired: $changed" "the repaired mesh has no more faces than were asked for: the hull is the repaired mesh itself"
done
expect 0 "nothing was turned" $prohull build twice.obj --faces 12 -o hull.obj
says out "nothing was turned" "and its inside after repairs"
expect 0 "no openings" $prohull convex twice.obj --pieces 1 -o piece.obj
says out "no openings" "and its inside after repairs"
expect 0 "a closed sheet" $prohull build sheet.obj --faces 8 -o hull.obj
says out "a closed sheet" "bounds no solid: the mesh encloses no volume"
says out "a hull of a slab is thinner at its rim" "the hull is one of a thin solid around them"
says out "one pair" "(the mesh: 1 pair of faces)"

expect 3 "no inner hull of a closed sheet" $prohull build sheet.obj --side inner -o hull.obj
says err "no inner hull of a closed sheet" "sheet.obj: the mesh encloses no volume; there is no inner hull of what bounds no solid"

# --- open meshes: what closes them is no part of the file ---
printf "$corners$bottom$walls" >bucket.obj
for mesh in bucket nan; do
  echo "<robot name='r'><link name='a'><visual><geometry><mesh filename='$mesh.obj'/></geometry></visual></link></robot>" >$mesh.urdf
done
expect 0 "a bucket" $prohull urdf bucket.urdf -o bucket --max-distance 1cm --no-pictures
says out "a bucket" "a: its openings count as closed, and from its triangles alone it reaches at most 501 mm"
says bucket/report.json "a bucket" '"distance_to_triangles": {'
expect 0 "a corner that is not finite" $prohull urdf nan.urdf -o nan --no-pictures
says out "a corner that is not finite" "a: 1 triangle that is not finite was left out"
says nan/report.json "a corner that is not finite" "no point of a finite triangle of its visual meshes lies outside of its hull"
expect 0 "a sweep of a corner that is not finite" $prohull sweep nan.obj --move 1,0,0 -o nan_swept.obj
says out "a sweep of a corner that is not finite" "not finite were left out: 1"
for side in outer inner; do
  expect 0 "openings of a bucket: $side" $prohull build bucket.obj --faces 12 --side $side -o $side.obj
  expect 0 "openings are closed as by build: $side" $prohull verify $side.obj bucket.obj --side $side --open-shells close --report closed.json
  says closed.json "openings are closed as by build: $side" '"cap_faces": 2'
done
says out "an inner hull of a bucket" "yes: inner.obj is enclosed by bucket.obj with its openings closed by 2 faces, exactly"
expect 0 "the triangles of a bucket" $prohull verify outer.obj bucket.obj
says out "the triangles of a bucket" "yes: outer.obj covers every triangle of bucket.obj, exactly"
expect 0 "a shell" $prohull build bucket.obj --faces 500 --open-shells keep -o shell.obj
expect 0 "a shell covers the triangles" $prohull verify shell.obj bucket.obj
expect 1 "a shell has the inside outside" $prohull verify shell.obj bucket.obj --open-shells close
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >leaf.obj
expect 3 "an inner hull of an open mesh" $prohull verify inner.obj bucket.obj --side inner
says err "an inner hull of an open mesh" '`prohull repair` closes it'
expect 3 "nothing closes a leaf" $prohull verify cube.obj leaf.obj --side inner --open-shells close

# --- numbers that nobody can read ---
awk '/^v / { $4 = $4 * 1e-18 } { print }' cube.obj >thin.obj
expect 0 "spheres around a thin cube" $prohull spheres thin.obj --count 8 -o thin.yaml
says out "spheres around a thin cube" ", more than 1000000 % more than the solid's"
expect 0 "a box around a thin cube" $prohull convex thin.obj --shape box -o thin.urdf
says out "a box around a thin cube" ", more than 1000000 % more volume than the mesh"

# --- control characters ---
printf 'v 0 0 \033[31m\n' >red.obj
expect 3 "a control character in a file" $prohull info red.obj
says err "a control character in a file" "red.obj: line 1: '\x1b[31m' is not a number"

# --- repairs ---
expect 0 "a corner that is not finite" $prohull build nan.obj --faces 12 -o hull.obj
says out "a corner that is not finite" "the finite triangles of the original"
for command in build cage repair convex; do
  expect 0 "triangles that are left out: $command" $prohull $command nan.obj -o hull.obj --report nan.json
  says out "triangles that are left out: $command" "the finite triangles of the original"
  says nan.json "triangles that are left out: $command" '"non_finite_faces": 1'
done
expect 0 "parts that overlap count once" $prohull repair nested.obj -o solid.obj --report solid.json
says solid.json "parts that overlap count once" '"volume": 1.0'
expect 0 "one defect" $prohull info nan.obj
says out "one defect" "1 vertex that is not finite"

# --- docs/formats.md: which commands scale meshes ---
for command in build cage collide contains convex distance info motion query repair spheres sweep verify view; do
  expect 0 "help $command" $prohull help $command --all
  says out "$command scales meshes" "  --unit "
  says out "$command scales meshes" "  --scale "
done
for command in render urdf lod sample; do
  expect 0 "help $command" $prohull help $command --all
  says_not out "$command scales no meshes" "  --unit "
done

# --- outputs ---
expect 3 "a file where a folder should be" $prohull build cube.obj nested.obj -o tube.obj/
says err "a file where a folder should be" "a file has that name; name another folder"

# --- self-intersections ---
expect 0 "what --tight guarantees" env COLUMNS=1000 $prohull help build
says out "what --tight guarantees" "It does not intersect itself unless the mesh does"
says_not out "what --tight guarantees" "never intersects itself"

# A closed mesh that covers some of its own faces no more, so that its hull is one of a wrap.
$prohull sample knot -o knot.obj --faces 1500 --quiet
awk '/^v / { for (i = 2; i <= 4; ++i) { s = (s * 16807) % 2147483647; $i += (s / 2147483647 - 0.5) * 0.4 } } { print }' s=7 knot.obj >rough.obj
expect 0 "a hull of a wrap" $prohull build rough.obj --faces 300 -o rough.ply --hierarchy rough.phull --report rough.json
expect 0 "a wrap may be needed" $prohull info rough.obj
says out "a wrap may be needed" "pairs of its faces intersect"

# --- levels ---
$prohull sample sphere -o sphere.obj --faces 600 --quiet
awk '/^v / { ++n; if (n == 1 || $4 > top) { top = $4; highest = n } } { line[NR] = $0 } END { n = 0
  for (i = 1; i <= NR; ++i) print line[i] ~ /^v / && ++n == highest ? "v 0.03 0.05 -1.001" : line[i] }' sphere.obj >folded.obj
for mesh in sphere folded; do
  expect 0 "levels: $mesh" $prohull build $mesh.obj --faces 12 --hierarchy $mesh.phull -o hull.ply
done
expect 0 "a level that encloses" $prohull lod sphere.phull --faces 300 -o level.stl --report level.json
says out "a level that encloses" "certified: yes, the file as written encloses the finest level"
says level.json "a level that encloses" '"certified": true'
expect 0 "a level that leaves folds" $prohull lod folded.phull --faces 300 -o level.ply --report level.json
says out "a level that leaves folds" "not covered, at least in part: triangles of folds"
says level.json "a level that leaves folds" '"certified": false'
expect 1 "a level that leaves folds: verify" $prohull verify level.ply folded.obj
uncovered=$(sed -n 's/^  \([0-9]*\) faces* of folded.obj lies* outside.*/\1/p' out)
expect 0 "how many faces it leaves" $prohull lod folded.phull --faces 300 -o level.ply
says out "how many faces it leaves" "certified: no, the file as written does not enclose the finest level, of which $uncovered face"
expect 0 "the base mesh covers them" $prohull lod folded.phull -o level.ply
says out "the base mesh covers them" "certified: yes, the file as written encloses the finest level"
expect 0 "the finest level" $prohull lod folded.phull --faces 600 -o level.ply --report level.json
says level.json "the finest level" '"certified": true'
says out "the finest level" "certified: yes, the file as written is the finest level"
expect 0 "an inner hull" $prohull build sphere.obj --side inner --faces 100 --hierarchy inner.phull -o hull.ply
expect 0 "an inner level" $prohull lod inner.phull --faces 300 -o level.ply
says out "an inner level" "certified: yes, the file as written is enclosed by the finest level"

{
  grep '^v' stone.obj
  awk '/^v / { print "v", $2 + 0.5, $3, $4 }' stone.obj
  grep '^f' stone.obj
  awk -v n="$(grep -c '^v' stone.obj)" '/^f / { print "f", $2 + n, $3 + n, $4 + n }' stone.obj
} >overlapping.obj
expect 0 "volumes of levels" $prohull build overlapping.obj --faces 200 -o hull.ply --hierarchy overlapping.phull --report hull.json
void=$(sed -n 's/.*, void \([0-9.]* %\).*/\1/p' out)
expect 0 "volumes of levels" $prohull info overlapping.phull --report info.json
says out "overlaps of levels count once" "void $void"
says info.json "levels have a box" '"diagonal": '
says info.json "levels have vertices" '"vertices": '
expect 0 "volumes of a wrap" $prohull info rough.phull
says out "volumes of a wrap" "% of the finest level"
expect 0 "a level" $prohull lod sphere.phull --faces 1 -o level.ply --report level.json
says level.json "which level it is" '"coarsest": true'
says level.json "of how many faces" '"finest_faces": '
awk '/^v / { $2 += 5400000 } { print }' stone.obj >far.obj
expect 0 "recentered levels" $prohull build far.obj --faces 100 --recenter -o near.obj --hierarchy near.phull
for hull in near.obj near.phull; do
  expect 1 "recentered: $hull" $prohull verify $hull far.obj
  says out "recentered: $hull" "if it was built with --recenter, give the --offset that the build told"
done

# --- inside out ---
awk '/^f / { print "f", $2, $4, $3; next } { print }' cube.obj >inverted.obj
printf 'v 0.4 0.4 0.4\nv 0.6 0.4 0.4\nv 0.4 0.6 0.4\nv 0.4 0.4 0.6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >inside.obj
turned="is inside out: it was turned, so that its inside counts as solid"
expect 1 "inside out: collide" $prohull collide inverted.obj inside.obj --report collide.json
says out "inside out: collide" "inverted.obj $turned"
says collide.json "inside out: collide" '"solid": true'
says collide.json "inside out: the note" "\"inverted.obj $turned\""
expect 0 "inside out: contains" $prohull contains inverted.obj --random 9 --report contains.json
says out "inside out: contains" "9 of 9 points inside"
expect 0 "inside out: distance" $prohull distance inverted.obj --random 9 --signed --report distance.json
says out "inside out: distance" "distances from -"
for command in contains distance; do
  says out "inside out: $command" "inverted.obj $turned"
  says $command.json "inside out: $command" '"inside_out": true'
  says $command.json "inside out: $command, the note" "\"inverted.obj $turned\""
done
expect 1 "inside out, conservatively" $prohull collide inverted.obj inside.obj --conservative
expect 0 "distances from faces have no inside" $prohull distance inverted.obj --random 9
says_not out "distances from faces have no inside" "inside out"
# Beside an outward cube: together they have no volume, or less than none.
for size in 1 1.2; do
  {
    grep '^v' cube.obj
    awk -v size=$size '/^v / { print "v", 2 + size * $2, $3, $4 }' cube.obj
    grep '^f' cube.obj
    awk '/^f / { print "f", $2 + 8, $4 + 8, $3 + 8 }' cube.obj
  } >parts.obj
  expect 1 "one part inside out" $prohull collide parts.obj inside.obj --pose 2,0,0,1,0,0,0
  says out "one part inside out" "the component of face 12 of parts.obj $turned"
done

# --- faces alone ---
grep -v '^f 1 ' cube.obj >lidless.obj
for pair in "lidless.obj inside.obj" "inside.obj lidless.obj"; do
  expect 0 "faces alone" $prohull collide $pair --report open.json -q
  says err "faces alone, with -q" "prohull: lidless.obj is not closed: only its faces count, not what lies inside"
  says open.json "faces alone, in the report" "\"lidless.obj is not closed: only its faces count"
  expect 0 "faces alone" $prohull collide $pair
  says out "faces alone" "lidless.obj is not closed: only its faces count, not what lies inside"
  is "faces alone, once" test ! -s err
done
expect 1 "no part inside out" $prohull collide nested.obj inside.obj
says_not out "no part inside out" "inside out"

# --- a part that crosses another one inside out ---
for height in 0.04 0.06; do
  {
    awk '/^v / { print "v", 0.05 * $2, $3, $4 }' cube.obj
    awk -v height=$height '/^v / { print "v", 0.02 + $2, $3, 0.5 + height * $4 }' cube.obj
    grep '^f' cube.obj
    awk '/^f / { print "f", $2 + 8, $4 + 8, $3 + 8 }' cube.obj
  } >crossed.obj
  expect 0 "a solid that is crossed" $prohull build crossed.obj --faces 100 -o hull.ply
  says out "a solid that is crossed" ", void "
  says_not out "a solid that is crossed" "no space"
  expect 0 "pieces of a solid that is crossed" $prohull convex crossed.obj --pieces 2 -o pieces.obj
  said=$(sed -n 's/^.* \([0-9.]*\) % more volume than the mesh.*$/\1/p' out)
  says_not out "pieces of a solid that is crossed" "estimated"
  expect 0 "pieces of a solid that is crossed" $prohull verify pieces.obj crossed.obj --union
  is "one void of pieces and verify" awk -v said="$said" '/void/ { d = $(NF - 1) - said; near = d * d < 0.0002 } END { exit !near }' out
done
for i in $(seq 0 59); do
  awk -v i=$i '/^v / { a = 0.052 * i; x = 3 * ($2 - 0.5); y = 0.2 * ($3 - 0.5)
    print "v", x * cos(a) - y * sin(a), x * sin(a) + y * cos(a), $4 }
    /^f / { print "f", $2 + 8 * i, $3 + 8 * i, $4 + 8 * i }' cube.obj
done >fan.obj
expect 0 "a volume that takes too long" $prohull repair fan.obj -o solid.obj
is "a volume that takes too long" awk '/estimated/ { near = 6.5 < $8 && $8 < 7.7 } END { exit !near }' out
expect 0 "as a whole inside out" $prohull verify hull.ply crossed.obj
says out "as a whole inside out" "24 faces of the original count as turned, as its volume is negative: 12 of these look inwards"
says_not out "as a whole inside out" "24 faces of the original look inwards"

# --- vertices that no face uses ---
expect 0 "a cube without what is not finite" $prohull repair nan.obj -o finite.obj
is "a solid has no vertices that no face uses" test "$(grep -c '^v' finite.obj)" -eq 8
expect 0 "a hull of it" $prohull build nan.obj --faces 12 -o finite.obj
is "a hull has no vertices that no face uses" test "$(grep -c '^v' finite.obj)" -eq 8

# --- distances far below the size of the mesh ---
awk '/^v / { print "v", 1e300 * $2, 1e300 * $3, 1e300 * $4; next } { print }' cube.obj >huge.obj
printf -- '-2.5,0.5,0.5\n' >near.csv
expect 0 "bounds that tell nothing" $prohull distance huge.obj --points near.csv
says out "bounds that tell nothing" "from 0 (between 0 and "
expect 0 "bounds as good as the digits" $prohull distance cube.obj --points near.csv
says out "bounds as good as the digits" "1 point at distances from 2.5 to 2.5"

expect 2 "an unknown command" $prohull frobnicate
says err "an unknown command" "\`prohull help\` shows all commands."
for asked in "contains cube.obj --random 1e9" "sample sphere --faces 1e9 -o x.ply"; do
  [ "$(awk '/MemAvailable/ { print $2 > 40e6 }' /proc/meminfo)" = 1 ] && break # this computer has room for it
  expect 2 "memory: $asked" $prohull $asked
  says err "memory: $asked" "1,000,000,000 "
  says err "memory: $asked" "GB are available; ask for fewer"
done
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >nan.obj
expect 3 "not finite" $prohull contains nan.obj --random 9
says err "not finite" "coordinates must be finite; \`prohull repair\` drops such triangles"

# --- distances below rounding ---
printf 'v 1.0000000000000002 0 0\nv 3 0 0\nv 2 1 0\nv 2 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >beside.obj
expect 0 "closer than rounding tells" $prohull collide cube.obj beside.obj --distance
says out "closer than rounding tells" "  at most "
says_not out "closer than rounding tells" "between 0 and"

# --- boxes ---
awk '/^v / { print "v", $2 + 1000000, $3 + 0.5, $4 * 1e300; next } { print }' cube.obj >box.obj
expect 0 "a box far from the origin" $prohull info box.obj --report info.json
says out "a box far from the origin" "(1000000, 0.5, 0) to (1000001, 1.5, 1e+300), diagonal 1e+300"
says info.json "a box far from the origin" '"diagonal": 1e+300'

# --- nothing is left ---
printf 'v 0 0 0\nv 1 0 0\nf 1 2 2\n' >needle.obj
expect 0 "no face with three corners" $prohull repair needle.obj -o solid.obj
says out "no face with three corners" "bounds no solid: no face has three different corners"

# --- several meshes ---
mkdir hulls
expect 0 "more faces than asked for" $prohull build cube.obj rock.ply --repair none --faces 6 -o hulls/{name}.obj
says out "more faces than asked for" "1 of 2 meshes: as asked"

# --- what is proven is not rounded away ---
expect 0 "a least distance" $prohull cage cube.obj -o cage.obj --gap 0.00346410161 --report cage.json
is "a least distance" awk '/gap: at least/ { said = $4 + 0 } /"gap":/ && !proven { proven = $2 + 0 } END { exit !(said <= proven) }' out cage.json
for gap in 0.123 0.2 0.31 0.44; do
  expect 0 "a greatest distance" $prohull build cube.obj -o away.obj --faces 12 --gap $gap --report away.json
  is "a greatest distance" awk '/at most/ { sub(/.*at most /, ""); said = $1 + 0 } /"distance_to_triangles":/ { inside = 1 } inside && /"upper":/ { proven = $2 + 0; inside = 0 } END { exit !(said >= proven) }' out away.json
done
for factor in 1.2469135782468 1.3333333333 1.777777777777; do
  awk -v f=$factor '/^v / { printf "v %.17g %.17g %.17g\n", ($2 - 0.5) * f + 0.5, ($3 - 0.5) * f + 0.5, ($4 - 0.5) * f + 0.5; next } { print }' cube.obj >larger.obj
  for gap in 0.1 0.4; do
    $prohull verify larger.obj cube.obj --gap $gap --report larger.json >out
    is "a least distance that is an upper bound, gap $gap" awk '/least distance: at most/ { said = $NF + 0 } /"least_distance":/ { proven = $2 + 0 } END { exit !(0 < proven && proven <= said && said < 1.00001 * proven) }' out larger.json
  done
done

# --- bounds ---
expect 2 "a gap beyond the largest distance" $prohull build cube.obj -o away.obj --gap 0.2 --max-distance 0.1
says err "a gap beyond the largest distance" "the largest distance must be greater than the gap"
expect 1 "a distance with a gap" $prohull build cube.obj -o away.obj --faces 12 --gap 0.1 --max-distance 0.12 --repair none
says out "a distance with a gap" "NOT within the bounds asked for"
says out "a distance with a gap" "% of the largest distance; allow that much"
expect 1 "of two bounds the one that is missed" $prohull build cube.obj -o away.obj --faces 12 --gap 0.1 --max-distance 0.5 --max-void 1
says out "of two bounds the one that is missed" "% of the largest void; allow at least that much"
expect 0 "a distance with a gap" $prohull build cube.obj -o away.obj --faces 12 --gap 0.1 --max-distance 0.15 --report away.json
is "a distance with a gap" awk '/"distance_to_triangles":/ { inside = 1 } inside && /"upper":/ { proven = $2 + 0; inside = 0 } END { exit !(0.1 <= proven && proven <= 0.15) }' away.json
expect 0 "a void with a gap" $prohull build rock.ply -o away.obj --faces 12 --gap 0.02 --max-void 20 --report away.json
is "a void with a gap" awk '/"void_ratio":/ { void = $2 + 0 } END { exit !(0 < void && void <= 0.2) }' away.json
for command in build convex; do
  expect 3 "the void of nothing: $command" $prohull $command sheet.obj -o hull.obj --max-void 20
  says err "the void of nothing: $command" "no volume was found inside of the mesh of which the void could be a share; bound the distance instead"
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n' >leaf.obj
expect 3 "the void of a leaf" $prohull build leaf.obj -o hull.obj --max-void 20
expect 0 "pieces of a shape" $prohull convex rock.ply -o piece.urdf --pieces 4 --shape box --max-void 40
says out "pieces of a shape" "have the shape asked for; no more were found to keep the bounds"

# --- what is told of each ---
expect 0 "equal values" $prohull info cube.obj
says out "equal values" "median 0.866, 10th percentile 0.866, 1st percentile 0.866, worst 0.866"
expect 0 "notes of each hull" $prohull build tube.obj --faces 4,40 -o 'hull_{faces}.obj'
says out "notes of each hull" "no legal collapse of the repaired mesh is left at 12 faces"
expect 0 "self-intersections of the file" $prohull build twice.obj --faces 12 -o hull.obj --report twice.json
is "self-intersections of the file" awk '/"repaired_self_intersections": 0/ { repaired = 1 } /"self_intersections": [1-9]/ { given = 1 } END { exit !(repaired && given) }' twice.json

# --- spheres ---
for part in cube nested rock; do
  mesh=$(ls $part.*)
  for count in 1 2 3 5; do
    expect 0 "a share of the diagonal" $prohull spheres "$mesh" -o s.json --count $count --report spheres.json
    is "a share of the diagonal" awk '/reach out/ { said = $(NF - 4) / 100 } /"diagonal":/ { diagonal = $2 + 0 } /"distance_to_solid":/ { inside = 1 } inside && /"upper":/ { proven = $2 + 0; inside = 0 } END { exit !(said * (1 + 1e-12) >= proven / diagonal) }' out spheres.json
  done
done
expect 0 "nothing to close" $prohull spheres sheet.obj -o s.json --count 4
says_not out "nothing to close" "its openings"
says out "nothing to close" "of the diagonal, from the triangles alone"
expect 0 "a distance that is kept" $prohull spheres cube.obj -o s.json --max-distance 0.3 --count 8
says_not out "a distance that is kept" "keep a distance"
expect 1 "a distance that is not kept" $prohull spheres cube.obj -o s.json --max-distance 0.01 --count 1
says out "a distance that is not kept" "no cover by 1 sphere was found that keeps a distance of 0.01"

# --- what is refused before any work ---
expect 3 "a certificate of an inner hull" $prohull build bucket.obj --side inner --faces 60 -o inner.obj --certificate inner.phcert
says err "a certificate of an inner hull" "bucket.obj: it is not closed"
says err "a certificate of an inner hull" "prohull repair"
printf 'OFF\n0 0 0\n' >none.off
printf 'OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n' >point.off
for mesh in none.off point.off; do
  expect 3 "no size: $mesh" $prohull build $mesh --faces 60 -o hull.obj --max-distance 1
  cp err plain
  expect 3 "no size: $mesh" $prohull build $mesh --faces 60 -o hull.obj --max-distance 2%
  is "the same words of $mesh" cmp err plain
done
expect 2 "13 numbers" $prohull collide cube.obj cube.obj --pose 1,2,3,4,5,6,7,8,9,10,11,12,13
says err "13 numbers" "or 12, the upper three rows"
says_not err "an option has no lines" "line 1"

# --- robots ---
cat >links.urdf <<'EOF'
<robot name="r">
<link name="covered"><visual><geometry><box size="1 1 1"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="leaking"><visual><geometry><box size="1 1 1.5"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="undecided"><visual><geometry><cylinder radius="1" length="1"/></geometry></visual>
  <collision><origin xyz="0 0 0.25"/><geometry><cylinder radius="1" length="0.5"/></geometry></collision>
  <collision><origin xyz="0 0 -0.25"/><geometry><cylinder radius="1" length="0.5"/></geometry></collision></link>
<link name="bare"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
<joint name="a" type="fixed"><parent link="covered"/><child link="leaking"/></joint>
<joint name="b" type="fixed"><parent link="covered"/><child link="undecided"/></joint>
<joint name="c" type="fixed"><parent link="covered"/><child link="bare"/></joint>
</robot>
EOF
counts="1 link covered, 1 leaking, 1 undecided, 1 without collision geometry"
expect 1 "links are counted" $prohull urdf --check links.urdf
says out "links are counted" "NO: $counts; "
$prohull urdf links.urdf -o links_safe --faces 50 >out 2>err
says out "links are counted in one way" "shipped collision geometry: $counts; the worst is leaking"
cat >robot.urdf <<'EOF'
<robot name="r"><link name="a">
  <visual><geometry><mesh filename="nowhere.stl"/></geometry></visual>
  <collision><geometry><box size="1 1 1"/></geometry></collision>
</link></robot>
EOF
expect 1 "a mesh that is missing" $prohull urdf --check robot.urdf
says out "a mesh that is missing" "NO: 0 links covered, 1 not checked"
says_not out "a mesh that is missing" "makes collision meshes"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n' >flat.obj
cat >robot.urdf <<'EOF'
<robot name="r">
  <link name="a"><visual><origin rpy="0.3 0.1 0.2"/><geometry><mesh filename="flat.obj"/></geometry></visual></link>
  <link name="b"><visual><geometry><mesh filename="tube.obj"/></geometry></visual></link>
  <link name="c"><visual><geometry><mesh filename="soup.obj"/></geometry></visual></link>
  <joint name="ab" type="fixed"><parent link="a"/><child link="b"/></joint>
  <joint name="bc" type="fixed"><parent link="b"/><child link="c"/></joint>
</robot>
EOF
while read -r corners; do
  printf 'v %s %s %s\nv %s %s %s\nv %s %s %s\nf -3 -2 -1\n' $corners
done >soup.obj <<'EOF'
0.54 0.42 0.69 0.20 0.88 0.03 0.67 0.42 0.56
0.14 0.20 0.80 0.97 0.31 0.69 0.88 0.89 0.09
0.69 0.83 0.02 0.75 0.99 0.75 0.28 0.79 0.10
0.45 0.91 0.29 0.29 0.13 0.02 0.68 0.21 0.27
0.41 0.05 0.54 0.66 0.51 0.94 0.59 0.90 0.14
0.14 0.81 0.40 0.17 0.93 0.35 0.75 0.73 0.88
EOF
expect 0 "a robot of loose triangles" $prohull urdf robot.urdf --faces 40 -o robot
is "a flat link is no share of its convex hull" awk '$1 == "a" && $5 == "-" { found = 1 } END { exit !found }' out
says out "an estimated part" "~: the volume of the part is estimated"
is "an estimated part" awk '$1 == "c" && $4 == "~" { found = 1 } END { exit !found }' out
is "a part that is closed by caps is not estimated" awk '$1 == "b" && $4 != "~" { found = 1 } END { exit !found }' out
says robot/report.json "an estimated part" '"sealed_volume_is_estimated": true'

# --- numbers of things ---
expect 0 "one point" $prohull contains cube.obj --random 1
says out "one point" "1 random point, seed 1"
# --- the record ---
# The names in each verdict of a report, in one line.
keys_of() {
  awk '{ indent = match($0, /[^ ]/) } /"verdict": \{/ { inside = indent; next }
    inside && indent <= inside { print ""; inside = 0 } inside && indent == inside + 2 && /":/ { printf "%s ", $1 }' "$1" | sort -u
}
expect 0 "the record: verify" $prohull verify cube.obj cube.obj --report verify.json
record=$(keys_of verify.json)
is "the record has its keys" test "$record" = '"cap_faces": "certified": "covers_triangles": "distance_to_solid": "distance_to_triangles": "encloses_solid": "gap": "non_finite_faces": "original_closed": "proof": "side": "why_not": '
$prohull sample mobile-base -o base >out
while read -r product arguments; do
  expect 0 "the record: $product" $prohull $arguments --report $product.json
  is "the record: $product" test "$(keys_of $product.json)" = "$record"
done <<END
build build cube.obj -o r.obj --hierarchy r.phull
cage cage cube.obj -o r.obj --inner i.obj
convex convex cube.obj -o r.obj
spheres spheres cube.obj -o r.json --count 8
sweep sweep cube.obj -o r.obj --angle 10
lod lod r.phull -o r.obj
repair repair cube.obj -o r.obj
union verify --union cube.obj cube.obj
END
expect 0 "the record: urdf" $prohull urdf base/mobile-base.urdf -o base_safe --faces 40 --configurations 0 --no-pictures
is "the record: urdf" test "$(keys_of base_safe/report.json)" = "$record"
says spheres.json "what was not asked is null" '"encloses_solid": null'
says verify.json "what was not measured is null" '"distance_to_triangles": null'

# --- a budget of steps ---
$prohull sample knot -o knot.obj --faces 200 >out
awk '/^v / { print "v", $2 + 0.05, $3, $4 }' knot.obj >moved.obj
awk '/^f / { print "f", $2 + '"$(grep -c '^v ' knot.obj)"', $3 + '"$(grep -c '^v ' knot.obj)"', $4 + '"$(grep -c '^v ' knot.obj)"' }' knot.obj >faces.obj
{ grep '^v ' knot.obj; cat moved.obj; grep '^f ' knot.obj; cat faces.obj; } >tangled.obj
expect 0 "itself" $prohull verify tangled.obj tangled.obj --steps 1
expect 0 "as many steps as it takes" $prohull verify tangled.obj knot.obj
expect 4 "too few steps" $prohull verify tangled.obj knot.obj --steps 1 --report verify.json
says out "too few steps" "UNDECIDED: tangled.obj may enclose knot.obj: the search was ended before "
says verify.json "too few steps" '"encloses_solid": null'
says verify.json "too few steps" '"certified": false'
$prohull sample sphere -o ball.obj --faces 300 >out
expect 0 "a hull with a gap" $prohull build ball.obj -o far.obj --faces 100 --gap 1%
expect 0 "as many steps as it takes" $prohull verify far.obj ball.obj --gap 1%
expect 4 "too few steps for a gap" $prohull verify far.obj ball.obj --gap 1% --steps 100 --report verify.json
says out "too few steps for a gap" "UNDECIDED: far.obj encloses ball.obj, and may keep the gap of "
says verify.json "too few steps for a gap" '"keeps_gap": null'
expect 1 "one face that is too near" $prohull verify far.obj ball.obj --gap 50% --steps 100
$prohull sample torus -o ring.obj --faces 300 >out
expect 0 "spheres" $prohull spheres ring.obj -o balls.yaml --count 8
expect 4 "too few steps for spheres" $prohull verify --union balls.yaml ring.obj --steps 1
says out "too few steps for spheres" "UNDECIDED: it is undecided whether the balls cover all of "


# --- what is inside out, and what does not enclose ---
awk '/^f/ { print $1, $2, $4, $3; next } 1' cube.obj >turned.obj
{
  grep '^v' cube.obj
  awk '/^v / { print "v", 0.5 + $2, 0.5 + $3, 0.5 + $4 }' cube.obj
  grep '^f' cube.obj
  awk '/^f / { print "f", $2 + 8, $4 + 8, $3 + 8 }' cube.obj
} >crossing.obj
said="the component of face 12 of crossing.obj is inside out and crosses or repeats others: it was turned"
awk '/^v / { print "v", 1.2 + 0.1 * $2, 1.2 + 0.1 * $3, 1.2 + 0.1 * $4; next } 1' cube.obj >inner.obj
expect 1 "what crosses others inside out" $prohull collide crossing.obj inner.obj
says out "what crosses others inside out" "$said"
expect 1 "what crosses others inside out, conservatively" $prohull collide crossing.obj inner.obj --conservative
printf '1.25,1.25,1.25\n0.25,0.25,0.25\n0.75,0.75,0.75\n' >inside.csv
expect 0 "what crosses others inside out, points" $prohull contains crossing.obj --points inside.csv --report crossing.json
says out "what crosses others inside out, points" "3 of 3 points inside"
says crossing.json "what crosses others inside out, in the report" "$said"
expect 3 "what is not closed has a name" $prohull collide cube.obj bucket.obj --conservative
says err "what is not closed has a name" "bucket.obj: it is not closed"
expect 0 "an inner hierarchy" $prohull build rock.ply --side inner --faces 100 -o inner.obj --hierarchy inner.phull
expect 2 "an inner hierarchy" $prohull collide inner.phull cube.obj --conservative
says err "an inner hierarchy" "prohull: inner.phull: it holds inner hulls"

# --- numbers that look the same ---
awk '/^v / { print "v", 0.25 + 0.5 * $2, 0.25 + 0.5 * $3, 0.25 + 0.5 * $4; next } 1' cube.obj >core.obj
expect 1 "a gap that is hardly kept" $prohull verify cube.obj core.obj --gap 0.2500000000001
says out "a gap that is hardly kept" "does not keep the gap of 0.2500000000001"
says_not out "a gap that is hardly kept" "does not keep the gap of 0.25:"
expect 1 "a hull in the midst" $prohull verify core.obj cube.obj --report verify.json
says verify.json "a hull in the midst has no cavity" '"cavities": 0'
expect 0 "one face" $prohull render triangle.obj -o triangle.png
says out "one face" ", 1 face, "
expect 2 "help of no command" $prohull help nope
says err "help of no command" "\`prohull help\` shows all commands"
expect 0 "help of build" $prohull help build
says_not out "help of build: options of --all" "--recenter"
