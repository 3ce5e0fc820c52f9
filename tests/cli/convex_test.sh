# Drives `prohull convex`, and `prohull render` of what it writes, as a user would
$prohull sample bracket --faces 300 -o part.stl >/dev/null
convex="$prohull convex part.stl --pieces 4 --vertices 24"

# --- one file with all pieces ---
expect 0 "OBJ" $convex -o a.obj --report a.json
says out "OBJ: the summary" "of at most"
says out "OBJ: the summary" "which reach out by at most"
says out "OBJ: the summary" "certified: yes, the union of the pieces as written encloses the original"
says a.json "the report" '"certified": true'
says a.json "the report" '"a.obj"'
says a.obj "an object for each piece" "o a_01"
pieces=$(grep -c '^o a_0[1-4]$' a.obj)
is "an object for each piece" test "$pieces" -ge 2
says out "an object for each piece" "a.obj: $pieces convex pieces"
is "the report counts the same" test "$(grep -c '"shape": "polytope"' a.json)" -eq $((pieces + 1))
expect 0 "the verifier agrees" $prohull verify a.obj part.stl
expect 0 "GLB" $convex -o a.glb
expect 0 "the verifier agrees on GLB" $prohull verify a.glb part.stl
expect 0 "one thread" $convex -o one_thread.obj --threads 1
sed 's/^o one_thread/o a/' one_thread.obj >renamed.obj
is "one thread makes the same pieces" cmp renamed.obj a.obj
expect 0 "standard output" $convex -o - --out-format obj
sed 's/^o piece/o a/' out >renamed.obj
is "standard output gets the same pieces" cmp renamed.obj a.obj
says err "standard output leaves the summary to standard error" "certified: yes"
expect 0 "standard input" sh -c "$prohull convex - --pieces 4 --vertices 24 -o b.obj -q <part.stl"
is "quiet" test ! -s out
expect 0 "a unit" $prohull convex part.stl --pieces 2 --unit mm -o metres.obj
expect 0 "a unit is read as metres" $prohull verify metres.obj part.stl --unit mm

# --- a file for each piece ---
for suffix in stl ply off; do
  touch "p_99.$suffix" "p_x.$suffix"
  expect 0 "$suffix" $convex -o p.$suffix --report p.json
  says out "$suffix: what else looks like a piece" "p_99.$suffix; remove"
  says p.json "$suffix: what else looks like a piece" "\"p_99.$suffix\""
  is "$suffix: and it stays" test -e p_99.$suffix
  rm p_99.$suffix p_x.$suffix
  is "$suffix: a file for each piece" test "$(ls p_0[1-4].$suffix | wc -l)" -eq "$pieces"
  absent p.$suffix "$suffix: no file for all"
  for piece in p_0*.$suffix; do
    expect 0 "$suffix: $piece" $prohull info $piece
    says out "$suffix: $piece is closed" "closed 2-manifold"
  done
done
expect 0 "one piece" $prohull convex part.stl --pieces 1 --vertices 16 -o one.stl
is "one piece has the name that was said" test -s one.stl
absent "one_*.stl" "one piece has no number"
expect 0 "one piece covers" $prohull verify one.stl part.stl
expect 1 "bounds that cannot be kept" $prohull convex part.stl --pieces 1 --max-distance 1e-6 -o far.obj
says out "bounds that cannot be kept" "NOT within the bounds asked for"
is "what misses bounds is written" test -s far.obj

printf 'OFF\n5 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nnan 0 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 1 4\n' >nan.off
expect 0 "a corner that is no number" $prohull convex nan.off --pieces 1 -o nan.obj
says out "a corner that is no number" "triangles with corners that are not finite were left out: 1"

# --- robot files ---
for suffix in urdf xml; do
  rm -f r_*.stl
  expect 0 "$suffix" $convex -o r.$suffix
  is "$suffix: STL files" test "$(ls r_0[1-4].stl | wc -l)" -eq "$pieces"
  says r.$suffix "$suffix names them" '"r_01.stl"'
  expect 0 "$suffix can be drawn" $prohull render r.$suffix --size 40x30 -o r.png
  for shape in box capsule sphere; do
    expect 0 "$suffix of shape $shape" $convex --shape $shape -o s.$suffix --report s.json
    says s.json "$suffix of shape $shape" "\"shape\": \"$shape\""
    says s.json "$suffix of shape $shape has no float32 to pay for" '"float32_coordinates": false'
    says s.json "$suffix of shape $shape is not read again" '"shapes_by_construction": true'
    says out "$suffix of shape $shape is not read again" "which lie in the shapes as written by construction, encloses"
    absent "s_*.stl" "$suffix of shape $shape needs no meshes"
    expect 0 "$suffix of shape $shape can be drawn" $prohull render s.$suffix --size 40x30 -o s.png
  done
  rm s.$suffix
done
says s.json "spheres larger than the convex hull, in the report" "times the volume of the convex hull of the whole mesh"
says r.xml "MJCF" '<geom name="r_01"'
if command -v check_urdf >/dev/null; then
  expect 0 "urdfdom reads it" check_urdf r.urdf
fi
expect 0 "boxes as meshes" $convex --shape box -o boxes.obj
# Of a needle the rounding of corners to float32 would be most of the volume.
printf 'OFF\n8 6 0\n0 0 0\n1 0 0\n1 1e-7 0\n0 1e-7 0\n0 0 1e-7\n1 0 1e-7\n1 1e-7 1e-7\n0 1e-7 1e-7\n' >needle.off
printf '4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n' >>needle.off
expect 0 "boxes as they are written" $prohull convex needle.off --shape box --max-void 20 -o needle.xml --report needle.json
says out "boxes as they are written" "needle.xml: 1 box,"
is "boxes as they are written" awk -F'"' '/type="box"/ { split($14, h, " "); box = 8 * h[1] * h[2] * h[3] }
  /"volume":/ { split($0, v, /[:,]/); said = v[2] } END { exit !(box > 0 && said < box * 1.000001 && said > box * 0.999999) }' needle.xml needle.json
expect 0 "boxes as meshes cover" $prohull verify boxes.obj part.stl

# --- for an engine ---
$prohull sample sphere --faces 3000 -o ball.stl >/dev/null
# limits ENGINE VERTICES POLYGONS: counted in the files by prohull info
limits() {
  rm -f e_*.ply
  expect 0 "for $1" $prohull convex ball.stl --pieces 3 --vertices 1000 --for "$1" -o e.ply
  says out "for $1" "for $1: pieces as written have at most"
  for piece in e_0*.ply; do
    $prohull info "$piece" --report piece.json >/dev/null
    is "for $1: vertices of $piece" test "$(sed -n 's/^ *"vertices": \([0-9]*\),*$/\1/p' piece.json | head -n 1)" -le "$2"
    is "for $1: polygons of $piece" test "$(sed -n 's/^ *"faces": \([0-9]*\),*$/\1/p' piece.json | head -n 1)" -le "$3"
  done
}
limits physx 64 255
says out "for physx" "64 vertices (limit 64) and 124 polygons (limit 255)"
is "for physx: float32 coordinates" grep -aq "property float x" e_01.ply
limits physx-gpu 33 64
expect 0 "for unity" $prohull convex ball.stl --pieces 1 --vertices 1000 --for unity -o e.obj --report e.json
says out "for unity" "127 vertices and 250 polygons (limit 255)"
says e.json "for unity, in the report" '"polygons": 250'
says e.json "for unity, in the report" '"for": "unity"'
expect 0 "for unreal" $convex --for unreal -o e.obj
says e.obj "for unreal: named as the mesh" "o UCX_part_01"
expect 0 "for unreal, from standard input" sh -c "$prohull convex - --pieces 1 --for unreal -o e.obj <part.stl"
says e.obj "for unreal: named as the output" "o UCX_e"
expect 0 "for godot" $convex --for godot -o e.glb
is "for godot: names" grep -aq '"e_02-convcolonly"' e.glb
expect 0 "for godot: covers" $prohull verify --union e.glb part.stl
expect 0 "for bullet" $convex --for bullet -o e.urdf
expect 0 "for mujoco" $convex --for mujoco -o e.xml
expect 0 "for mujoco: boxes have no vertices to count" $convex --for mujoco --shape box -o e.xml
is "for mujoco: boxes have no vertices to count, said" test "$(grep -c "as written have" out)" = 0

printf 'OFF\n4 4 0\n9999 0 0\n9999.2 0 0\n9999 0.1 0\n9999 0 0.1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >off.off
expect 0 "boxes need no float32" $prohull convex off.off --pieces 1 --shape box -o off.urdf
expect 3 "polytopes beside boxes do" $prohull convex off.off --pieces 1 --shape box --max-void 900 -o off.urdf

# --- pictures ---
expect 0 "exploded" $prohull render part.stl a.obj --explode none --explode 0.3 --size 80x30 -o exploded.png
expect 0 "not exploded" $prohull render part.stl a.obj --size 80x30 -o together.png
is "an exploded view shows something else" sh -c "! cmp -s exploded.png together.png"
expect 0 "coloured over the original" $prohull render a.obj --explode 0 --over part.stl --size 40x30 -o over.png
expect 0 "an exploded robot" $prohull render r.urdf --explode 1 --size 40x30 -o robot.png
for factor in -1 101 nan 1x ""; do
  expect 2 "exploded by '$factor'" $prohull render a.obj --explode "$factor" -o wrong.png
  says err "exploded by '$factor'" "between 0 and 100"
done
expect 2 "two factors, three panels" $prohull render a.obj a.obj a.obj --explode 1 --explode 2 -o wrong.png
cat >spheres.yaml <<'YAML'
collision_spheres:
  r:
    - {center: [0.0, 0.0, 0.0], radius: 1.0}
    - {center: [2.0, 1.0, 0.0], radius: 1.5}
YAML
expect 0 "spheres" $prohull render spheres.yaml --size 40x30 -o spheres.png
expect 0 "spheres over a mesh" $prohull render spheres.yaml --over part.stl --size 40x30 -o spheres_over.png
is "spheres over a mesh show it" sh -c "! cmp -s spheres.png spheres_over.png"
expect 0 "spheres over a robot" $prohull render spheres.yaml --over r.urdf --size 40x30 --explode 0 -o spheres.png
sed 's/^  r:/  other:/' spheres.yaml >other.yaml
expect 3 "spheres of a link that is not there" $prohull render other.yaml --over r.urdf -o wrong.png
says err "spheres of a link that is not there" "other.yaml: the robot 'r' has no link 'other'"
printf '  other:\n    - {center: [0.0, 0.0, 0.0], radius: 1.0}\n' >>spheres.yaml
expect 2 "spheres of two links without a robot" $prohull render spheres.yaml -o wrong.png
says err "spheres of two links without a robot" "--over ROBOT"
expect 2 "spheres split" $prohull render spheres.yaml --split part.stl -o wrong.png
echo 'collision_spheres: {}' >none.yaml
expect 3 "no spheres" $prohull render none.yaml -o wrong.png
echo 'nothing: 1' >broken.yaml
expect 3 "a file of something else" $prohull render broken.yaml -o wrong.png
absent wrong.png "what is refused"

# --- what is refused, and leaves nothing ---
# refused EXIT_CODE NAME SAYS ARGUMENTS...
refused() {
  code=$1 name=$2 text=$3
  shift 3
  expect "$code" "$name" "$prohull" convex "$@"
  says err "$name" "$text"
  is "$name: one line" test "$(wc -l <err)" -eq 1
  absent "wrong* .wrong*" "$name"
}
refused 2 "another suffix" ".glb" part.stl -o wrong.step
refused 2 "several files to standard output" "obj or glb" part.stl -o -
refused 2 "several files to standard output, said" "one file" part.stl -o - --out-format stl
refused 2 "a format that the engine does not read" "for unity are not written to .glb files; name the file .obj" part.stl --for unity -o wrong.glb
refused 2 "a format that the engine does not read, said" "written to .glb" part.stl --for godot -o - --out-format obj
refused 2 "an engine of several files, to standard output" "for mujoco are not written to standard output" part.stl --for mujoco -o -
expect 2 "another engine" $prohull convex part.stl --for gazebo -o wrong.obj
says err "another engine" "--for must be physx, physx-gpu, unity"
refused 2 "spheres in a mesh file" ".urdf or .xml" part.stl --shape sphere -o wrong.obj
refused 2 "a piece over the input" "named twice" r_01.stl -o r.stl
refused 2 "a report over a piece" "named twice" part.stl -o wrong.stl --report wrong_02.stl
refused 3 "a folder that is not there" "there is no folder" part.stl -o wrong/a.obj
refused 3 "no file" "nowhere.ply" nowhere.ply -o wrong.obj
head -c 200 part.stl >truncated.stl
refused 3 "a truncated file" "truncated.stl: " truncated.stl -o wrong.stl
printf 'OFF\n0 0 0\n' >empty.off
refused 3 "no triangles" "empty.off: " empty.off -o wrong.urdf
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n' >nan.off
refused 3 "no finite triangle" "nan.off: " nan.off -o wrong.xml
printf 'OFF\n3 1 0\n1e9 0 0\n1000000001 0 0\n1e9 1 0\n3 0 1 2\n' >far.off
refused 3 "too far away for float32" "float32" far.off -o wrong.stl
for wrong in "--pieces 0" "--pieces 1001" "--vertices 3" "--max-distance 0" "--max-void -1" "--shape cone"; do
  # shellcheck disable=SC2086
  expect 2 "$wrong" $prohull convex part.stl -o wrong.obj $wrong
done
absent "wrong*" "wrong usage"
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >triangle.off
expect 0 "one triangle" $prohull convex triangle.off -o triangle.obj
says out "one triangle" "certified: yes"
mkdir closed && chmod 555 closed
if [ ! -w closed ]; then
  expect 3 "a folder that takes no files" $convex -o closed/a.stl
  says err "a folder that takes no files" "choose another folder"
fi

# --- names that hurt ---
hostile='o "x" <&>é;touch bad; .v2'
expect 0 "a hostile name of an OBJ" $convex -o "$hostile.obj"
expect 0 "a hostile name of a GLB" $convex -o "$hostile.glb"
expect 0 "a hostile name of a robot" $convex -o "$hostile.urdf"
is "a hostile name of pieces" test -s "${hostile}_01.stl"
expect 0 "a hostile name can be drawn" $prohull render "$hostile.urdf" --size 40x30 -o drawn.png
absent bad "a hostile name is no command"
line='two
lines'
expect 0 "two lines in the name of an OBJ" $convex -o "$line.obj"
says "$line.obj" "two lines in the name of an OBJ" "o two_lines_01"
expect 2 "two lines in the name of a robot" $convex -o "$line.urdf"
says err "two lines in the name of a robot" "control characters"

# --- the examples of --help run ---
mkdir examples && cd examples || exit 1
$prohull sample bracket --faces 300 -o arm.stl >/dev/null
cp arm.stl pump.stl
mkdir parts && cp arm.stl parts/
$prohull sample bracket --faces 300 -o horse.ply >/dev/null
$prohull help convex | sed -n '/^Examples:/,$p' | grep '^  prohull convex' >lines
is "there are examples" test "$(wc -l <lines)" -ge 5
while read -r _ arguments; do
  $prohull $arguments >out 2>err </dev/null
  code=$?
  is "example: prohull $arguments: exit code $code" test $code -le 1
done <lines
is "examples write files" test -s horse_pieces.obj
cd ..

# --- Ctrl-C ---
$prohull sample knot --faces 300000 -o big.ply >/dev/null
$prohull convex big.ply -o interrupted.stl >out 2>err &
sleep 1
kill -INT $!
wait $!
code=$?
is "Ctrl-C: exit code $code" test $code -eq 130
says err "Ctrl-C" "interrupted"
absent "interrupted* .interrupted*" "Ctrl-C"
